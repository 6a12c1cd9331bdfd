// SPDX-License-Identifier: MIT
// The program itself: its picture, and how it refuses.
#include "../engine/program.hpp"

namespace rebound::engine {

const TestedProgram program{"REBOUND_VULKAN_ENGINE", "rebound_vulkan_engine"};

TEST_CASE("a picture of a built-in scene, with validation on") { checkPicture(program); }
TEST_CASE("a window, with validation on, where there is a display") { checkWindow(program); }
TEST_CASE("what it, or the machine, cannot do ends in one sentence and exit code 2") {
    checkRefusals(program);
}

} // namespace rebound::engine
