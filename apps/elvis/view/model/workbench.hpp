/**
 * @file workbench.hpp
 * The model together with the thread that draws it: everything that panels can ask for, still without a window.
 */
#pragma once

#include "conversion_task.hpp"
#include "frame_worker.hpp"
#include "histogram.hpp"
#include "model.hpp"
#include "second_view.hpp"
#include "shown_view.hpp"
#include "write_task.hpp"
#include <apps/elvis/view/scene/camera_motion.hpp>

#include <array>
#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

struct Message {
    enum class Kind { info, warning, error };
    Kind kind = Kind::info;
    std::string text;
};

/** Pictures shown while something moved. */
struct MotionStatistics {
    std::deque<double> frame_seconds; ///< between pictures, the latest last
    /** From the last time that the hand let go. */
    std::optional<double> rest_to_full_seconds, rest_to_exact_seconds;

    double frames_per_second() const;
};

class Workbench {
public:
    using Clock = std::chrono::steady_clock;

    explicit Workbench(std::unique_ptr<Session> session);
    /** What is being written is not written to its end. */
    ~Workbench();
    Workbench(const Workbench&) = delete;
    Workbench& operator=(const Workbench&) = delete;

    Model& model() { return m_model; }
    const Model& model() const { return m_model; }

    /** A volume, a scene, or a foreign file, for which a conversion is then offered. */
    void open(const std::string& path) { open_files({path}, true); }
    /** What the command line names: foreign files are converted into the cache without a question. */
    void open_files(const std::vector<std::string>& paths) { open_files(paths, false); }
    void save_scene(const std::string& path);
    void save_picture(const std::string& path, const std::array<std::uint32_t, 2>& size, int bits);
    /** Pictures wait until it is done; not while another file is being written. Says what has been written. */
    void write_data(const DataFile& file);
    WriteTask& writing() { return m_writing; }
    /** What is seen at a place of the first view's picture, or of the second one's. */
    void pick(const PicturePoint& place, std::size_t view = 0);
    const std::optional<Picked>& picked() const { return m_picked; }

    /** A line along which a field is shown; none at first, and none of another volume. */
    std::optional<LineProbe> line;
    /** Along the line, or along where it was a moment ago; asked for when it is not known, and nothing until then. */
    const LineAnswer* line_answer();

    /** Begins to find integrals and extrema of what is shown, row by row, when nothing else is to be done. */
    void find_numbers();
    void stop_numbers();
    const std::vector<Numbers>& numbers() const { return m_numbers; }
    bool is_finding_numbers() const;
    /** The scene asks for the same rows still. */
    bool has_present_numbers() const;

    /** The camera there, as near as it sees all of the volume. */
    Camera fitted(const Camera& camera) const { return m_session->fitted(m_model.scene(), camera, *m_model.volume()); }
    /**
     * JSON of elvis_scene_get_transfer for a scene of these parts alone; of what the library refuses, nothing: the picture says
     * why.
     */
    const Json& transfer(const Json& color_map, const Json& volume_rendering, const std::array<double, 2>& range);

    /** Of a field or expression at the present time step; asked for when it is not known yet, and nothing until then. */
    std::optional<FieldRange> range(const std::optional<std::string>& field);
    const Histogram* histogram(const std::optional<std::string>& field);

    /** A foreign file that waits for somebody to say that it shall be converted. */
    std::optional<std::string> foreign_file;
    void convert(const std::string& input, const std::string& output);
    ConversionTask& conversion() { return m_conversion; }

    /** Beside the first view; both are drawn by the same thread, a picture at a time. */
    void turn_on_second();
    void turn_off_second();
    SecondView& second() { return m_second; }
    const SecondView& second() const { return m_second; }

    /** To be called often: takes what has come. Returns the view of which there is a new picture. `showing`: what a picture
     * takes to show. */
    std::optional<std::size_t> collect(double showing_milliseconds);
    /** To be called after that, and after changes: sees to the next picture. `is_moving`: the hand is at work. */
    void go_on(bool is_moving);
    /** A picture is on its way. */
    bool is_drawing() const { return m_worker.drawing().has_value(); }
    /** What is on the screen of the first view, 0, or the second, 1. */
    const ShownView& shown(std::size_t view = 0) const { return m_views[view]; }
    const Picture& picture() const { return m_views[0].picture; }
    FrameStage stage() const { return m_views[0].stage; }
    std::uint32_t divisor() const { return m_views[0].divisor; }
    /** The picture, in whatever stage, is of the present scene. */
    bool has_shown_present(std::size_t view = 0) const { return m_views[view].shows(revision_of(view)); }
    /** Pictures are exact and of the present scene, and nothing is being done. */
    bool is_settled() const;
    /** What is being done: "drawing", "opening"; empty if nothing. */
    std::string activity() const;
    const MotionStatistics& motion() const { return m_motion; }
    CancelTimes cancel_times() const { return m_worker.cancel_times(); }

    const std::vector<Message>& messages() const { return m_messages; }
    void say(Message::Kind kind, std::string text);
    /** The same to be told of the picture, from its counts. */
    std::vector<Message> picture_messages() const;
    std::vector<std::string> validation_messages() const { return m_session->validation_messages(); }
    /** What the device that draws holds now. */
    DeviceUse device_use() const { return m_session->device_use(); }

    /** Called with each volume and scene that was opened or saved. */
    std::function<void(const std::string& path)> on_file;

private:
    /** Adds the values at some more points to a histogram, and then asks for more. */
    void sample(const std::optional<std::string>& field, const std::string& key, unsigned piece);
    /** `asks`: before a foreign file is converted. */
    void open_files(const std::vector<std::string>& paths, bool asks);
    void show(Scene scene, VolumeFacts facts, const std::string& file, const std::string& path);
    void find_row(std::size_t row, const Scene& scene);
    std::string field_key(const std::optional<std::string>& field) const;
    void take(DrawAnswer answer, double showing_milliseconds);
    void take(const ConversionResult& result);
    /** Tells the schedules what has changed since the last call, and whether the hand is at work. */
    void follow(bool is_moving);
    void follow(std::size_t view, bool is_moving, Clock::time_point now);
    /** What the hand does, in figures. */
    void note_motion(std::size_t view, FrameStage drawn, Clock::time_point now);
    std::size_t n_views() const { return m_second.is_on() ? 2 : 1; }
    const Scene& scene_of(std::size_t view) const { return view == 0 ? m_model.scene() : m_second.scene(); }
    std::uint64_t revision_of(std::size_t view) const { return view == 0 ? m_model.revision() : m_second.revision(); }
    /** The picture to begin now, if one is wanted: of the view that was not drawn last, where both want one of the same kind.
     */
    std::optional<DrawnStep> next_step(Clock::time_point now) const;
    bool is_outdated(const DrawnStep& drawing, Clock::time_point now) const;

    Model m_model;
    SecondView m_second;
    std::array<ShownView, 2> m_views;
    std::size_t m_last_view = 1;
    bool m_was_moving = false;
    /** The worker's, asked only what any thread may ask. */
    const Session* m_session;
    std::optional<Picked> m_picked;
    std::map<std::string, std::optional<FieldRange>> m_ranges;
    std::map<std::string, std::optional<Histogram>> m_histograms;
    /** The last ones asked for. */
    std::map<std::string, Json> m_transfers;
    /** What the answer is of: the line, the time step, the warp. */
    std::string m_line_key;
    bool m_is_asking_line = false;
    std::optional<LineAnswer> m_line_answer;
    std::vector<Numbers> m_numbers;
    /** Grows with each search: rows of another one are dropped, and not searched on. */
    std::atomic<std::uint64_t> m_numbers_search = 0;
    bool m_is_searching = false;
    /** Answers to questions about volumes that are no longer open are dropped. */
    std::uint64_t m_volume_number = 0;

    /** When the hand let go; nothing while it is at work, or when the exact picture has come. */
    std::optional<Clock::time_point> m_rest_since;
    std::optional<Clock::time_point> m_last_moving_picture;
    MotionStatistics m_motion;
    std::vector<Message> m_messages;
    ConversionTask m_conversion;
    WriteTask m_writing;
    /** After all else: its answers touch it. */
    FrameWorker m_worker;
};

} // namespace elvis::view
