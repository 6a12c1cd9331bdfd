// SPDX-License-Identifier: MIT
#include "rebound/mpi/bake_crew.hpp"

#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <utility>

namespace rebound {

struct MpiBakeCrew::State {
    MPI_Comm processes = MPI_COMM_NULL;
    int rank = 0, count = 1;
    bool endsMpi = false;
    BakePartFolder* kept = nullptr;
    std::optional<Error> failure; // on which all have agreed
};

namespace {

Result<> succeeded(int code, const char* what) {
    if (code == MPI_SUCCESS) return {};
    char text[MPI_MAX_ERROR_STRING] = "";
    int length = 0;
    MPI_Error_string(code, text, &length);
    std::string reason(text, size_t(length));
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    return Error{ErrorCode::inputOutput, std::string(what) + " failed between processes: " + reason};
}

} // namespace

bool MpiBakeCrew::isStartedByMpi() {
    // Open MPI, and those that descend from MPICH.
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
        if (const char* value = std::getenv(name); value && std::atoi(value) > 1) return true;
    return false;
}

Result<std::unique_ptr<MpiBakeCrew>> MpiBakeCrew::join() {
    auto state = std::make_unique<State>();
    int isStarted = 0, isEnded = 0;
    MPI_Initialized(&isStarted);
    MPI_Finalized(&isEnded);
    if (isEnded)
        return Error{ErrorCode::unsupported, "MPI has ended in this process; it cannot be started again"};
    if (!isStarted) {
        int granted = MPI_THREAD_SINGLE;
        if (auto begun =
                succeeded(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &granted), "MPI_Init");
            !begun)
            return begun.error();
        state->endsMpi = true;
    }
    // A communicator of its own: neither messages nor settings meet those of a host.
    if (auto made = succeeded(MPI_Comm_dup(MPI_COMM_WORLD, &state->processes), "MPI_Comm_dup"); !made)
        return made.error();
    MPI_Comm_set_errhandler(state->processes, MPI_ERRORS_RETURN);
    MPI_Comm_rank(state->processes, &state->rank);
    MPI_Comm_size(state->processes, &state->count);
    return std::unique_ptr<MpiBakeCrew>(new MpiBakeCrew(std::move(state)));
}

MpiBakeCrew::MpiBakeCrew(std::unique_ptr<State> s) : state(std::move(s)) {}

MpiBakeCrew::~MpiBakeCrew() {
    if (std::uncaught_exceptions() > 0) MPI_Abort(state->processes, 2); // the others would wait for ever
    MPI_Comm_free(&state->processes);
    if (state->endsMpi) MPI_Finalize();
}

int MpiBakeCrew::rank() const { return state->rank; }
int MpiBakeCrew::processes() const { return state->count; }
void MpiBakeCrew::keepIn(BakePartFolder* folder) { state->kept = folder; }

Result<> MpiBakeCrew::agree(const Result<>& own) {
    if (state->failure) return *state->failure;
    const int mine = own ? state->count : state->rank;
    int first = mine;
    if (auto met =
            succeeded(MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, state->processes), "MPI_Allreduce");
        !met) {
        state->failure = met.error();
        return met;
    }
    if (first == state->count) return {};
    Error error;
    if (first == state->rank) error = own.error();
    int head[2] = {int(error.code), int(error.message.size())};
    auto told = succeeded(MPI_Bcast(head, 2, MPI_INT, first, state->processes), "MPI_Bcast");
    error.code = ErrorCode(head[0]);
    error.message.resize(size_t(std::max(head[1], 0)));
    if (told)
        told = succeeded(MPI_Bcast(error.message.data(), head[1], MPI_CHAR, first, state->processes),
                         "MPI_Bcast");
    if (!told) error = told.error();
    // What fails in process 0 is as a single process would say it.
    else if (first > 0)
        error.message = "process " + std::to_string(first) + " of " + std::to_string(state->count) +
                        " failed: " + error.message;
    state->failure = error;
    return error;
}

// A process with other instructions may round otherwise; its parts would not fit those of the others.
Result<> MpiBakeCrew::agreeOnTask(const BakeTask& task) {
    if (auto ready = agree({}); !ready) return ready;
    std::array<uint32_t, 4> key = task.key;
    if (auto told = succeeded(MPI_Bcast(key.data(), 4, MPI_UINT32_T, 0, state->processes), "MPI_Bcast");
        !told)
        return agree(told);
    if (key == task.key) return agree({});
    return agree(Error{ErrorCode::invalidData,
                       "it has prepared another geometry, tree or caches for the " + std::string(task.name) +
                           " than process 0; the same program, scene and kind of processor were expected"});
}

Result<BakeParts> MpiBakeCrew::run(const BakeTask& task, int threads, const BakeProgress& progress) {
    if (auto same = agreeOnTask(task); !same) return same.error();
    std::vector<uint32_t> numbers;
    for (uint32_t p = uint32_t(state->rank); p < task.parts; p += uint32_t(state->count))
        numbers.push_back(p);
    auto own = doBakeParts(task, numbers, threads, state->kept, progress);
    if (auto all = agree(own ? Result<>() : Result<>(own.error())); !all) return all.error();
    if (state->rank == 0) return collect(task, *std::move(own));
    if (auto given = handOver(numbers, *own); !given) return given.error();
    return BakeParts();
}

Result<BakeParts> MpiBakeCrew::collect(const BakeTask& task, BakeParts own) {
    BakeParts all(task.parts);
    for (uint32_t p = 0; p < task.parts; ++p) {
        const int from = int(p % uint32_t(state->count));
        if (from == 0) {
            all[p] = std::move(own[p / uint32_t(state->count)]);
            continue;
        }
        MPI_Status status;
        int length = 0;
        Result<> got = succeeded(MPI_Probe(from, int(p), state->processes, &status), "MPI_Probe");
        if (got) got = succeeded(MPI_Get_count(&status, MPI_UINT32_T, &length), "MPI_Get_count");
        if (!got) return got.error();
        all[p].resize(size_t(std::max(length, 0)));
        got = succeeded(
            MPI_Recv(all[p].data(), length, MPI_UINT32_T, from, int(p), state->processes, MPI_STATUS_IGNORE),
            "MPI_Recv");
        if (!got) return got.error();
    }
    return all;
}

Result<> MpiBakeCrew::handOver(const std::vector<uint32_t>& numbers, const BakeParts& parts) {
    for (size_t i = 0; i < parts.size(); ++i)
        if (auto sent = succeeded(MPI_Send(parts[i].data(), int(parts[i].size()), MPI_UINT32_T, 0,
                                           int(numbers[i]), state->processes),
                                  "MPI_Send");
            !sent)
            return sent;
    return {};
}

} // namespace rebound
