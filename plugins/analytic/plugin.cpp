/*
 * A runtime plugin in its smallest form: what elvis/runtime.h requires, and nothing that is optional.
 */
#include "analytic_snippet.hpp"
#include "file.hpp"

#include <elvis/plugin.hpp>

#include <cmath>
#include <limits>

namespace elvis::analytic {
namespace {

enum : std::uint32_t { geometry_buffer, terms_buffer, n_buffers };

class Volume : public api::RuntimeVolume {
public:
    static std::uint32_t probe(const char* path) { return has_our_header(path) ? 100 : 0; }

    /** There are no options. */
    Volume(const api::Host& host, const std::string& path, const std::string&) : RuntimeVolume(host), m_file(read_file(path)) {
        for (const Field& field : m_file.fields) {
            if (field.terms.empty()) {
                throw api::Error(ELVIS_ERROR_FORMAT, path, "field '" + field.name + "' has no terms");
            }
            m_constants.push_back(api::constant("ANALYTIC_N_TERMS", static_cast<std::int64_t>(field.terms.size())));
        }
    }

    void get_info(elvis_volume_info& info) override {
        info.dimension = 3;
        info.n_elements = m_file.hexahedra.size();
        info.n_classes = 1;
        info.n_fields = static_cast<std::uint32_t>(m_file.fields.size());
        info.n_time_steps = 1;
        info.n_buffers = n_buffers;
    }

    void get_class(std::uint32_t, elvis_element_class& out) override {
        out.shape = ELVIS_SHAPE_HEXAHEDRON;
        out.n_elements = m_file.hexahedra.size();
        std::fill_n(out.geometry_order, 3, 1u);
    }

    void get_field(std::uint32_t field, elvis_field& out) override {
        const Field& from = m_file.fields.at(field);
        out.n_components = from.n_components;
        out.name = from.name.c_str();
        out.unit = from.unit.empty() ? nullptr : from.unit.c_str();
        out.continuity = ELVIS_CONTINUITY_CONTINUOUS;
        out.max_jump = std::nan("");
    }

    void get_class_field(std::uint32_t, std::uint32_t field, elvis_class_field& out) override {
        out.n_constants = 1;
        out.constants = &m_constants.at(field);
        std::fill_n(out.order, 3, -1);
    }

    double get_time(std::uint32_t) override { return 0; }

    void get_buffer(std::uint32_t buffer, std::uint32_t field, elvis_buffer& out) override {
        out.kind = ELVIS_BUFFER_REAL;
        if (buffer == geometry_buffer) {
            out.name = "geometry";
            out.n_records = m_file.hexahedra.size();
            out.record_size = 24;
        } else {
            out.name = "terms";
            out.depends = ELVIS_DEPENDS_ON_FIELD;
            out.element_class = ELVIS_ALL_CLASSES;
            out.n_records = 1;
            out.record_size = 8 * static_cast<std::uint32_t>(m_file.fields.at(field).terms.size());
        }
    }

    void get_snippet(std::uint32_t, elvis_snippet& out) override {
        static const elvis_text source = api::text(snippet::files[0].name, snippet::files[0].text);
        out.prefix = "analytic";
        out.n_sources = 1;
        out.sources = &source;
    }

    /** A trilinear image lies in the convex hull of its corners. */
    elvis_certainty get_bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) override {
        for (std::uint64_t i = 0; i < count; ++i) {
            for (std::size_t d = 0; d < 3; ++d) {
                double low = std::numeric_limits<double>::infinity();
                double high = -low;
                for (const std::uint32_t corner : m_file.hexahedra.at(first + i)) {
                    low = std::min(low, m_file.vertices[corner][d]);
                    high = std::max(high, m_file.vertices[corner][d]);
                }
                // The snippet sums eight products of rounded coefficients, none larger than the largest coordinate: in single
                // precision at most 8 (1 + 4) 2^-24 of it.
                const double rounding = std::ldexp(std::max(std::abs(low), std::abs(high)), -18);
                bounds[6 * i + d] = low - rounding;
                bounds[6 * i + 3 + d] = high + rounding;
            }
        }
        return ELVIS_CERTIFIED;
    }

    void fill_buffer(const elvis_fill_request& request, void* destination) override {
        auto* numbers = static_cast<double*>(destination);
        if (request.buffer == geometry_buffer) {
            for (std::uint64_t i = 0; i < request.count; ++i) {
                write_geometry(m_file.hexahedra.at(request.first + i), numbers + 24 * i);
            }
            return;
        }
        for (const Term& term : m_file.fields.at(request.field).terms) {
            const auto& p = term.parameters;
            for (const double number : {static_cast<double>(term.kind), static_cast<double>(term.component), term.amplitude,
                                        p[3], p[0], p[1], p[2], 0.0}) {
                *numbers++ = number;
            }
        }
    }

private:
    /** Coefficients of 1, xi1, xi2, xi1 xi2, and of the same times xi3, for x, then y, then z. */
    void write_geometry(const std::array<std::uint32_t, 8>& corners, double* out) const {
        for (std::size_t d = 0; d < 3; ++d) {
            for (unsigned product = 0; product < 8; ++product) {
                double sum = 0;
                for (unsigned corner = 0; corner < 8; ++corner) {
                    // Signs of xi at the corner, as bits: set means +1. Corners 2, 3 and 6, 7 run backwards.
                    const unsigned plus = corner ^ ((corner >> 1) & 1u);
                    const bool negative = (__builtin_popcount(product & ~plus) & 1) != 0;
                    sum += (negative ? -1 : 1) * m_file.vertices[corners[corner]][d];
                }
                *out++ = sum / 8;
            }
        }
    }

    File m_file;
    std::vector<elvis_constant> m_constants;
};

} // namespace
} // namespace elvis::analytic

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("Analytic fields", ".txt")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.analytic", .name = "Analytic fields", .version = "1.0.0", .vendor = "ElVis",
             .description = "Draws closed-form fields on hexahedra given as text",
             .runtime = elvis::api::runtime_table<elvis::analytic::Volume>(), .formats = &formats_table);
