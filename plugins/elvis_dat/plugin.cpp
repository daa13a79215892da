/**
 * @file plugin.cpp
 * Conversion plugin for volumes of the original ElVis.
 */
#include "dat_file.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>

namespace {

using elvis_dat::DatFile;
using elvis_dat::Element;
using elvis_dat::Type;

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) { return DatFile::has_mark(path) ? 100 : 0; }

    Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string& options)
        : ConverterSource(host), m_file(paths.front()) {
        if (paths.size() > 1) {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths[1],
                                    "this format keeps geometry and field in one file; give just that");
        }
        if (!options.empty() && options != "{}") {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths.front(), "this format has no options");
        }
    }

    void get_info(elvis_source_info& info) override {
        info.dimension = 3;
        info.n_elements = m_file.elements().size();
        info.n_fields = 1;
        info.n_time_steps = 1;
        info.mantissa_bits = 53;
        // Copies of one corner were written with five decimals in some elements and in full in others.
        info.corner_tolerance = 1e-5;
    }

    void get_field(std::uint32_t, elvis_source_field& out) override {
        out.n_components = 1;
        // The file gives no name; the original program called the field so.
        out.name = "density";
        out.continuity = ELVIS_CONTINUITY_UNKNOWN;
    }

    void get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            elvis_source_element element{};
            // Corners and axes of both types are those of elvis/element.h.
            element.shape = m_file.elements()[first + index].type == Type::prism ? ELVIS_SHAPE_PRISM : ELVIS_SHAPE_HEXAHEDRON;
            std::fill_n(element.geometry_order, 3, 1u);
            std::fill_n(element.face_groups, 6, ELVIS_GROUP_NONE);
            out.set(index, element);
        }
    }

    void get_spaces(std::uint32_t, std::uint64_t first, elvis::api::StructArray<elvis_source_space> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            const Element& source = m_file.elements()[first + index];
            elvis_source_space space{};
            // A direction of degree 0 beside others of higher degree is contained in degree 1.
            const std::int32_t least = std::max({source.degree[0], source.degree[1], source.degree[2]}) > 0 ? 1 : 0;
            for (std::size_t direction = 0; direction < 3; ++direction) {
                space.order[direction] = static_cast<std::uint32_t>(std::max(least, source.degree[direction]));
            }
            space.is_contained = 1;
            out.set(index, space);
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        for (std::size_t at = 0; at < xi.size(); at += 3) {
            const auto x = elvis_dat::position(m_file.elements()[element], &xi[at]);
            std::copy(x.begin(), x.end(), positions.begin() + static_cast<std::ptrdiff_t>(at));
        }
    }

    void sample(std::uint32_t, std::uint64_t element, std::span<const double> xi, double* values) override {
        const Element& source = m_file.elements()[element];
        const std::span<const double> coefficients = m_file.coefficients(source);
        for (std::size_t at = 0; at < xi.size(); at += 3) {
            values[at / 3] = elvis_dat::value(source, coefficients, &xi[at]);
        }
    }

private:
    DatFile m_file;
};

} // namespace

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("Volume of the original ElVis", ".dat")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.dat", .name = "ElVis volume reader", .version = "1.0.0", .vendor = "ElVis",
             .description =
                 "Converts volumes (.dat) of the original ElVis: hexahedra and prisms with modal Jacobi coefficients.",
             .converter = elvis::api::converter_table<Source>(), .formats = &formats_table);
