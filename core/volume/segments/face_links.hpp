/**
 * @file face_links.hpp
 * The neighbours of elements across their faces, as rays read them on their way.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <vector>

namespace elvis {

/** Where no neighbour is known. */
constexpr std::uint32_t no_link = 0xffffffffu;
/** Words of an element; the last has room for something else. */
constexpr std::uint32_t links_an_element = 8;

/** For each class, and in it by local element and local face: the neighbour among all elements of the volume. */
std::vector<std::vector<std::uint32_t>> read_face_links(const RuntimeVolume& volume);

/** Whether the element has a face without a link. */
bool has_open_face(const std::vector<std::uint32_t>& links, const ClassInfo& info, std::uint64_t local_element);

} // namespace elvis
