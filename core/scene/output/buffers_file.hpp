/**
 * @file buffers_file.hpp
 * What a picture is made of, per pixel, as HDF5.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/frame.hpp>
#include <core/vulkan/precision.hpp>

#include <string>

namespace elvis {

/**
 * Datasets, top row first: color (height, width, 4), value, depth, normal (height, width, 3), in single or double precision;
 * element (int64), flags (uint32). Attributes say what each is, its unit, the bits of flags, camera and time step
 * (core/scene/buffers.md). `frame` is what `request` for `volume` gave. Appears whole or not at all. Throws Error naming the
 * file.
 */
void write_buffers(const Frame& frame, const FrameRequest& request, const RuntimeVolume& volume, const std::string& path,
                   Precision precision);

} // namespace elvis
