/**
 * @file table_copy.hpp
 * Reading structs of plugins that were compiled with older or newer headers.
 */
#pragma once

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace elvis {

/** A struct as this host knows it: members that the plugin's own struct_size does not reach are zero. */
template <class Struct> Struct copy_known_part(const Struct& theirs) {
    static_assert(std::is_trivially_copyable_v<Struct>);
    Struct ours{};
    std::memcpy(&ours, &theirs, std::min<std::size_t>(theirs.struct_size, sizeof ours));
    ours.struct_size = sizeof ours;
    return ours;
}

/** Entry of an array of structs whose stride is the struct_size of its first entry. */
template <class Struct> Struct copy_entry(const Struct* array, std::size_t index) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(array) + index * array->struct_size;
    Struct header{};
    std::memcpy(&header, bytes, std::min<std::size_t>(array->struct_size, sizeof header));
    return header;
}

/** An empty struct for the plugin to fill. */
template <class Struct> Struct sized() {
    Struct value{};
    value.struct_size = sizeof value;
    return value;
}

} // namespace elvis
