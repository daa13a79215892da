#include <core/base/bounds.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/render/segments/walk_search.hpp>
#include <core/render/tiles/tile_list.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis {

namespace {

/** Words of a tile's list: shaders/tiles/ray_tiles.glsl. */
constexpr std::uint32_t walk_tile_stride = 64;
constexpr std::uint32_t walk_group_size = 32;
enum EyeCount : std::size_t { eye_evaluations, eye_overlaps };

struct WalkTilesParameters {
    std::uint32_t tiles_a_row, n_tiles, first_tile, end_tile;
};

struct EyeParameters {
    std::uint32_t width, height;
    std::uint32_t first_group;
    std::uint32_t first_element;
    std::uint32_t zero;
    float extent, data_error;
};

struct SeekParameters {
    std::uint32_t width, height;
    std::uint32_t tiles_a_row;
    std::uint32_t first_group;
    std::uint32_t first_element;
    std::uint32_t zero;
    float extent, data_error;
    float overlap_length;
};

/** Of positions, which solvers and converters have rounded in double precision: see shaders/cut_surface/element_candidate.glsl.
 */
double data_error_of(const std::array<double, 6>& bounds) {
    double farthest = 0;
    for (const double coordinate : bounds) {
        farthest = std::max(farthest, std::abs(coordinate));
    }
    return 32 * 0x1p-53 * farthest;
}

} // namespace

WalkSearch::WalkSearch(const Device& device, const DeviceVolume& data, const WalkData& walk_data, const RuntimeVolume& volume,
                       std::vector<std::pair<std::string, std::string>> defines, bool are_given)
    : m_device(device), m_data(data), m_walk_data(walk_data), m_defines(std::move(defines)), m_are_given(are_given),
      m_tile_width(tile_width_on(device)), m_extent(static_cast<float>(diagonal_of(data.bounds()))),
      m_data_error(static_cast<float>(data_error_of(data.bounds()))), m_counts(device, n_counts * sizeof(std::uint32_t)) {
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        if (info.n_elements > 0) {
            m_ranges.push_back(
                {index, static_cast<std::uint32_t>(info.first_element), static_cast<std::uint32_t>(info.n_elements)});
        }
    }
    m_kernels.resize(m_ranges.size());
}

KernelRequest WalkSearch::request(const Range& range, const char* kernel) const {
    KernelRequest request;
    request.name = std::string(kernel) + " of element class " + std::to_string(range.element_class);
    request.kernel = std::string(kernel) + ".comp";
    request.precision = m_data.precision();
    request.buffers = m_walk_data.host_buffers(range.element_class);
    request.buffers.push_back(m_data.elements(range.element_class));
    request.defines = {{"CORE_TILE_WIDTH", std::to_string(m_tile_width) + "u"},
                       {"CORE_TILE_HEIGHT", std::to_string(tile_height) + "u"},
                       GroupShape(m_tile_width).define(),
                       {"CORE_LEAF_WORD", "index"},
                       m_walk_data.curved_define(range.element_class)};
    request.defines.insert(request.defines.end(), m_defines.begin(), m_defines.end());
    return request;
}

void WalkSearch::compile() {
    for (std::size_t index = 0; index < m_ranges.size(); ++index) {
        Kernels& kernels = m_kernels[index];
        if (kernels.seek) {
            continue;
        }
        const Range& range = m_ranges[index];
        if (!m_are_given) {
            KernelRequest tiles = request(range, "tiles/ray_tiles");
            tiles.defines.emplace_back("CORE_TESTS_STARTS", "1");
            tiles.instances = {m_data.instance(range.element_class)};
            tiles.bindings = buffer_bindings({.uniform = 1, .storage = 2});
            tiles.push_constant_bytes = sizeof(WalkTilesParameters);
            kernels.tiles = std::make_unique<ComposedKernel>(m_device, tiles);
        }
        KernelRequest seek = request(range, "segments/find_walk");
        seek.instances = {m_data.instance(range.element_class)};
        seek.bindings = buffer_bindings({.uniform = 1, .storage = 4});
        seek.push_constant_bytes = sizeof(SeekParameters);
        kernels.seek = std::make_unique<ComposedKernel>(m_device, seek);
    }
}

void WalkSearch::list_starts(const WalkRays& rays) {
    const std::uint32_t n_tiles = tiles_a_row(rays.width) * divided_up(rays.height, tile_height);
    const WalkTilesParameters parameters{tiles_a_row(rays.width), n_tiles, 0, n_tiles};
    const std::uint64_t bytes = std::uint64_t{parameters.n_tiles} * walk_tile_stride * sizeof(std::uint32_t);
    const std::uint64_t flag_bytes = std::uint64_t{parameters.n_tiles} * sizeof(std::uint32_t);
    provide_buffer(m_has_starts, m_device, flag_bytes).fill(0);
    for (std::size_t index = 0; index < m_ranges.size(); ++index) {
        Kernels& kernels = m_kernels[index];
        provide_buffer(kernels.lists, m_device, bytes);
        if (m_walk_data.n_starts(m_ranges[index].element_class) > 0) {
            const std::array<const Buffer*, 3> bindings = {&rays.frame, &*kernels.lists, &*m_has_starts};
            kernels.tiles->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)),
                                    divided_up(parameters.n_tiles, walk_group_size));
        }
    }
}

const ComposedKernel& WalkSearch::eye_kernel(std::size_t index) {
    std::unique_ptr<ComposedKernel>& kernel = m_kernels[index].start_at_eye;
    if (!kernel) {
        const Range& range = m_ranges[index];
        KernelRequest wanted = request(range, "segments/start_at_eye");
        wanted.instances = {m_data.instance(range.element_class)};
        wanted.bindings = buffer_bindings({.uniform = 1, .storage = 3});
        wanted.push_constant_bytes = sizeof(EyeParameters);
        kernel = std::make_unique<ComposedKernel>(m_device, wanted);
    }
    return *kernel;
}

std::uint64_t WalkSearch::start_at_eyes(const WalkRays& rays, const RayGroups& groups) {
    bool is_any = false;
    for (std::size_t index = 0; index < m_ranges.size(); ++index) {
        if (!m_walk_data.may_hold_eye(m_ranges[index].element_class)) {
            continue;
        }
        if (!is_any) {
            begin_search();
        }
        is_any = true;
        const EyeParameters parameters{rays.width, rays.height, 0, m_ranges[index].first_element, 0, m_extent, m_data_error};
        const std::array<const Buffer*, 4> bindings = {&rays.frame, &rays.states, &m_counts,
                                                       m_are_given ? rays.given : groups.list};
        dispatch(eye_kernel(index), bindings, parameters, rays, groups);
    }
    return is_any ? m_counts.read_items<std::uint32_t>(n_counts)[eye_evaluations] : 0;
}

void WalkSearch::seek(std::size_t index, const WalkRays& rays, const RayGroups& groups) {
    if (m_walk_data.n_starts(m_ranges[index].element_class) == 0) {
        return;
    }
    const SeekParameters parameters{rays.width, rays.height,  tiles_a_row(rays.width), 0, m_ranges[index].first_element, 0,
                                    m_extent,   m_data_error, m_data.overlap_length()};
    // No lists are read where rays are given: anything.
    const std::array<const Buffer*, 5> bindings = {&rays.frame, &rays.states,
                                                   m_are_given ? &m_counts : &*m_kernels[index].lists, &m_counts,
                                                   m_are_given ? rays.given : groups.list};
    dispatch(*m_kernels[index].seek, bindings, parameters, rays, groups);
}

template <class Parameters>
void WalkSearch::dispatch(const ComposedKernel& kernel, std::span<const Buffer* const> bindings, const Parameters& parameters,
                          const WalkRays& rays, const RayGroups& groups) const {
    if (m_are_given) {
        kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), tiles_a_row(rays.width));
    } else {
        groups.dispatch(kernel, bindings, parameters);
    }
}

} // namespace elvis
