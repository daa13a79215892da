/**
 * @file session.hpp
 * The open volume with all that works on it: the renderer, and whoever answers questions about points.
 */
#pragma once

#include "camera_motion.hpp"
#include "pick.hpp"
#include "picture.hpp"
#include "volume_facts.hpp"

#include <core/base/cancel.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/probe/probe.hpp>
#include <core/render/frame_schedule.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/scene.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

/** One thread at a time. Everything throws Error. */
class Session {
public:
    Session(const std::string& device, bool validation);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    const Device& device() const { return *m_device; }
    const PluginRegistry& registry() const { return m_registry; }
    /** Asks for an end of what is being drawn, from any thread. */
    TaskControl& control() { return m_control; }

    /** Opens the scene's volume, unless it is open. After an error the volume that was open before still is. */
    VolumeFacts open(const Scene& scene);
    bool is_open() const { return m_volume != nullptr; }

    /** A new scene of a volume: what a picture of it shows first. */
    Scene first_scene(const std::string& volume);

    /** As the step shows it, but of full size, as is its annotation. */
    Picture draw(const Scene& scene, const FrameSchedule::Step& step);
    /** The full picture, to a file. Returns remarks. */
    std::vector<std::string> save_picture(const Scene& scene, const std::string& path, int bits);

    /** Of a field or expression at the scene's time step. */
    FieldRange range(const Scene& scene, const std::optional<std::string>& field);
    /** What is seen at a place of the scene's picture. */
    Picked pick(const Scene& scene, const std::array<double, 2>& place);
    /** Values of a field at the points of one piece (apps/elvis/render/field_samples.hpp). */
    std::vector<double> samples(const Scene& scene, const std::optional<std::string>& field, unsigned piece);

private:
    FrameRequest drawn_request(const Scene& scene);
    /** What is in the element that a picked point lies in; whether there is one. */
    bool probe(const Ray& ray, std::uint32_t time_step, Picked& picked);
    void need_precision(const Scene& scene);

    PluginRegistry m_registry;
    std::unique_ptr<Device> m_device;
    TaskControl m_control;
    std::string m_key;
    std::unique_ptr<RuntimeVolume> m_volume;
    Precision m_precision = Precision::float32;
    std::unique_ptr<Renderer> m_renderer;
    std::unique_ptr<Prober> m_prober;
};

} // namespace elvis::view
