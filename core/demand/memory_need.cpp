#include <core/demand/memory_need.hpp>

#include <core/expression/expression.hpp>
#include <core/hierarchy/hierarchy.hpp>
#include <core/volume/element/element_octants.hpp>
#include <core/volume/element/element_records.hpp>
#include <core/volume/isosurface/isovalue_set.hpp>
#include <core/volume/isosurface/octant_records.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <bit>
#include <set>
#include <tuple>
#include <utility>

namespace elvis {

namespace {

/** Two nodes of the hierarchy, records of where Newton's method starts, and what is known of strongly bent ones. */
constexpr std::uint64_t device_bytes_an_element = 2 * sizeof(HierarchyNode) + 4 * element_record_size + 20;
/** Boxes, origins, the hierarchy while it is built and as it is, curvatures, numbers: 390 bytes by count, of which some go. */
constexpr std::uint64_t host_bytes_an_element = 400;
/**
 * The layer of a surface: 61 bytes were measured in single precision without lines, 105 in double precision with them. Several
 * surfaces, faces and such as are seen through take another layer. Each class has lists of pixels.
 */
constexpr std::uint64_t reals_a_pixel = 12, words_a_pixel = 5, words_a_pixel_and_class = 4;
/** Of isosurfaces besides: two crossings, curvature, a list. */
constexpr std::uint64_t isosurface_reals_a_pixel = 7, isosurface_words_a_pixel = 1;
/** The picture as the program has it, and on its way to files: 126 were measured. */
constexpr std::uint64_t host_bytes_a_pixel = 160;
/** Parts of buffers on their way; the program, its driver and the compiler of kernels: 175 MB were measured. */
constexpr std::uint64_t device_bytes_in_any_case = std::uint64_t{1} << 20, host_bytes_in_any_case = std::uint64_t{192} << 20;

/** Of a face, without its polynomial: 150 bytes on the device and 250 on the host were measured of straight ones. */
constexpr std::uint64_t device_bytes_a_face = 200, host_bytes_a_face = 400;

/** Besides, of an isosurface: two nodes and a model of an element; of an octant two nodes and its record. */
constexpr std::uint64_t device_bytes_a_model = 2 * sizeof(HierarchyNode) + 32,
                        device_bytes_an_octant = 2 * sizeof(HierarchyNode) + octant_size * sizeof(std::uint32_t);
/** Boxes and ranges; records as they come from the device and go back, boxes, and the hierarchy. */
constexpr std::uint64_t host_bytes_a_model = 200, host_bytes_an_octant = 500;

/** Records are padded to rows of four numbers. */
std::uint64_t padded(std::uint64_t n_numbers) { return (n_numbers + 3) / 4 * 4; }

/** A field as it is on the device: lacking the middle of its range, a value near isovalues, or nothing. */
struct DeviceField {
    std::uint32_t field = 0;
    bool is_magnitude = false;
    std::optional<double> about{};

    auto operator<=>(const DeviceField&) const = default;
};

DeviceField field_of(const Isosurfaces& isosurfaces) {
    const FieldChoice& field = isosurfaces.field;
    const double middle = 0.5 * (isosurfaces.values.front() + isosurfaces.values.back());
    return {field.field, field.component < 0, field.component < 0 ? std::nullopt : std::optional(middle)};
}

/** Of isosurfaces that are looked for by the ranges of elements. */
std::set<DeviceField> isosurface_fields(const FrameRequest& request) {
    std::set<DeviceField> fields;
    for (const Surface& surface : request.surfaces) {
        const Isosurfaces* const isosurfaces = traits_of(surface.geometry).isosurfaces;
        if (isosurfaces != nullptr && !isosurfaces->field.expression) {
            fields.insert(field_of(*isosurfaces));
        }
    }
    return fields;
}

std::set<DeviceField> device_fields(const FrameRequest& request) {
    std::set<DeviceField> fields = isosurface_fields(request);
    for (const Surface& surface : request.surfaces) {
        const Isosurfaces* const isosurfaces = traits_of(surface.geometry).isosurfaces;
        if (surface.field.expression) {
            for (const std::uint32_t field : surface.field.expression->fields()) {
                fields.insert({field, false, {}});
            }
        } else if (isosurfaces == nullptr || surface.field != isosurfaces->field) {
            fields.insert({surface.field.field, surface.field.component < 0, {}});
        }
    }
    return fields;
}

/** Kernels that look for points of planes: each may come to look for them in octants. */
std::size_t n_plane_passes(const FrameRequest& request) {
    std::set<std::tuple<std::string, std::uint32_t, bool, bool>> passes;
    for (const Surface& surface : request.surfaces) {
        if (std::holds_alternative<CutPlane>(surface.geometry)) {
            const FieldChoice& field = surface.field;
            passes.emplace(field.expression ? field.expression->text() : std::string(), field.field, field.component < 0,
                           surface.has_lines());
        }
    }
    return passes.size();
}

} // namespace

NeedOfElements::NeedOfElements(const FrameRequest& request, const RuntimeVolume& whole, Precision precision, bool is_cpu)
    : m_n_elements(whole.n_elements()), m_real_bytes(real_bytes(precision)), m_is_cpu(is_cpu) {
    const std::uint64_t real = real_bytes(precision);
    const std::set<DeviceField> fields = device_fields(request), of_isosurfaces = isosurface_fields(request);
    m_n_isosurfaces = of_isosurfaces.size();
    const bool has_lines = std::ranges::any_of(request.surfaces, [](const Surface& surface) { return surface.has_lines(); });
    for (const ClassInfo& info : whole.classes()) {
        // Origins and curvatures are records of one row each.
        m_bytes.push_back(device_bytes_an_element + 2 * 4 * real + m_n_isosurfaces * device_bytes_a_model);
        m_first_elements.push_back(info.first_element);
        const std::uint64_t order = std::max<std::uint64_t>(1, *std::ranges::max_element(info.geometry_order));
        m_face_numbers = std::max(m_face_numbers, 3 * (order + 1) * (order + 1));
        m_shared_bytes += info.is_affine || info.n_elements == 0 ? 0 : n_plane_passes(request) * octants_bytes;
    }
    for (const DeviceField& shown : fields) {
        const bool has_bounds = has_lines || of_isosurfaces.contains(shown);
        for (std::uint64_t& bytes : m_bytes) {
            bytes += has_bounds ? 4 * real * whole.fields()[shown.field].n_components : 0;
        }
    }
    for (std::uint32_t buffer = 0; buffer < whole.n_buffers(); ++buffer) {
        for (const DeviceField& shown : fields) {
            const BufferInfo info = whole.buffer(buffer, shown.field);
            const std::uint64_t record =
                padded(info.record_size) * (info.kind == ELVIS_BUFFER_REAL ? real : sizeof(std::uint32_t));
            if (info.element_class == ELVIS_ALL_CLASSES) {
                m_shared_bytes += record * info.n_records;
            } else {
                m_bytes[info.element_class] += record;
            }
            if ((info.depends & ELVIS_DEPENDS_ON_FIELD) == 0) {
                break;
            }
        }
    }
}

MemoryNeed NeedOfElements::of_class(std::size_t element_class, std::uint64_t n_elements) const {
    const std::uint64_t device = m_bytes[element_class] * n_elements;
    const std::uint64_t host = (host_bytes_an_element + m_n_isosurfaces * host_bytes_a_model) * n_elements;
    return {device, host + (m_is_cpu ? device : 0)};
}

/** Of elements of one class. */
MemoryNeed NeedOfElements::of_octants(std::uint64_t n_elements) const {
    const std::uint64_t n_octants =
        n_elements > 0 ? m_n_isosurfaces * std::bit_ceil(most_isosurface_octants(n_elements, 0)) : 0;
    const std::uint64_t device = device_bytes_an_octant * n_octants;
    return {device, host_bytes_an_octant * n_octants + (m_is_cpu ? device : 0)};
}

MemoryNeed NeedOfElements::of(std::span<const std::uint64_t> elements) const {
    MemoryNeed need;
    for (std::size_t index = 0; index < m_bytes.size(); ++index) {
        const auto first = std::ranges::lower_bound(elements, m_first_elements[index]);
        const auto end =
            index + 1 < m_bytes.size() ? std::ranges::lower_bound(elements, m_first_elements[index + 1]) : elements.end();
        const auto n_elements = static_cast<std::uint64_t>(end - first);
        need = need + of_class(index, n_elements) + of_octants(n_elements);
    }
    return need;
}

MemoryNeed NeedOfElements::of_all() const {
    MemoryNeed need;
    for (std::size_t index = 0; index < m_bytes.size(); ++index) {
        const std::uint64_t end = index + 1 < m_bytes.size() ? m_first_elements[index + 1] : m_n_elements;
        const std::uint64_t n_elements = end - m_first_elements[index];
        need = need + of_class(index, n_elements) + of_octants(n_elements);
    }
    return need;
}

MemoryNeed NeedOfElements::of_faces(std::uint64_t n_faces) const {
    const std::uint64_t device = (device_bytes_a_face + padded(m_face_numbers) * m_real_bytes) * n_faces;
    // Polynomials are fitted in double precision.
    return {device, (host_bytes_a_face + m_face_numbers * sizeof(double)) * n_faces + (m_is_cpu ? device : 0)};
}

MemoryNeed NeedOfElements::least_of(std::uint64_t n_elements) const {
    return of_class(static_cast<std::size_t>(std::ranges::min_element(m_bytes) - m_bytes.begin()), n_elements);
}

std::uint64_t NeedOfElements::most(const MemoryBudget& budget) const {
    const MemoryNeed one = least_of(1);
    return std::min(
        {m_n_elements, budget.device.value_or(UINT64_MAX) / one.device, budget.host.value_or(UINT64_MAX) / one.host});
}

MemoryNeed need_of_picture(const FrameRequest& request, std::size_t n_classes, Precision precision, bool is_cpu) {
    const std::uint64_t n_pixels = std::uint64_t{request.width} * request.height;
    const bool is_simple = request.surfaces.size() == 1 && !request.surfaces.front().is_see_through() &&
                           std::holds_alternative<CutPlane>(request.surfaces.front().geometry);
    const std::uint64_t layers = (is_simple ? 1 : 2) * (reals_a_pixel * real_bytes(precision) + 4 * words_a_pixel);
    const std::uint64_t isosurfaces =
        isosurface_fields(request).size() * (isosurface_reals_a_pixel * real_bytes(precision) + 4 * isosurface_words_a_pixel);
    const std::uint64_t device =
        device_bytes_in_any_case + (layers + isosurfaces + 4 * words_a_pixel_and_class * n_classes) * n_pixels;
    return {device, host_bytes_in_any_case + host_bytes_a_pixel * n_pixels + (is_cpu ? device : 0)};
}

std::string bytes_text(std::uint64_t bytes) {
    const unsigned shift = bytes < (std::uint64_t{64} << 20u) ? 10 : 20;
    return std::to_string((bytes + (std::uint64_t{1} << shift) - 1) >> shift) + (shift == 10 ? " KiB" : " MiB");
}

} // namespace elvis
