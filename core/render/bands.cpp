#include <core/render/bands.hpp>

#include <core/base/host.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <thread>
#include <vector>

namespace elvis {

namespace {

/** The rows that are kept of a band, and those that are drawn. */
struct Band {
    std::uint32_t first = 0, end = 0, first_drawn = 0, end_drawn = 0;
};

/** Lines look at the pixels around them. */
std::uint32_t margin_of(const FrameRequest& request) {
    double reach = 0;
    for (const Surface& surface : request.surfaces) {
        // Half of a line's width, and of pixels that are met by halves their neighbours.
        reach = surface.contours ? std::max(reach, surface.contours->style.width + 2) : reach;
        reach = surface.mesh_lines ? std::max(reach, surface.mesh_lines->style.width + 2) : reach;
    }
    return part_rows * static_cast<std::uint32_t>(std::ceil(reach / part_rows));
}

std::vector<Band> bands_of(const FrameRequest& request, std::size_t n) {
    const std::uint32_t margin = margin_of(request);
    const std::uint64_t n_units = (std::uint64_t{request.height} + part_rows - 1) / part_rows;
    std::vector<Band> bands;
    for (std::size_t i = 0; i < n; ++i) {
        const auto border = [&](std::size_t band) {
            return static_cast<std::uint32_t>(std::min<std::uint64_t>(n_units * band / n * part_rows, request.height));
        };
        const std::uint32_t first = border(i), end = border(i + 1);
        if (first < end) {
            bands.push_back({first, end, first - std::min(first, margin), std::min(end + margin, request.height)});
        }
    }
    return bands;
}

FrameRequest request_for(const FrameRequest& whole, const Band& band) {
    FrameRequest request = whole;
    request.height = band.end_drawn - band.first_drawn;
    request.part = {band.first_drawn, whole.height};
    return request;
}

/** All of them, each on a thread of its own; throws what the first of them threw. */
std::vector<Frame> draw(std::span<Renderer* const> renderers, const FrameRequest& request, const std::vector<Band>& bands,
                        const TaskControl* control) {
    std::vector<Frame> frames(bands.size());
    std::vector<std::exception_ptr> failures(bands.size());
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < bands.size(); ++i) {
            threads.emplace_back([&, i, &of = host()] {
                const HostScope scope(of);
                try {
                    frames[i] = renderers[i]->render(request_for(request, bands[i]), control);
                } catch (...) {
                    failures[i] = std::current_exception();
                }
            });
        }
    }
    for (const std::exception_ptr& failure : failures) {
        if (failure) {
            std::rethrow_exception(failure);
        }
    }
    return frames;
}

/** The band's rows of what has some numbers a pixel. */
template <class T> void append(const std::vector<T>& from, const Band& band, std::size_t row_length, std::vector<T>& to) {
    if (!from.empty()) {
        const auto at = [&](std::uint32_t row) { return from.begin() + static_cast<std::ptrdiff_t>(row * row_length); };
        to.insert(to.end(), at(band.first - band.first_drawn), at(band.end - band.first_drawn));
    }
}

/** What is not of the volume but of pixels, or of work. */
constexpr std::uint64_t FrameCounts::*counts[] = {&FrameCounts::hit_pixels,
                                                  &FrameCounts::field_evaluations,
                                                  &FrameCounts::mapping_evaluations,
                                                  &FrameCounts::newton_failures,
                                                  &FrameCounts::newton_iterations,
                                                  &FrameCounts::undecided_pixels,
                                                  &FrameCounts::overlap_pixels,
                                                  &FrameCounts::nan_pixels,
                                                  &FrameCounts::work_limit_pixels,
                                                  &FrameCounts::careful_pixels,
                                                  &FrameCounts::estimated_pixels,
                                                  &FrameCounts::contour_pixels,
                                                  &FrameCounts::undecided_contour_pixels,
                                                  &FrameCounts::mesh_line_pixels,
                                                  &FrameCounts::undecided_mesh_line_pixels,
                                                  &FrameCounts::isosurface_pixels,
                                                  &FrameCounts::undecided_isosurface_pixels,
                                                  &FrameCounts::excluded_intervals,
                                                  &FrameCounts::undecided_intervals,
                                                  &FrameCounts::isosurface_crossings,
                                                  &FrameCounts::projected_pixels,
                                                  &FrameCounts::certified_segments,
                                                  &FrameCounts::fits,
                                                  &FrameCounts::fit_degrees,
                                                  &FrameCounts::verified_fits,
                                                  &FrameCounts::undecided_fits,
                                                  &FrameCounts::volume_pixels,
                                                  &FrameCounts::inexact_volume_pixels,
                                                  &FrameCounts::volume_segments,
                                                  &FrameCounts::empty_segments,
                                                  &FrameCounts::volume_steps,
                                                  &FrameCounts::volume_breakpoints,
                                                  &FrameCounts::refined_pixels,
                                                  &FrameCounts::hidden_pixels,
                                                  &FrameCounts::spared_pixels};

/** All but its pixels. */
void add_part(const Frame& part, Frame& whole) {
    for (std::uint64_t FrameCounts::*count : counts) {
        whole.counts.*count += part.counts.*count;
    }
    whole.counts.overlapping_elements = part.counts.overlapping_elements;
    whole.counts.half_drawn_elements = part.counts.half_drawn_elements;
    whole.special_values.resize(part.special_values.size());
    for (std::size_t i = 0; i < part.special_values.size(); ++i) {
        const SpecialValues& from = part.special_values[i];
        SpecialValues& to = whole.special_values[i];
        to = {to.below || from.below, to.above || from.above, to.nan || from.nan, to.is_shown || from.is_shown};
    }
    whole.is_met.resize(part.is_met.size());
    for (std::size_t i = 0; i < part.is_met.size(); ++i) {
        whole.is_met[i] = whole.is_met[i] || part.is_met[i];
    }
    whole.render_milliseconds = std::max(whole.render_milliseconds, part.render_milliseconds);
    whole.device_milliseconds = std::max(whole.device_milliseconds, part.device_milliseconds);
    whole.submissions += part.submissions;
    whole.host_waits += part.host_waits;
}

} // namespace

Frame render_in_bands(std::span<Renderer* const> renderers, const FrameRequest& request, const TaskControl* control) {
    const std::vector<Band> bands = bands_of(request, renderers.size());
    std::vector<Frame> frames = draw(renderers, request, bands, control);
    Frame whole;
    whole.width = request.width;
    whole.height = request.height;
    for (std::size_t i = 0; i < bands.size(); ++i) {
        const Frame& part = frames[i];
        const std::size_t width = request.width;
        append(part.color, bands[i], 4 * width, whole.color);
        append(part.value, bands[i], width, whole.value);
        append(part.depth, bands[i], width, whole.depth);
        append(part.element, bands[i], width, whole.element);
        append(part.normal, bands[i], 3 * width, whole.normal);
        append(part.flags, bands[i], width, whole.flags);
        add_part(part, whole);
    }
    whole.counts.pixels = std::uint64_t{request.width} * request.height;
    return whole;
}

} // namespace elvis
