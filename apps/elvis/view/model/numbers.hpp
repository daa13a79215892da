/**
 * @file numbers.hpp
 * Integrals and extrema of what a scene shows, as rows of a table.
 */
#pragma once

#include "volume_facts.hpp"
#include <apps/elvis/view/scene/scene.hpp>

#include <elvis/elvis.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

/** What is asked for one row. */
struct NumbersQuestion {
    /** "Volume", "Boundary inlet", "Isosurface 0.5". */
    std::string of;
    elvis_domain domain = ELVIS_DOMAIN_VOLUME;
    /** A field or expression; of a vector its magnitude. */
    std::string field;
    std::vector<std::string> groups{};
    std::array<double, 4> plane{};
    std::string level_field{};
    double isovalue = 0;
    std::uint32_t time_step = 0;
    /** Empty without. */
    Json warp{};
    /** Parts are cut away in the picture, by planes or a threshold; the numbers are of all of it. */
    bool is_clipped = false;

    friend bool operator==(const NumbersQuestion&, const NumbersQuestion&) = default;
};

/** A row. What it lacks is still being found, or is not asked. */
struct Numbers {
    NumbersQuestion question;
    std::optional<elvis_integral> integral;
    /** Of the volume. */
    std::optional<elvis_range> extrema;
    /** Why there is something missing. */
    std::string error;
    bool is_done = false;
};

/**
 * The volume, by each field that is shown, and each boundary, cut plane and isosurface that is shown. Other surfaces are not
 * integrated.
 */
std::vector<NumbersQuestion> questions_of(const Scene& scene, const VolumeFacts& volume);

/** What is not certain in a row, for people; empty if nothing is. */
std::string remark_of(const Numbers& row);

/** Where an extremum is, as "(0.1, 0.2, 0.3)"; empty if its place is not known. */
std::string place_text(const double position[3]);

/** Tab-separated, a line of names first. Numbers have all their digits. */
std::string table_text(const std::vector<Numbers>& rows);

} // namespace elvis::view
