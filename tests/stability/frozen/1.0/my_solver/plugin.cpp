/*
 * The plugin my_solver: draws its volumes in their own basis. This file says what is in a volume and hands out the data;
 * snippet.glsl evaluates it.
 */
#include "mesh_file.hpp"
#include "snippet.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace my_solver {
namespace {

enum : std::uint32_t { corners_buffer, modes_buffer, n_buffers };

/** Values and derivatives of P_0 .. P_N at x. */
struct Legendre {
    std::vector<double> value;
    std::vector<double> derivative;

    Legendre(int order, double x) : value(order + 2, 0.0), derivative(order + 2, 0.0) {
        value[0] = 1;
        for (int n = 0; n <= order; ++n) {
            value[n + 1] = ((2 * n + 1) * x * value[n] - (n > 0 ? n * value[n - 1] : 0)) / (n + 1);
            derivative[n + 1] = (n > 0 ? derivative[n - 1] : 0) + (2 * n + 1) * value[n];
        }
    }
};

/** Reference coordinates of a corner, in the order of elvis/element.h. */
std::array<double, 3> corner_place(unsigned k) {
    return {((k ^ (k >> 1)) & 1u) != 0 ? 1.0 : -1.0, (k & 2u) != 0 ? 1.0 : -1.0, (k & 4u) != 0 ? 1.0 : -1.0};
}

/** Corners of the local faces of a hexahedron (elvis/element.h). */
constexpr unsigned face_corners[6][4] = {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {3, 2, 6, 7}, {0, 3, 7, 4}, {4, 5, 6, 7}};

class Volume : public elvis::api::RuntimeVolume {
public:
    static std::uint32_t probe(const char* path) { return is_mesh_file(path) ? 100 : 0; }

    Volume(const elvis::api::Host& host, const std::string& path, const std::string&)
        : RuntimeVolume(host), m_file(read_mesh_file(path)), m_order(elvis::api::constant("MY_SOLVER_ORDER", m_file.order)) {
        find_faces();
    }

    void get_info(elvis_volume_info& info) override {
        info.dimension = 3;
        info.n_elements = m_file.hexahedra.size();
        info.n_classes = 1;
        info.n_fields = 1;
        info.n_time_steps = 1;
        info.n_buffers = n_buffers;
        info.n_faces = m_faces.size();
    }

    void get_class(std::uint32_t, elvis_element_class& out) override {
        out.shape = ELVIS_SHAPE_HEXAHEDRON;
        out.n_elements = m_file.hexahedra.size();
        std::fill_n(out.geometry_order, 3, 1u);
    }

    void get_field(std::uint32_t, elvis_field& out) override {
        out.n_components = 1;
        out.name = m_file.field.c_str();
        out.continuity = ELVIS_CONTINUITY_DISCONTINUOUS;
        out.max_jump = std::nan("");
    }

    /** The snippet is compiled for this order. */
    void get_class_field(std::uint32_t, std::uint32_t, elvis_class_field& out) override {
        out.n_constants = 1;
        out.constants = &m_order;
        std::fill_n(out.order, 3, m_file.order);
    }

    double get_time(std::uint32_t) override { return 0; }

    /** One record an element: eight rows of x, y, z, 0; and the coefficients. */
    void get_buffer(std::uint32_t buffer, std::uint32_t, elvis_buffer& out) override {
        out.kind = ELVIS_BUFFER_REAL;
        out.element_class = 0;
        out.n_records = m_file.hexahedra.size();
        if (buffer == corners_buffer) {
            out.name = "corners";
            out.record_size = 32;
        } else {
            out.name = "modes";
            out.depends = ELVIS_DEPENDS_ON_FIELD;
            out.record_size = static_cast<std::uint32_t>(m_file.n_modes());
        }
    }

    void fill_buffer(const elvis_fill_request& request, void* destination) override {
        auto* number = static_cast<double*>(destination);
        for (std::uint64_t i = 0; i < request.count; ++i) {
            const Hexahedron& hexahedron = m_file.hexahedra.at(request.first + i);
            if (request.buffer == modes_buffer) {
                number = std::copy(hexahedron.modes.begin(), hexahedron.modes.end(), number);
                continue;
            }
            for (const Corner& corner : hexahedron.corners) {
                number = std::copy(corner.begin(), corner.end(), number);
                *number++ = 0;
            }
        }
    }

    void get_snippet(std::uint32_t, elvis_snippet& out) override {
        static const elvis_text source = elvis::api::text("snippet.glsl", snippet::files[0].text);
        out.prefix = "my_solver";
        out.capabilities = ELVIS_SNIPPET_FIELD_GRADIENT;
        out.n_sources = 1;
        out.sources = &source;
    }

    /** A trilinear element lies in the convex hull of its corners. */
    elvis_certainty get_bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) override {
        for (std::uint64_t i = 0; i < count; ++i) {
            const auto& corners = m_file.hexahedra.at(first + i).corners;
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

    /** Positions, and Jacobians with entry 3i + j = dx_i/dxi_j; either may be null. */
    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, double* positions, double* jacobians) {
        const auto& corners = m_file.hexahedra.at(element).corners;
        for (std::size_t point = 0; point < xi.size() / 3; ++point) {
            std::array<double, 3> x{};
            std::array<double, 9> jacobian{};
            for (unsigned k = 0; k < 8; ++k) {
                const auto s = corner_place(k);
                const double f[3] = {1 + s[0] * xi[3 * point], 1 + s[1] * xi[3 * point + 1], 1 + s[2] * xi[3 * point + 2]};
                for (std::size_t i = 0; i < 3; ++i) {
                    x[i] += f[0] * f[1] * f[2] * corners[k][i] / 8;
                    jacobian[3 * i] += s[0] * f[1] * f[2] * corners[k][i] / 8;
                    jacobian[3 * i + 1] += f[0] * s[1] * f[2] * corners[k][i] / 8;
                    jacobian[3 * i + 2] += f[0] * f[1] * s[2] * corners[k][i] / 8;
                }
            }
            if (positions) {
                std::copy(x.begin(), x.end(), positions + 3 * point);
            }
            if (jacobians) {
                std::copy(jacobian.begin(), jacobian.end(), jacobians + 9 * point);
            }
        }
    }

    /** Values, and gradients by xi; either may be null. */
    void evaluate_field(std::uint32_t, std::uint32_t, std::uint64_t element, std::span<const double> xi, double* values,
                        double* gradients) {
        const std::vector<double>& modes = m_file.hexahedra.at(element).modes;
        for (std::size_t point = 0; point < xi.size() / 3; ++point) {
            const Legendre p(m_file.order, xi[3 * point]);
            const Legendre q(m_file.order, xi[3 * point + 1]);
            const Legendre r(m_file.order, xi[3 * point + 2]);
            double value = 0;
            std::array<double, 3> gradient{};
            auto mode = modes.begin();
            for (int i = 0; i <= m_file.order; ++i) {
                for (int j = 0; j <= m_file.order; ++j) {
                    for (int k = 0; k <= m_file.order; ++k, ++mode) {
                        value += *mode * p.value[i] * q.value[j] * r.value[k];
                        gradient[0] += *mode * p.derivative[i] * q.value[j] * r.value[k];
                        gradient[1] += *mode * p.value[i] * q.derivative[j] * r.value[k];
                        gradient[2] += *mode * p.value[i] * q.value[j] * r.derivative[k];
                    }
                }
            }
            if (values) {
                values[point] = value;
            }
            if (gradients) {
                std::copy(gradient.begin(), gradient.end(), gradients + 3 * point);
            }
        }
    }

    /** No Legendre polynomial exceeds 1 in size: the field is within the sum of the other coefficients of the first one. */
    elvis_certainty get_field_ranges(std::uint32_t, std::uint32_t, std::uint64_t first, std::uint64_t count,
                                     std::span<double> ranges) {
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::vector<double>& modes = m_file.hexahedra.at(first + i).modes;
            double others = 0;
            for (std::size_t mode = 1; mode < modes.size(); ++mode) {
                others += std::abs(modes[mode]);
            }
            // For what single precision rounds in a sum of some hundred terms.
            const double rounding = std::ldexp(std::abs(modes[0]) + others, -14);
            ranges[2 * i] = modes[0] - others - rounding;
            ranges[2 * i + 1] = modes[0] + others + rounding;
        }
        return ELVIS_CERTIFIED;
    }

    void get_faces(std::uint64_t first, elvis::api::StructArray<elvis_face> faces) {
        for (std::uint64_t i = 0; i < faces.size(); ++i) {
            faces.set(i, m_faces.at(first + i));
        }
    }

private:
    /** Two local faces with the same corners are one face of the mesh. */
    void find_faces() {
        std::map<std::array<Corner, 4>, std::size_t> known;
        for (std::size_t element = 0; element < m_file.hexahedra.size(); ++element) {
            for (int local_face = 0; local_face < 6; ++local_face) {
                std::array<Corner, 4> corners;
                for (std::size_t k = 0; k < 4; ++k) {
                    corners[k] = m_file.hexahedra[element].corners[face_corners[local_face][k]];
                }
                std::sort(corners.begin(), corners.end());
                const auto [place, is_new] = known.try_emplace(corners, m_faces.size());
                if (is_new) {
                    elvis_face face{};
                    face.group = ELVIS_GROUP_NONE;
                    face.element = static_cast<std::int64_t>(element);
                    face.local_face = local_face;
                    face.neighbour = ELVIS_NEIGHBOUR_NONE;
                    face.neighbour_local_face = -1;
                    m_faces.push_back(face);
                } else if (elvis_face& face = m_faces[place->second]; face.neighbour == ELVIS_NEIGHBOUR_NONE) {
                    face.neighbour = static_cast<std::int64_t>(element);
                    face.neighbour_local_face = local_face;
                } else {
                    throw elvis::api::Error(ELVIS_ERROR_FORMAT, {},
                                            "more than two hexahedra share a face of hexahedron " + std::to_string(element));
                }
            }
        }
    }

    MeshFile m_file;
    elvis_constant m_order;
    std::vector<elvis_face> m_faces;
};

} // namespace
} // namespace my_solver

ELVIS_PLUGIN(.id = "org.example.my_solver", .name = "my_solver", .version = "0.1.0",
             .description = "Draws volumes of my_solver", .runtime = elvis::api::runtime_table<my_solver::Volume>());
