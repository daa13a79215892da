#include <core/base/vector3.hpp>
#include <core/render/lines/edge_pass.hpp>

#include <core/volume/element/chebyshev.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace elvis {

namespace {

/** In pixels. */
constexpr double chord_error = 1e-3;
/** Chords of an edge: enough for one that fills the picture many times. */
constexpr double most_chords = 4096;
/** Share of the distance looked at, before which nothing is drawn. */
constexpr double nearest_depth = 1e-6;

/** A point in the camera's directions: right, top, and along the view from the eye. */
struct ViewPoint {
    double x, y, z;
};

/** A point on the picture: column and row, whole numbers in the middles of pixels; and what is linear along chords there. */
struct PicturePoint {
    double column, row;
    /** 1 / z in perspective, else z. */
    double depth;
};

/** The camera's formulas (scene.schema.json). */
class View {
public:
    View(const Camera& camera, std::uint32_t width, std::uint32_t height) : m_camera(camera), m_width(width), m_height(height) {
        m_axis = unit(minus(camera.look_at, camera.eye));
        m_right = unit(cross(m_axis, camera.up));
        m_top = cross(m_right, m_axis);
        m_spread = std::tan(camera.field_of_view * std::numbers::pi / 360);
        const Vector3 corner = direction(0, 0), other = direction(width - 1, height - 1);
        m_slope = std::sqrt(std::max(dot(corner, corner), dot(other, other)));
        // Half of what a point at the least depth has: some are drawn that lie a little beside the picture.
        m_near = std::max(nearest_depth * dot(m_axis, minus(camera.look_at, camera.eye)), 0.5 * camera.near / m_slope);
    }

    ViewPoint see(const Vector3& x) const {
        const Vector3 away = minus(x, m_camera.eye);
        return {dot(away, m_right), dot(away, m_top), dot(away, m_axis)};
    }
    /** Half the picture's height at this distance, in world units. */
    double half_height(double z) const { return m_camera.orthographic ? 0.5 * m_camera.height : m_spread * z; }
    double pixel_size(double z) const { return 2 * half_height(z) / m_height; }
    PicturePoint project(const ViewPoint& p) const {
        const double half = half_height(p.z);
        return {0.5 * (p.x / half * m_height + m_width) - 0.5 - m_camera.image_shift[0],
                0.5 * (1 - p.y / half) * m_height - 0.5 - m_camera.image_shift[1], m_camera.orthographic ? p.z : 1 / p.z};
    }
    double z_of(double depth) const { return m_camera.orthographic ? depth : 1 / depth; }
    /** Nothing of the picture is seen nearer along the view. */
    double near() const { return m_near; }
    /** The most that rays of the picture slant: length of a direction. */
    double slope() const { return m_slope; }

    /** The parts of a chord, as shares of it, that are at least this deep: along rays in perspective. */
    std::vector<std::array<double, 2>> parts_from(double depth, const ViewPoint& a, const ViewPoint& b) const {
        const double across = m_camera.orthographic ? 0 : 1;
        const Vector3 start{across * a.x, across * a.y, a.z}, way{across * (b.x - a.x), across * (b.y - a.y), b.z - a.z};
        // |start + share way| = depth
        const double square = dot(way, way), slant = dot(start, way);
        const double rest = dot(start, start) - std::max(depth, 0.0) * depth;
        const double discriminant = slant * slant - square * rest;
        if (!(discriminant > 0)) {
            return rest >= 0 ? std::vector<std::array<double, 2>>{{0, 1}} : std::vector<std::array<double, 2>>{};
        }
        const double enters = (-slant - std::sqrt(discriminant)) / square, leaves = (-slant + std::sqrt(discriminant)) / square;
        std::vector<std::array<double, 2>> parts;
        for (const auto& [from, to] : {std::array{0.0, std::min(enters, 1.0)}, std::array{std::max(leaves, 0.0), 1.0}}) {
            if (from < to) {
                parts.push_back({from, to});
            }
        }
        return parts;
    }

    /** Of a pixel's ray, with component 1 along the view. */
    Vector3 direction(std::uint32_t column, std::uint32_t row) const {
        if (m_camera.orthographic) {
            return m_axis;
        }
        const double s = (2 * (column + 0.5 + m_camera.image_shift[0]) / m_width - 1) * m_width / m_height * m_spread;
        const double v = (1 - 2 * (row + 0.5 + m_camera.image_shift[1]) / m_height) * m_spread;
        return plus(plus(m_axis, scaled(m_right, s)), scaled(m_top, v));
    }

private:
    Camera m_camera;
    double m_width, m_height;
    Vector3 m_axis{}, m_right{}, m_top{};
    double m_spread = 0, m_slope = 0, m_near = 0;
};

struct Pixel {
    double z = std::numeric_limits<double>::infinity();
    std::uint32_t number = 0;
    std::uint32_t flags = 0;
};

/** Marks pixels along chords. */
class Canvas {
public:
    Canvas(const View& view, std::uint32_t width, const PixelRows& rows, double line_width)
        : m_view(view), m_width(width), m_rows(rows), m_line_width(line_width),
          // The square, or the disc, around a pixel's middle that the chord must meet.
          m_reach(std::max(0.5, 0.5 * line_width)), m_pixels(std::size_t{width} * (rows.end - rows.first)) {}

    /** `error`: how far the edge may be from the chord, in pixels. `is_doubtful`: whether the chord is seen at all. */
    void draw(const PicturePoint& a, const PicturePoint& b, double error, bool is_doubtful, std::uint32_t number) {
        const double room = m_reach + error;
        const auto [top, bottom] = std::minmax(a.row, b.row);
        const std::int64_t first = std::max<std::int64_t>(m_rows.first, floor(top - room));
        const std::int64_t last = std::min<std::int64_t>(std::int64_t{m_rows.end} - 1, ceil(bottom + room));
        for (std::int64_t row = first; row <= last; ++row) {
            // The part of the chord near this row.
            const auto y = static_cast<double>(row);
            double from = 0, to = 1;
            if (a.row != b.row) {
                const double one = (y - room - a.row) / (b.row - a.row), other = (y + room - a.row) / (b.row - a.row);
                from = std::clamp(std::min(one, other), 0.0, 1.0);
                to = std::clamp(std::max(one, other), 0.0, 1.0);
            }
            const double x0 = a.column + from * (b.column - a.column), x1 = a.column + to * (b.column - a.column);
            const std::int64_t left = std::max<std::int64_t>(0, floor(std::min(x0, x1) - room));
            const std::int64_t right = std::min<std::int64_t>(m_width - 1, ceil(std::max(x0, x1) + room));
            for (std::int64_t column = left; column <= right; ++column) {
                visit(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), a, b, error, is_doubtful, number);
            }
        }
    }

    const std::vector<Pixel>& pixels() const { return m_pixels; }
    const PixelRows& rows() const { return m_rows; }

private:
    // Of numbers that may be far off the picture.
    static std::int64_t floor(double x) { return static_cast<std::int64_t>(std::floor(std::clamp(x, -1e9, 1e9))); }
    static std::int64_t ceil(double x) { return static_cast<std::int64_t>(std::ceil(std::clamp(x, -1e9, 1e9))); }

    void visit(std::uint32_t column, std::uint32_t row, const PicturePoint& a, const PicturePoint& b, double error,
               bool is_doubtful, std::uint32_t number) {
        const double ax = a.column - column, ay = a.row - row, bx = b.column - column, by = b.row - row;
        const double dx = bx - ax, dy = by - ay;
        const double length = std::hypot(dx, dy);
        // How far the chord and the pixel's square are apart along the axes that can separate them; negative: they overlap.
        double apart =
            std::max({std::min(ax, bx) - 0.5, -0.5 - std::max(ax, bx), std::min(ay, by) - 0.5, -0.5 - std::max(ay, by)});
        if (length > 0) {
            apart = std::max(apart, (std::abs(ax * dy - ay * dx) - 0.5 * (std::abs(dx) + std::abs(dy))) / length);
        }
        const double at = length > 0 ? std::clamp(-(ax * dx + ay * dy) / (length * length), 0.0, 1.0) : 0.0;
        const double distance = std::hypot(ax + at * dx, ay + at * dy);
        const bool is_met = apart <= error;
        const bool is_drawn = m_line_width <= 1 ? is_met : distance <= 0.5 * m_line_width || is_met;
        if (!is_drawn) {
            return;
        }
        Pixel& pixel = m_pixels[std::size_t{row - m_rows.first} * m_width + column];
        const bool is_certain = apart < -error && !is_doubtful;
        pixel.flags |= is_certain ? pixel_flag::mesh_line : is_met ? pixel_flag::mesh_line_undecided : 0u;
        const double z = m_view.z_of(a.depth + at * (b.depth - a.depth));
        if (z < pixel.z || (z == pixel.z && number < pixel.number)) {
            pixel.z = z;
            pixel.number = number;
        }
    }

    const View& m_view;
    std::uint32_t m_width;
    PixelRows m_rows;
    double m_line_width, m_reach;
    std::vector<Pixel> m_pixels;
};

/** Bounds of one edge: of its distance along the view, and of how far its tangents turn over its whole length. */
struct Extent {
    double nearest, farthest, bend;
};

Extent extent_of(const View& view, std::span<const double> coefficients) {
    const ViewPoint middle = view.see({coefficients[0], coefficients[1], coefficients[2]});
    double reach = 0, bend = 0;
    for (std::size_t m = 1; 3 * m < coefficients.size(); ++m) {
        const double size = std::hypot(coefficients[3 * m], coefficients[3 * m + 1], coefficients[3 * m + 2]);
        const auto square = static_cast<double>(m * m);
        reach += size;
        // |T_m''| <= m^2 (m^2 - 1) / 3
        bend += size * square * (square - 1) / 3;
    }
    return {middle.z - reach, middle.z + reach, bend};
}

/** `error`: how far the edge may be from the chord in pixels; `world_error`: in world units. */
struct Chord {
    ViewPoint a, b;
    double error, world_error;
    std::uint32_t number;
};

/** What is deep enough to be seen. */
void draw_chord(const View& view, const Chord& chord, double least_depth, Canvas& canvas) {
    const auto& [a, b, error, world_error, number] = chord;
    const auto project = [&](double share) {
        return view.project({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)});
    };
    const std::vector<std::array<double, 2>> certain = view.parts_from(least_depth + world_error, a, b);
    for (const auto& [from, to] : certain) {
        canvas.draw(project(from), project(to), error, false, number);
    }
    if (certain != std::vector<std::array<double, 2>>{{0, 1}}) {
        for (const auto& [from, to] : view.parts_from(least_depth - world_error, a, b)) {
            canvas.draw(project(from), project(to), error, true, number);
        }
    }
}

void draw_edge(const View& view, const EdgeSet& edges, const EdgeSet::Edge& edge, double least_depth, Canvas& canvas) {
    const std::span<const double> coefficients = edges.coefficients(edge);
    const Extent extent = extent_of(view, coefficients);
    if (extent.farthest <= view.near()) {
        return;
    }
    const double nearest = std::max(extent.nearest, view.near());
    // What a distance in the world is on the picture, at most: across the view, and along it where rays slant.
    const double pixels_a_length = view.slope() / view.pixel_size(nearest);
    // A chord over 2/n of the parameter is off by at most bend (2/n)^2 / 8.
    const double n_wanted = std::sqrt(0.5 * extent.bend * pixels_a_length / chord_error);
    const double n = std::clamp(std::ceil(n_wanted), 1.0, most_chords);
    const double error = 0.5 * extent.bend * pixels_a_length / (n * n) + edges.rounding() * pixels_a_length;
    ViewPoint before{};
    for (double k = 0; k <= n; ++k) {
        const std::vector<double> t = chebyshev_values(static_cast<int>(edge.order), 2 * k / n - 1);
        Vector3 x{};
        for (std::size_t m = 0; m < t.size(); ++m) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                x[axis] += t[m] * coefficients[3 * m + axis];
            }
        }
        const ViewPoint now = view.see(x);
        if (k > 0 && std::max(before.z, now.z) > view.near()) {
            ViewPoint a = before, b = now;
            for (ViewPoint* behind : {&a, &b}) {
                if (behind->z < view.near()) {
                    const double share = (view.near() - before.z) / (now.z - before.z);
                    *behind = {before.x + share * (now.x - before.x), before.y + share * (now.y - before.y), view.near()};
                }
            }
            draw_chord(view, {a, b, error, error / pixels_a_length, edge.number}, least_depth, canvas);
        }
        before = now;
    }
}

template <class Real>
void write(const View& view, const Canvas& canvas, double width, double value, std::uint32_t surface, const Layer& layer,
           Precision precision) {
    std::vector<Sample<Real>> samples(layer.n_pixels());
    std::vector<Mark> marks(layer.n_pixels());
    std::vector<double> normals(3 * layer.n_pixels());
    for (std::size_t i = 0; i < canvas.pixels().size(); ++i) {
        const Pixel& pixel = canvas.pixels()[i];
        if (!std::isfinite(pixel.z)) {
            continue;
        }
        const Vector3 d = view.direction(static_cast<std::uint32_t>(i % layer.width),
                                         canvas.rows().first + static_cast<std::uint32_t>(i / layer.width));
        const double distance = length(d);
        const double tolerance = EdgePass::depth_tolerance * std::max(1.0, width) * view.pixel_size(pixel.z);
        samples[i] = {static_cast<Real>(value), static_cast<Real>(distance * std::max(pixel.z - tolerance, 0.5 * pixel.z)),
                      pixel.number};
        // What one chord leaves open another one may tell.
        const bool is_met = (pixel.flags & pixel_flag::mesh_line) != 0;
        marks[i] = {surface << owner_bits, is_met ? pixel_flag::mesh_line : pixel.flags};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            normals[3 * i + axis] = -d[axis] / distance;
        }
    }
    layer.samples.write_items(std::span<const Sample<Real>>(samples));
    layer.marks.write_items(std::span<const Mark>(marks));
    write_reals(layer.normals, precision, normals);
}

} // namespace

void EdgePass::draw(const EdgeSet& edges, const Camera& camera, const PicturePart& part, double width, double value,
                    std::uint32_t surface, const LayerTarget& target) const {
    const Layer& layer = target.layer;
    const View view(camera, layer.width, part.of_height);
    Canvas canvas(view, layer.width, {part.first_row, part.first_row + layer.height}, width);
    for (const EdgeSet::Edge& edge : edges.edges()) {
        draw_edge(view, edges, edge, camera.near, canvas);
    }
    with_real(m_precision, [&]<class Real>(Real) { write<Real>(view, canvas, width, value, surface, layer, m_precision); });
}

} // namespace elvis
