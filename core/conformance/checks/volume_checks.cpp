/**
 * @file volume_checks.cpp
 * Checks of what a runtime plugin says about a volume, without a device: consistent counts, pieces, threads, faces.
 */
#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/conformance/check.hpp>
#include <core/conformance/description.hpp>
#include <core/conformance/pieces.hpp>
#include <core/conformance/reference_points.hpp>
#include <elvis/native/space.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace elvis::conformance {

namespace {

void check_counts(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    std::set<std::string> kinds;
    for (std::uint32_t c = 0; c < volume.classes().size(); ++c) {
        const ClassInfo& info = volume.classes()[c];
        kinds.insert(shape_name(info.shape));
        volume.snippet(c);
        for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
            std::set<std::string> names;
            for (const auto& [name, value] : volume.class_field(c, field).constants) {
                if (!names.insert(name).second) {
                    context.fail("get_class_field gives the constant " + name + " twice for class " + std::to_string(c));
                }
            }
        }
    }
    for (std::size_t step = 1; step < volume.times().size(); ++step) {
        if (!(volume.times()[step] >= volume.times()[step - 1])) {
            context.fail("get_time: step " + std::to_string(step) + " is not later than the one before");
            break;
        }
    }
    if (volume.fields().empty()) {
        context.fail("get_info counts no field; there is nothing to draw");
    }
    const std::uint64_t n = std::min<std::uint64_t>(volume.n_elements(), 1u << 20);
    std::vector<std::int64_t> numbers(n);
    volume.element_numbers(0, n, numbers);
    if (std::set<std::int64_t>(numbers.begin(), numbers.end()).size() != numbers.size()) {
        context.fail("get_element_numbers gives the same number to two elements");
    }
    std::string shapes;
    for (const std::string& kind : kinds) {
        shapes += (shapes.empty() ? "" : ", ") + kind;
    }
    context.note(counted(volume.n_elements(), "element") + " (" + shapes + "), " + counted(volume.fields().size(), "field") +
                 ", " + counted(volume.times().size(), "time step"));
}

void check_buffers(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
        std::map<std::string, std::set<std::uint32_t>> users;
        for (std::uint32_t buffer = 0; buffer < volume.n_buffers(); ++buffer) {
            const BufferInfo info = volume.buffer(buffer, field);
            auto& classes = users[info.name];
            const bool clashes =
                !classes.empty() && (info.element_class == ELVIS_ALL_CLASSES || classes.count(ELVIS_ALL_CLASSES) != 0 ||
                                     classes.count(info.element_class) != 0);
            if (clashes) {
                context.fail("get_buffer: two buffers named '" + info.name + "' in one class");
            }
            classes.insert(info.element_class);
            const BufferInfo first = volume.buffer(buffer, 0);
            if ((info.depends & ELVIS_DEPENDS_ON_FIELD) == 0 &&
                (info.n_records != first.n_records || info.record_size != first.record_size || info.kind != first.kind)) {
                context.fail("get_buffer: '" + info.name + "' does not depend on the field, but looks different for field " +
                             std::to_string(field));
            }
            // Some numbers from the first and the last step, twice: what is asked again must be the same.
            const std::uint64_t limit = std::max<std::uint64_t>(1, (1u << 18) / info.record_size);
            const std::uint64_t count = std::min(info.n_records, limit);
            const auto last = static_cast<std::uint32_t>(volume.times().size() - 1);
            context.progress("fill_buffer of " + info.name);
            const std::vector<double> begin = read_buffer(volume, buffer, field, 0, 0, count);
            const std::vector<double> end = read_buffer(volume, buffer, field, last, 0, count);
            const std::vector<double> again = read_buffer(volume, buffer, field, 0, 0, count);
            const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
            if (!std::equal(begin.begin(), begin.end(), again.begin(), same)) {
                context.fail("fill_buffer of '" + info.name + "' gives other numbers when asked again");
            }
            if ((info.depends & ELVIS_DEPENDS_ON_TIME) == 0 && !std::equal(begin.begin(), begin.end(), end.begin(), same)) {
                context.fail("fill_buffer of '" + info.name +
                             "' gives other numbers at another time step, but get_buffer does "
                             "not say that it depends on time");
            }
            if ((info.depends & ELVIS_DEPENDS_ON_FIELD) == 0 && field > 0) {
                const std::vector<double> other = read_buffer(volume, buffer, 0, 0, 0, count);
                if (!std::equal(begin.begin(), begin.end(), other.begin(), same)) {
                    context.fail("fill_buffer of '" + info.name +
                                 "' gives other numbers for another field, but get_buffer does not say that it depends on it");
                }
            }
        }
    }
}

void check_volume_pieces(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    check_pieces(context, queries(volume, 512));
}

void check_volume_threads(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    check_threads(context, queries(volume, 512));
}

/** Positions of the corners of a local face, through evaluate_mapping. */
std::vector<Point> corner_positions(const RuntimeVolume& volume, std::uint64_t element, std::int32_t local_face) {
    const native::Shape shape{volume.classes()[class_of(volume, element)].shape};
    std::vector<Point> positions;
    for (const int corner : native::face_corners(shape, local_face)) {
        Point x{};
        volume.evaluate_mapping(element, native::corner(shape, corner), x, {});
        positions.push_back(x);
    }
    return positions;
}

/** Largest distance from a corner of one face to the nearest of the other. */
double corner_distance(const std::vector<Point>& a, const std::vector<Point>& b) {
    double largest = 0;
    for (const Point& x : a) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Point& y : b) {
            nearest = std::min(nearest, length(minus(x, y)));
        }
        largest = std::max(largest, nearest);
    }
    return largest;
}

struct BoundaryFace {
    std::int64_t element;
    std::vector<Point> corners;
    /** Of the corners' middle along a direction that is none of the mesh's. */
    double place;
    double size;
};

std::vector<BoundaryFace> boundary_faces(const RuntimeVolume& volume, const std::vector<elvis_face>& faces) {
    constexpr std::size_t most = 1u << 18;
    std::vector<BoundaryFace> found;
    for (const elvis_face& face : faces) {
        if (face.neighbour != ELVIS_NEIGHBOUR_NONE || found.size() >= most) {
            continue;
        }
        BoundaryFace entry{face.element, {}, 0, 0};
        entry.corners =
            corner_positions(volume, static_cast<std::uint64_t>(face.element), static_cast<std::uint32_t>(face.local_face));
        for (const Point& x : entry.corners) {
            const Point& first = entry.corners[0];
            entry.place += (0.5 * x[0] + 0.7071 * x[1] + 0.5001 * x[2]) / static_cast<double>(entry.corners.size());
            entry.size = std::max(entry.size, length(minus(x, first)));
        }
        found.push_back(std::move(entry));
    }
    return found;
}

/** Two faces without neighbour in one place may be a crack; more often, a reader has not matched them. */
void note_coinciding_boundary(Context& context, const RuntimeVolume& volume, const std::vector<elvis_face>& faces) {
    std::vector<BoundaryFace> boundary = boundary_faces(volume, faces);
    std::ranges::sort(boundary, {}, &BoundaryFace::place);
    std::size_t n_pairs = 0;
    std::string example;
    for (std::size_t i = 0; i < boundary.size(); ++i) {
        const BoundaryFace& one = boundary[i];
        const double tolerance = 1e-4 * one.size;
        for (std::size_t j = i + 1; j < boundary.size() && boundary[j].place - one.place <= 2 * tolerance; ++j) {
            const BoundaryFace& other = boundary[j];
            if (one.corners.size() == other.corners.size() && corner_distance(one.corners, other.corners) <= tolerance &&
                corner_distance(other.corners, one.corners) <= tolerance) {
                ++n_pairs;
                if (example.empty()) {
                    example = "elements " + std::to_string(std::min(one.element, other.element)) + " and " +
                              std::to_string(std::max(one.element, other.element));
                }
            }
        }
    }
    if (n_pairs > 0) {
        context.note("warning: " + std::to_string(n_pairs) + (n_pairs == 1 ? " pair" : " pairs") +
                     " of faces in one place without neighbour (ELVIS_NEIGHBOUR_NONE), for example of " + example +
                     ": they are drawn as boundary; if this is no crack, the faces were not matched");
    }
}

/** Of a face that two elements share. */
bool check_corners(Context& context, const RuntimeVolume& volume, const elvis_face& face) {
    const auto here = corner_positions(volume, static_cast<std::uint64_t>(face.element), face.local_face);
    const auto there = corner_positions(volume, static_cast<std::uint64_t>(face.neighbour), face.neighbour_local_face);
    double size = 0;
    for (const Point& x : here) {
        size = std::max(size, length(minus(x, here[0])));
    }
    // Sources round corners to as few as five digits.
    const double distance = std::max(corner_distance(here, there), corner_distance(there, here));
    const bool is_same = here.size() == there.size() && distance <= 1e-4 * size;
    if (!is_same) {
        context.fail("get_faces: elements " + std::to_string(face.element) + " and " + std::to_string(face.neighbour) +
                     " are said to share a face, but its corners are " + std::to_string(distance) + " apart");
    }
    return is_same;
}

void check_faces(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    if (volume.n_faces() == 0) {
        throw Skipped("the plugin does not tell faces");
    }
    const std::uint64_t n = std::min<std::uint64_t>(volume.n_faces(), 1u << 20);
    std::vector<elvis_face> faces(n);
    volume.faces(0, n, faces);
    std::set<std::pair<std::int64_t, std::int32_t>> seen;
    const auto add = [&](std::int64_t element, std::int32_t local_face) {
        const elvis_shape shape = volume.classes()[class_of(volume, static_cast<std::uint64_t>(element))].shape;
        const std::string which = "local face " + std::to_string(local_face) + " of element " + std::to_string(element);
        if (local_face < 0 || local_face >= native::n_faces(native::Shape{shape})) {
            context.fail("get_faces: " + which + ", which is a " + shape_name(shape));
            return false;
        }
        if (!seen.insert({element, local_face}).second) {
            context.fail("get_faces: " + which + " comes twice; a face is listed once, with its neighbour");
            return false;
        }
        return true;
    };
    int n_complaints = 0;
    for (const elvis_face& face : faces) {
        bool is_sound = add(face.element, face.local_face);
        if (face.neighbour >= 0) {
            is_sound = is_sound && add(face.neighbour, face.neighbour_local_face);
            is_sound = is_sound && (!volume.has_evaluation() || check_corners(context, volume, face));
        }
        if (!is_sound && ++n_complaints >= 5) {
            context.fail("get_faces: and perhaps more; the rest was not looked at");
            return;
        }
    }
    if (n == volume.n_faces()) {
        std::uint64_t n_local_faces = 0;
        for (const ClassInfo& info : volume.classes()) {
            n_local_faces += info.n_elements * static_cast<std::uint64_t>(native::n_faces(native::Shape{info.shape}));
        }
        if (seen.size() < n_local_faces) {
            context.fail("get_faces: of " + std::to_string(n_local_faces) + " local faces only " + std::to_string(seen.size()) +
                         " are mentioned");
        }
    }
    context.note(counted(volume.n_faces(), "face"));
    if (volume.has_evaluation() && n_complaints == 0) {
        note_coinciding_boundary(context, volume, faces);
    }
}

} // namespace

std::vector<Check> volume_checks() {
    return {
        {"volume-description", "counts, classes, fields, times and element numbers agree with each other", check_counts},
        {"volume-buffers", "buffers have names of their own, depend on what they say, and are filled within their records",
         check_buffers},
        {"volume-pieces", "any range of elements or records gives the same numbers as the whole", check_volume_pieces},
        {"volume-threads", "the functions that may run at the same time give the same numbers from several threads",
         check_volume_threads},
        {"volume-faces", "every local face comes once, and neighbours' faces lie in the same place", check_faces},
    };
}

} // namespace elvis::conformance
