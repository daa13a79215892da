/**
 * @file frame_remarks.hpp
 * What people should know of a picture, from its counts.
 */
#pragma once

#include <core/render/frame.hpp>

#include <string>
#include <vector>

namespace elvis {

struct FrameRemark {
    /** Something may be wrong with the picture or the data; else it is only good to know. */
    bool is_warning = false;
    std::string text;
};

std::vector<FrameRemark> remarks_on(const FrameCounts& counts);

} // namespace elvis
