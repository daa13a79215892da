/**
 * @file parts_fixture.hpp
 * Volumes in parts and as a whole, and what their pictures differ in.
 */
#pragma once

#include <core/parts/draw_in_parts.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/frame_request.hpp>
#include <core/session/volume/warped.hpp>
#include <tests/support/files.hpp>
#include <tests/support/test_volumes.hpp>

#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>

namespace elvis::test {

/** A volume, by default a native one from the generator. */
class Stage {
public:
    /** In parts as native volumes are, or as those of any runtime plugin. */
    enum class Way { native, plugin };

    explicit Stage(const std::string& description, Precision precision = Precision::float32, Way way = Way::native)
        : m_path(m_folder.path("volume.h5")), m_way(way), m_precision(precision) {
        oracle::generate(description, m_path);
        m_whole.emplace(oracle::open_volume(m_path));
    }
    /** What a runtime plugin opens. */
    struct File {
        std::string path;
    };
    explicit Stage(const File& file) : m_path(file.path), m_way(Way::plugin), m_whole(oracle::open_volume(m_path)) {}

    const RuntimeVolume& volume() const { return *m_whole; }
    std::shared_ptr<const native::VolumeSource> source() const { return native_source(m_path); }

    /** Of a scene with these keys. */
    Scene scene(const std::string& keys) const {
        Scene made = scene_of(nlohmann::json::parse(R"({"version": 1, "image": {"size": [160, 120]}, )" + keys + "}"), "scene");
        made.volume = m_path;
        return made;
    }

    Frame as_whole(const Scene& scene) {
        if (!m_renderer) {
            m_renderer = std::make_unique<Renderer>(device(), *m_whole, m_precision);
        }
        return draw_still(scene, *m_whole, *m_renderer, {}).frame;
    }

    Frame in_parts(const Scene& scene, std::uint32_t n_parts, std::uint32_t most_fine_pixels = 1u << 22) {
        if (!m_parts || m_n_parts != n_parts) {
            m_parts = open_parts(Partition::in_shares(m_whole->n_elements(), n_parts));
            m_n_parts = n_parts;
        }
        return m_parts->draw(scene, true, most_fine_pixels).still.frame;
    }

    std::unique_ptr<VolumeInParts> open_parts(Partition partition) {
        m_parted = m_way == Way::native ? parted_native({source()}, *m_whole, nullptr) : parted_by_plugin(*m_whole);
        return std::make_unique<VolumeInParts>(*m_parted, device(), m_precision, std::move(partition), m_alone);
    }

private:
    TemporaryFolder m_folder;
    std::string m_path;
    Way m_way;
    Precision m_precision = Precision::float32;
    OneProcess m_alone;
    std::optional<RuntimeVolume> m_whole;
    std::unique_ptr<PartedVolume> m_parted;
    std::unique_ptr<Renderer> m_renderer;
    std::unique_ptr<VolumeInParts> m_parts;
    std::uint32_t m_n_parts = 0;
};

} // namespace elvis::test
