#include <core/integrate/reference_rule.hpp>

#include <core/convert/projection/projector.hpp>

#include <elvis/native/space.hpp>

#include <cassert>

namespace elvis {

namespace {

/** A face as corner + (1 + u)/2 first + (1 + v)/2 last, with (u, v) in a reference square or triangle; an edge without the
 * last. */
struct FaceFrame {
    Vector3 corner{}, first{}, last{};
    native::Shape shape = native::Shape::quadrilateral;

    Vector3 at(double u, double v) const {
        return plus(corner, plus(scaled(first, 0.5 * (1 + u)), scaled(last, 0.5 * (1 + v))));
    }
};

FaceFrame face_frame(native::Shape shape, int local_face) {
    const std::span<const int> corners = native::face_corners(shape, local_face);
    FaceFrame frame;
    frame.corner = native::corner(shape, corners[0]);
    frame.first = minus(native::corner(shape, corners[1]), frame.corner);
    if (corners.size() > 2) {
        frame.last = minus(native::corner(shape, corners.back()), frame.corner);
    }
    frame.shape = corners.size() == 3 ? native::Shape::triangle : native::Shape::quadrilateral;
    return frame;
}

/** Of all of the face, out of the shape. */
Vector3 outward_area(native::Shape shape, const FaceFrame& frame) {
    Vector3 inside{};
    for (int corner = 0; corner < native::n_corners(shape); ++corner) {
        inside = plus(inside, scaled(native::corner(shape, corner), 1.0 / native::n_corners(shape)));
    }
    const Vector3 area = cross(frame.first, frame.last);
    return dot(area, minus(frame.corner, inside)) < 0 ? scaled(area, -1) : area;
}

void append(std::vector<double>& list, const Vector3& v) { list.insert(list.end(), v.begin(), v.end()); }

void append_element_points(native::Shape shape, const CollapsedBox& box, const GaussLine& line, ReferencePoints& points) {
    const bool is_flat = native::dimension(shape) == 2;
    const double h = box.half_side;
    const double scale = is_flat ? h * h : h * h * h;
    const std::size_t n = line.points.size();
    for (std::size_t k = 0; k < (is_flat ? 1 : n); ++k) {
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t i = 0; i < n; ++i) {
                const native::Point eta{box.middle[0] + h * line.points[i], box.middle[1] + h * line.points[j],
                                        is_flat ? 0 : box.middle[2] + h * line.points[k]};
                append(points.xi, native::expand(shape, eta));
                points.weights.push_back(scale * line.weights[i] * line.weights[j] * (is_flat ? 1 : line.weights[k]) *
                                         collapse_factor(shape, eta));
            }
        }
    }
}

void append_face_points(native::Shape shape, int local_face, const CollapsedBox& box, const GaussLine& line,
                        ReferencePoints& points) {
    const FaceFrame frame = face_frame(shape, local_face);
    // (u, v) have four times the area of the parallelogram's own coordinates.
    const Vector3 area = scaled(outward_area(shape, frame), 0.25 * box.half_side * box.half_side);
    for (std::size_t j = 0; j < line.points.size(); ++j) {
        for (std::size_t i = 0; i < line.points.size(); ++i) {
            const native::Point eta{box.middle[0] + box.half_side * line.points[i],
                                    box.middle[1] + box.half_side * line.points[j], 0};
            const native::Point place = native::expand(frame.shape, eta);
            append(points.xi, frame.at(place[0], place[1]));
            append(points.vectors, scaled(area, line.weights[i] * line.weights[j] * collapse_factor(frame.shape, eta)));
        }
    }
}

void append_edge_points(native::Shape shape, int local_face, const CollapsedBox& box, const GaussLine& line,
                        ReferencePoints& points) {
    const FaceFrame edge = face_frame(shape, local_face);
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        append(points.xi, edge.at(box.middle[0] + box.half_side * line.points[i], -1));
        append(points.vectors, scaled(edge.first, 0.5 * box.half_side * line.weights[i]));
    }
}

} // namespace

const GaussLine& gauss_line(unsigned n) {
    // Of every number of points, made once.
    static const std::vector<GaussLine> lines = [] {
        std::vector<GaussLine> all(most_gauss_points + 1);
        for (std::size_t count = 1; count < all.size(); ++count) {
            all[count].points.resize(count);
            all[count].weights.resize(count);
            native::gauss_legendre(all[count].points, all[count].weights);
        }
        return all;
    }();
    assert(n >= 1 && n <= most_gauss_points);
    return lines[n];
}

void ReferencePoints::clear() {
    xi.clear();
    weights.clear();
    vectors.clear();
    has_edges = false;
}

unsigned ElementPart::dimension() const {
    const int of_element = native::dimension(native::Shape{shape});
    return static_cast<unsigned>(local_face < 0 ? of_element : of_element - 1);
}

void append_gauss_points(const ElementPart& part, const CollapsedBox& box, unsigned n, ReferencePoints& points) {
    const native::Shape shape{part.shape};
    if (part.local_face < 0) {
        append_element_points(shape, box, gauss_line(n), points);
    } else if (part.dimension() == 2) {
        append_face_points(shape, part.local_face, box, gauss_line(n), points);
    } else {
        append_edge_points(shape, part.local_face, box, gauss_line(n), points);
        points.has_edges = true;
    }
}

} // namespace elvis
