// SPDX-License-Identifier: MIT
// Who bakes for the command line: this process, or all of those that mpirun has started.
#pragma once

#include "rebound/bake/bake_crew.hpp"

#include <memory>

namespace rebound::cli {

class BakeWorkers {
public:
    virtual ~BakeWorkers() = default;

    // kept: finished parts; null: they are not kept. It has to outlive the crew.
    virtual BakeCrew& crew(BakePartFolder* kept) = 0;
    // Succeeds where every process hands in success; a process that stops before or after baking calls it.
    virtual Result<> agree(const Result<>& own) = 0;
    // Whether the bake is another process's to write, and errors another's to print.
    virtual bool helpsOnly() const = 0;
    virtual int processes() const = 0;
};

// Fails where mpirun has started several processes, and this program knows nothing of MPI.
Result<std::unique_ptr<BakeWorkers>> bakeWorkers();

} // namespace rebound::cli
