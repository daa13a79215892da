/**
 * @file joined.hpp
 * Native volumes that have the fields of others beside their own, as a scene's volume says.
 */
#pragma once

#include <elvis/native/joined_volume.hpp>

#include <memory>
#include <string>
#include <vector>

namespace elvis {

/** See elvis/native/joined_volume.hpp. `name` stands for the volume in messages; throws Error. */
std::shared_ptr<const native::VolumeSource> joined_source(std::shared_ptr<const native::VolumeSource> source,
                                                          std::vector<native::Joined> others, const std::string& name);

/** That a volume cannot be joined. */
[[noreturn]] void refuse_joined(const std::string& path);

} // namespace elvis
