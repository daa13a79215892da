/**
 * @file outside_pass.hpp
 * Shows where a surface lies in no element.
 */
#pragma once

#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/render/picture/layer.hpp>
#include <core/shader/composer.hpp>

#include <array>

namespace elvis {

class OutsidePass {
public:
    /** Of planes, or of surfaces whose crossings are given. */
    OutsidePass(const Device& device, Precision precision, bool on_plane);

    /**
     * Marks the crossings of surface number `surface` that no element has taken. `frame`: the rays of the picture as the device
     * has them. `hits`: the crossings (surface/hits.comp); null for a plane.
     */
    void draw(const Buffer& frame, const Buffer* hits, std::uint32_t surface, const LayerTarget& target) const;

    /** The box in which planes are shown: min x y z, max x y z, relative to the reference point of the rays. */
    void set_box(const std::array<double, 6>& box) { m_box = box; }

private:
    ComposedKernel m_kernel;
    std::array<double, 6> m_box{};
};

/** Where surfaces without end are shown: three times the volume's size. */
std::array<double, 6> box_around(const std::array<double, 6>& volume);

} // namespace elvis
