#include <core/volume/outline.hpp>

#include <core/base/bounds.hpp>
#include <core/base/in_parts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace elvis {

namespace {

/** Directions are this far apart: about 0.28, of which a half turns a sphere's outline inwards by a percent. */
constexpr std::size_t n_spread = 162;
/** Bounds that reach less far beyond what is known, as a share of the diagonal, are not worth a look at their element. */
constexpr double worth_a_look = 0.01;
/** Fewer elements than this may be large and strongly bent. */
constexpr std::uint64_t few_elements = 128;

using Box = BoxPieces::Box;

/** Along the axes, and spread evenly over the sphere (Fibonacci's lattice). */
std::vector<Vector3> all_around() {
    std::vector<Vector3> directions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (std::size_t i = 0; i < n_spread; ++i) {
        const double z = 1 - (2 * static_cast<double>(i) + 1) / n_spread;
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / std::numbers::phi;
        const double radius = std::sqrt(1 - z * z);
        directions.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
    return directions;
}

Vector3 farthest_corner(const Box& box, const Vector3& direction) {
    return {box[direction[0] > 0 ? 3 : 0], box[direction[1] > 0 ? 4 : 1], box[direction[2] > 0 ? 5 : 2]};
}

/** Points on the faces of a shape: a grid of `n` on each edge of the cube, collapsed as in Karniadakis & Sherwin. */
std::vector<double> points_on_faces(elvis_shape shape, int n) {
    const bool is_flat = shape == ELVIS_SHAPE_QUADRILATERAL || shape == ELVIS_SHAPE_TRIANGLE;
    const auto place = [n](int i) { return 2.0 * i / (n - 1) - 1; };
    const auto is_end = [n](int i) { return i == 0 || i == n - 1; };
    std::vector<double> xi;
    for (int node = 0; node < (is_flat ? n * n : n * n * n); ++node) {
        const int i = node % n, j = node / n % n, k = node / (n * n);
        if (!is_flat && !is_end(i) && !is_end(j) && !is_end(k)) {
            continue;
        }
        double x = place(i), y = place(j);
        const double z = is_flat ? 0 : place(k);
        if (shape == ELVIS_SHAPE_PYRAMID || shape == ELVIS_SHAPE_TETRAHEDRON) {
            y = 0.5 * (1 + y) * (1 - z) - 1;
        }
        if (shape == ELVIS_SHAPE_PRISM || shape == ELVIS_SHAPE_PYRAMID) {
            x = 0.5 * (1 + x) * (1 - z) - 1;
        } else if (shape == ELVIS_SHAPE_TETRAHEDRON) {
            x = 0.5 * (1 + x) * (-y - z) - 1;
        } else if (shape == ELVIS_SHAPE_TRIANGLE) {
            x = 0.5 * (1 + x) * (1 - y) - 1;
        }
        xi.insert(xi.end(), {x, y, z});
    }
    return xi;
}

/** The farthest points that are known so far. */
class Outline {
public:
    Outline(const RuntimeVolume& volume, const MappingReader& mapping)
        : m_volume(volume), m_mapping(mapping), m_directions(all_around()), m_points(m_directions.size()),
          m_reach(m_directions.size(), -std::numeric_limits<double>::infinity()) {
        for (const ClassInfo& info : volume.classes()) {
            m_xi.push_back(points_on_faces(info.shape, info.is_affine ? 2 : volume.n_elements() < few_elements ? 5 : 3));
        }
    }

    /** Without such directions in which nothing was found. */
    std::vector<Vector3> points() const {
        std::vector<Vector3> found;
        for (std::size_t i = 0; i < m_points.size(); ++i) {
            if (std::isfinite(m_reach[i])) {
                found.push_back(m_points[i]);
            }
        }
        return found;
    }

    void take(const Vector3& point) {
        for (std::size_t i = 0; i < m_directions.size(); ++i) {
            const double reach = dot(m_directions[i], point);
            if (std::isfinite(reach) && reach > m_reach[i]) {
                m_reach[i] = reach;
                m_points[i] = point;
            }
        }
    }

    /** Samples of an element's mapping; those that are no numbers are left out. */
    void take_element(std::size_t element_class, std::uint64_t element) {
        const std::vector<double>& xi = m_xi[element_class];
        m_positions.resize(xi.size());
        if (m_mapping) {
            m_mapping(element, xi, m_positions);
        } else {
            m_volume.evaluate_mapping(element, xi, m_positions, {});
        }
        for (std::size_t at = 0; at < m_positions.size(); at += 3) {
            take({m_positions[at], m_positions[at + 1], m_positions[at + 2]});
        }
    }

    /** Of each direction the element whose bounds reach farthest, and that box. */
    std::map<std::uint64_t, Box> first_candidates(const BoxPieces& pieces) const {
        std::vector<std::pair<std::uint64_t, Box>> best(m_directions.size());
        std::vector<double> reach = m_reach;
        const auto may_reach = [&](const Box& around, std::size_t i) {
            return dot(m_directions[i], farthest_corner(around, m_directions[i])) > reach[i];
        };
        const auto matters = [&](const Box& around) {
            for (std::size_t i = 0; i < m_directions.size(); ++i) {
                if (may_reach(around, i)) {
                    return true;
                }
            }
            return false;
        };
        pieces.for_each(matters, [&](std::uint64_t first, std::span<const double> boxes) {
            for_each_group(boxes, [&](std::uint64_t at, std::uint64_t end, const Box& around) {
                for (std::size_t i = 0; i < m_directions.size(); ++i) {
                    for (std::uint64_t element = at; may_reach(around, i) && element < end; ++element) {
                        const Box box = box_of(boxes, element);
                        const double here = dot(m_directions[i], farthest_corner(box, m_directions[i]));
                        if (here > reach[i]) {
                            best[i] = {first + element, box};
                            reach[i] = here;
                        }
                    }
                }
            });
        });
        return {best.begin(), best.end()};
    }

    /** Calls look(first, end, box around them) for elements that follow each other: they lie together, and most of them inside.
     */
    template <class Look> static void for_each_group(std::span<const double> boxes, Look look) {
        constexpr std::uint64_t together = 64;
        const std::uint64_t n = boxes.size() / 6;
        for (std::uint64_t at = 0; at < n; at += together) {
            const std::uint64_t end = std::min(at + together, n);
            look(at, end, box_of_all(boxes, at, end));
        }
    }

    /** Of elements `first` to `end - 1`. */
    static Box box_of_all(std::span<const double> boxes, std::uint64_t first, std::uint64_t end) {
        Box all = box_of(boxes, first);
        for (std::uint64_t at = 6 * first; at < 6 * end; ++at) {
            const std::size_t axis = at % 6;
            all[axis] = axis < 3 ? std::min(all[axis], boxes[at]) : std::max(all[axis], boxes[at]);
        }
        return all;
    }

    bool may_reach_beyond(const Box& box, double tolerance) const {
        for (std::size_t i = 0; i < m_directions.size(); ++i) {
            if (dot(m_directions[i], farthest_corner(box, m_directions[i])) > m_reach[i] + tolerance) {
                return true;
            }
        }
        return false;
    }

    static Box box_of(std::span<const double> boxes, std::uint64_t element) {
        Box box{};
        std::copy_n(boxes.begin() + static_cast<std::ptrdiff_t>(6 * element), box.size(), box.begin());
        return box;
    }

private:
    const RuntimeVolume& m_volume;
    const MappingReader& m_mapping;
    std::vector<Vector3> m_directions;
    std::vector<Vector3> m_points;
    std::vector<double> m_reach;
    /** Reference points of each class. */
    std::vector<std::vector<double>> m_xi;
    std::vector<double> m_positions;
};

std::vector<double> all_bounds(const RuntimeVolume& volume, Background& background) {
    constexpr std::uint64_t block = 16384;
    std::vector<double> boxes(6 * volume.n_elements());
    in_parts(background, volume.n_elements(), block, [&](std::uint64_t first, std::uint64_t count) {
        volume.bounds(first, count, std::span<double>(boxes).subspan(6 * first, 6 * count));
    });
    return boxes;
}

/** All bounds as one piece. */
class OnePiece : public BoxPieces {
public:
    explicit OnePiece(std::span<const double> boxes)
        : m_boxes(boxes), m_bounds(Outline::box_of_all(boxes, 0, boxes.size() / 6)) {}

    const Box& bounds() const override { return m_bounds; }
    void for_each(const std::function<bool(const Box& around)>&,
                  const std::function<void(std::uint64_t first, std::span<const double> boxes)>& look) const override {
        look(0, m_boxes);
    }

private:
    std::span<const double> m_boxes;
    Box m_bounds;
};

std::size_t class_of(const RuntimeVolume& volume, std::uint64_t element) {
    const std::vector<ClassInfo>& classes = volume.classes();
    const auto after = std::upper_bound(classes.begin(), classes.end(), element,
                                        [](std::uint64_t e, const ClassInfo& info) { return e < info.first_element; });
    return static_cast<std::size_t>(std::prev(after) - classes.begin());
}

} // namespace

std::vector<Vector3> outline_points(const RuntimeVolume& volume, Background& background) {
    return outline_points(volume, all_bounds(volume, background));
}

std::vector<Vector3> outline_points(const RuntimeVolume& volume, const std::vector<double>& boxes,
                                    const MappingReader& mapping) {
    return outline_points(volume, OnePiece(boxes), mapping);
}

std::vector<Vector3> outline_points(const RuntimeVolume& volume, const BoxPieces& pieces, const MappingReader& mapping) {
    Outline outline(volume, mapping);
    const std::map<std::uint64_t, Box> first = outline.first_candidates(pieces);
    if (!volume.has_evaluation()) {
        for (const auto& [element, box] : first) {
            for (unsigned corner = 0; corner < 8; ++corner) {
                outline.take({box[(corner & 1) ? 3 : 0], box[(corner & 2) ? 4 : 1], box[(corner & 4) ? 5 : 2]});
            }
        }
        return outline.points();
    }
    for (const auto& [element, box] : first) {
        outline.take_element(class_of(volume, element), element);
    }
    const double tolerance = worth_a_look * diagonal_of(pieces.bounds());
    const auto matters = [&](const Box& around) { return outline.may_reach_beyond(around, tolerance); };
    pieces.for_each(matters, [&](std::uint64_t piece, std::span<const double> boxes) {
        Outline::for_each_group(boxes, [&](std::uint64_t at, std::uint64_t end, const Box& around) {
            // Where elements that follow each other do not reach beyond together, none of them does.
            for (std::uint64_t index = at; matters(around) && index < end; ++index) {
                const std::uint64_t element = piece + index;
                if (matters(Outline::box_of(boxes, index)) && !first.contains(element)) {
                    outline.take_element(class_of(volume, element), element);
                }
            }
        });
    });
    return outline.points();
}

} // namespace elvis
