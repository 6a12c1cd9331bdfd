// SPDX-License-Identifier: MIT
#include "lab/charts/gnuplot.hpp"

#include "lab/files/run_program.hpp"

namespace rebound::charts {

namespace fs = std::filesystem;

Result<fs::path> findGnuplot() {
    if (const auto program = lab::findProgram("gnuplot")) return *program;
    return Error{
        ErrorCode::notFound,
        "the program gnuplot, which draws the charts, is not in PATH; Debian's package is gnuplot-nox"};
}

Result<> runGnuplot(const fs::path& program, const fs::path& script) {
    // Its complaints begin with lines that quote the script and mark a place in it.
    if (auto drawn = lab::runProgram(program, {script.string()}, " \t^"); !drawn)
        return Error{ErrorCode::unsupported, "gnuplot could not draw the charts: " + drawn.error().message};
    return {};
}

} // namespace rebound::charts
