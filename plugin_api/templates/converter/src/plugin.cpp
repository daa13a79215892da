/*
 * The plugin @NAME@: reads its volumes for conversion to the native volume of ElVis, which chooses the points, projects, and
 * measures how exact the result is. Only what elvis/converter.h requires is here.
 */
#include "mesh_file.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>

namespace @NAME@ {
namespace {

/** Weight of each corner at a reference point, by which positions and values are interpolated alike. */
std::array<double, 8> corner_weights(const double* xi) {
    std::array<double, 8> weights;
    for (unsigned k = 0; k < 8; ++k) {
        const double r = ((k ^ (k >> 1)) & 1u) != 0 ? 1 + xi[0] : 1 - xi[0];
        const double s = (k & 2u) != 0 ? 1 + xi[1] : 1 - xi[1];
        const double t = (k & 4u) != 0 ? 1 + xi[2] : 1 - xi[2];
        weights[k] = r * s * t / 8;
    }
    return weights;
}

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) { return is_mesh_file(path) ? 100 : 0; }

    Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string&)
        : ConverterSource(host), m_file(read_mesh_file(paths.front())) {
        if (paths.size() > 1) {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths[1], "mesh and field are in one file; give just that");
        }
    }

    void get_info(elvis_source_info& info) override {
        info.dimension = 3;
        info.n_elements = m_file.hexahedra.size();
        info.n_corner_ids = 0; // corners are matched by position
        info.n_fields = 1;
        info.n_time_steps = 1;
        info.mantissa_bits = 20; // six decimals in the file
    }

    void get_field(std::uint32_t, elvis_source_field& out) override {
        out.n_components = 1;
        out.name = m_file.field.c_str();
        out.continuity = ELVIS_CONTINUITY_UNKNOWN;
    }

    void get_elements(std::uint64_t, elvis::api::StructArray<elvis_source_element> out) override {
        for (std::uint64_t i = 0; i < out.size(); ++i) {
            elvis_source_element element{};
            element.shape = ELVIS_SHAPE_HEXAHEDRON;
            std::fill_n(element.geometry_order, 3, 1u);
            std::fill_n(element.face_groups, 6, ELVIS_GROUP_NONE);
            out.set(i, element);
        }
    }

    /** Trilinear functions lie in the native space of order 1: the conversion is exact. */
    void get_spaces(std::uint32_t, std::uint64_t, elvis::api::StructArray<elvis_source_space> out) override {
        for (std::uint64_t i = 0; i < out.size(); ++i) {
            elvis_source_space space{};
            std::fill_n(space.order, 3, 1u);
            space.is_contained = 1;
            out.set(i, space);
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        const Hexahedron& corners = m_file.hexahedra.at(element);
        std::fill(positions.begin(), positions.end(), 0.0);
        for (std::size_t point = 0; point < xi.size(); point += 3) {
            const auto weights = corner_weights(&xi[point]);
            for (std::size_t k = 0; k < 8; ++k) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    positions[point + axis] += weights[k] * corners[k][axis];
                }
            }
        }
    }

    void sample(std::uint32_t, std::uint64_t element, std::span<const double> xi, double* values) override {
        const Hexahedron& corners = m_file.hexahedra.at(element);
        for (std::size_t point = 0; point < xi.size(); point += 3) {
            const auto weights = corner_weights(&xi[point]);
            double value = 0;
            for (std::size_t k = 0; k < 8; ++k) {
                value += weights[k] * corners[k][3];
            }
            *values++ = value;
        }
    }

private:
    MeshFile m_file;
};

} // namespace
} // namespace @NAME@

ELVIS_PLUGIN(.id = "@ID@", .name = "@NAME@", .version = "0.1.0", .description = "Converts volumes of @NAME@",
             .converter = elvis::api::converter_table<@NAME@::Source>());
