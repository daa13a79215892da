/**
 * @file scenes.hpp
 * Random scenes of a volume, each wholly determined by a number.
 */
#pragma once

#include <core/oracle/element/volume.hpp>
#include <core/oracle/samples/random.hpp>
#include <core/scene/scene.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace elvis::hunt {

/** Each number is that of one scene of the first list, in which numbers take turns, and one of each kind of the second. */
inline constexpr std::array<std::string_view, 6> kinds{"plane", "isosurface", "boundary", "volume", "layers", "shape"};
inline constexpr std::array<std::string_view, 2> more_kinds{"lines", "implicit"};

/** What scenes are made from. */
struct SceneGround {
    /** The volume as scenes speak of it, and one of its fields in memory. */
    std::string path, field;
    const oracle::Volume* volume = nullptr;
    std::int32_t component = 0;
    /** Of samples. */
    oracle::Vector lower, upper;
    double low = 0, high = 0;
    bool has_faces = false;
};

SceneGround ground_of(const std::string& path, const std::string& field, const oracle::Volume& volume, bool has_faces);

Scene make_scene(const SceneGround& ground, std::string_view kind, std::uint64_t number);

/** Width and height of pictures that cost about the same. */
std::array<std::uint32_t, 2> size_of(std::string_view kind);

} // namespace elvis::hunt
