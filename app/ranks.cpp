#include "app/ranks.h"

#include <cstdlib>
#include <utility>

#ifdef FB_MPI
#include <mpi.h>
#endif

namespace fb {
namespace {

// What the launchers of Open MPI, MPICH and Slurm tell the processes that they start.
bool isStartedByMpi() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"}) {
        if (std::getenv(name) != nullptr) return true;
    }
    return false;
}

}  // namespace

#ifdef FB_MPI

Result<Ranks> Ranks::start() {
    Ranks ranks;
    if (!isStartedByMpi()) return ranks;
    int ready = 0;
    MPI_Initialized(&ready);
    if (ready == 0 && MPI_Init(nullptr, nullptr) != MPI_SUCCESS) return failure("MPI", {}, "cannot be started");
    int index = 0, count = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &index);
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    ranks.index_ = static_cast<std::uint32_t>(index);
    ranks.count_ = static_cast<std::uint32_t>(count);
    ranks.isStarted_ = true;
    return ranks;
}

Ranks::~Ranks() {
    if (isStarted_) MPI_Finalize();
}

bool Ranks::agree(bool mine) const {
    if (!isStarted_) return mine;
    int all = 0;
    const int one = mine ? 1 : 0;
    MPI_Allreduce(&one, &all, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    return all != 0;
}

std::uint64_t Ranks::sumOf(std::uint64_t mine) const {
    std::uint64_t sum = mine;
    if (isStarted_) MPI_Allreduce(&mine, &sum, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    return sum;
}

bool Ranks::haveSame(std::uint64_t mine) const {
    if (!isStarted_) return true;
    std::uint64_t first = mine;
    MPI_Bcast(&first, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    return agree(first == mine);
}

#else

Result<Ranks> Ranks::start() {
    if (!isStartedByMpi()) return Ranks();
    return failure("mpirun", {}, "this program was built without MPI", "install libopenmpi-dev and build it again");
}
Ranks::~Ranks() = default;
bool Ranks::agree(bool mine) const { return mine; }
std::uint64_t Ranks::sumOf(std::uint64_t mine) const { return mine; }
bool Ranks::haveSame(std::uint64_t) const { return true; }

#endif

Ranks::Ranks(Ranks&& other) noexcept
    : index_(other.index_), count_(other.count_), isStarted_(std::exchange(other.isStarted_, false)) {}

}  // namespace fb
