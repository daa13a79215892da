#include <core/render/bands.hpp>

#include <core/base/host.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace elvis {

namespace {

/** Lines, and line integral convolution, look at the pixels around them. */
std::uint32_t margin_of(const FrameRequest& request) {
    double reach = 0;
    for (const Surface& surface : request.surfaces) {
        // And of pixels that are met by halves their neighbours.
        reach = surface.contours ? std::max(reach, line_reach(surface.contours->style.width) + 1.0) : reach;
        reach = surface.mesh_lines ? std::max(reach, line_reach(surface.mesh_lines->style.width) + 1.0) : reach;
        // Curves look at the pixels beside them, and at what is beside those.
        reach = surface.lic ? std::max(reach, surface.lic->length + 3) : reach;
    }
    return part_rows * static_cast<std::uint32_t>(std::ceil(reach / part_rows));
}

/** The rows that are drawn for those that are kept. */
Rows drawn_for(const Rows& kept, const FrameRequest& request) {
    const std::uint32_t margin = margin_of(request);
    return {kept.first - std::min(kept.first, margin), std::min(kept.end + margin, request.height)};
}

FrameRequest request_for(const FrameRequest& whole, const Rows& rows) {
    FrameRequest request = whole;
    request.height = rows.end - rows.first;
    request.part = PicturePart{whole.place().first_row + rows.first, whole.place().of_height};
    const auto take_rows = [&](std::shared_ptr<const std::vector<double>>& numbers) {
        if (numbers) {
            const auto own =
                std::span(*numbers).subspan(std::size_t{rows.first} * whole.width, std::size_t{request.height} * whole.width);
            numbers = std::make_shared<const std::vector<double>>(own.begin(), own.end());
        }
    };
    take_rows(request.hidden_from);
    take_rows(request.shades);
    return request;
}

/** Leaves the kept rows of what has some numbers a pixel. */
template <class T> void keep(std::vector<T>& numbers, const Rows& drawn, const Rows& kept, std::size_t row_length) {
    if (!numbers.empty()) {
        numbers.resize((kept.end - drawn.first) * row_length);
        numbers.erase(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>((kept.first - drawn.first) * row_length));
    }
}

void crop(Frame& frame, const Rows& drawn, const Rows& kept) {
    const std::size_t width = frame.width;
    keep(frame.color, drawn, kept, 4 * width);
    keep(frame.value, drawn, kept, width);
    keep(frame.depth, drawn, kept, width);
    keep(frame.element, drawn, kept, width);
    keep(frame.normal, drawn, kept, 3 * width);
    keep(frame.flags, drawn, kept, width);
    frame.height = kept.end - kept.first;
}

/** Writes the band's rows into a vector that has room for all. */
template <class T>
void put(const std::vector<T>& band, const Rows& rows, const FrameRequest& whole, std::size_t row_length, std::vector<T>& all) {
    if (!band.empty()) {
        all.resize(whole.height * row_length);
        std::copy(band.begin(), band.end(), all.begin() + static_cast<std::ptrdiff_t>(rows.first * row_length));
    }
}

void put_pixels(const Frame& band, const Rows& rows, const FrameRequest& request, Frame& pixels) {
    const std::size_t width = request.width;
    put(band.color, rows, request, 4 * width, pixels.color);
    put(band.value, rows, request, width, pixels.value);
    put(band.depth, rows, request, width, pixels.depth);
    put(band.element, rows, request, width, pixels.element);
    put(band.normal, rows, request, 3 * width, pixels.normal);
    put(band.flags, rows, request, width, pixels.flags);
}

void take_pixels(Frame pixels, Frame& whole) {
    whole.color = std::move(pixels.color);
    whole.value = std::move(pixels.value);
    whole.depth = std::move(pixels.depth);
    whole.element = std::move(pixels.element);
    whole.normal = std::move(pixels.normal);
    whole.flags = std::move(pixels.flags);
}

std::vector<Rows> all_bands(const FrameRequest& request, std::uint32_t n_rows) {
    std::vector<Rows> bands;
    for (std::uint32_t first = 0; first < request.height; first += n_rows) {
        bands.push_back({first, std::min(request.height, first + n_rows)});
    }
    return bands;
}

/** What is not of the volume but of pixels, or of work. */
constexpr std::uint64_t FrameCounts::*added_counts[] = {&FrameCounts::hit_pixels,
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

/** What renderers share while they draw. */
struct Work {
    const FrameRequest& request;
    std::uint32_t n_rows;
    const TaskControl* control;
    const std::function<void(const Frame&, const Rows&)>& take;
    std::mutex mutex{};
    std::uint32_t next_row = 0;
    Frame sum{};
    std::exception_ptr failure{};

    std::optional<Rows> next() {
        const std::lock_guard lock(mutex);
        if (failure || next_row >= request.height) {
            return std::nullopt;
        }
        const Rows rows{next_row, std::min(request.height, next_row + n_rows)};
        next_row = rows.end;
        return rows;
    }
};

void draw_bands(Renderer& renderer, Work& work) {
    double milliseconds = 0, device_milliseconds = 0;
    try {
        while (const std::optional<Rows> rows = work.next()) {
            const Rows drawn = drawn_for(*rows, work.request);
            Frame frame = renderer.render(request_for(work.request, drawn), work.control);
            milliseconds += frame.render_milliseconds;
            device_milliseconds += frame.device_milliseconds;
            crop(frame, drawn, *rows);
            const std::lock_guard lock(work.mutex);
            add_part(frame, work.sum);
            work.take(frame, *rows);
        }
    } catch (...) {
        const std::lock_guard lock(work.mutex);
        work.failure = work.failure ? work.failure : std::current_exception();
    }
    const std::lock_guard lock(work.mutex);
    work.sum.render_milliseconds = std::max(work.sum.render_milliseconds, milliseconds);
    work.sum.device_milliseconds = std::max(work.sum.device_milliseconds, device_milliseconds);
}

std::uint32_t whole_units(std::uint64_t n_rows) {
    return static_cast<std::uint32_t>(std::max<std::uint64_t>(part_rows, n_rows / part_rows * part_rows));
}

} // namespace

void add_part(const Frame& part, Frame& whole) {
    for (std::uint64_t FrameCounts::*count : added_counts) {
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
    whole.submissions += part.submissions;
    whole.host_waits += part.host_waits;
}

Frame render_bands(std::span<Renderer* const> renderers, const FrameRequest& request, std::uint32_t n_rows,
                   const TaskControl* control, const std::function<void(const Frame& band, const Rows& rows)>& take) {
    Work work{request, n_rows, control, take};
    {
        std::vector<std::jthread> threads;
        for (Renderer* const renderer : renderers.subspan(1)) {
            threads.emplace_back([&work, renderer, &of = host()] {
                const HostScope scope(of);
                draw_bands(*renderer, work);
            });
        }
        draw_bands(*renderers.front(), work);
    }
    if (work.failure) {
        std::rethrow_exception(work.failure);
    }
    work.sum.width = request.width;
    work.sum.height = request.height;
    work.sum.counts.pixels = std::uint64_t{request.width} * request.height;
    return std::move(work.sum);
}

std::uint32_t rows_a_band(std::span<Renderer* const> renderers, const FrameRequest& request) {
    const std::uint64_t n_units = (std::uint64_t{request.height} + part_rows - 1) / part_rows;
    std::uint64_t n_rows = (n_units + renderers.size() - 1) / renderers.size() * part_rows;
    const std::uint64_t margins = 2 * margin_of(request);
    for (const Renderer* const renderer : renderers) {
        const std::uint64_t most = renderer->most_pixels(request) / std::max(1u, request.width);
        if (request.height > most) {
            n_rows = std::min(n_rows, most - std::min(most, margins));
        }
    }
    return whole_units(n_rows);
}

Frame render_in_bands(std::span<Renderer* const> renderers, const FrameRequest& request, const TaskControl* control) {
    const std::uint32_t n_rows = rows_a_band(renderers, request);
    if (n_rows >= request.height) {
        return renderers.front()->render(request, control);
    }
    Frame pixels;
    Frame whole = render_bands(renderers, request, n_rows, control,
                               [&](const Frame& band, const Rows& rows) { put_pixels(band, rows, request, pixels); });
    take_pixels(std::move(pixels), whole);
    return whole;
}

std::vector<FrameRequest> bands_of(const FrameRequest& request, std::uint32_t n_rows) {
    std::vector<FrameRequest> bands;
    for (const Rows& rows : all_bands(request, n_rows)) {
        bands.push_back(n_rows < request.height ? request_for(request, drawn_for(rows, request)) : request);
    }
    return bands;
}

Frame render_band_by_band(const FrameRequest& request, std::uint32_t n_rows,
                          const std::function<Frame(const FrameRequest& band)>& draw,
                          const std::function<void(const Frame& band, const Rows& rows)>& take) {
    Frame whole;
    for (const Rows& rows : all_bands(request, n_rows)) {
        const Rows drawn = n_rows < request.height ? drawn_for(rows, request) : rows;
        Frame band = draw(n_rows < request.height ? request_for(request, drawn) : request);
        crop(band, drawn, rows);
        take(band, rows);
        add_part(band, whole);
        whole.render_milliseconds += band.render_milliseconds;
        whole.device_milliseconds += band.device_milliseconds;
    }
    whole.width = request.width;
    whole.height = request.height;
    whole.counts.pixels = std::uint64_t{request.width} * request.height;
    return whole;
}

Frame render_band_by_band(const FrameRequest& request, std::uint32_t n_rows,
                          const std::function<Frame(const FrameRequest& band)>& draw) {
    if (n_rows >= request.height) {
        return draw(request);
    }
    Frame pixels;
    Frame whole = render_band_by_band(request, n_rows, draw,
                                      [&](const Frame& band, const Rows& rows) { put_pixels(band, rows, request, pixels); });
    take_pixels(std::move(pixels), whole);
    return whole;
}

} // namespace elvis
