/**
 * @file session.hpp
 * The open volume, and what the window asks of it: by the library's public interface.
 */
#pragma once

#include "line_probe.hpp"
#include "numbers.hpp"
#include "pick.hpp"
#include "picture.hpp"
#include "volume_facts.hpp"

#include <core/base/cancel.hpp>
#include <core/render/frame_schedule.hpp>
#include <core/scene/camera_ray.hpp>
#include <core/scene/scene.hpp>

#include <elvis/elvis.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

/** What the device that draws holds. */
struct DeviceUse {
    std::uint64_t bytes = 0, n_buffers = 0, n_kernels = 0;
};

/** One thread at a time, but for what is said to be for any. Everything throws std::exception; draw() throws cancelled, too. */
class Session {
public:
    explicit Session(const context& library);

    /** For any thread. */
    DeviceUse device_use() const;
    std::vector<std::string> validation_messages() const;
    /** Asks for an end of what is being drawn. For any thread. */
    TaskControl& control() { return m_control; }

    /** A foreign file, which is to be converted first. Throws where it is nobody's. */
    bool is_foreign(const std::string& path) const;
    /** Opens the scene's volume, unless it is open. After an error the volume that was open before still is. */
    VolumeFacts open(const Scene& scene);

    /** A new scene of the volume: what a picture of it shows first. */
    Scene first_scene(const std::string& path);

    /** As the step shows it, but of full size, as is its annotation. */
    Picture draw(const Scene& scene, const FrameSchedule::Step& step);
    /** The full picture, to a file. Returns what may be wrong with it. */
    std::vector<std::string> save_picture(const Scene& scene, const std::string& path, int bits);

    /** Of a field or expression, or of the first field, at the scene's time step. */
    FieldRange range(const Scene& scene, const std::optional<std::string>& field);
    /** What is seen at a place of the scene's picture. */
    Picked pick(const Scene& scene, const PicturePoint& place);
    /** Fields along a line, at the scene's time step. */
    LineAnswer along(const Scene& scene, const LineProbe& line);
    /** One row; throws cancelled if it is stopped. Any thread may be asked whether it is. */
    Numbers numbers(const Scene& scene, const NumbersQuestion& question, const std::function<bool()>& is_stopped);
    /** Values of a field at the points of one piece of ELVIS_SAMPLE_PIECES. */
    std::vector<double> samples(const Scene& scene, const std::optional<std::string>& field, unsigned piece);

private:
    elvis::scene library_scene(const Scene& scene) const;
    const data& opened() const;
    /** What the scene shows of it: displaced, if it has a warp. */
    const data& shown(const Scene& scene);
    std::string text_of(const Scene& scene, const std::optional<std::string>& field) const;

    context m_library;
    TaskControl m_control;
    task m_watch{{}, [this] { return m_control.is_cancelled(); }};
    std::string m_key;
    std::optional<data> m_data;
    std::optional<data> m_displaced;
};

} // namespace elvis::view
