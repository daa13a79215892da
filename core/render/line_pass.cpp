#include <core/render/line_pass.hpp>
#include <core/render/real_array.hpp>

#include <algorithm>

namespace elvis {

namespace {

constexpr std::uint32_t group_width = 32;
/** Pixels of one dispatch: bounds its time. */
constexpr std::uint32_t pixels_a_dispatch = 1u << 16;

struct Parameters {
    std::uint32_t width, height;
    std::uint32_t first_row;
    std::uint32_t first_component, end_component;
    std::uint32_t n_isovalues;
    std::uint32_t with_mesh_lines;
    std::uint32_t subdivisions;
};

} // namespace

LinePass::LinePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, bool on_faces)
    : m_device(device), m_precision(data.precision()),
      m_frame(device, cut_plane_rows * 4 * real_bytes(data.precision()), Buffer::Use::uniform),
      m_counts(device, sizeof(std::uint32_t)) {
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        if (volume.classes()[index].n_elements == 0) {
            continue;
        }
        KernelRequest request;
        request.name = "surface_lines of element class " + std::to_string(index);
        request.kernel = "kernels/surface_lines.comp";
        request.precision = m_precision;
        request.buffers = data.host_buffers(index);
        data.add_field(request, index, true);
        request.defines = {{"CORE_ON_FACES", on_faces ? "1" : "0"}};
        request.bindings = {{0, BindingType::uniform_buffer}};
        for (std::uint32_t binding = 1; binding <= (on_faces ? 5u : 6u); ++binding) {
            request.bindings.push_back({binding, BindingType::storage_buffer});
        }
        request.push_constant_bytes = sizeof(Parameters);
        m_kernels.push_back(std::make_unique<ComposedKernel>(device, request));
    }
}

void LinePass::draw(const CutPlaneGeometry& view, const ShownComponent& component, const LineRequest& lines,
                    const Buffer* bending, const LayerTarget& target, FrameCounts& counts) {
    const Layer& layer = target.layer;
    write_reals(m_frame, m_precision, std::span<const double>(view.rows.front().data(), 4 * view.rows.size()));
    m_counts.fill(0);
    const auto n_isovalues = static_cast<std::uint32_t>(lines.isovalues.size());
    // A buffer cannot be empty.
    const std::uint64_t bytes = std::max<std::uint64_t>(n_isovalues, 1) * real_bytes(m_precision);
    if (!m_isovalues || m_isovalues->bytes() != bytes) {
        m_isovalues.emplace(m_device, bytes);
    }
    write_reals(*m_isovalues, m_precision, lines.isovalues);
    std::vector<const Buffer*> bindings = {&m_frame, &layer.samples, &layer.normals, &m_counts, &layer.marks, &*m_isovalues};
    if (bending != nullptr) {
        bindings.push_back(bending);
    }
    const std::uint32_t rows_a_dispatch = std::max(1u, pixels_a_dispatch / layer.width);
    for (const std::unique_ptr<ComposedKernel>& kernel : m_kernels) {
        for (std::uint32_t first_row = 0; first_row < layer.height; first_row += rows_a_dispatch) {
            const Parameters parameters{layer.width,     layer.height,           first_row,
                                        component.first(), component.end(),        n_isovalues,
                                        lines.mesh_lines ? 1u : 0u, lines.subdivisions};
            kernel->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), (layer.width + group_width - 1) / group_width,
                             std::min(rows_a_dispatch, layer.height - first_row));
        }
    }
    const std::uint32_t n_evaluations = m_counts.read_items<std::uint32_t>(1)[0];
    counts.field_evaluations += n_evaluations;
}

} // namespace elvis
