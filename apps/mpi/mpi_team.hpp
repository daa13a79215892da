/**
 * @file mpi_team.hpp
 * The processes of an MPI program as a team.
 */
#pragma once

#include <core/parts/team.hpp>

#include <string>

namespace elvis {

/** MPI from here on, of one thread; one in a program. */
class MpiTeam final : public Team {
public:
    /** Must come before the program looks at its arguments. */
    MpiTeam(int& argc, char**& argv);
    ~MpiTeam() override;
    MpiTeam(const MpiTeam&) = delete;
    MpiTeam& operator=(const MpiTeam&) = delete;

    std::uint32_t rank() const override { return m_rank; }
    std::uint32_t size() const override { return m_size; }
    /** Among the processes on the same machine. */
    std::uint32_t local_rank() const { return m_local_rank; }
    void minimum(std::span<double> numbers) override;
    std::vector<double> joined(std::vector<double> numbers) override;
    std::vector<double> of_first(std::vector<double> numbers) override;
    std::vector<std::vector<std::byte>> gathered(std::vector<std::byte> bytes) override;

    /**
     * Says what this process failed of, and ends all. Where several fail, as with a file that none can read, the one of lowest
     * rank speaks: the others wait a moment for it to end them.
     */
    [[noreturn]] void fail(const std::string& message, int status) const;

private:
    std::uint32_t m_rank = 0, m_size = 1, m_local_rank = 0;
};

} // namespace elvis
