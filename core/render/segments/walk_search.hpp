/**
 * @file walk_search.hpp
 * Finds where rays begin their walk through the elements (shaders/segments/start_at_eye.comp, shaders/tiles/ray_tiles.comp,
 * shaders/segments/find_walk.comp), for all that goes along rays.
 */
#pragma once

#include <core/render/device/in_batches.hpp>
#include <core/render/volume/live_rays.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/segments/walk_data.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

/** Where rays and their states are on the device. */
struct WalkRays {
    std::uint32_t width = 0, height = 0;
    /** Rows of a CutPlaneGeometry. */
    const Buffer& frame;
    /** One record a ray, which begins as core_walk does (shaders/segments/walk_state.glsl). */
    const Buffer& states;
    /** The rays themselves; null if they are those of the pixels. */
    const Buffer* given = nullptr;
};

class WalkSearch {
public:
    static constexpr std::uint32_t tile_height = 16;

    /** The elements of a class that has some. */
    struct Range {
        std::uint32_t element_class = 0;
        std::uint32_t first_element = 0, n_elements = 0;
    };

    /** All must outlive it. `defines`: of all kernels that request() makes; `are_given`: WalkRays::given is never null, or
     * always. */
    WalkSearch(const Device& device, const DeviceVolume& data, const WalkData& walk_data, const RuntimeVolume& volume,
               std::vector<std::pair<std::string, std::string>> defines, bool are_given);

    const std::vector<Range>& ranges() const { return m_ranges; }
    std::uint32_t tile_width() const { return m_tile_width; }
    std::uint32_t tiles_a_row(std::uint32_t width) const { return divided_up(width, m_tile_width); }
    /** The diagonal of the volume's bounds. */
    float extent() const { return m_extent; }
    /** What positions are off before they are evaluated. */
    float data_error() const { return m_data_error; }

    /** Of a kernel that goes along the rays in the class's elements; without the class's snippet. Binding 0 is the frame. */
    KernelRequest request(const Range& range, const char* kernel) const;

    /** Compiles its kernels. */
    void compile();
    /** Of rays of pixels: which elements each tile's rays may start in. Before seek(), as often as the view changes. */
    void list_starts(const WalkRays& rays);
    /** A word for each tile, 0 where no class has a list. Valid until list_starts(). */
    const Buffer& has_starts() const { return *m_has_starts; }

    /** Rays that begin in an element; before the first seek(). Evaluations that it took. */
    std::uint64_t start_at_eyes(const WalkRays& rays, const RayGroups& groups);

    /** Of the searches since begin_search(). */
    struct Found {
        /** Whether any ray looked for a start. */
        bool is_seeking = false;
        std::uint32_t evaluations = 0;
    };
    void begin_search() const { m_counts.fill(0); }
    /** The nearest start in elements of ranges()[index] of each ray that looks for one: of those given, which are one row, or
     * in these groups. */
    void seek(std::size_t index, const WalkRays& rays, const RayGroups& groups);
    Found found() const { return found_in(m_counts.read_items<std::uint32_t>(n_counts)); }
    /** The same, of what counts() holds. */
    static Found found_in(std::span<const std::uint32_t> counts) { return {counts[seeking] > 0, counts[evaluations]}; }
    const Buffer& counts() const { return m_counts; }

private:
    struct Kernels {
        std::unique_ptr<ComposedKernel> tiles, seek;
        /** When it is needed first: few pictures have the eye in an element. */
        std::unique_ptr<ComposedKernel> start_at_eye;
        std::optional<Buffer> lists;
    };

    enum Count : std::size_t { seeking, evaluations, n_counts };

    const ComposedKernel& eye_kernel(std::size_t index);
    /** Of a kernel that goes through rays that are given, or through groups. */
    template <class Parameters>
    void dispatch(const ComposedKernel& kernel, std::span<const Buffer* const> bindings, const Parameters& parameters,
                  const WalkRays& rays, const RayGroups& groups) const;

    const Device& m_device;
    const DeviceVolume& m_data;
    const WalkData& m_walk_data;
    std::vector<std::pair<std::string, std::string>> m_defines;
    bool m_are_given;
    std::uint32_t m_tile_width;
    float m_extent = 0, m_data_error = 0;
    std::vector<Range> m_ranges;
    /** By m_ranges. */
    std::vector<Kernels> m_kernels;
    std::optional<Buffer> m_has_starts;
    Buffer m_counts;
};

} // namespace elvis
