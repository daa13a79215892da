#include <core/demand/memory_need.hpp>

#include <core/expression/expression.hpp>
#include <core/hierarchy/hierarchy.hpp>
#include <core/volume/element/element_octants.hpp>
#include <core/volume/element/element_records.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
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
/** The picture as the program has it, and on its way to files: 126 were measured. */
constexpr std::uint64_t host_bytes_a_pixel = 160;
/** Parts of buffers on their way; the program, its driver and the compiler of kernels: 175 MB were measured. */
constexpr std::uint64_t device_bytes_in_any_case = std::uint64_t{1} << 20, host_bytes_in_any_case = std::uint64_t{192} << 20;

/** Of a face, without its polynomial: 150 bytes on the device and 250 on the host were measured of straight ones. */
constexpr std::uint64_t device_bytes_a_face = 200, host_bytes_a_face = 400;

/** Records are padded to rows of four numbers. */
std::uint64_t padded(std::uint64_t n_numbers) { return (n_numbers + 3) / 4 * 4; }

/** Fields as they are on the device, the magnitude's apart, which lacks nothing. */
std::set<std::pair<std::uint32_t, bool>> device_fields(const FrameRequest& request) {
    std::set<std::pair<std::uint32_t, bool>> fields;
    for (const Surface& surface : request.surfaces) {
        if (surface.field.expression) {
            for (const std::uint32_t field : surface.field.expression->fields()) {
                fields.emplace(field, false);
            }
        } else {
            fields.emplace(surface.field.field, surface.field.component < 0);
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
    const auto fields = device_fields(request);
    const bool has_lines = std::ranges::any_of(request.surfaces, [](const Surface& surface) { return surface.has_lines(); });
    for (const ClassInfo& info : whole.classes()) {
        // Origins and curvatures are records of one row each.
        m_bytes.push_back(device_bytes_an_element + 2 * 4 * real);
        m_first_elements.push_back(info.first_element);
        const std::uint64_t order = std::max<std::uint64_t>(1, *std::ranges::max_element(info.geometry_order));
        m_face_numbers = std::max(m_face_numbers, 3 * (order + 1) * (order + 1));
        m_shared_bytes += info.is_affine || info.n_elements == 0 ? 0 : n_plane_passes(request) * octants_bytes;
    }
    for (const auto& [field, is_magnitude] : fields) {
        for (std::uint64_t& bytes : m_bytes) {
            bytes += has_lines ? 4 * real * whole.fields()[field].n_components : 0;
        }
    }
    for (std::uint32_t buffer = 0; buffer < whole.n_buffers(); ++buffer) {
        for (const auto& [field, is_magnitude] : fields) {
            const BufferInfo info = whole.buffer(buffer, field);
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
    return {device, host_bytes_an_element * n_elements + (m_is_cpu ? device : 0)};
}

MemoryNeed NeedOfElements::of(std::span<const std::uint64_t> elements) const {
    MemoryNeed need;
    for (std::size_t index = 0; index < m_bytes.size(); ++index) {
        const auto first = std::ranges::lower_bound(elements, m_first_elements[index]);
        const auto end =
            index + 1 < m_bytes.size() ? std::ranges::lower_bound(elements, m_first_elements[index + 1]) : elements.end();
        need = need + of_class(index, static_cast<std::uint64_t>(end - first));
    }
    return need;
}

MemoryNeed NeedOfElements::of_all() const {
    MemoryNeed need;
    for (std::size_t index = 0; index < m_bytes.size(); ++index) {
        const std::uint64_t end = index + 1 < m_bytes.size() ? m_first_elements[index + 1] : m_n_elements;
        need = need + of_class(index, end - m_first_elements[index]);
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
    const std::uint64_t device = device_bytes_in_any_case + (layers + 4 * words_a_pixel_and_class * n_classes) * n_pixels;
    return {device, host_bytes_in_any_case + host_bytes_a_pixel * n_pixels + (is_cpu ? device : 0)};
}

std::string bytes_text(std::uint64_t bytes) {
    const unsigned shift = bytes < (std::uint64_t{64} << 20u) ? 10 : 20;
    return std::to_string((bytes + (std::uint64_t{1} << shift) - 1) >> shift) + (shift == 10 ? " KiB" : " MiB");
}

} // namespace elvis
