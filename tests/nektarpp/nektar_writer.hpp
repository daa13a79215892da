/**
 * @file nektar_writer.hpp
 * Writes small Nektar++ files.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace nektar_writer {

using elvis::native::Point;
using elvis::native::Shape;

/** base64 of zlib of little-endian words, padded with NUL to a multiple of three bytes as Nektar++ does. */
std::string pack(const std::vector<std::uint64_t>& words);
std::string pack(const std::vector<double>& numbers);
/** Inverse of pack; nothing if the text is no such thing. */
std::vector<std::uint64_t> unpack(const std::string& text);

/** One ELEMENTS of a field file. */
struct Block {
    std::string fields;
    std::string shape;
    std::string basis;
    std::string n_modes;
    std::string ids;
    std::vector<double> coefficients;
    std::string more_attributes = R"(COMPRESSED="B64Z-LittleEndian" BITSIZE="64")";
};
/** `metadata` is what stands inside of Metadata. */
std::string field_file(const std::vector<Block>& blocks, const std::string& metadata = {});

/** A mesh of one element, whose edges and faces (or the element itself, in two dimensions) follow a map. */
struct Element {
    Shape shape = Shape::hexahedron;
    std::function<Point(const Point&)> map;
    /** Points along each curved edge; 0 if straight. */
    int n_along = 0;
    std::string edge_points = "PolyEvenlySpaced";
    std::string triangle_points = "NodalTriEvenlySpaced";
    /** Changes the direction of edges, and how faces are turned: eight ways for quadrilaterals, two for triangles. */
    int turn = 0;
    bool is_compressed = false;
    std::string vertex_attributes;
};
std::string geometry_file(const Element& element);

} // namespace nektar_writer
