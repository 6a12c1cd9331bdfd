// SPDX-License-Identifier: MIT
#include "../device_main.hpp"

#include "lab/host/vulkan_context.hpp"

int main(int count, char** arguments) {
    rebound::host::VulkanOptions options;
    options.validation = true;
    const std::string why = rebound::test::whyMissing(rebound::host::VulkanContext::create(options));
    return rebound::test::runUnlessMissing(why, count, arguments);
}
