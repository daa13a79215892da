#include <core/render/device/in_batches.hpp>
#include <core/render/device/pixel_kernel.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/render/isosurface/isosurface_projection.hpp>
#include <core/segment/tables.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

constexpr std::uint32_t projection_group_size = 32;
/** Pixels of one dispatch: each may take a thousand evaluations. */
constexpr std::uint32_t projection_pixels_a_dispatch = 1u << 13;
/** Of m_counts. */
struct ProjectionCount {
    enum : std::size_t { evaluations, certified, verified, undecided, crossings, failures, fits, degrees, n_counts };
};

struct ProjectionListParameters {
    std::uint32_t n_pixels, groups_x, wanted_flags, kept_flags;
};

struct ProjectionParameters {
    std::uint32_t width;
    std::uint32_t first, end;
    std::uint32_t surface;
    std::uint32_t first_component, end_component;
    std::uint32_t n_isovalues, n_clips;
    std::uint32_t has_beyond;
    std::uint32_t round;
    float extent;
};

} // namespace

IsosurfaceProjection::IsosurfaceProjection(const Device& device)
    : m_device(device), m_counts(device, ProjectionCount::n_counts * sizeof(std::uint32_t)) {}

const ComposedKernel& IsosurfaceProjection::provide(const KernelRequest& request, std::uint32_t element_class,
                                                    IsosurfaceMethod method, std::uint32_t degree) {
    const bool uses_colleague = method == IsosurfaceMethod::companion;
    const Key key{element_class, uses_colleague, degree};
    const auto found = m_kernels.find(key);
    if (found != m_kernels.end()) {
        return found->second;
    }
    KernelRequest own = request;
    own.name = "isosurface_projection of element class " + std::to_string(element_class);
    own.kernel = "isosurface/isosurface_projection.comp";
    own.text += segment::segment_glsl(degree == 0 ? segment::nested_plan() : segment::fixed_plan(static_cast<int>(degree)));
    own.defines.emplace_back("CORE_USES_COLLEAGUE", uses_colleague ? "1" : "0");
    own.defines.emplace_back("CORE_PLAIN", degree == 0 ? "0" : "1");
    own.bindings = buffer_bindings({.uniform = 1, .storage = 10});
    own.push_constant_bytes = sizeof(ProjectionParameters);
    return m_kernels.try_emplace(key, m_device, own).first->second;
}

const ComposedKernel& IsosurfaceProjection::provide_list_kernel(bool fills_mask) {
    std::unique_ptr<ComposedKernel>& kernel = m_list_kernels[fills_mask ? 1 : 0];
    if (!kernel) {
        KernelRequest request = pixel_kernel("isosurface/list_open_pixels", Precision::float32,
                                             {.storage = fills_mask ? 4u : 3u}, sizeof(ProjectionListParameters));
        request.defines.emplace_back("CORE_FILLS_MASK", fills_mask ? "1" : "0");
        kernel = std::make_unique<ComposedKernel>(m_device, request);
    }
    return *kernel;
}

std::uint32_t IsosurfaceProjection::list(const Layer& layer, std::uint32_t flags, std::uint32_t kept, const Buffer* mask) {
    provide_buffer(m_list, m_device, layer.n_pixels() * sizeof(std::uint32_t));
    m_counts.fill(0);
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    const ProjectionListParameters parameters{n_pixels, pixel_groups_x, flags, kept};
    std::vector<const Buffer*> bindings{&layer.marks, &*m_list, &m_counts};
    if (mask) {
        bindings.push_back(mask);
    }
    dispatch_rows(provide_list_kernel(mask != nullptr), bindings, std::as_bytes(std::span(&parameters, 1)), layer);
    m_n_listed = m_counts.read_items<std::uint32_t>(1)[0];
    return m_n_listed;
}

void IsosurfaceProjection::draw(const ComposedKernel& kernel, const Picture& picture, std::uint32_t surface,
                                FrameCounts& counts) {
    const Layer& layer = picture.target.layer;
    // The beyond buffer is not read without depths: anything of reals.
    const Buffer& beyond = picture.target.beyond ? *picture.target.beyond : layer.normals;
    const std::array<const Buffer*, 11> bindings = {&picture.frame,        &layer.samples,   &layer.normals,     &m_counts,
                                                    &layer.marks,          &*m_list,         &picture.isovalues, &beyond,
                                                    picture.target.places, &picture.bending, &picture.last};
    m_counts.fill(0);
    in_batches(m_n_listed, items_a_dispatch(m_device, projection_pixels_a_dispatch, projection_group_size),
               [&](std::uint32_t first, std::uint32_t count) {
                   const ProjectionParameters parameters{layer.width,
                                                         first,
                                                         first + count,
                                                         surface,
                                                         picture.component.first,
                                                         picture.component.end,
                                                         picture.n_isovalues,
                                                         picture.n_clips,
                                                         picture.target.beyond ? 1u : 0u,
                                                         picture.round,
                                                         picture.extent};
                   kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)),
                                   divided_up(count, projection_group_size));
               });
    take_counts(layer, m_counts, ProjectionCount::n_counts, [&counts](std::span<const std::uint32_t> found) {
        counts.field_evaluations += found[ProjectionCount::evaluations];
        counts.certified_segments += found[ProjectionCount::certified];
        counts.verified_fits += found[ProjectionCount::verified];
        counts.undecided_fits += found[ProjectionCount::undecided];
        counts.isosurface_crossings += found[ProjectionCount::crossings];
        counts.newton_failures += found[ProjectionCount::failures];
        counts.fits += found[ProjectionCount::fits];
        counts.fit_degrees += found[ProjectionCount::degrees];
    });
    // Once, not for each class.
    counts.projected_pixels = std::max<std::uint64_t>(counts.projected_pixels, m_n_listed);
}

} // namespace elvis
