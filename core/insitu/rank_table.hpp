/**
 * @file rank_table.hpp
 * A volume of which each rank's own functions serve some elements, seen as a plugin's.
 */
#pragma once

#include <core/parts/partition.hpp>
#include <core/plugin_host/handed_on_table.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace elvis::library {

/** What this rank knows of all elements. */
struct ElementsOfTable {
    /** By class. */
    std::vector<std::uint64_t> n_elements;
    /** This rank's, ascending: in the order in which its functions count them. */
    std::vector<std::uint64_t> own;
    /** Of all, as people know them. */
    std::vector<std::int64_t> numbers;
};

/** All elements, of which this rank's alone can be asked about; values of others are NaN. Faces are those of own elements. */
class RankTable : public HandedOnTable {
public:
    /** Not asked: volumes are made by open_rank_table(). */
    static std::uint32_t probe(const char*) { return 0; }
    RankTable(const api::Host& host, const std::string& path, const std::string& options);
    RankTable(const api::Host& host, const elvis::RuntimeVolume& served, ElementsOfTable elements);

    void get_element_numbers(std::uint64_t first, std::span<std::int64_t> numbers);

private:
    void for_each_run(std::uint64_t first, std::uint64_t count, const Read& read) const override;
    bool is_known(std::uint64_t element) const override;
    std::int64_t number_here(std::int64_t element) const;

    ElementsOfTable m_elements;
};

/** `served` is what the rank's own functions serve, and must outlive it. */
RuntimeVolume open_rank_table(const RuntimeVolume& served, ElementsOfTable elements);

} // namespace elvis::library
