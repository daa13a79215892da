#include <core/parts/fold.hpp>

#include <core/parts/line_doubts.hpp>
#include <core/render/bands.hpp>
#include <core/render/picture/frame_read.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace elvis {

namespace {

constexpr double behind_everything = std::numeric_limits<double>::infinity();
/** What was perhaps not found holds whatever others show. */
constexpr std::uint32_t misses =
    pixel_flag::newton_failure | pixel_flag::isosurface_undecided | pixel_flag::work_limit | pixel_flag::estimated;
/** So does what may be in front of an element of the part's own. Of elements around it another part knows better. */
constexpr std::uint32_t own_doubts = misses | pixel_flag::undecided | pixel_flag::overlap;

/** Of flags: those of surfaces that are not seen there stand above the others until all surfaces are there. */
constexpr std::uint32_t half_bits = 16, lower_half = 0xffff;

/** What a pixel shows so far. */
struct Shown {
    const PartPixel* own = nullptr;
    /** Of elements around the parts. */
    const PartPixel* other = nullptr;
    /** Of parts that know no element there, and what they doubt. */
    const PartPixel* outside = nullptr;
    std::uint32_t outside_doubt = 0;
    std::uint32_t part = 0;
    std::uint32_t doubt = 0;
    /** Of parts that show nothing there, which may have lines that end in the pixel. */
    std::uint32_t beside = 0;
};

bool is_nearer(const PartPixel& one, const PartPixel* than) { return than == nullptr || one.depth < than->depth; }

std::vector<Shown> nearest(std::size_t n_pixels, std::span<const PartPixels> parts) {
    std::vector<Shown> shown(n_pixels);
    for (const PartPixels& one : parts) {
        for (const PartPixel& pixel : one.pixels) {
            Shown& here = shown[pixel.pixel];
            here.doubt |= doubts_of(pixel);
            here.beside |= pixel.is_hit() ? 0 : pixel.flags;
            if (pixel.is_own != 0 && is_nearer(pixel, here.own)) {
                here.own = &pixel;
                here.part = one.part;
            } else if (pixel.is_own == 0 && pixel.is_hit() && is_nearer(pixel, here.other)) {
                here.other = &pixel;
            } else if (pixel.is_outside()) {
                here.outside = here.outside == nullptr || is_better_outside(pixel, *here.outside) ? &pixel : here.outside;
                here.outside_doubt |= pixel.flags;
            }
        }
    }
    return shown;
}

/** Among parts that do not agree, the nearest; with doubt. What lies in an element of one part is outside of others. */
void settle(std::vector<Shown>& shown, double tolerance) {
    for (Shown& here : shown) {
        const double own_depth = here.own != nullptr ? here.own->depth : behind_everything;
        if (here.other != nullptr && here.other->depth < own_depth - tolerance) {
            here.own = here.other;
            here.doubt |= pixel_flag::undecided;
        }
        if (here.own == nullptr && here.outside != nullptr) {
            here.own = here.outside;
            here.doubt |= here.outside_doubt;
        }
    }
}

/** Of surfaces that are not met in the pixel's middle: whether their lines are hidden there only the whole could tell. */
std::uint32_t as_open(std::uint32_t flags) {
    return ((flags & pixel_flag::contour) != 0 ? pixel_flag::contour_undecided : 0) |
           ((flags & pixel_flag::mesh_line) != 0 ? pixel_flag::mesh_line_undecided : 0);
}

void write_pixels(const std::vector<Shown>& shown, Frame& frame) {
    for (std::size_t pixel = 0; pixel < shown.size(); ++pixel) {
        const std::uint32_t beside = shown[pixel].beside;
        frame.flags[pixel] = settled_lines(shown[pixel].doubt | beside);
        if (const PartPixel* const from = shown[pixel].own) {
            frame.flags[pixel] = settled_lines(shown[pixel].doubt | as_open(beside) | from->flags);
            frame.element[pixel] = from->element;
            frame.value[pixel] = from->value;
            frame.depth[pixel] = from->depth;
            std::ranges::copy(from->normal, &frame.normal[3 * pixel]);
            std::ranges::copy(from->color, &frame.color[4 * pixel]);
        }
    }
}

/** Edges of several parts in one pixel are seen together: where one of them is certain, there is an edge. */
void join_edges(std::span<const PartPixels> parts, Frame& frame) {
    for (const PartPixels& one : parts) {
        for (const PartPixel& pixel : one.pixels) {
            frame.flags[pixel.pixel] |= pixel.flags & (pixel_flag::mesh_line | pixel_flag::mesh_line_undecided);
        }
    }
    std::ranges::transform(frame.flags, frame.flags.begin(), settled_lines);
}

/** A run, and whose it is. */
struct OwnedRun {
    const LightRun* run;
    std::uint32_t part;
    bool is_stop;
};

/** By pixel, then along the ray; those that begin together by part. */
std::vector<OwnedRun> all_runs(std::span<const PartRuns> parts, std::span<const LightRun> stops) {
    std::vector<OwnedRun> runs;
    for (const PartRuns& one : parts) {
        for (const LightRun& run : one.runs) {
            runs.push_back({&run, one.part, false});
        }
    }
    for (const LightRun& stop : stops) {
        runs.push_back({&stop, 0, true});
    }
    std::ranges::stable_sort(runs, {}, [](const OwnedRun& one) {
        return std::tuple(one.run->pixel, one.run->n_stops, one.is_stop, one.run->first, one.part, one.run->end);
    });
    return runs;
}

/** As shaders/volume/volume_finish.comp. */
void put_in_front(const LightRun& light, std::span<double> color) {
    const double rest = color[3] * light.transmittance, alpha = 1 - light.transmittance + rest;
    const std::array<double, 3> own{light.red, light.green, light.blue};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        color[channel] = alpha > 0 ? (own[channel] + rest * color[channel]) / alpha : color[channel];
    }
    color[3] = alpha;
}

/** Of the diagonal: where faces between parts lie is rounded, far more where a ray grazes them. */
constexpr double hardly_overlapping = 1e-4;

/** Of the block's pixels those in `kept`, `n` numbers each. */
template <class T> void keep(std::vector<T>& numbers, const PixelBlock& block, const PixelBlock& kept, std::size_t n) {
    std::vector<T> all = std::exchange(numbers, {});
    numbers.reserve(kept.n_pixels() * n);
    for (std::uint32_t row = 0; row < kept.height; ++row) {
        const std::size_t place =
            std::size_t{kept.first_row - block.first_row + row} * block.width + kept.first_column - block.first_column;
        const auto from = all.begin() + static_cast<std::ptrdiff_t>(place * n);
        numbers.insert(numbers.end(), from, from + static_cast<std::ptrdiff_t>(kept.width * n));
    }
}

void crop(Frame& frame, const PixelBlock& block, const PixelBlock& kept) {
    if (kept.n_pixels() == block.n_pixels()) {
        return;
    }
    keep(frame.color, block, kept, 4);
    keep(frame.value, block, kept, 1);
    keep(frame.depth, block, kept, 1);
    keep(frame.element, block, kept, 1);
    keep(frame.normal, block, kept, 3);
    keep(frame.flags, block, kept, 1);
    frame.width = kept.width;
    frame.height = kept.height;
}

} // namespace

bool is_better_outside(const PartPixel& one, const PartPixel& than) {
    constexpr std::uint32_t lines = pixel_flag::contour | pixel_flag::mesh_line;
    return std::popcount(one.flags & lines) > std::popcount(than.flags & lines);
}

std::uint32_t doubts_of(const PartPixel& pixel) {
    const bool others_know_better = pixel.is_outside() || (pixel.is_hit() && pixel.is_own == 0);
    return pixel.flags & (others_know_better ? misses : own_doubts);
}

bool meets_rays_once(const Surface& surface) {
    const SurfaceTraits traits = traits_of(surface.geometry);
    return traits.plane != nullptr || traits.wires != nullptr;
}

Frame empty_block(const FrameRequest& request, const PixelBlock& block, Precision precision) {
    FrameRequest empty;
    empty.width = block.width;
    empty.height = block.height;
    empty.background = request.background;
    if (precision == Precision::float32) {
        // As the device has it.
        std::ranges::transform(request.background, empty.background.begin(),
                               [](double channel) { return static_cast<double>(static_cast<float>(channel)); });
    }
    return background_frame(empty);
}

Frame empty_facts(const FrameRequest& request) {
    Frame facts;
    facts.width = request.width;
    facts.height = request.height;
    facts.counts.pixels = std::uint64_t{request.width} * request.height;
    facts.is_met.resize(request.surfaces.size());
    facts.special_values.resize(request.surfaces.size());
    return facts;
}

Frame folded(const FrameRequest& request, const PixelBlock& block, const PixelBlock& kept, std::span<const PartPixels> parts,
             double diagonal, Precision precision) {
    Frame frame = empty_block(request, block, precision);
    std::vector<Shown> shown = nearest(frame.flags.size(), parts);
    settle(shown, same_depth * diagonal);
    write_pixels(shown, frame);
    if (traits_of(request.surfaces[0].geometry).wires != nullptr) {
        join_edges(parts, frame);
    }
    std::vector<LayerOfPart> sources(shown.size());
    for (std::size_t pixel = 0; pixel < shown.size(); ++pixel) {
        if (shown[pixel].own != nullptr && shown[pixel].own->is_hit()) {
            sources[pixel] = {shown[pixel].part, 0};
        }
    }
    LineDoubts(request, block, parts).flag(sources, frame);
    crop(frame, block, kept);
    return frame;
}

Frame folded_facts(const FrameRequest& request, std::span<const Frame> parts) {
    Frame facts = empty_facts(request);
    std::uint64_t n_overlapping = 0;
    for (const Frame& part : parts) {
        add_part(part, facts);
        n_overlapping = std::max(n_overlapping, part.counts.overlapping_elements);
        facts.render_milliseconds += part.render_milliseconds;
        facts.device_milliseconds += part.device_milliseconds;
    }
    // At least so many: an element may overlap some of another part.
    facts.counts.overlapping_elements = n_overlapping;
    return facts;
}

std::uint32_t merged_flags(std::uint32_t picture, std::uint32_t surface, bool is_drawn, bool is_nearest) {
    const std::uint32_t front = is_nearest ? surface : picture, back = is_nearest ? picture : surface;
    const std::uint32_t staying = back & (is_drawn ? own_doubts : lower_half);
    return (front & lower_half) | ((front | back) & ~lower_half) | (staying << half_bits);
}

std::uint32_t doubt_behind(std::uint32_t flags) {
    constexpr std::uint32_t colors = pixel_flag::undecided | pixel_flag::overlap | pixel_flag::range_too_fine,
                            lines = pixel_flag::contour_undecided | pixel_flag::mesh_line_undecided;
    const std::uint32_t doubt = flags & colors;
    return (doubt | ((settled_lines(flags & lower_half) & lines) != 0 ? pixel_flag::undecided : 0)) << half_bits;
}

void add_surface(const Frame& surface, Frame& picture) {
    for (std::size_t pixel = 0; pixel < picture.flags.size(); ++pixel) {
        const bool is_drawn = !std::isnan(surface.depth[pixel]), is_empty = std::isnan(picture.depth[pixel]);
        const bool is_nearest = is_drawn && (is_empty || surface.depth[pixel] < picture.depth[pixel]);
        picture.flags[pixel] = merged_flags(picture.flags[pixel], surface.flags[pixel], is_drawn, is_nearest);
        if (is_nearest) {
            picture.element[pixel] = surface.element[pixel];
            picture.value[pixel] = surface.value[pixel];
            picture.depth[pixel] = surface.depth[pixel];
            std::copy_n(&surface.normal[3 * pixel], 3, &picture.normal[3 * pixel]);
            std::copy_n(&surface.color[4 * pixel], 4, &picture.color[4 * pixel]);
        }
    }
}

void add_work(const Frame& from, Frame& to) {
    Frame facts;
    facts.counts = from.counts;
    facts.counts.overlapping_elements = to.counts.overlapping_elements;
    facts.counts.half_drawn_elements = to.counts.half_drawn_elements;
    facts.submissions = from.submissions;
    facts.host_waits = from.host_waits;
    facts.is_met.resize(to.is_met.size());
    facts.special_values.resize(to.special_values.size());
    add_part(facts, to);
    to.render_milliseconds += from.render_milliseconds;
    to.device_milliseconds += from.device_milliseconds;
}

void add_surface_facts(const Frame& surface, std::size_t index, Frame& picture) {
    add_work(surface, picture);
    picture.counts.overlapping_elements = surface.counts.overlapping_elements;
    picture.is_met[index] = surface.is_met.front();
    // Of the surface, and of those that are added where a part of the volume ends.
    for (const SpecialValues& one : surface.special_values) {
        SpecialValues& all = picture.special_values[index];
        all = {all.below || one.below, all.above || one.above, all.nan || one.nan, all.is_shown || one.is_shown};
    }
}

void finish_surfaces(Frame& picture) {
    for (std::uint32_t& flags : picture.flags) {
        flags = settled_lines((flags | flags >> half_bits) & lower_half);
    }
}

std::uint64_t add_light(const LightRule& rule, std::span<const PartRuns> parts, std::span<const LightRun> stops,
                        Frame& picture) {
    std::uint64_t n_colored = 0;
    const std::vector<OwnedRun> runs = all_runs(parts, stops);
    for (auto next = runs.begin(); next != runs.end();) {
        LightRun light;
        light.pixel = next->run->pixel;
        light.error = rule.color_error;
        bool is_overlapping = false;
        for (; next != runs.end() && next->run->pixel == light.pixel; ++next) {
            is_overlapping = is_overlapping || next->run->first < light.end - hardly_overlapping * rule.diagonal;
            add_behind(light, *next->run);
        }
        picture.flags[light.pixel] |= light.flags | (is_overlapping ? pixel_flag::undecided : 0);
        picture.flags[light.pixel] |= error_of(light) <= rule.tolerance ? 0 : pixel_flag::volume_tolerance;
        if (light.transmittance < 1) {
            put_in_front(light, std::span(picture.color).subspan(4 * std::size_t{light.pixel}, 4));
            ++n_colored;
        }
    }
    return n_colored;
}

} // namespace elvis
