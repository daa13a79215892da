/**
 * @file face_set.hpp
 * Boundary faces on the device: what rays descend through to meet them.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/hierarchy/hierarchy.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/vulkan/buffer.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace elvis {

/** The faces of a volume that have no neighbour, by element class. */
class FaceSet {
public:
    /**
     * Faces of the named boundary groups, of all if there are none; an unknown name is an error. A face counts as boundary if
     * it has no neighbour. `centre`: what the hierarchies' bounds are relative to. Faces are boxed by their element's certified
     * bounds.
     */
    FaceSet(const Device& device, const RuntimeVolume& volume, Precision precision, const std::array<double, 3>& centre,
            const std::vector<std::string>& groups, const TaskControl* control);

    /** Nodes of the class's hierarchy over faces; null if it has none. */
    const RecordBuffer* nodes(std::uint32_t element_class) const { return m_classes[element_class].nodes.get(); }
    /** Of each face: local element, local face, two unused. */
    const RecordBuffer* faces(std::uint32_t element_class) const { return m_classes[element_class].faces.get(); }
    std::uint64_t n_faces() const { return m_n_faces; }

private:
    struct ClassFaces {
        std::unique_ptr<RecordBuffer> nodes;
        std::unique_ptr<RecordBuffer> faces;
    };
    std::vector<ClassFaces> m_classes;
    std::uint64_t m_n_faces = 0;
};

} // namespace elvis
