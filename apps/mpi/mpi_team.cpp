#include "mpi_team.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace elvis {

namespace {

/** MPI counts with int: what is larger goes in pieces. */
constexpr std::size_t most_at_once = std::size_t{1} << 30;

/** Calls pass(first, count as int) for one piece after the other. */
template <class Pass> void in_pieces(std::size_t n, std::size_t most, Pass pass) {
    for (std::size_t done = 0; done < n; done += most) {
        pass(done, static_cast<int>(std::min(most, n - done)));
    }
}

} // namespace

MpiProgram::MpiProgram(int& argc, char**& argv) {
    int thread_support = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &thread_support);
}

MpiProgram::~MpiProgram() { MPI_Finalize(); }

MpiTeam::MpiTeam() : MpiTeam(MPI_COMM_WORLD) {
    int local_rank = 0;
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, static_cast<int>(m_rank), MPI_INFO_NULL, &machine);
    MPI_Comm_rank(machine, &local_rank);
    MPI_Comm_free(&machine);
    m_local_rank = static_cast<std::uint32_t>(local_rank);
}

MpiTeam::MpiTeam(MPI_Comm ranks) : m_ranks(ranks) {
    int rank = 0, size = 1;
    MPI_Comm_rank(m_ranks, &rank);
    MPI_Comm_size(m_ranks, &size);
    m_rank = static_cast<std::uint32_t>(rank);
    m_size = static_cast<std::uint32_t>(size);
}

MpiTeam::~MpiTeam() {
    if (m_ranks != MPI_COMM_WORLD) {
        MPI_Comm_free(&m_ranks);
    }
}

std::unique_ptr<Team> MpiTeam::group(std::uint32_t n_groups) {
    MPI_Comm own = MPI_COMM_NULL;
    MPI_Comm_split(m_ranks, static_cast<int>(group_number(n_groups)), static_cast<int>(m_rank), &own);
    return std::unique_ptr<Team>(new MpiTeam(own));
}

/** How many things each process has; on all. */
std::vector<std::uint64_t> MpiTeam::sizes_of_all(std::uint64_t own) const {
    std::vector<std::uint64_t> sizes(m_size);
    MPI_Allgather(&own, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, m_ranks);
    return sizes;
}

void MpiTeam::minimum(std::span<double> numbers) {
    in_pieces(numbers.size(), most_at_once / sizeof(double), [&](std::size_t first, int count) {
        MPI_Allreduce(MPI_IN_PLACE, numbers.data() + first, count, MPI_DOUBLE, MPI_MIN, m_ranks);
    });
}

std::vector<double> MpiTeam::joined(std::vector<double> numbers) {
    const std::vector<std::uint64_t> sizes = sizes_of_all(numbers.size());
    std::vector<double> all;
    for (std::uint32_t rank = 0; rank < m_size; ++rank) {
        const std::size_t before = all.size();
        all.resize(before + sizes[rank]);
        if (rank == m_rank) {
            std::ranges::copy(numbers, all.begin() + static_cast<std::ptrdiff_t>(before));
        }
        in_pieces(sizes[rank], most_at_once / sizeof(double), [&](std::size_t first, int count) {
            MPI_Bcast(all.data() + before + first, count, MPI_DOUBLE, static_cast<int>(rank), m_ranks);
        });
    }
    return all;
}

std::vector<double> MpiTeam::of_first(std::vector<double> numbers) {
    std::uint64_t size = numbers.size();
    MPI_Bcast(&size, 1, MPI_UINT64_T, 0, m_ranks);
    numbers.resize(size);
    in_pieces(size, most_at_once / sizeof(double),
              [&](std::size_t first, int count) { MPI_Bcast(numbers.data() + first, count, MPI_DOUBLE, 0, m_ranks); });
    return numbers;
}

std::vector<std::vector<std::byte>> MpiTeam::gathered(std::vector<std::byte> bytes) {
    const std::vector<std::uint64_t> sizes = sizes_of_all(bytes.size());
    if (!is_first()) {
        in_pieces(bytes.size(), most_at_once,
                  [&](std::size_t first, int count) { MPI_Send(bytes.data() + first, count, MPI_BYTE, 0, 0, m_ranks); });
        return {};
    }
    std::vector<std::vector<std::byte>> all;
    all.push_back(std::move(bytes));
    for (std::uint32_t rank = 1; rank < m_size; ++rank) {
        std::vector<std::byte>& theirs = all.emplace_back(sizes[rank]);
        in_pieces(theirs.size(), most_at_once, [&](std::size_t first, int count) {
            MPI_Recv(theirs.data() + first, count, MPI_BYTE, static_cast<int>(rank), 0, m_ranks, MPI_STATUS_IGNORE);
        });
    }
    return all;
}

/*
 * Not MPI_Alltoallv, which counts all that a process sends with int, and not DIY's all_to_all (vtkdiy2): that forwards what it
 * sends several times, and a running solver's communicator (elvis/insitu.h) is not one of MPI's.
 */
std::vector<std::vector<std::byte>> MpiTeam::exchanged(std::vector<std::vector<std::byte>> sent) {
    std::vector<std::uint64_t> sent_sizes(m_size), sizes(m_size);
    std::ranges::transform(sent, sent_sizes.begin(), [](const auto& bytes) { return bytes.size(); });
    MPI_Alltoall(sent_sizes.data(), 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, m_ranks);
    std::vector<std::vector<std::byte>> received(m_size);
    std::vector<MPI_Request> requests;
    // Each begins with its neighbour, so that not all send to the same one first.
    for (std::uint32_t step = 1; step < m_size; ++step) {
        const std::uint32_t from = (m_rank + m_size - step) % m_size;
        received[from].resize(sizes[from]);
        in_pieces(sizes[from], most_at_once, [&](std::size_t first, int count) {
            MPI_Irecv(received[from].data() + first, count, MPI_BYTE, static_cast<int>(from), 1, m_ranks,
                      &requests.emplace_back());
        });
    }
    for (std::uint32_t step = 1; step < m_size; ++step) {
        const std::uint32_t to = (m_rank + step) % m_size;
        in_pieces(sent[to].size(), most_at_once, [&](std::size_t first, int count) {
            MPI_Isend(sent[to].data() + first, count, MPI_BYTE, static_cast<int>(to), 1, m_ranks, &requests.emplace_back());
        });
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    received[m_rank] = std::move(sent[m_rank]);
    return received;
}

void MpiTeam::fail(const std::string& message, int status) const {
    // Those who fail at the same time do so within some milliseconds.
    constexpr std::chrono::milliseconds pause{200}, longest{4000};
    std::this_thread::sleep_for(std::min(longest, m_rank * pause));
    std::fprintf(stderr, "elvis-mpi: rank %u: %s\n", m_rank, message.c_str());
    std::fflush(stderr);
    MPI_Abort(MPI_COMM_WORLD, status);
    std::abort();
}

} // namespace elvis
