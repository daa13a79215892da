/**
 * @file warped.hpp
 * Native volumes whose geometry is displaced, as a scene's warp says.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/scene/scene.hpp>

#include <elvis/native/volume_source.hpp>

#include <cstdint>
#include <memory>
#include <string>

namespace elvis {

/** The plugin whose files are native volumes. */
inline constexpr const char* native_plugin_id = "org.elvis.native";

/** The numbers of a native volume's file. */
std::shared_ptr<const native::VolumeSource> native_source(const std::string& path);

/**
 * A volume that serves these numbers; `name` stands for it in messages. `control`, if there is one, must outlive it. `*served`,
 * if given, is what the native plugin's functions know it by (elvis/native/serve.hpp), as long as the volume lives.
 */
RuntimeVolume serve_native(std::shared_ptr<const native::VolumeSource> source, const std::string& name,
                           const TaskControl* control, elvis_volume** served = nullptr);

/** Displaced by the fields of that time step. Throws Error for fields that are not there or that are no displacement. */
std::shared_ptr<const native::VolumeSource> warped_source(std::shared_ptr<const native::VolumeSource> source,
                                                          const SceneWarp& warp, std::uint32_t time_step,
                                                          const std::string& name);

/**
 * Displaced by the fields of that time step (elvis/native/warped_volume.hpp). `name` stands for the volume in messages.
 * `control`, if there is one, must outlive it. Throws Error for fields that are not there or that are no displacement.
 */
RuntimeVolume open_warped(std::shared_ptr<const native::VolumeSource> source, const SceneWarp& warp, std::uint32_t time_step,
                          const std::string& name, const TaskControl* control);

} // namespace elvis
