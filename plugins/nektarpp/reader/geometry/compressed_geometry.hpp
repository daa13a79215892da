/**
 * @file compressed_geometry.hpp
 * Compressed parts of a GEOMETRY: packed records of 8-byte integers and doubles.
 */
#pragma once

#include "geometry_data.hpp"

#include <bit>
#include <functional>
#include <span>

namespace nektarpp {

/** A record's words as integers or doubles. */
using Record = std::span<const std::uint64_t>;
inline std::int64_t integer_of(std::uint64_t word) { return std::bit_cast<std::int64_t>(word); }

/** Calls `take` for every record of n_words words in a node. */
void for_each_record(const XmlFile& file, const pugi::xml_node& node, std::size_t n_words,
                     const std::function<void(Record)>& take);

/** Three words as a position; an error if it is not finite. */
Position position_of(const XmlFile& file, const pugi::xml_node& node, Record words);

/** A curve as CURVED lists it in either form. */
struct CurveRecord {
    /** The edge, face or element that is curved. */
    std::int64_t entity = 0;
    std::int64_t n_points = 0;
    PointSet set = PointSet::evenly_spaced;
    std::vector<Position> points;
};

/** The curves in a compressed CURVED; `take` gets the tag, E or F, and the record. Scaling has not been applied. */
void read_compressed_curves(const XmlFile& file, const pugi::xml_node& curved,
                            const std::function<void(const pugi::xml_node&, CurveRecord&)>& take);

} // namespace nektarpp
