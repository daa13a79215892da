/**
 * @file encoding.hpp
 * The binary form of one array: base64 or raw bytes, plain or in compressed blocks.
 *
 * An array is a header of unsigned integers and then data. Plain: the number of bytes, the bytes. Compressed: number of
 * blocks, size of a block, size of a last, partial block (0: none is partial), compressed size of each block; the blocks.
 * Base64 is decoded in groups of four characters. A group that ends in '=' holds fewer bytes and does not end the text, so that
 * it does not matter whether a writer encodes header and data together or one after the other: both are in use.
 */
#pragma once

#include "xml_file.hpp"

#include <stdexcept>
#include <string_view>
#include <vector>

namespace elvis_vtk {

/** What is wrong with an array's bytes; who knows the place turns it into an Error. */
class Malformed : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/**
 * The array's bytes, in the byte order of the file. `data` begins at its header and may go on beyond its end. Memory is
 * bounded by the size of `data` and the largest ratio that the compressors reach.
 */
std::vector<unsigned char> decode(std::string_view data, bool is_base64, const Encoding& encoding);

} // namespace elvis_vtk
