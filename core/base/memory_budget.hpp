/**
 * @file memory_budget.hpp
 * The most memory that something may take, and sizes as people write them.
 */
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace elvis {

/** In bytes; as much as there is where none are given. */
struct MemoryBudget {
    std::optional<std::uint64_t> device, host;

    bool operator==(const MemoryBudget&) const = default;
};

/** Bytes of "2G", "1.5G", "800M", "65536K" (1024, 1024² and so on) or "1000000"; nothing if the text is no size above 0. */
std::optional<std::uint64_t> bytes_of_size(const std::string& text);

/** What is wrong with a text that is no size. */
std::string no_size_text(const std::string& text);

/** The shortest size that is so many bytes: "1536M". */
std::string size_text(std::uint64_t bytes);

} // namespace elvis
