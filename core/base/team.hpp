/**
 * @file team.hpp
 * Processes that work on one thing together.
 */
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace elvis {

/** All members call the same functions in the same order; one thread of each. */
class Team {
public:
    virtual ~Team() = default;

    virtual std::uint32_t rank() const = 0;
    virtual std::uint32_t size() const = 0;
    /** Each number becomes the smallest that a member has in its place; the same on all. No NaN. */
    virtual void minimum(std::span<double> numbers) = 0;
    /** The members' numbers one after the other, in the order of ranks; on all. */
    virtual std::vector<double> joined(std::vector<double> numbers) = 0;
    /** The first's numbers; on all. */
    virtual std::vector<double> of_first(std::vector<double> numbers) = 0;
    /** What each member has, in the order of ranks; on rank 0 alone, nothing on others. */
    virtual std::vector<std::vector<std::byte>> gathered(std::vector<std::byte> bytes) = 0;
    /** `sent`: bytes for each member. Returns those from each; own ones stay. */
    virtual std::vector<std::vector<std::byte>> exchanged(std::vector<std::vector<std::byte>> sent) = 0;

    bool is_first() const { return rank() == 0; }
};

/** One that works on several things at the same time, each by a group of members. */
class DivisibleTeam : public Team {
public:
    /** This member's of so many groups, no more than members; groups are of consecutive ranks. Called by all. */
    virtual std::unique_ptr<Team> group(std::uint32_t n_groups) = 0;
    std::uint32_t group_number(std::uint32_t n_groups) const {
        return static_cast<std::uint32_t>(std::uint64_t{rank()} * n_groups / size());
    }
};

/** One process by itself. */
class OneProcess final : public DivisibleTeam {
public:
    std::uint32_t rank() const override { return 0; }
    std::uint32_t size() const override { return 1; }
    std::unique_ptr<Team> group(std::uint32_t) override { return std::make_unique<OneProcess>(); }
    void minimum(std::span<double>) override {}
    std::vector<double> joined(std::vector<double> numbers) override { return numbers; }
    std::vector<double> of_first(std::vector<double> numbers) override { return numbers; }
    std::vector<std::vector<std::byte>> gathered(std::vector<std::byte> bytes) override {
        std::vector<std::vector<std::byte>> all;
        all.push_back(std::move(bytes));
        return all;
    }
    std::vector<std::vector<std::byte>> exchanged(std::vector<std::vector<std::byte>> sent) override { return sent; }
};

} // namespace elvis
