// SPDX-License-Identifier: MIT
#pragma once

#include "lab/camera_conventions.hpp"

namespace rebound::test {
using namespace lab;
}
