/**
 * @file plan.hpp
 * What annotation writes, and where, before there is a picture to write on.
 */
#pragma once

#include <core/annotation/annotation.hpp>
#include <core/annotation/drawing.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

/** annotate() paints the items one after the other; their boxes with halos do not meet. */
struct AnnotationPlan {
    struct Item {
        Drawing drawing;
        /** As Drawing::paint takes it. */
        std::optional<Color> ink;
    };
    std::vector<Item> items;
    double halo_radius = 1;
    /** Names of those that found no room. */
    std::vector<std::string> left_out;
};

/** For a picture of that size. Throws as annotate() does. */
AnnotationPlan plan_annotation(std::uint32_t width, std::uint32_t height, const AnnotationRequest& request);

void paint(Frame& frame, const AnnotationPlan& plan);

} // namespace elvis
