/**
 * @file repeated_frame.hpp
 * A picture drawn several times, and the least time that it took.
 */
#pragma once

#include <core/render/renderer.hpp>

#include <algorithm>

namespace elvis {

struct RepeatedFrame {
    /** The last one. */
    Frame frame;
    /** The least of all runs, each. */
    double milliseconds = 0, wall_milliseconds = 0;
};

/** Once for what is made at the first time (kernels, buffers), then `n_runs` times. */
inline RepeatedFrame render_repeatedly(Renderer& renderer, const FrameRequest& request, int n_runs) {
    RepeatedFrame result;
    renderer.render(request);
    for (int run = 0; run < n_runs; ++run) {
        result.frame = renderer.render(request);
        const Frame& frame = result.frame;
        result.milliseconds = run == 0 ? frame.device_milliseconds : std::min(result.milliseconds, frame.device_milliseconds);
        result.wall_milliseconds =
            run == 0 ? frame.render_milliseconds : std::min(result.wall_milliseconds, frame.render_milliseconds);
    }
    return result;
}

} // namespace elvis
