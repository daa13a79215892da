/**
 * @file face_samples.hpp
 * Positions of points of faces, computed on the device with the class's snippet.
 */
#pragma once

#include <core/volume/boundary/face_fit.hpp>
#include <core/volume/device_volume.hpp>

#include <functional>

namespace elvis {

/**
 * Calls `take` with the first face and the positions (three numbers a point, relative to the element's origin) of some faces,
 * until all have been given. `faces`: records of FaceSet::ClassFaces::faces.
 */
void sample_faces(const Device& device, const DeviceVolume& data, std::uint32_t element_class, const RecordBuffer& faces,
                  const FaceFit& fit, const std::function<void(std::uint64_t first, std::span<const double> positions)>& take);

} // namespace elvis
