/**
 * @file frame_schedule.hpp
 * Which picture to draw next while somebody looks: a small one while things move, then all of it.
 */
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

namespace elvis::view {

/** What is on the screen. */
enum class FrameStage {
    /** Nothing that was asked for. */
    none,
    /** Fewer pixels, and as coarse as `full`, without lines where these take too long: while things move. */
    moving,
    /** Every pixel, but volume rendering to a hundredth of a channel, and lines that are looked for in few subpixels. */
    full,
    /** The request itself: to the byte what `elvis render` draws of it. */
    exact
};

/**
 * Decides from measured times. Calls come from one thread, with the time they happen; nothing is drawn here:
 *
 *     touch() whenever the camera or anything else changes; release() when the hand lets go, if that is known
 *     step = next(); if there is one: draw its stage; then drawn()
 *     while it is drawn: if is_outdated(step), cancel it and take the next one
 *
 * The size of moving pictures follows from what the last ones took; a larger one is tried now and then where it may be quick
 * enough, the more seldom the more often it was not.
 *
 * Without release() things have come to rest when nothing changes for `rest`. Where all pixels would take longer than a moving
 * picture may, fewer come first also at rest: something to look at meanwhile.
 */
class FrameSchedule {
public:
    using Clock = std::chrono::steady_clock;
    using Time = Clock::time_point;
    struct Step {
        FrameStage stage = FrameStage::none;
        std::uint32_t divisor = 1;
        /** Of what is asked for. */
        std::uint64_t version = 0;
        bool with_lines = true;
    };

    static constexpr std::chrono::milliseconds rest{200};
    /** Divisors of moving pictures: few, as another size takes other buffers. */
    static constexpr std::array<std::uint32_t, 9> divisors = {1, 2, 3, 4, 6, 8, 12, 16, 24};

    explicit FrameSchedule(double wanted_frames_a_second = 10) : m_budget(1000 / wanted_frames_a_second) {}

    /** Something else is to be shown from now on, and more of that may follow. */
    void touch(Time now);
    /** Something else is to be shown, and this is all for now: a value typed in, a file opened. */
    void change() { ++m_version, m_is_moving = false; }
    void release() { m_is_moving = false; }

    /** What to draw now; nothing if the screen shows it, or until something happens. */
    std::optional<Step> next(Time now) const;
    /** Whether the step is no longer worth its time: another one is wanted, which a pixel-exact picture must not delay. */
    bool is_outdated(const Step& step, Time now) const;
    /**
     * It is on the screen; `milliseconds` without compilation and upload, as elvis_picture_info.render_milliseconds.
     * `is_refinable`: elvis_picture_info.is_refinable of what was drawn; if not, `full` is exact.
     */
    void drawn(const Step& step, bool is_refinable, double milliseconds);

    /** Of the last picture that was drawn. FrameStage::none once something else is asked for and nothing of it was drawn. */
    FrameStage shown() const { return m_shown_version == m_version ? m_shown : FrameStage::none; }
    /** Into how many pixels across one of the moving pictures goes. */
    std::uint32_t moving_divisor() const { return m_divisor; }

private:
    bool moves(Time now) const { return m_is_moving && now - m_touched < rest; }
    /** What a picture of one size took. */
    struct Sample {
        std::uint32_t divisor;
        double milliseconds;
    };
    /** What another size would take. */
    double expected(std::uint32_t divisor, const Sample& drawn) const;
    void choose_divisor(Sample drawn);
    std::uint32_t wanted_divisor(const Sample& drawn) const;
    /** What another size takes is known only by drawing it. */
    bool is_worth_a_trial(std::uint32_t larger, const Sample& drawn) const;
    void choose_patience(std::uint32_t wanted);
    /** Whether lines are worth their time while things move. */
    void choose_lines(const Step& drawn, double milliseconds);

    double m_budget;
    std::uint64_t m_version = 1, m_shown_version = 0;
    FrameStage m_shown = FrameStage::none;
    bool m_is_moving = false;
    Time m_touched{};
    std::uint32_t m_divisor = 4;
    /** With or without lines, as m_with_lines says. */
    std::optional<Sample> m_last, m_other_size;
    /** Pictures of one size, before the last one. */
    int m_n_alike = 0;
    /** Pictures of one size before a trial: few, and ever more where larger ones were too slow. */
    static constexpr int first_patience = 3;
    int m_patience = first_patience;
    /** What another size, or lines, once took is forgotten after so many: they may have been slow for another reason. */
    static constexpr int most_alike = 20;
    int m_line_patience = most_alike;
    /** The next picture is the second one of a larger size. */
    bool m_is_second = false;
    /** The last change of the size was to more pixels. */
    bool m_went_up = false;
    bool m_with_lines = true;
    /** What all pixels took the last time that lines were not given up. */
    double m_full_with_lines = 0;
};

} // namespace elvis::view
