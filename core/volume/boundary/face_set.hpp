/**
 * @file face_set.hpp
 * Faces of elements on the device: their polynomials, patches, and the hierarchies that rays descend through to meet them.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/hierarchy/hierarchy.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/boundary/element_faces.hpp>
#include <core/volume/device_volume.hpp>
#include <core/vulkan/buffer.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace elvis {

/** Chosen faces of one volume, by element class. Belongs to the geometry that `data` held (DeviceVolume::geometry_version). */
class FaceSet {
public:
    /** `faces`: in the order of elements. A field must be selected in `data`. */
    FaceSet(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, std::span<const ElementFace> faces,
            const TaskControl* control);

    struct ClassFaces {
        std::uint64_t n_faces = 0, n_patches = 0;
        /** Order of the faces' polynomials. */
        int order = 0;
        /** They are the faces, but for rounding. Otherwise they only tell where to look. */
        bool is_polynomial = true;
        /** Hierarchy over patches. */
        std::unique_ptr<RecordBuffer> nodes;
        /** Of each face: local element, local face, number, and the polynomial's misfit as a float. */
        std::unique_ptr<RecordBuffer> faces;
        /** shaders/boundary/face_patch.glsl */
        std::unique_ptr<RecordBuffer> patches;
        /** shaders/boundary/face_point.glsl */
        std::unique_ptr<RecordBuffer> points;
    };
    /** Without faces, all pointers are null. */
    const ClassFaces& of_class(std::uint32_t element_class) const { return m_classes[element_class]; }
    std::uint64_t n_faces() const { return m_n_faces; }
    std::uint64_t bytes() const;

private:
    std::vector<ClassFaces> m_classes;
    std::uint64_t m_n_faces = 0;
};

} // namespace elvis
