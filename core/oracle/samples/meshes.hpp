/**
 * @file meshes.hpp
 * Meshes of the unit cube made of each shape, bent by a smooth map, written as native volumes.
 */
#pragma once

#include "exact_volumes.hpp"

#include <string>

namespace elvis::oracle {

/** Affine maps of one cell, [lower, lower + size]^3, split into elements of one shape: 1, 2, 6 or 6 of them. */
std::vector<Map> split_cell(native::Shape shape, const Vector& lower, double size);

/** All of n^3 cells of the unit cube. */
std::vector<Map> cube(native::Shape shape, int n);

/** `outer` after each of the maps. */
std::vector<Map> compose(const std::vector<Map>& maps, const std::function<Vector(const Vector&)>& outer);

/** A map of the unit cube that is quadratic (in each variable and together) and one to one. */
Vector quadratic_bend(const Vector& x);

/**
 * n^3 cells bent by quadratic_bend, each split into a shape of its own, four classes in one volume; faces of neighbouring cells
 * coincide as surfaces, though their elements may not match. Elements are numbered cell by cell.
 */
VolumeData mixed_volume(int n, std::uint32_t field_order, const Function& function);

/** Writes a volume with one field, named u. */
void write_volume(const std::string& path, const VolumeData& data);

} // namespace elvis::oracle
