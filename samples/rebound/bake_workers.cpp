// SPDX-License-Identifier: MIT
#include "bake_workers.hpp"

#ifdef REBOUND_HAS_MPI
#include "rebound/mpi/bake_crew.hpp"
#endif

#include <cstdlib>
#include <optional>
#include <utility>

namespace rebound::cli {

namespace {

class OneProcess : public BakeWorkers {
public:
    BakeCrew& crew(BakePartFolder* kept) override { return alone.emplace(kept); }
    Result<> agree(const Result<>& own) override { return own; }
    bool helpsOnly() const override { return false; }
    int processes() const override { return 1; }

private:
    std::optional<LocalBakeCrew> alone;
};

#ifdef REBOUND_HAS_MPI
class ManyProcesses : public BakeWorkers {
public:
    explicit ManyProcesses(std::unique_ptr<MpiBakeCrew> joined) : all(std::move(joined)) {}
    BakeCrew& crew(BakePartFolder* kept) override {
        all->keepIn(kept);
        return *all;
    }
    Result<> agree(const Result<>& own) override { return all->agree(own); }
    bool helpsOnly() const override { return all->rank() > 0; }
    int processes() const override { return all->processes(); }

private:
    std::unique_ptr<MpiBakeCrew> all;
};
#endif

} // namespace

Result<std::unique_ptr<BakeWorkers>> bakeWorkers() {
#ifdef REBOUND_HAS_MPI
    if (MpiBakeCrew::isStartedByMpi()) {
        auto all = MpiBakeCrew::join();
        if (!all) return all.error();
        return std::unique_ptr<BakeWorkers>(std::make_unique<ManyProcesses>(*std::move(all)));
    }
#else
    if (const char* count = std::getenv("OMPI_COMM_WORLD_SIZE"); count && std::atoi(count) > 1)
        return Error{ErrorCode::unsupported,
                     std::string("OMPI_COMM_WORLD_SIZE is ") + count +
                         ", but this program was built without MPI; one process was expected"};
#endif
    return std::unique_ptr<BakeWorkers>(std::make_unique<OneProcess>());
}

} // namespace rebound::cli
