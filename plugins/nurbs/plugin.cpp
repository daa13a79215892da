/*
 * A runtime plugin for isogeometric volumes: knot spans of NURBS patches, in Bezier form.
 */
#include "nurbs_snippet.hpp"
#include "patch.hpp"

#include <elvis/demand.h>
#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace elvis::nurbs {
namespace {

/** Corners of the local faces of a hexahedron, and places of corners (elvis/element.h). */
constexpr unsigned face_corners[6][4] = {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {3, 2, 6, 7}, {0, 3, 7, 4}, {4, 5, 6, 7}};
constexpr double corner_places[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                        {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

double binomial(int n, int k) {
    double value = 1;
    for (int i = 0; i < k; ++i) {
        value = value * (n - i) / (i + 1);
    }
    return value;
}

/** Elements of the same degrees. */
struct Class {
    std::array<int, 3> degree{};
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    std::array<elvis_constant, 3> constants{};

    std::size_t n_points() const { return static_cast<std::size_t>((degree[0] + 1) * (degree[1] + 1) * (degree[2] + 1)); }
};

class Volume : public api::RuntimeVolume {
public:
    static std::uint32_t probe(const char* path) { return has_our_header(path) ? 100 : 0; }

    /** There are no options. */
    Volume(const api::Host& host, const std::string& path, const std::string&) : RuntimeVolume(host), m_file(read_file(path)) {
        std::map<std::array<int, 3>, std::vector<std::uint32_t>> by_degree;
        for (std::uint32_t patch = 0; patch < m_file.patches.size(); ++patch) {
            by_degree[m_file.patches[patch].degree].push_back(patch);
        }
        for (const auto& [degree, patches] : by_degree) {
            Class c;
            c.degree = degree;
            c.first = m_elements.size();
            for (const std::uint32_t patch : patches) {
                host.check_cancelled();
                auto some = extract_elements(m_file.patches[patch], patch, m_file.width());
                std::move(some.begin(), some.end(), std::back_inserter(m_elements));
            }
            c.count = m_elements.size() - c.first;
            c.constants = {api::constant("NURBS_P", degree[0]), api::constant("NURBS_Q", degree[1]),
                           api::constant("NURBS_R", degree[2])};
            m_classes.push_back(c);
        }
        std::size_t channel = 4;
        for (const Field& field : m_file.fields) {
            m_channels.push_back(channel);
            channel += field.n_components;
        }
        find_faces();
    }

    void get_info(elvis_volume_info& info) override {
        info.dimension = 3;
        info.n_elements = m_elements.size();
        info.n_faces = m_faces.size();
        info.n_classes = static_cast<std::uint32_t>(m_classes.size());
        info.n_fields = static_cast<std::uint32_t>(m_file.fields.size());
        info.n_time_steps = 1;
        info.n_buffers = static_cast<std::uint32_t>(m_classes.size());
    }

    void get_class(std::uint32_t element_class, elvis_element_class& out) override {
        out.shape = ELVIS_SHAPE_HEXAHEDRON;
        out.n_elements = m_classes.at(element_class).count;
        std::fill_n(out.geometry_order, 3, 0u); // rational
    }

    void get_field(std::uint32_t field, elvis_field& out) override {
        const Field& from = m_file.fields.at(field);
        out.n_components = static_cast<std::uint32_t>(from.n_components);
        out.name = from.name.c_str();
        out.unit = from.unit.empty() ? nullptr : from.unit.c_str();
        out.continuity = m_file.patches.size() == 1 ? ELVIS_CONTINUITY_CONTINUOUS : ELVIS_CONTINUITY_UNKNOWN;
        out.max_jump = std::nan("");
    }

    void get_class_field(std::uint32_t element_class, std::uint32_t, elvis_class_field& out) override {
        out.n_constants = 3;
        out.constants = m_classes.at(element_class).constants.data();
        std::fill_n(out.order, 3, -1); // rational
    }

    double get_time(std::uint32_t) override { return 0; }

    /** One for each class: geometry, weight and field together, so that one loop of the snippet serves all. */
    void get_buffer(std::uint32_t buffer, std::uint32_t field, elvis_buffer& out) override {
        const Class& c = m_classes.at(buffer);
        out.kind = ELVIS_BUFFER_REAL;
        out.name = "points";
        out.element_class = buffer;
        out.depends = ELVIS_DEPENDS_ON_FIELD;
        out.n_records = c.count;
        out.record_size = static_cast<std::uint32_t>((4 + m_file.fields.at(field).n_components) * c.n_points());
    }

    void fill_buffer(const elvis_fill_request& request, void* destination) override {
        const Class& c = m_classes.at(request.buffer);
        const Field& field = m_file.fields.at(request.field);
        auto* number = static_cast<double*>(destination);
        for (std::uint64_t i = 0; i < request.count; ++i) {
            const std::uint64_t index = c.first + request.first + i;
            const Element& element = m_elements.at(index);
            for (std::size_t channel = 0; channel < 4 + field.n_components; ++channel) {
                const std::size_t from = channel < 4 ? channel : m_channels.at(request.field) + channel - 4;
                // What is to be subtracted from a quotient is subtracted from its numerator times the weight.
                const double less = channel < 3   ? request.origins[3 * index + channel]
                                    : channel > 3 ? request.field_offset[channel - 4]
                                                  : 0;
                std::size_t point = 0;
                for (int z = 0; z <= c.degree[2]; ++z) {
                    for (int y = 0; y <= c.degree[1]; ++y) {
                        for (int x = 0; x <= c.degree[0]; ++x, ++point) {
                            const double* numbers = &element.coefficients[point * m_file.width()];
                            *number++ = binomial(c.degree[0], x) * binomial(c.degree[1], y) * binomial(c.degree[2], z) *
                                        (numbers[from] - less * numbers[3]);
                        }
                    }
                }
            }
        }
    }

    void get_snippet(std::uint32_t, elvis_snippet& out) override {
        static const elvis_text source = api::text(snippet::files[0].name, snippet::files[0].text);
        out.capabilities = ELVIS_SNIPPET_FIELD_GRADIENT | ELVIS_SNIPPET_MAPPING_JACOBIAN | ELVIS_SNIPPET_FIELD_OFFSET |
                           ELVIS_SNIPPET_LOCAL_ORIGIN | ELVIS_SNIPPET_ELEMENT_RECORDS;
        out.prefix = "nurbs";
        out.n_sources = 1;
        out.sources = &source;
    }

    /** With positive weights, a rational Bezier element lies in the convex hull of its points. */
    elvis_certainty get_bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) override {
        for (std::uint64_t i = 0; i < count; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                hull(m_elements.at(first + i), axis, bounds[6 * i + axis], bounds[6 * i + 3 + axis]);
            }
        }
        return ELVIS_CERTIFIED;
    }

    /** And so does its field. */
    elvis_certainty get_field_ranges(std::uint32_t field, std::uint32_t, std::uint64_t first, std::uint64_t count,
                                     std::span<double> ranges) {
        const std::size_t n = m_file.fields.at(field).n_components;
        for (std::uint64_t i = 0; i < count; ++i) {
            for (std::size_t component = 0; component < n; ++component) {
                double* range = &ranges[2 * (n * i + component)];
                hull(m_elements.at(first + i), m_channels.at(field) + component, range[0], range[1]);
            }
        }
        return ELVIS_CERTIFIED;
    }

    void get_faces(std::uint64_t first, api::StructArray<elvis_face> faces) {
        for (std::uint64_t i = 0; i < faces.size(); ++i) {
            faces.set(i, m_faces.at(first + i));
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, double* positions, double* jacobians) {
        for (std::size_t point = 0; point < xi.size() / 3; ++point) {
            std::array<double, 16> numbers{};
            evaluate(element, 0, 4, &xi[3 * point], numbers.data());
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double x = numbers[4 * axis] / numbers[12];
                if (positions) {
                    positions[3 * point + axis] = x;
                }
                for (std::size_t j = 0; jacobians && j < 3; ++j) {
                    jacobians[9 * point + 3 * axis + j] = (numbers[4 * axis + 1 + j] - x * numbers[13 + j]) / numbers[12];
                }
            }
        }
    }

    void evaluate_field(std::uint32_t field, std::uint32_t, std::uint64_t element, std::span<const double> xi, double* values,
                        double* gradients) {
        const std::size_t n = m_file.fields.at(field).n_components;
        std::vector<double> numbers(4 * n);
        for (std::size_t point = 0; point < xi.size() / 3; ++point) {
            std::array<double, 4> weight{};
            evaluate(element, 3, 1, &xi[3 * point], weight.data());
            evaluate(element, m_channels.at(field), n, &xi[3 * point], numbers.data());
            for (std::size_t component = 0; component < n; ++component) {
                const double f = numbers[4 * component] / weight[0];
                if (values) {
                    values[n * point + component] = f;
                }
                for (std::size_t j = 0; gradients && j < 3; ++j) {
                    gradients[3 * (n * point + component) + j] =
                        (numbers[4 * component + 1 + j] - f * weight[1 + j]) / weight[0];
                }
            }
        }
    }

private:
    const std::array<int, 3>& degree_of(const Element& element) const { return m_file.patches[element.patch].degree; }

    void evaluate(std::uint64_t element, std::size_t first, std::size_t count, const double* xi, double* out) const {
        const Element& from = m_elements.at(element);
        evaluate_bezier(from, degree_of(from), m_file.width(), first, count, xi, out);
    }

    /** Smallest and largest quotient of a channel's coefficients and the weights, widened by what single precision rounds. */
    void hull(const Element& element, std::size_t channel, double& low, double& high) const {
        low = std::numeric_limits<double>::infinity();
        high = -low;
        for (std::size_t at = 0; at < element.coefficients.size(); at += m_file.width()) {
            const double value = element.coefficients[at + channel] / element.coefficients[at + 3];
            low = std::min(low, value);
            high = std::max(high, value);
        }
        // Horner's scheme rounds each of p + q + r <= 24 steps; numerator and weight, and the division: below 2^-24 * 2^6.
        const double rounding = std::ldexp(std::max(std::abs(low), std::abs(high)), -18);
        low -= rounding;
        high += rounding;
    }

    /** Two local faces are one where their corners and centres coincide, within a millionth of the first one's size. */
    void find_faces() {
        using Key = std::array<std::array<long long, 3>, 5>;
        std::map<Key, std::size_t> known;
        double size = 0;
        for (std::uint64_t element = 0; element < m_elements.size(); ++element) {
            std::array<double, 6> box{};
            get_bounds(element, 1, box);
            size = std::max({size, box[3] - box[0], box[4] - box[1], box[5] - box[2]});
        }
        for (std::uint64_t element = 0; element < m_elements.size(); ++element) {
            for (int local_face = 0; local_face < 6; ++local_face) {
                Key key{};
                std::array<double, 3> centre{};
                for (std::size_t corner = 0; corner < 5; ++corner) {
                    std::array<double, 3> xi = centre;
                    if (corner < 4) {
                        std::copy_n(corner_places[face_corners[local_face][corner]], 3, xi.begin());
                        for (std::size_t axis = 0; axis < 3; ++axis) {
                            centre[axis] += xi[axis] / 4;
                        }
                    }
                    std::array<double, 3> x{};
                    evaluate_mapping(element, xi, x.data(), nullptr);
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        key[corner][axis] = std::llround(x[axis] / (1e-6 * size));
                    }
                }
                std::sort(key.begin(), key.begin() + 4);
                const auto [place, is_new] = known.try_emplace(key, m_faces.size());
                if (elvis_face* other = is_new ? nullptr : &m_faces[place->second];
                    other && other->neighbour == ELVIS_NEIGHBOUR_NONE) {
                    other->neighbour = static_cast<std::int64_t>(element);
                    other->neighbour_local_face = local_face;
                    continue;
                }
                elvis_face face{};
                face.group = ELVIS_GROUP_NONE;
                face.element = static_cast<std::int64_t>(element);
                face.local_face = local_face;
                face.neighbour = ELVIS_NEIGHBOUR_NONE;
                face.neighbour_local_face = -1;
                m_faces.push_back(face);
            }
        }
    }

    File m_file;
    std::vector<Class> m_classes;
    /** Class by class. */
    std::vector<Element> m_elements;
    /** First channel of each field. */
    std::vector<std::size_t> m_channels;
    std::vector<elvis_face> m_faces;
};

} // namespace
} // namespace elvis::nurbs

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("NURBS volume", ".nurbs")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.nurbs", .name = "NURBS volumes", .version = "1.0.0", .vendor = "ElVis",
             .description = "Draws isogeometric volumes: rational B-splines of any continuity, from text",
             .runtime = elvis::api::runtime_table<elvis::nurbs::Volume>(), .formats = &formats_table);
