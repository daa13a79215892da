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

/** A native volume from the generator. */
class Stage {
public:
    explicit Stage(const std::string& description, Precision precision = Precision::float32) : m_precision(precision) {
        oracle::generate(description, m_folder.path("volume.h5"));
        m_whole.emplace(oracle::open_volume(m_folder.path("volume.h5")));
    }

    const RuntimeVolume& volume() const { return *m_whole; }
    std::shared_ptr<const native::VolumeSource> source() const { return native_source(m_folder.path("volume.h5")); }

    /** Of a scene with these keys. */
    Scene scene(const std::string& keys) const {
        Scene made = scene_of(nlohmann::json::parse(R"({"version": 1, "image": {"size": [160, 120]}, )" + keys + "}"), "scene");
        made.volume = m_folder.path("volume.h5");
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
        return std::make_unique<VolumeInParts>(source(), *m_whole, device(), m_precision, std::move(partition), m_alone);
    }

private:
    TemporaryFolder m_folder;
    Precision m_precision;
    OneProcess m_alone;
    std::optional<RuntimeVolume> m_whole;
    std::unique_ptr<Renderer> m_renderer;
    std::unique_ptr<VolumeInParts> m_parts;
    std::uint32_t m_n_parts = 0;
};

} // namespace elvis::test
