/**
 * @file line_plot.hpp
 * A plot of fields over the arc length of a line.
 */
#pragma once

#include <apps/elvis/view/window/ui.hpp>

#include <cstddef>
#include <optional>

namespace elvis::view {

/** As wide as there is room. Returns the row that the cursor is at, if it is in the plot. */
std::optional<std::size_t> draw_line_plot(Ui& ui, const LineAnswer& answer);

} // namespace elvis::view
