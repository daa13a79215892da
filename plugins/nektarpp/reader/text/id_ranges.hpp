/**
 * @file id_ranges.hpp
 * Lists of ids as Nektar++ writes them, "0-5,7".
 */
#pragma once

#include "xml_file.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace nektarpp {

/** Ids first .. last; never expanded before it is known which exist. */
struct IdRange {
    std::int64_t first = 0;
    std::int64_t last = 0;
};

/** Errors name `node`. */
std::vector<IdRange> parse_ranges(const XmlFile& file, const pugi::xml_node& node, std::string_view text);

/** Ids of one kind: the "H[0-3,7]" of a composite, or the "C[0]" of a domain. */
struct IdGroup {
    char kind = ' ';
    std::vector<IdRange> ranges;
};

/** All groups in a text, "H[0-3] R[7]". */
std::vector<IdGroup> parse_groups(const XmlFile& file, const pugi::xml_node& node, std::string_view text);

} // namespace nektarpp
