/**
 * @file svg.hpp
 * Annotation as shapes and text, apart from the picture that it is written on.
 */
#pragma once

#include <core/annotation/plan.hpp>

#include <string>
#include <vector>

namespace elvis {

/** Colours of a part of a picture, as Frame::color has them. */
struct CoveredPart {
    PixelBox box;
    std::vector<double> color;
};

/** What paint() will cover. */
std::vector<CoveredPart> covered_by(const AnnotationPlan& plan, const Frame& frame);
/** Undoes paint(). */
void uncover(Frame& frame, const std::vector<CoveredPart>& covered);

/** SVG's elements for the plan, in pixels of the picture, in the colours that paint() would take on it. */
std::string svg_elements(const AnnotationPlan& plan, const Frame& frame);

} // namespace elvis
