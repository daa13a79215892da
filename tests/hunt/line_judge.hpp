/**
 * @file line_judge.hpp
 * Flags of contours and mesh lines, and the colours of lines, against the oracle.
 */
#pragma once

#include "judge.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace elvis::hunt {

/** Of a request of one opaque surface with lines. Some pixels of the frame are judged: those that look suspicious first. */
Judgement judge_lines(const FrameRequest& request, const Frame& frame, Precision precision, const std::vector<Answer>& answers,
                      const std::vector<std::shared_ptr<oracle::SceneOracle>>& oracles);

/** Which colour the flags around a pixel that shows the surface ask for. */
LineColor line_color_of(const Surface& surface, const Frame& frame, std::size_t pixel);

} // namespace elvis::hunt
