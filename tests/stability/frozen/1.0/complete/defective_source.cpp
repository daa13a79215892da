/*
 * The converter of the defective plugin.
 */
#include "defective_data.hpp"

#include <cmath>

using namespace defective;

struct elvis_source_volume {
    Data data;
};

namespace {

elvis_result open_source(const elvis_host* host, const char* const* paths, std::uint32_t, const char* options,
                         elvis_source_volume** source) {
    Data data;
    const elvis_result result = open_data(host, paths[0], options, data);
    if (result == ELVIS_OK) {
        *source = new elvis_source_volume{data};
    }
    return result;
}

void close_source(elvis_source_volume* source) {
    --n_open;
    delete source;
}

elvis_result get_source_info(elvis_source_volume*, elvis_source_info* out) {
    out->dimension = 3;
    out->n_elements = 2;
    out->n_corner_ids = 12;
    out->n_fields = 1;
    out->n_time_steps = 1;
    out->mantissa_bits = has("source-bits") ? 99 : 53;
    return ELVIS_OK;
}

elvis_result get_source_field(elvis_source_volume* source, std::uint32_t, elvis_source_field* out) {
    out->n_components = 1;
    out->name = source->data.name.c_str();
    out->continuity = ELVIS_CONTINUITY_CONTINUOUS;
    return ELVIS_OK;
}

elvis_result get_elements(elvis_source_volume*, std::uint64_t first, std::uint64_t count, elvis_source_element* elements) {
    // Four corners at each of x = -1, 1, 3, counted round the face.
    constexpr std::int64_t of_corner[] = {0, 4, 5, 1, 3, 7, 6, 2};
    auto* entry = reinterpret_cast<unsigned char*>(elements);
    const std::size_t stride = has("source-stride") ? sizeof(elvis_source_element) : elements->struct_size;
    for (std::uint64_t i = 0; i < count; ++i, entry += stride) {
        elvis_source_element out{};
        out.struct_size = elements->struct_size;
        out.shape = ELVIS_SHAPE_HEXAHEDRON;
        std::fill_n(out.geometry_order, 3, has("source-geometry") ? 1u : 2u);
        const auto element = static_cast<std::int64_t>(has("source-piece") ? i : first + i);
        for (std::size_t corner = 0; corner < 8; ++corner) {
            out.corners[corner] = of_corner[corner] + 4 * element;
        }
        if (has("source-corner")) {
            std::swap(out.corners[2], out.corners[3]);
        }
        std::fill_n(out.face_groups, 6, ELVIS_GROUP_NONE);
        std::memcpy(entry, &out, sizeof out);
    }
    return ELVIS_OK;
}

elvis_result get_spaces(elvis_source_volume*, std::uint32_t, std::uint64_t, std::uint64_t count, elvis_source_space* spaces) {
    auto* entry = reinterpret_cast<unsigned char*>(spaces);
    for (std::uint64_t i = 0; i < count; ++i, entry += spaces->struct_size) {
        elvis_source_space out{};
        out.struct_size = spaces->struct_size;
        std::fill_n(out.order, 3, has("source-claims") ? 1u : 2u);
        out.is_contained = 1;
        std::memcpy(entry, &out, sizeof out);
    }
    return ELVIS_OK;
}

elvis_result map_source(elvis_source_volume*, std::uint64_t element, std::uint64_t n_points, const double* xi,
                        double* positions) {
    for (std::uint64_t i = 0; i < n_points; ++i) {
        position(element, xi + 3 * i, positions + 3 * i);
    }
    return ELVIS_OK;
}

elvis_result sample(elvis_source_volume* source, std::uint32_t, std::uint64_t, std::uint64_t n_points, const double* xi,
                    double* values) {
    const Inside inside(has("source-threads"));
    for (std::uint64_t i = 0; i < n_points; ++i) {
        if (has("source-unwritten") && i + 1 == n_points && n_points > 1) {
            continue;
        }
        const bool is_wrong = inside.is_disturbed() || (has("source-batch") && n_points == 1);
        values[i] = value(source->data, xi + 3 * i) + (is_wrong ? 1 : 0);
    }
    return ELVIS_OK;
}

} // namespace

const elvis_converter* defective::converter() {
    static const elvis_converter table = {sizeof(elvis_converter),
                                          0,
                                          probe,
                                          open_source,
                                          close_source,
                                          get_source_info,
                                          get_source_field,
                                          get_elements,
                                          get_spaces,
                                          map_source,
                                          sample,
                                          nullptr,
                                          nullptr,
                                          nullptr};
    return &table;
}
