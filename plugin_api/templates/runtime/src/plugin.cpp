/*
 * The plugin @NAME@: draws its volumes in their own basis. This file says what is in a volume and hands out the data;
 * snippet.glsl evaluates it. Only what elvis/runtime.h requires is here, nothing optional.
 */
#include "mesh_file.hpp"
#include "snippet.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>

namespace @NAME@ {
namespace {

class Volume : public elvis::api::RuntimeVolume {
public:
    static std::uint32_t probe(const char* path) { return is_mesh_file(path) ? 100 : 0; }

    Volume(const elvis::api::Host& host, const std::string& path, const std::string&)
        : RuntimeVolume(host), m_file(read_mesh_file(path)) {}

    void get_info(elvis_volume_info& info) override {
        info.dimension = 3;
        info.n_elements = m_file.hexahedra.size();
        info.n_classes = 1;
        info.n_fields = 1;
        info.n_time_steps = 1;
        info.n_buffers = 1;
    }

    void get_class(std::uint32_t, elvis_element_class& out) override {
        out.shape = ELVIS_SHAPE_HEXAHEDRON;
        out.n_elements = m_file.hexahedra.size();
        std::fill_n(out.geometry_order, 3, 1u);
    }

    void get_field(std::uint32_t, elvis_field& out) override {
        out.n_components = 1;
        out.name = m_file.field.c_str();
        out.continuity = ELVIS_CONTINUITY_UNKNOWN;
        out.max_jump = std::nan("");
    }

    void get_class_field(std::uint32_t, std::uint32_t, elvis_class_field& out) override { std::fill_n(out.order, 3, 1); }

    double get_time(std::uint32_t) override { return 0; }

    /** One record an element: eight rows of x, y, z, value. */
    void get_buffer(std::uint32_t, std::uint32_t, elvis_buffer& out) override {
        out.kind = ELVIS_BUFFER_REAL;
        out.name = "corners";
        out.element_class = 0;
        out.depends = ELVIS_DEPENDS_ON_FIELD;
        out.n_records = m_file.hexahedra.size();
        out.record_size = 32;
    }

    void fill_buffer(const elvis_fill_request& request, void* destination) override {
        auto* number = static_cast<double*>(destination);
        for (std::uint64_t i = 0; i < request.count; ++i) {
            for (const Corner& corner : m_file.hexahedra.at(request.first + i)) {
                number = std::copy(corner.begin(), corner.end(), number);
            }
        }
    }

    void get_snippet(std::uint32_t, elvis_snippet& out) override {
        static const elvis_text source = elvis::api::text("snippet.glsl", snippet::files[0].text);
        out.prefix = "@NAME@";
        out.n_sources = 1;
        out.sources = &source;
    }

    /** A trilinear element lies in the convex hull of its corners. */
    elvis_certainty get_bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) override {
        for (std::uint64_t i = 0; i < count; ++i) {
            const Hexahedron& corners = m_file.hexahedra.at(first + i);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto [low, high] = std::minmax_element(
                    corners.begin(), corners.end(), [&](const Corner& a, const Corner& b) { return a[axis] < b[axis]; });
                // Single precision rounds the snippet's sum of eight products, none larger than the largest coordinate.
                const double rounding = std::ldexp(std::max(std::abs((*low)[axis]), std::abs((*high)[axis])), -18);
                bounds[6 * i + axis] = (*low)[axis] - rounding;
                bounds[6 * i + 3 + axis] = (*high)[axis] + rounding;
            }
        }
        return ELVIS_CERTIFIED;
    }

private:
    MeshFile m_file;
};

} // namespace
} // namespace @NAME@

ELVIS_PLUGIN(.id = "@ID@", .name = "@NAME@", .version = "0.1.0", .description = "Draws volumes of @NAME@",
             .runtime = elvis::api::runtime_table<@NAME@::Volume>());
