/**
 * @file mesh_samples.hpp
 * The same tetrahedron in every format that is read.
 */
#pragma once

#include <core/surface/mesh_cursor.hpp>
#include <core/surface/patch_mesh.hpp>

#include <algorithm>
#include <bit>
#include <functional>
#include <string>
#include <vector>

namespace elvis::samples {

inline const std::vector<std::array<double, 3>> points = {{0, 0, 0}, {1.5, 0, 0}, {0, 2, 0.25}, {0, 0.5, -3}};
inline const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

template <class Number> std::string bytes_of(Number number, bool is_big) {
    const auto word = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    std::string text(word.begin(), word.end());
    if (is_big) {
        std::reverse(text.begin(), text.end());
    }
    return text;
}

inline std::string text_of(double number) {
    std::string text = std::to_string(number);
    return text;
}

inline std::string obj() {
    std::string text = "# a tetrahedron\no thing\n";
    for (const auto& p : points) {
        text += "v " + text_of(p[0]) + " " + text_of(p[1]) + "\\\n " + text_of(p[2]) + " 1.0\n";
    }
    text += "vn 0 0 1\nusemtl stone\n";
    text += "f 1//1 3//1 2//1\nf 1/1 2/2 4/3 # a comment\nf -3 -2 -1\r\nf 3 1 4\n";
    return text;
}

inline std::string ascii_stl() {
    std::string text = "solid a tetrahedron\n";
    for (const auto& triangle : triangles) {
        text += "  facet normal 0 0 1\n    outer loop\n";
        for (const std::uint32_t corner : triangle) {
            const auto& p = points[corner];
            text += "      vertex " + text_of(p[0]) + " " + text_of(p[1]) + " " + text_of(p[2]) + "\n";
        }
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid a tetrahedron\n";
}

inline std::string binary_stl() {
    std::string text(80, 'x');
    text += bytes_of(static_cast<std::uint32_t>(triangles.size()), false);
    for (const auto& triangle : triangles) {
        for (int i = 0; i < 3; ++i) {
            text += bytes_of(0.0f, false);
        }
        for (const std::uint32_t corner : triangle) {
            for (const double coordinate : points[corner]) {
                text += bytes_of(static_cast<float>(coordinate), false);
            }
        }
        text += std::string(2, '\0');
    }
    return text;
}

/** With a property and an element that mean nothing, and a polygon's count in each type. */
inline std::string ply(const std::string& format) {
    std::string text = "ply\nformat " + format +
                       " 1.0\ncomment made for a test\nelement vertex 4\nproperty double x\nproperty float y\n"
                       "property uchar red\nproperty float z\nelement face 4\nproperty list uchar int vertex_indices\n"
                       "element edge 1\nproperty short a\nproperty list ushort double b\nend_header\n";
    const bool is_big = format == "binary_big_endian";
    if (format == "ascii") {
        for (const auto& p : points) {
            text += text_of(p[0]) + " " + text_of(p[1]) + " 7 " + text_of(p[2]) + "\n";
        }
        for (const auto& t : triangles) {
            text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
        }
        return text + "-1 2 0.5 0.25\n";
    }
    for (const auto& p : points) {
        text += bytes_of(p[0], is_big) + bytes_of(static_cast<float>(p[1]), is_big) + '\7' +
                bytes_of(static_cast<float>(p[2]), is_big);
    }
    for (const auto& t : triangles) {
        text += '\3';
        for (const std::uint32_t corner : t) {
            text += bytes_of(static_cast<std::int32_t>(corner), is_big);
        }
    }
    return text + bytes_of(std::int16_t{-1}, is_big) + bytes_of(std::uint16_t{2}, is_big) + bytes_of(0.5, is_big) +
           bytes_of(0.25, is_big);
}

/** Two patches. */
inline std::string bpt() {
    std::string text = "2\n";
    for (int patch = 0; patch < 2; ++patch) {
        text += "3 3\n";
        for (int i = 0; i < 16; ++i) {
            text += text_of(i / 4 + patch) + " " + text_of(i % 4) + "\t" + text_of(0.1 * i) + "\n";
        }
    }
    return text;
}

struct Sample {
    std::string name;
    std::string text;
    std::function<TriangleMesh(const std::string&, std::string_view)> read;
};

/** Control points of patches, as triangles, for tests that only ask whether they are sound. */
inline TriangleMesh read_bpt_points(const std::string& path, std::string_view text) {
    TriangleMesh mesh;
    for (const BezierPatch& patch : read_bpt(path, text).patches) {
        for (const auto& point : patch.points) {
            const auto index = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.push_back(point);
            mesh.triangles.push_back({index, index, index});
        }
    }
    return mesh;
}

inline std::vector<Sample> all() {
    return {{"obj", obj(), read_obj},
            {"ascii stl", ascii_stl(), read_stl},
            {"binary stl", binary_stl(), read_stl},
            {"ascii ply", ply("ascii"), read_ply},
            {"little ply", ply("binary_little_endian"), read_ply},
            {"big ply", ply("binary_big_endian"), read_ply}};
}

} // namespace elvis::samples
