// SPDX-License-Identifier: MIT
// The program itself: its picture, and how it refuses.
#include "../engine/program.hpp"

namespace rebound::engine {

const TestedProgram program{"REBOUND_OPENGL_ENGINE", "rebound_opengl_engine"};

TEST_CASE("a picture of a built-in scene, with debug output on") { checkPicture(program); }
TEST_CASE("a window, with debug output on, where there is a display") { checkWindow(program); }
TEST_CASE("what it, or the machine, cannot do ends in one sentence and exit code 2") {
    checkRefusals(program);
}

} // namespace rebound::engine
