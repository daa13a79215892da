#include <core/session/joined_pictures.hpp>

#include <core/render/bands.hpp>
#include <core/render/picture/count_pixels.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace elvis {

namespace {

constexpr std::uint32_t line_bits = pixel_flag::contour | pixel_flag::mesh_line;
/** What was perhaps not found may be in front of what another volume shows. */
constexpr std::uint32_t doubt_bits = pixel_flag::newton_failure | pixel_flag::isosurface_undecided | pixel_flag::undecided |
                                     pixel_flag::work_limit | pixel_flag::estimated;

/** What was found may be hidden. */
std::uint32_t opened(std::uint32_t flags) {
    const std::uint32_t open = ((flags & pixel_flag::contour) != 0 ? pixel_flag::contour_undecided : 0) |
                               ((flags & pixel_flag::mesh_line) != 0 ? pixel_flag::mesh_line_undecided : 0);
    return (flags & ~line_bits) | open;
}

constexpr std::uint32_t open_lines = pixel_flag::contour_undecided | pixel_flag::mesh_line_undecided;

bool is_hit(const Frame& frame, std::size_t pixel) { return std::isfinite(frame.depth[pixel]); }

/** The frame that shows the nearest; of none that does, one whose lines end there, or else the first. */
std::uint32_t owner_of(std::span<const Frame> frames, std::size_t pixel) {
    std::uint32_t owner = 0;
    for (std::uint32_t i = 1; i < frames.size(); ++i) {
        const Frame& one = frames[i];
        const Frame& best = frames[owner];
        if (is_hit(one, pixel)
                ? !is_hit(best, pixel) || one.depth[pixel] < best.depth[pixel]
                : !is_hit(best, pixel) && (best.flags[pixel] & line_bits) == 0 && (one.flags[pixel] & line_bits) != 0) {
            owner = i;
        }
    }
    return owner;
}

class Joining {
public:
    Joining(std::span<const Frame> frames, double tolerance, double line_width)
        : m_frames(frames), m_tolerance(tolerance), m_reach(line_reach(line_width)), m_owners(frames.front().flags.size()) {
        for (std::size_t pixel = 0; pixel < m_owners.size(); ++pixel) {
            m_owners[pixel] = first_of_equals(pixel, owner_of(frames, pixel));
        }
    }

    Frame result() const {
        Frame frame = m_frames.front();
        for (std::size_t other = 1; other < m_frames.size(); ++other) {
            Frame facts;
            facts.counts = m_frames[other].counts;
            facts.submissions = m_frames[other].submissions;
            facts.host_waits = m_frames[other].host_waits;
            facts.is_met.resize(frame.is_met.size());
            facts.special_values.resize(frame.special_values.size());
            add_part(facts, frame);
            frame.render_milliseconds += m_frames[other].render_milliseconds;
            frame.device_milliseconds += m_frames[other].device_milliseconds;
        }
        for (std::size_t pixel = 0; pixel < m_owners.size(); ++pixel) {
            const Frame& from = m_frames[m_owners[pixel]];
            std::copy_n(&from.color[4 * pixel], 4, &frame.color[4 * pixel]);
            std::copy_n(&from.normal[3 * pixel], 3, &frame.normal[3 * pixel]);
            frame.value[pixel] = from.value[pixel];
            frame.depth[pixel] = from.depth[pixel];
            frame.element[pixel] = from.element[pixel];
            frame.flags[pixel] = flags_of(pixel);
        }
        count_pixels(frame);
        return frame;
    }

private:
    bool is_as_near(std::size_t pixel, std::uint32_t one, std::uint32_t owner) const {
        return one != owner && is_hit(m_frames[one], pixel) && is_hit(m_frames[owner], pixel) &&
               std::abs(m_frames[one].depth[pixel] - m_frames[owner].depth[pixel]) <= m_tolerance;
    }

    std::uint32_t first_of_equals(std::size_t pixel, std::uint32_t owner) const {
        for (std::uint32_t i = 0; i < owner; ++i) {
            if (is_as_near(pixel, i, owner)) {
                return i;
            }
        }
        return owner;
    }

    /** Whether a condition on another pixel holds for one from where lines reach this one. */
    template <class Condition> bool holds_nearby(std::size_t pixel, const Condition& condition) const {
        const auto width = static_cast<std::ptrdiff_t>(m_frames.front().width),
                   height = static_cast<std::ptrdiff_t>(m_frames.front().height);
        const auto place = static_cast<std::ptrdiff_t>(pixel);
        const std::ptrdiff_t column = place % width, row = place / width;
        for (std::ptrdiff_t y = std::max<std::ptrdiff_t>(0, row - m_reach); y <= std::min(height - 1, row + m_reach); ++y) {
            for (std::ptrdiff_t x = std::max<std::ptrdiff_t>(0, column - m_reach); x <= std::min(width - 1, column + m_reach);
                 ++x) {
                if (condition(static_cast<std::size_t>(y * width + x))) {
                    return true;
                }
            }
        }
        return false;
    }

    std::uint32_t flags_of(std::size_t pixel) const {
        const std::uint32_t owner = m_owners[pixel];
        std::uint32_t flags = m_frames[owner].flags[pixel];
        // Another volume that begins nearby may hide the line within the pixel.
        if ((flags & line_bits) != 0 && holds_nearby(pixel, [&](std::size_t there) {
                return m_owners[there] != owner && is_hit(m_frames[m_owners[there]], there) &&
                       !(m_frames[m_owners[there]].depth[there] > m_frames[owner].depth[pixel]);
            })) {
            flags = opened(flags);
        }
        for (std::uint32_t other = 0; other < m_frames.size(); ++other) {
            if (other == owner) {
                continue;
            }
            const std::uint32_t theirs = m_frames[other].flags[pixel];
            flags |= (theirs & doubt_bits) | (is_as_near(pixel, other, owner) ? pixel_flag::undecided : 0);
            // Lines of a volume that is seen nearby may reach into the pixel.
            const bool is_seen = !is_hit(m_frames[other], pixel) ||
                                 holds_nearby(pixel, [&](std::size_t there) { return m_owners[there] == other; });
            flags |= is_seen ? opened(theirs) & open_lines : 0;
        }
        // What is found is no longer open.
        flags &= (flags & pixel_flag::contour) != 0 ? ~pixel_flag::contour_undecided : ~0u;
        return flags & ((flags & pixel_flag::mesh_line) != 0 ? ~pixel_flag::mesh_line_undecided : ~0u);
    }

    std::span<const Frame> m_frames;
    double m_tolerance;
    int m_reach;
    std::vector<std::uint32_t> m_owners;
};

} // namespace

Frame joined(std::span<const Frame> frames, double tolerance, double line_width) {
    return Joining(frames, tolerance, line_width).result();
}

} // namespace elvis
