/**
 * @file face_cones.hpp
 * The directions that the faces of elements have.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/device_volume.hpp>
#include <core/vulkan/buffer.hpp>

#include <cstdint>
#include <memory>

namespace elvis {

/** One word for each face of the elements of a class, eight an element: shaders/segments/face_cone.glsl. */
std::unique_ptr<RecordBuffer> measure_face_cones(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                                                 std::uint32_t element_class);

} // namespace elvis
