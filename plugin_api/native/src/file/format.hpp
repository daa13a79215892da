/**
 * @file format.hpp
 * Names of the native volume's objects, as format.md lists them.
 */
#pragma once

#include <elvis/native/volume_file.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace elvis::native::format {

inline constexpr const char* mark = "ElVis native volume";
inline constexpr std::uint32_t version_major = 1;
inline constexpr std::uint32_t version_minor = 2;
/** Numbers in a row of the dataset `faces`: element, neighbour, local face, the neighbour's local face, group. */
inline constexpr std::uint64_t face_numbers = 5;
/** Numbers of an extremum in the dataset `extrema`: value, bound, class, place in the class, xi. */
inline constexpr std::uint64_t extremum_numbers = 7;

template <class Enumeration> struct Named {
    Enumeration value;
    const char* name;
};

inline constexpr Named<Continuity> continuities[] = {
    {Continuity::unknown, "unknown"}, {Continuity::continuous, "continuous"}, {Continuity::discontinuous, "discontinuous"}};
inline constexpr Named<Transform> transforms[] = {
    {Transform::none, "none"}, {Transform::covariant, "covariant"}, {Transform::contravariant, "contravariant"}};

template <class Enumeration, std::size_t N> const char* name_of(const Named<Enumeration> (&table)[N], Enumeration value) {
    for (const Named<Enumeration>& entry : table) {
        if (entry.value == value) {
            return entry.name;
        }
    }
    return "";
}

template <class Enumeration, std::size_t N>
std::optional<Enumeration> value_of(const Named<Enumeration> (&table)[N], std::string_view name) {
    for (const Named<Enumeration>& entry : table) {
        if (entry.name == name) {
            return entry.value;
        }
    }
    return std::nullopt;
}

} // namespace elvis::native::format
