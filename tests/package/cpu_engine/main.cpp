// SPDX-License-Identifier: MIT
#include <rebound/cpu/device.hpp>
#include <rebound/techniques/screen_indirect.hpp>

int main() {
    const auto settings = rebound::screenIndirectPreset("quarter-64", {64, 36});
    if (!settings) return 1;
    const auto plan = rebound::planScreenIndirect(*settings);
    const auto device = rebound::cpu::Device::create();
    return plan && device && device->compile(*plan) ? 0 : 1;
}
