/**
 * @file written_file.hpp
 * Files with a row of bent cubes (or squares), 1 wide, and polynomials as fields: any detail can be chosen, every value is
 * known.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <array>
#include <string>
#include <vector>

enum class Nodes { gauss_lobatto, equidistant };

/** One part. */
struct WrittenFile {
    int n = 5;
    int dimension = 3;
    int real_size = 8;
    bool is_big = false;
    std::string code = "XUPTS02";
    /** Behind the code. */
    std::string tail;
    double time = 1.5;
    /** Of all parts. */
    int n_elements = 3;
    /** Of the elements here, from 1, in the order of the file. */
    std::vector<int> numbers{1, 2, 3};
    int part = 0;
    int n_parts = 1;
    Nodes nodes = Nodes::gauss_lobatto;
    /** Pressure at Gauss-Legendre points, and numbers that are none behind it. */
    bool has_gauss_pressure = false;
    /** All elements are moved by it along x. */
    double shift = 0;
    bool has_ranges = true;

    std::string header() const;
    std::string content() const;
};

/** Where a point of element 0, 1, .. lies, and what the fields are there. */
elvis::native::Point written_position(int dimension, std::uint64_t element, elvis::native::Point xi);
/** Of velocity, pressure, temperature, S01, S02, ..., one after the other. */
std::vector<double> written_values(int dimension, std::uint64_t element, elvis::native::Point xi, double time, int n_scalars);

/** A number as bytes. */
std::string real_bytes(double value, int size, bool is_big);
std::string integer_bytes(std::int32_t value, bool is_big);
/** Right-aligned in columns. */
std::string in_columns(const std::string& text, std::size_t width);
