/**
 * @file found_scenes.hpp
 * What tests share that draw scenes in which the hunt found silent errors.
 */
#pragma once

#include "judge.hpp"

#include <tests/support/test_volumes.hpp>

#include <core/oracle/samples/meshes.hpp>
#include <core/render/renderer.hpp>

#include <string>
#include <vector>

namespace elvis::hunt {

/** Draws and judges; what is wrong first is printed. */
Tally judge_picture(const std::string& path, const FrameRequest& request, Precision precision);

/** With all digits. */
std::string text_of(double number);

/** x + y z. */
double field(const oracle::Vector& x);
/** Hexahedra of order 2. */
void write_hexahedra(const std::string& path, const std::vector<oracle::Map>& maps, const std::vector<native::Face>& faces = {},
                     const oracle::Function& values = field);
/** Of a mesh of one hexahedron. */
std::vector<native::Face> faces_of_one();

FrameRequest request_from(const oracle::Vector& eye, const Vector3& look_at);
/** Sixteen rows, from this one on, of a parallel view of 800x600 pixels. */
FrameRequest rows_of_parallel_view(std::uint32_t first_row);
std::size_t pixel_in_rows(std::uint32_t first_row, std::size_t row, std::size_t column);

Surface colored_surface();

} // namespace elvis::hunt
