#include <core/render/face_pass.hpp>
#include <core/render/real_array.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

constexpr std::uint32_t group_width = 32;
/** Pixels of one dispatch: bounds its time. */
constexpr std::uint32_t pixels_a_dispatch = 1u << 17;

struct Parameters {
    std::uint32_t width, height;
    std::uint32_t first_row;
    std::uint32_t surface;
    std::uint32_t first_component, end_component;
    std::uint32_t is_discontinuous;
};

/** Patches along each side of a face that Newton's method starts from: one where the mapping is affine. */
int patches(const ClassInfo& info) {
    const bool is_straight = info.geometry_order[0] == 1 && info.geometry_order[1] == 1 && info.geometry_order[2] <= 1;
    const bool is_simplex = info.shape == ELVIS_SHAPE_TRIANGLE || info.shape == ELVIS_SHAPE_TETRAHEDRON;
    return !is_straight ? 4 : is_simplex ? 1 : 2;
}

/** Those of the class, with the faces' hierarchy in place of the elements'. */
std::vector<FetchBuffer> host_buffers(const DeviceVolume& data, const FaceSet* faces, std::uint32_t element_class) {
    std::vector<FetchBuffer> buffers = data.host_buffers(element_class);
    if (faces != nullptr) {
        for (FetchBuffer& buffer : buffers) {
            if (buffer.name == "core_nodes") {
                buffer.records = faces->nodes(element_class);
            }
        }
        buffers.push_back({"core_faces", faces->faces(element_class)});
    }
    return buffers;
}

} // namespace

FacePass::FacePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, const FaceSet* faces)
    : m_precision(data.precision()), m_frame(device, cut_plane_rows * 4 * real_bytes(data.precision()), Buffer::Use::uniform),
      m_counts(device, n_pass_counts * sizeof(std::uint32_t)) {
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        if (info.n_elements == 0 || (faces != nullptr && faces->nodes(index) == nullptr)) {
            continue;
        }
        KernelRequest request;
        request.name = "faces of element class " + std::to_string(index);
        request.kernel = "kernels/faces.comp";
        request.precision = m_precision;
        request.instances = {data.instance(index)};
        request.buffers = host_buffers(data, faces, index);
        request.defines = {{"CORE_PATCHES", std::to_string(patches(info))}};
        request.bindings = {{0, BindingType::uniform_buffer},
                            {1, BindingType::storage_buffer},
                            {2, BindingType::storage_buffer},
                            {3, BindingType::storage_buffer},
                            {4, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(Parameters);
        m_kernels.push_back(std::make_unique<ComposedKernel>(device, request));
    }
}

void FacePass::draw(const CutPlaneGeometry& view, std::uint32_t first_surface, const ShownComponent& component,
                    const LayerTarget& target, FrameCounts& counts) {
    write_reals(m_frame, m_precision, std::span<const double>(view.rows.front().data(), 4 * view.rows.size()));
    m_counts.fill(0);
    const std::uint32_t rows_a_dispatch = std::max(1u, pixels_a_dispatch / target.layer.width);
    const std::array<const Buffer*, 5> bindings = {&m_frame, &target.layer.samples, &target.layer.normals, &m_counts, &target.layer.marks};
    for (std::uint32_t index = 0; index < m_kernels.size(); ++index) {
        for (std::uint32_t first_row = 0; first_row < target.layer.height; first_row += rows_a_dispatch) {
            const Parameters parameters{target.layer.width,
                                        target.layer.height,
                                        first_row,
                                        first_surface + index,
                                        component.first(),
                                        component.end(),
                                        component.is_discontinuous ? 1u : 0u};
            m_kernels[index]->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)),
                                       (target.layer.width + group_width - 1) / group_width,
                                       std::min(rows_a_dispatch, target.layer.height - first_row));
        }
    }
    const std::vector<std::uint32_t> found = m_counts.read_items<std::uint32_t>(n_pass_counts);
    counts.field_evaluations += found[0];
    counts.newton_iterations += found[1];
    counts.newton_failures += found[2];
}

} // namespace elvis
