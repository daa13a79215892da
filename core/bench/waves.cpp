#include <core/bench/waves.hpp>

#include <core/base/error.hpp>
#include <core/convert/convert.hpp>
#include <core/plugin_host/source_volume.hpp>

#include <cmath>
#include <fstream>

namespace elvis {

BenchFolder::BenchFolder(const std::string& kept) : m_path(kept.empty() ? m_own.emplace().path().string() : kept) {
    std::filesystem::create_directories(m_path);
}

RuntimeVolume generated_volume(const PluginRegistry& registry, const BenchFolder& folder, const std::string& name,
                               const std::string& generator) {
    const std::string description = (folder.path() / (name + ".json")).string();
    const std::string path = (folder.path() / (name + ".h5")).string();
    if (!std::filesystem::exists(path)) {
        std::ofstream file(description);
        file << generator << '\n';
        file.close();
        if (!file) {
            throw Error(description, "cannot be written");
        }
        const SourceVolume source(registry.converter_for(description), {description});
        convert(source, path, {}, {});
    }
    return RuntimeVolume(registry.runtime_for(path), path);
}

RuntimeVolume waves_volume(const PluginRegistry& registry, const BenchFolder& folder, std::uint32_t n, std::uint32_t order) {
    return generated_volume(
        registry, folder, "waves-" + std::to_string(n) + "-order-" + std::to_string(order),
        R"({"generator":1,"mesh":"waves","shape":"hexahedron","geometry_order":2,"field":"waves","elements":)" +
            std::to_string(n) + R"(,"order":)" + std::to_string(order) + "}");
}

FrameRequest waves_cut_plane(std::uint32_t size) {
    FrameRequest request;
    request.with_buffers = false;
    request.width = size;
    request.height = size;
    request.camera.eye = {2.9, 2.3, 1.7};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 40;
    request.background = {1, 1, 1, 1};
    Surface surface;
    surface.colors.points = {{-2, {0, 0, 1}}, {0, {1, 1, 1}}, {2, {1, 0, 0}}};
    surface.colors.below = {0, 0, 0.5, 1};
    surface.colors.above = {0.5, 0, 0, 1};
    surface.geometry = CutPlane{{0.3, 0.25, 1, -0.05 * std::sqrt(0.3 * 0.3 + 0.25 * 0.25 + 1)}};
    request.surfaces = {surface};
    return request;
}

FrameRequest waves_boundary(std::uint32_t size) {
    FrameRequest request = waves_cut_plane(size);
    request.surfaces[0].geometry = BoundaryFaces{};
    return request;
}

FrameRequest waves_isosurface(std::uint32_t size, double value, bool skips_by_range) {
    FrameRequest request = waves_cut_plane(size);
    auto& isosurfaces = request.surfaces[0].geometry.emplace<Isosurfaces>();
    isosurfaces.values = {value};
    isosurfaces.skips_by_range = skips_by_range;
    request.lighting.emplace();
    return request;
}

} // namespace elvis
