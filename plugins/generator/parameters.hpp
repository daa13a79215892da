/**
 * @file parameters.hpp
 * The JSON description of a generated data set, read and checked. README.md documents every key.
 */
#pragma once

#include <elvis/element.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace generator {

enum class MeshKind { box, waves, ball, hemisphere, shell, torus, twisted_tetrahedron };
enum class Split { hexahedron, prism, tetrahedron, pyramid, mixed };
enum class FieldKind { sphere, polynomial, sinc, taylor_green, waves, jump, element, distance };

/** coefficient * x^i y^j z^k */
struct Term {
    std::array<std::uint32_t, 3> exponents{};
    double coefficient = 0;
};

struct FieldParameters {
    FieldKind kind = FieldKind::sphere;
    std::string name;
    /** Terms of a polynomial; empty for other kinds. */
    std::vector<Term> terms;
    /** Order of the target in each direction, if the user wants another than the smallest exact one. */
    std::optional<std::array<std::uint32_t, 3>> order;
    /** If the user wants another than the field's own. */
    std::optional<elvis_continuity> continuity;
};

struct Parameters {
    MeshKind mesh = MeshKind::box;
    Split split = Split::hexahedron;
    std::array<std::array<double, 3>, 2> box{{{-1, -1, -1}, {1, 1, 1}}};
    std::array<std::uint32_t, 3> elements{4, 4, 4};
    std::uint32_t layers = 2;
    std::uint32_t geometry_order = 1;
    double radius = 1;
    double inner_radius = 0.5;
    double tube_radius = 0.4;
    double amplitude = 0.06;
    std::uint32_t time_steps = 1;
    std::vector<FieldParameters> fields;
};

/** Reads and checks a file; throws elvis::api::Error, whose text names the key. */
Parameters read_parameters(const std::string& path);

/** Whether the file looks like a description: a JSON object with the key "generator". Never throws. */
bool is_description(const std::string& path) noexcept;

} // namespace generator
