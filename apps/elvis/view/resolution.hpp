/**
 * @file resolution.hpp
 * How coarse pictures must be to keep up with the hand.
 */
#pragma once

namespace elvis::view {

/**
 * A fraction of the full width and height, from measured times. Time has a part that grows with the pixels and one that does not;
 * the fraction goes towards what the target would allow if it all grew, at most by a factor of two a frame, in steps that keep
 * small fluctuations from changing the picture's size.
 */
class ResolutionChooser {
public:
    /** Ten frames a second leave 100 ms; some of that is for showing them. */
    static constexpr double target_milliseconds = 80;
    static constexpr double least_scale = 1.0 / 12;

    double scale() const { return m_scale; }
    /** A picture at that scale took this long. */
    void measured(double scale, double milliseconds);

private:
    double m_scale = 0.25;
};

} // namespace elvis::view
