/**
 * @file items.hpp
 * What a scene shows, as one list: surfaces, isosurfaces, the volume itself, lights.
 */
#pragma once

#include "scene.hpp"
#include <apps/elvis/view/model/volume_facts.hpp>

#include <compare>
#include <cstddef>
#include <string>
#include <vector>

namespace elvis::view {

enum class ItemKind { surface, volume, light };

struct ItemId {
    ItemKind kind = ItemKind::surface;
    /** Among those of its kind; 0 for the volume. */
    std::size_t index = 0;

    auto operator<=>(const ItemId&) const = default;
};

std::vector<ItemId> items_of(const Scene& scene);
bool exists(const Scene& scene, const ItemId& item);
/** Where the scene has it, as a JSON Pointer. */
std::string pointer_of(const ItemId& item);
/** What the scene says of an item that exists. */
const Json& part_of(const Scene& scene, const ItemId& item);
Json& part_of(Scene& scene, const ItemId& item);

/** "Cut plane slice", "Isosurface 0.5, 0.7", "Boundary inlet". */
std::string item_label(const Scene& scene, const ItemId& item);
/** "cut plane", for names of steps. */
std::string item_kind_name(const Scene& scene, const ItemId& item);

bool is_shown(const Scene& scene, const ItemId& item);
void set_shown(Scene& scene, const ItemId& item, bool shown);
void remove(Scene& scene, const ItemId& item);
/** Puts a copy after it, and returns the copy; of the volume, of which there is one, itself. */
ItemId duplicate(Scene& scene, const ItemId& item);

/** What can be added, in the order of the menu. */
enum class NewItem {
    boundary,
    cut_plane,
    sphere,
    cylinder,
    cone,
    torus,
    quadric,
    implicit,
    elements,
    wireframe,
    isosurface,
    streamlines,
    pathlines,
    arrows,
    volume,
    directional_light,
    point_light
};
struct NewItemInfo {
    NewItem item;
    const char* name;
    const char* help;
};
const std::vector<NewItemInfo>& new_items();
/** Vector fields that lines can follow and arrows can show, and expressions made of fields; the latter last. */
std::vector<std::string> flows_of(const VolumeFacts& volume);
/** Fields that can displace the volume. */
std::vector<std::string> displacements_of(const VolumeFacts& volume);
/** Whether a volume has what it takes, and the scene room for it. */
bool can_add(const Scene& scene, const VolumeFacts& volume, NewItem item);
/** Places it sensibly in the volume's bounds. `middle`: a value of the scene's field, for isosurfaces. */
ItemId add(Scene& scene, const VolumeFacts& volume, NewItem item, double middle);

} // namespace elvis::view
