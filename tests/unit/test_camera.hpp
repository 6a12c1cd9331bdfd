// SPDX-License-Identifier: MIT
#pragma once

#include "lab/scenes/camera_conventions.hpp"

namespace rebound::test {
using namespace lab;
}
