/**
 * @file stage.hpp
 * A volume on a device, for which tests write scenes.
 */
#pragma once

#include <core/plugin_host/plugin.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/frame_request.hpp>
#include <tests/support/files.hpp>

#include <cmath>
#include <string>

namespace elvis::test {

struct Stage {
    explicit Stage(Precision precision = Precision::float32) : renderer(device, volume, precision) {}

    RuntimeVolume volume{Plugin::load(ELVIS_ANALYTIC_PLUGIN), ELVIS_ANALYTIC_SAMPLE};
    Device device{""};
    Renderer renderer;

    /** Of a scene with these keys. */
    FrameRequest request(const std::string& keys) {
        const TemporaryFolder folder;
        Scene scene = read_scene(folder.write("scene.json", R"({"version": 1)" + (keys.empty() ? "" : ", " + keys) + "}"));
        scene.volume = ELVIS_ANALYTIC_SAMPLE;
        return make_frame_request(scene, volume, renderer);
    }

    double diagonal() const {
        const std::array<double, 6> b = renderer.bounds();
        return std::sqrt((b[3] - b[0]) * (b[3] - b[0]) + (b[4] - b[1]) * (b[4] - b[1]) + (b[5] - b[2]) * (b[5] - b[2]));
    }
};

} // namespace elvis::test
