/**
 * @file packed_data.hpp
 * Compressed content of Nektar++ files: base64 of a zlib stream of little-endian 8-byte numbers.
 */
#pragma once

#include "xml_file.hpp"

#include <cstdint>
#include <vector>

namespace nektarpp {

/**
 * The 8-byte words in a node's text, in this machine's byte order. The zlib stream may be followed by up to two bytes of
 * padding. More than `most` words are an error; memory grows with what is really there.
 */
std::vector<std::uint64_t> unpack(const XmlFile& file, const pugi::xml_node& node, std::uint64_t most);

} // namespace nektarpp
