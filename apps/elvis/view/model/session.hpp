/**
 * @file session.hpp
 * The open volume, and what the window asks of it: by the library's public interface.
 */
#pragma once

#include "data_file.hpp"
#include "frame_schedule.hpp"
#include "line_probe.hpp"
#include "numbers.hpp"
#include "pick.hpp"
#include "picture.hpp"
#include "volume_facts.hpp"
#include <apps/elvis/view/scene/scene.hpp>

#include <core/base/cancel.hpp>

#include <elvis/elvis.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

/** Of a field. */
struct FieldRange {
    double lower = 0, upper = 0;
};

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

    /** "scene", "volume", or "foreign", which is to be converted first. Throws where it is nobody's. */
    std::string kind_of(const std::string& path) const;
    Scene read(const std::string& path) const;
    /** Opens the scene's volume, unless it is open. After an error the volume that was open before still is. */
    VolumeFacts open(const Scene& scene);
    /** A new scene of the volume that is open: what a picture of it shows first. */
    Scene first_scene(const std::vector<std::string>& files);

    /** The scene with all of its camera said. For any thread. */
    Scene with_whole_camera(const Scene& scene, const VolumeFacts& volume) const;
    /** With another camera, which the volume fills. For any thread. */
    Camera fitted(const Scene& scene, const Camera& camera, const VolumeFacts& volume) const;
    /** Appears whole or not at all. For any thread. */
    void write(const Scene& scene, const std::string& path) const;
    /** JSON of elvis_scene_get_transfer. For any thread. */
    Json transfer(const Scene& scene, const std::array<double, 2>& range, double diagonal) const;

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
    /** Throws cancelled where the watch says so. */
    WrittenReport write_data(const Scene& scene, const DataFile& file, const task& watch);
    /** Values of a field at the points of one piece of ELVIS_SAMPLE_PIECES. */
    std::vector<double> samples(const Scene& scene, const std::optional<std::string>& field, unsigned piece);

private:
    elvis::scene library_scene(const Scene& scene) const;
    const data& opened() const;
    /** What the scene shows of it: displaced, if it has a warp. */
    const data& shown(const Scene& scene);
    std::string text_of(const Scene& scene, const std::optional<std::string>& field) const;
    /** A number that stands for a field or expression of the scene: of a vector its magnitude. */
    std::string number_text(const Scene& scene, const data& volume, const std::string& field) const;

    context m_library;
    TaskControl m_control;
    task m_watch{{}, [this] { return m_control.is_cancelled(); }};
    std::string m_key;
    std::optional<data> m_data;
    std::optional<data> m_displaced;
};

} // namespace elvis::view
