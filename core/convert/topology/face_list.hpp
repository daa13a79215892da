/**
 * @file face_list.hpp
 * The faces of a mesh as native volumes have them.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/convert/topology/topology.hpp>
#include <elvis/native/description.hpp>

#include <functional>
#include <span>

namespace elvis {

/** Hands over all faces, each once, in blocks. Elements are counted as in the source. */
void list_faces(const SourceVolume& source, const Topology& topology, const TaskControl& control,
                const std::function<void(std::span<const native::Face>)>& take);

} // namespace elvis
