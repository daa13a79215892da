/**
 * @file rank_table.hpp
 * A volume of which each rank's own functions serve some elements, seen as a plugin's.
 */
#pragma once

#include <core/plugin_host/handed_on_table.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace elvis::library {

/** What this rank knows of all elements. */
struct ElementsOfTable {
    /** By class. */
    std::vector<std::uint64_t> n_elements;
    /** Of each element that the rank's functions serve, as they count them: which one of all it is. */
    std::vector<std::uint64_t> served;
    /** Of all, as people know them. */
    std::vector<std::int64_t> numbers;
};

/** All elements, of which those that the rank serves can be asked about; values of others are NaN. Faces are those of served
 * ones. */
class RankTable : public HandedOnTable {
public:
    /** Not asked: volumes are made by open_rank_table(). */
    static std::uint32_t probe(const char*) { return 0; }
    RankTable(const api::Host& host, const std::string& path, const std::string& options);
    RankTable(const api::Host& host, const elvis::RuntimeVolume& served, ElementsOfTable elements);

    void get_element_numbers(std::uint64_t first, std::span<std::int64_t> numbers);

private:
    /** An element, and where the rank's functions have it. */
    struct Place {
        std::uint64_t element, there;
    };

    void for_each_run(std::uint64_t first, std::uint64_t count, const Read& read) const override;
    bool is_known(std::uint64_t element) const override;
    std::int64_t place_here(std::int64_t served) const;

    ElementsOfTable m_elements;
    /** By element. */
    std::vector<Place> m_places;
};

/** `served` is what the rank's own functions serve, and must outlive it. */
RuntimeVolume open_rank_table(const RuntimeVolume& served, ElementsOfTable elements);

} // namespace elvis::library
