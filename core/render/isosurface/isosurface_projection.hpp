/**
 * @file isosurface_projection.hpp
 * Draws isosurfaces by projection of the field along rays, in listed pixels (shaders/isosurface/isosurface_projection.comp).
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/shader/composer.hpp>
#include <core/volume/isosurface/isovalue_set.hpp>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

namespace elvis {

/** The kernels of one volume and of the field whose isosurfaces are drawn. Compiled when first needed. */
class IsosurfaceProjection {
public:
    explicit IsosurfaceProjection(const Device& device);

    /**
     * Takes the pixels that carry one of these flags, or all if there are none, and clears their marks but for the flags
     * `kept`. Returns their number. `mask`, if there is one: a number a pixel, which becomes 1 for these and 0 for others.
     */
    std::uint32_t list(const Layer& layer, std::uint32_t flags, std::uint32_t kept, const Buffer* mask = nullptr);

    struct Picture {
        const Buffer &frame, &isovalues, &bending, &last;
        const LayerTarget& target;
        ScalarComponent component;
        std::uint32_t n_isovalues = 0, n_clips = 0;
        std::uint32_t round = 0;
        /** The diagonal of the volume's bounds. */
        float extent = 0;
    };
    /** The kernel of one class, whose kernels have `request` in common (IsosurfacePass). Ask for all before the first is drawn:
     * they are compiled together. */
    const ComposedKernel& provide(const KernelRequest& request, std::uint32_t element_class, IsosurfaceMethod method,
                                  std::uint32_t degree);
    /** In the listed pixels, one class. */
    void draw(const ComposedKernel& kernel, const Picture& picture, std::uint32_t surface, FrameCounts& counts);

private:
    /** Element class, whether roots are eigenvalues, degree. */
    using Key = std::tuple<std::uint32_t, bool, std::uint32_t>;
    const ComposedKernel& provide_list_kernel(bool fills_mask);

    const Device& m_device;
    std::map<Key, ComposedKernel> m_kernels;
    /** Without a mask, and with one. */
    std::array<std::unique_ptr<ComposedKernel>, 2> m_list_kernels;
    Buffer m_counts;
    std::optional<Buffer> m_list;
    std::uint32_t m_n_listed = 0;
};

} // namespace elvis
