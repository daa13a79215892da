/**
 * @file mpi_team.hpp
 * The processes of an MPI program as a team.
 */
#pragma once

#include <core/base/team.hpp>

#include <mpi.h>

#include <string>

namespace elvis {

/** MPI, while it lives, of one thread; one in a program. */
class MpiProgram {
public:
    /** Must come before the program looks at its arguments. */
    MpiProgram(int& argc, char**& argv);
    ~MpiProgram();
    MpiProgram(const MpiProgram&) = delete;
    MpiProgram& operator=(const MpiProgram&) = delete;
};

/** Processes of the program: all, or a group of them. */
class MpiTeam final : public DivisibleTeam {
public:
    /** All. */
    MpiTeam();
    ~MpiTeam() override;
    MpiTeam(const MpiTeam&) = delete;
    MpiTeam& operator=(const MpiTeam&) = delete;

    std::uint32_t rank() const override { return m_rank; }
    std::uint32_t size() const override { return m_size; }
    /** Among the processes on the same machine. */
    std::uint32_t local_rank() const { return m_local_rank; }
    std::unique_ptr<Team> group(std::uint32_t n_groups) override;
    void minimum(std::span<double> numbers) override;
    std::vector<double> joined(std::vector<double> numbers) override;
    std::vector<double> of_first(std::vector<double> numbers) override;
    std::vector<std::vector<std::byte>> gathered(std::vector<std::byte> bytes) override;
    std::vector<std::vector<std::byte>> exchanged(std::vector<std::vector<std::byte>> sent) override;

    /**
     * Says what this process failed of, and ends all. Where several fail, as with a file that none can read, the one of lowest
     * rank speaks: the others wait a moment for it to end them.
     */
    [[noreturn]] void fail(const std::string& message, int status) const;

private:
    /** Gives the communicator back with itself. */
    explicit MpiTeam(MPI_Comm ranks);
    std::vector<std::uint64_t> sizes_of_all(std::uint64_t own) const;

    MPI_Comm m_ranks;
    std::uint32_t m_rank = 0, m_size = 1, m_local_rank = 0;
};

} // namespace elvis
