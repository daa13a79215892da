/**
 * @file sample_files.hpp
 * The files of `elvis sample`. Each appears whole or not at all.
 */
#pragma once

#include <apps/elvis/answers/sample_table.hpp>

#include <string>
#include <variant>
#include <vector>

namespace elvis::commands {

/** An array of a file, the last index fastest. */
struct NamedArray {
    std::string name;
    std::vector<std::size_t> shape;
    std::variant<std::vector<double>, std::vector<std::int64_t>> numbers;

    std::size_t n_bytes() const;
    const void* bytes() const;
    bool is_integer() const { return numbers.index() == 1; }
};

/**
 * points (n, 3), element (n), on lines arc_length (n), the values of each field or expression (n) or (n, components), its
 * gradients grad(NAME) with an index of 3 more, and of m places between elements break_points (m, 3), break_arc_length,
 * break_element_before and _after (-1: none), NAME_before and NAME_after (NaN where there is no element).
 */
std::vector<NamedArray> arrays_of(const SampleTable& table);

/** By the ending: .csv, .npz, .vti, of lines a plot, .svg; all else is HDF5. */
void write_samples(const SampleTable& table, const std::string& path);

/** A row a point. */
void write_csv(const SampleTable& table, const std::string& path);
/** An array a dataset; '/' in names is written as '|'. */
void write_hdf5(const SampleTable& table, const std::string& path);
/** NumPy's archive, not compressed. */
void write_npz(const SampleTable& table, const std::string& path);
/** VTK's ImageData, for grids along the axes. */
void write_vti(const SampleTable& table, const std::string& path);
/** A plot of values over the arc length, with jumps where the field has them. */
void write_svg_plot(const SampleTable& table, const std::string& path);

} // namespace elvis::commands
