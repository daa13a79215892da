#include <core/render/cut_plane_pass.hpp>
#include <core/render/real_array.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

constexpr std::uint32_t group_width = 32;
/** Pixels of one dispatch: bounds its time, so that no driver's time limit is met and a picture could be given up in between.
 */
constexpr std::uint32_t pixels_a_dispatch = 1u << 19;
constexpr std::uint32_t magnitude = 0xffffffffu;
constexpr std::size_t n_counts = 3;
constexpr std::size_t frame_rows = 9;

struct Parameters {
    std::uint32_t width, height;
    std::uint32_t first_row;
    std::uint32_t surface;
    std::uint32_t component;
    std::uint32_t is_discontinuous;
};

} // namespace

CutPlanePass::CutPlanePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_precision(data.precision()), m_frame(device, frame_rows * 4 * real_bytes(data.precision()), Buffer::Use::uniform),
      m_counts(device, n_counts * sizeof(std::uint32_t)) {
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        if (volume.classes()[index].n_elements == 0) {
            continue;
        }
        KernelRequest request;
        request.name = "cut_plane of element class " + std::to_string(index);
        request.kernel = "kernels/cut_plane.comp";
        request.precision = m_precision;
        request.instances = {data.instance(index)};
        request.buffers = data.host_buffers(index);
        request.bindings = {
            {0, BindingType::uniform_buffer}, {1, BindingType::storage_buffer}, {2, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(Parameters);
        m_kernels.push_back(std::make_unique<ComposedKernel>(device, request));
    }
}

void CutPlanePass::draw(const CutPlaneGeometry& geometry, std::uint32_t surface, std::int32_t component, bool is_discontinuous,
                        const Target& target, FrameCounts& counts) const {
    write_reals(m_frame, m_precision, std::span<const double>(geometry.rows.front().data(), 4 * geometry.rows.size()));
    const std::array<const Buffer*, 3> bindings = {&m_frame, &target.samples, &m_counts};
    const std::uint32_t rows_a_dispatch = std::max(1u, pixels_a_dispatch / target.width);
    for (const auto& kernel : m_kernels) {
        for (std::uint32_t first_row = 0; first_row < target.height; first_row += rows_a_dispatch) {
            const Parameters parameters{target.width,
                                        target.height,
                                        first_row,
                                        surface,
                                        component < 0 ? magnitude : static_cast<std::uint32_t>(component),
                                        is_discontinuous ? 1u : 0u};
            m_counts.fill(0);
            kernel->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), (target.width + group_width - 1) / group_width,
                             std::min(rows_a_dispatch, target.height - first_row));
            const std::vector<std::uint32_t> found = m_counts.read_items<std::uint32_t>(n_counts);
            counts.field_evaluations += found[0];
            counts.newton_iterations += found[1];
            counts.newton_failures += found[2];
        }
    }
}

} // namespace elvis
