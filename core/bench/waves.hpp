/**
 * @file waves.hpp
 * The scenes that times are compared on: a smooth field on a smoothly bent cube of quadratic hexahedra.
 */
#pragma once

#include <core/base/temporary_folder.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/frame.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>

namespace elvis {

/** A folder that is removed with all it holds, or, if named, kept for the next time. */
class BenchFolder {
public:
    explicit BenchFolder(const std::string& kept);

    const std::filesystem::path& path() const { return m_path; }

private:
    std::optional<TemporaryFolder> m_own;
    std::filesystem::path m_path;
};

/** What a description makes for the generator, by this name, made by the conversion engine unless the folder holds it already.
 */
RuntimeVolume generated_volume(const PluginRegistry& registry, const BenchFolder& folder, const std::string& name,
                               const std::string& generator);

/**
 * The waves volume of n^3 hexahedra, field order `order`: [-1,1]^3 moved by 0.06 (sin pi q2 cos pi q3, ...), field sin 3.5x
 * cos 3.5y + cyclic.
 */
RuntimeVolume waves_volume(const PluginRegistry& registry, const BenchFolder& folder, std::uint32_t n, std::uint32_t order);

/** Its picture: eye (2.9, 2.3, 1.7), 40 degrees, cut by the plane through n = unit(0.3, 0.25, 1) at n.x = 0.05. */
FrameRequest waves_cut_plane(std::uint32_t size);
/** The same view of the whole boundary. */
FrameRequest waves_boundary(std::uint32_t size);
/** The same view of the isosurface of this value, lit. */
FrameRequest waves_isosurface(std::uint32_t size, double value, bool skips_by_range);

} // namespace elvis
