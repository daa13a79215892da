/**
 * @file selected_volume.hpp
 * Some of the elements of a volume as a volume of their own.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <vector>

namespace elvis {

/** Whether the plugin says of all classes that records belong to elements (ELVIS_SNIPPET_ELEMENT_RECORDS). */
bool can_select(const RuntimeVolume& whole);

/** What a selection tells of faces. None: plugins are not asked for any. */
enum class SelectedFaces { none, of_elements };

/**
 * All classes, some of them maybe without elements; elements keep their numbers and their order. `elements`: ascending, at
 * least one, as counted in the whole, which must outlive the selection. Of the whole only these elements are asked for. Faces
 * between an element that is there and one that is not have an unknown neighbour: they are no boundary. Needs can_select().
 * Throws Error.
 */
RuntimeVolume selected_volume(const RuntimeVolume& whole, std::vector<std::uint64_t> elements, SelectedFaces faces);

} // namespace elvis
