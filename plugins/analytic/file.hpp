/**
 * @file file.hpp
 * The text format of the analytic plugin, described in README.md.
 */
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis::analytic {

enum class Kind { sine, gaussian, pole };

/** amplitude * g(x): see the table in README.md. */
struct Term {
    Kind kind = Kind::sine;
    std::uint32_t component = 0;
    double amplitude = 0;
    /** Wave vector or centre; then phase or width, 0 for a pole. */
    std::array<double, 4> parameters{};
};

struct Field {
    std::string name;
    std::uint32_t n_components = 1;
    std::string unit;
    std::vector<Term> terms;
};

struct File {
    std::vector<Field> fields;
    std::vector<std::array<double, 3>> vertices;
    /** Corners in the order of elvis/element.h. */
    std::vector<std::array<std::uint32_t, 8>> hexahedra;
};

/** Whether the file begins like one of ours; false if it cannot be read. */
bool has_our_header(const char* path);

/** Throws api::Error with file and line. */
File read_file(const std::string& path);

} // namespace elvis::analytic
