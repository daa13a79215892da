/**
 * @file communicator_team.hpp
 * Ranks of a program that talks to them itself (elvis/insitu.h) as a team that fails together.
 */
#pragma once

#include <core/base/team.hpp>

#include <elvis/insitu.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace elvis::library {

/**
 * Before anything is exchanged, ranks tell each other whether they are well. So a rank that fails at any place is heard of by
 * the others when they next want something of it, and none waits for what does not come.
 */
class CommunicatorTeam final : public Team {
public:
    /** Throws InvalidArgument. */
    explicit CommunicatorTeam(const elvis_communicator* communicator);

    std::uint32_t rank() const override { return m_table.rank; }
    std::uint32_t size() const override { return m_table.size; }
    std::uint32_t local_rank() const { return m_table.local_rank; }
    void minimum(std::span<double> numbers) override;
    std::vector<double> joined(std::vector<double> numbers) override;
    std::vector<double> of_first(std::vector<double> numbers) override;
    std::vector<std::vector<std::byte>> gathered(std::vector<std::byte> bytes) override;
    std::vector<std::vector<std::byte>> exchanged(std::vector<std::vector<std::byte>> sent) override;

    /** Bytes become those of rank `root`; of one size on all. */
    void broadcast(std::uint32_t root, std::span<std::byte> bytes);

    /** All do `what`. If it fails on one of them, all throw Error with what the lowest of those says, and do nothing any more.
     */
    void together(const std::function<void()>& what);

    /** To other ranks, so far. */
    std::uint64_t sent_bytes() const { return m_sent_bytes; }

private:
    void agree();
    /** Of all: the lowest rank that is not well, or the number of ranks. */
    std::uint32_t lowest_failed(bool is_well);
    [[noreturn]] void tell_failure(std::uint32_t failed, std::string own_text);
    /** How many things each rank has. */
    std::vector<std::uint64_t> sizes_of_all(std::uint64_t own);
    void check(std::int32_t result, const char* function) const;

    elvis_communicator m_table{};
    bool m_is_broken = false;
    std::uint64_t m_sent_bytes = 0;
};

} // namespace elvis::library
