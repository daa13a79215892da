/**
 * @file file_content.hpp
 * Files that may be compressed by gzip, as MFEM writes them on demand.
 */
#pragma once

#include <cstddef>
#include <string>

namespace elvis_mfem {

/** All of a file, uncompressed. Throws elvis::api::Error. */
std::string read_content(const std::string& path);

/** The first bytes, at most n; fewer or none if the file has no more or cannot be read. */
std::string read_head(const std::string& path, std::size_t n);

} // namespace elvis_mfem
