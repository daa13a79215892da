#include "frame_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace elvis::view {

namespace {

/** Of the budget that a picture of a larger size may be expected to take: less, so that the size does not go up and down. */
constexpr double most_of_budget = 0.7;
/**
 * At so few pixels lines are given up: they would be as wide as what they show, and the certain ones take the longer, the more
 * elements a pixel covers.
 */
constexpr std::uint32_t coarsest_with_lines = 4;

/**
 * Of the budget: below, the next size is tried though nothing is known of it. It has 1.8 to 4 times the pixels, and takes less
 * than so many times as long, for a part of the time goes with no pixel.
 */
constexpr double worth_a_trial = 0.64;
/** Of the mean time of pictures of a size: one that is slow by chance is not enough for another size. */
constexpr double newest_share = 0.3;
/** Of the budget: the first picture of a larger size makes its buffers, too, and is not what the size is judged by. */
constexpr double first_may_take = 3;
/** Pictures of one size before a trial, at most: after some that were too slow. */
constexpr int most_patience = 320;

} // namespace

void FrameSchedule::touch(Time now) {
    ++m_version;
    m_is_moving = true;
    m_touched = now;
}

std::optional<FrameSchedule::Step> FrameSchedule::next(Time now) const {
    switch (shown()) {
    case FrameStage::none:
        return m_divisor == 1 ? Step{FrameStage::full, 1, m_version}
                              : Step{FrameStage::moving, m_divisor, m_version, m_with_lines};
    case FrameStage::moving:
        return moves(now) ? std::nullopt : std::optional(Step{FrameStage::full, 1, m_version});
    case FrameStage::full:
        return moves(now) ? std::nullopt : std::optional(Step{FrameStage::exact, 1, m_version});
    case FrameStage::exact:
        break;
    }
    return {};
}

bool FrameSchedule::is_outdated(const Step& step, Time now) const {
    if (step.version == m_version) {
        return false;
    }
    // Pictures of a movement are finished, those of all pixels, too, where these are quick: of cancelled ones nothing would be
    // seen at all.
    const bool is_of_movement = step.stage == FrameStage::moving || (step.stage == FrameStage::full && m_divisor == 1);
    return !is_of_movement || !moves(now);
}

void FrameSchedule::drawn(const Step& step, bool is_refinable, double milliseconds) {
    m_shown = step.stage == FrameStage::full && !is_refinable ? FrameStage::exact : step.stage;
    m_shown_version = step.version;
    // What is exact takes longer than what would be drawn while things move, if it is anything else.
    if (step.stage == FrameStage::exact) {
        return;
    }
    choose_lines(step, milliseconds);
    if (step.with_lines == m_with_lines) {
        choose_divisor({step.divisor, milliseconds});
    }
}

void FrameSchedule::choose_lines(const Step& drawn, double milliseconds) {
    const bool had_lines = m_with_lines;
    if (drawn.stage == FrameStage::full) {
        // Again where there is less to draw than when they were given up.
        m_with_lines = m_with_lines || milliseconds < 0.5 * m_full_with_lines;
        m_full_with_lines = had_lines || m_full_with_lines == 0 ? milliseconds : m_full_with_lines;
    } else if (drawn.with_lines && drawn.divisor >= coarsest_with_lines && milliseconds > m_budget) {
        m_with_lines = false;
    } else if (!drawn.with_lines && m_n_alike >= m_line_patience) {
        // They may not have been what was slow.
        m_with_lines = true;
        m_line_patience = std::min(most_patience, 2 * m_line_patience);
    } else if (drawn.with_lines && m_n_alike > most_alike) {
        m_line_patience = most_alike;
    }
    if (m_with_lines != had_lines) {
        m_n_alike = 0;
        m_last.reset();
        m_other_size.reset();
    }
}

/**
 * Time is taken as a part that goes with the number of pixels and one that does not: a line through the picture just drawn and
 * the last one of another size, or through the origin while there is none.
 */
double FrameSchedule::expected(std::uint32_t divisor, const Sample& drawn) const {
    const auto share = [](double d) { return 1 / (d * d); };
    if (!m_other_size) {
        return drawn.milliseconds * share(divisor) / share(drawn.divisor);
    }
    // More pixels that took less time tell that pixels hardly matter.
    const double slope = std::max(0.0, (drawn.milliseconds - m_other_size->milliseconds) /
                                           (share(drawn.divisor) - share(m_other_size->divisor)));
    return std::max(0.0, drawn.milliseconds + slope * (share(divisor) - share(drawn.divisor)));
}

void FrameSchedule::choose_divisor(Sample drawn) {
    const bool is_larger = m_last && drawn.divisor < m_last->divisor;
    const bool is_slow = drawn.milliseconds > m_budget && drawn.milliseconds <= first_may_take * m_budget;
    if (is_larger && is_slow && !std::exchange(m_is_second, true)) {
        return;
    }
    m_is_second = false;
    const bool is_alike = m_last && m_last->divisor == drawn.divisor;
    m_n_alike = is_alike ? m_n_alike + 1 : 0;
    if (is_alike) {
        drawn.milliseconds = newest_share * drawn.milliseconds + (1 - newest_share) * m_last->milliseconds;
    } else {
        m_other_size = m_last;
    }
    if (m_n_alike > most_alike) {
        m_other_size.reset();
    }
    m_last = drawn;
    const std::uint32_t wanted = wanted_divisor(drawn);
    if (drawn.divisor == m_divisor) {
        choose_patience(wanted);
    }
    m_divisor = wanted;
}

std::uint32_t FrameSchedule::wanted_divisor(const Sample& drawn) const {
    // Fewer pixels than that are no use: the rest takes its time.
    constexpr double hardly_slower = 1.3;
    const double least = hardly_slower * expected(divisors.back(), drawn);
    const auto fits = [&](std::uint32_t divisor) {
        const double budget = (divisor < m_divisor ? most_of_budget : 1.0) * m_budget;
        return expected(divisor, drawn) <= std::max(budget, least);
    };
    // All pixels come with lines.
    const auto first = divisors.begin() + (m_with_lines ? 0 : 1);
    const auto found = std::find_if(first, divisors.end(), fits);
    const std::uint32_t wanted = found == divisors.end() ? divisors.back() : *found;
    if (wanted > m_divisor) {
        return wanted;
    }
    const auto now = std::find(first, divisors.end(), m_divisor);
    const bool has_larger = now != first && now != divisors.end();
    // A picture of another size tells less than one of this.
    if (drawn.divisor != m_divisor || !has_larger) {
        return m_divisor;
    }
    // One size at a time: two measured times may lead far astray.
    return wanted < m_divisor || is_worth_a_trial(*(now - 1), drawn) ? *(now - 1) : m_divisor;
}

bool FrameSchedule::is_worth_a_trial(std::uint32_t larger, const Sample& drawn) const {
    const bool may_fit = m_other_size ? expected(larger, drawn) <= m_budget : drawn.milliseconds <= worth_a_trial * m_budget;
    return may_fit && m_n_alike >= m_patience;
}

void FrameSchedule::choose_patience(std::uint32_t wanted) {
    if (wanted > m_divisor) {
        m_patience = std::clamp(2 * m_patience, most_alike, most_patience);
        m_went_up = false;
    } else if (wanted < m_divisor) {
        m_went_up = true;
    } else if (m_went_up && m_n_alike > most_alike) {
        m_patience = first_patience;
    }
}

} // namespace elvis::view
