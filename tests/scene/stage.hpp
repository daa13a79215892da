/**
 * @file stage.hpp
 * A volume on a device, for which tests write scenes.
 */
#pragma once

#include <core/base/bounds.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/frame_request.hpp>
#include <tests/support/files.hpp>

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
        return make_frame_request(scene, volume, renderer.ranges());
    }

    double diagonal() { return diagonal_of(renderer.ranges().bounds()); }
};

} // namespace elvis::test
