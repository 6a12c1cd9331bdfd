// SPDX-License-Identifier: MIT
// Bakes by many processes on many machines, which mpirun starts.
#pragma once

#include "rebound/bake/bake_crew.hpp"
#include "rebound/bake/part_folder.hpp"
#include "rebound/result.hpp"

#include <memory>
#include <vector>

namespace rebound {

// All processes of MPI_COMM_WORLD. Part p is done by process p modulo their number; process 0 gets what all parts have
// given, in their order. All calls are made by one thread, the one that joined, and every process makes the same ones.
class MpiBakeCrew : public BakeCrew {
public:
    // Whether mpirun has started this process as one of several.
    static bool isStartedByMpi();

    // Starts MPI, where the host has not. Fails where that fails, or a second one is made.
    static Result<std::unique_ptr<MpiBakeCrew>> join();
    // Ends MPI, if join() has started it: waits for the others. Where an exception is on its way, ends all processes.
    ~MpiBakeCrew() override;
    MpiBakeCrew(const MpiBakeCrew&) = delete;
    MpiBakeCrew& operator=(const MpiBakeCrew&) = delete;

    int rank() const;      // 0 to processes() - 1
    int processes() const; // at least 1

    // Finished parts are kept in this folder, which has to outlive the crew, from now on; null: nowhere. Best one that all
    // machines share: then any number of processes takes up what fewer or more of them have left.
    void keepIn(BakePartFolder*);

    // Succeeds where every process hands in success. Else everyone gets the error of the first that failed, which names it,
    // then and whenever this is called again. A process that cannot go on to run() calls this instead.
    Result<> agree(const Result<>& own);

    // Nothing in processes but 0. Fails where a process has prepared another task than process 0, as it is of another kind.
    Result<BakeParts> run(const BakeTask&, int threads, const BakeProgress&) override;

private:
    struct State;
    explicit MpiBakeCrew(std::unique_ptr<State>);
    Result<> agreeOnTask(const BakeTask&);
    Result<BakeParts> collect(const BakeTask&, BakeParts own);
    Result<> handOver(const std::vector<uint32_t>& numbers, const BakeParts&);

    std::unique_ptr<State> state;
};

} // namespace rebound
