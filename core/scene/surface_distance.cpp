#include <core/scene/surface_distance.hpp>

#include <core/base/error.hpp>
#include <core/base/vector3.hpp>
#include <core/scene/read/json_reader.hpp>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string_view>

namespace elvis {

namespace {

std::string join(std::initializer_list<std::string_view> parts) {
    std::string text;
    for (const std::string_view part : parts) {
        text += part;
    }
    return text;
}

/** With all digits, in parentheses. */
std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "(%.17g)", value);
    return text;
}

/** dot(direction, x - point) */
std::string along(const Vector3& direction, const Vector3& point) {
    return join({"(", number(direction[0]), "*(@x-", number(point[0]), ")+", number(direction[1]), "*(@y-", number(point[1]),
                 ")+", number(direction[2]), "*(@z-", number(point[2]), "))"});
}

/** |x - point|^2 */
std::string square(const Vector3& point) {
    return join({"((@x-", number(point[0]), ")^2+(@y-", number(point[1]), ")^2+(@z-", number(point[2]), ")^2)"});
}

/** Of x from an axis, from the height along it. Next to the axis the root would have no derivative. */
std::string from_axis(const Vector3& point, const std::string& height) {
    return join({"sqrt(max(1e-30,", square(point), "-", height, "^2))"});
}

/**
 * To a cone or cylinder. In the half plane of radius and height its side is a segment: `beside` counts across it, outwards, and
 * `past` beyond its nearer end. With caps it is a convex body: inside, the nearest of its faces is the nearest plane or cone;
 * outside, the nearest of three segments, which is at most 1e6 times as far as the farthest of those planes and cone unless an
 * apex is sharper than that. Roots of zero, which have no derivative, are kept away from.
 */
std::string distance_to(const Cone& cone) {
    const Vector3 axis = minus(cone.to, cone.from);
    const double length = std::hypot(axis[0], axis[1], axis[2]), growth = cone.to_radius - cone.from_radius;
    const double side = std::hypot(length, growth);
    const std::string height = along(unit(axis), cone.from);
    const std::string radius = from_axis(cone.from, height);
    const std::string outward = join({"(", radius, "-", number(cone.from_radius), ")"});
    const std::string beside = join({"(", number(length / side), "*", outward, "-", number(growth / side), "*", height, ")"});
    const std::string up = join({"(", number(growth / side), "*", outward, "+", number(length / side), "*", height, ")"});
    const std::string past = join({"max(0,max(-", up, ",", up, "-", number(side), "))"});
    const std::string to_side = join({"(", beside, "^2+", past, "^2)"});
    if (!cone.is_capped) {
        return join({"sqrt(max(1e-30,", to_side, "))"});
    }
    const std::string above = join({"(", height, "-", number(length), ")"});
    const std::string to_lower = join({"(", height, "^2+max(0,", outward, ")^2)"});
    const std::string to_upper = join({"(", above, "^2+max(0,", radius, "-", number(cone.to_radius), ")^2)"});
    const std::string most = join({"max(", beside, ",max(-", height, ",", above, "))"});
    return join({"(min(0,", most, ")+sqrt(max(1e-30,min((1e6*max(0,", most, "))^2,min(", to_side, ",min(", to_lower, ",",
                 to_upper, "))))))"});
}

/** Nothing where the distance has no closed form. */
struct DistanceTo {
    using Text = std::optional<std::string>;
    Text operator()(const CutPlane& plane) const {
        const auto& [a, b, c, d] = plane.plane;
        const double length = std::hypot(a, b, c);
        return join({"(", along({a / length, b / length, c / length}, {}), "+", number(d / length), ")"});
    }
    Text operator()(const CutShape& shape) const { return std::visit(*this, shape); }
    Text operator()(const Sphere& sphere) const {
        return join({"(sqrt", square(sphere.center), "-", number(sphere.radius), ")"});
    }
    Text operator()(const Torus& torus) const {
        const std::string height = along(unit(torus.axis), torus.center);
        return join({"(sqrt((", from_axis(torus.center, height), "-", number(torus.major_radius), ")^2+", height, "^2)-",
                     number(torus.minor_radius), ")"});
    }
    Text operator()(const Cone& cone) const { return distance_to(cone); }
    Text operator()(const Cylinder& cylinder) const {
        return distance_to(Cone{cylinder.from, cylinder.to, cylinder.radius, cylinder.radius, cylinder.is_capped});
    }
    Text operator()(const Quadric&) const { return {}; }
    Text operator()(const ImplicitSurface&) const { return {}; }
    Text operator()(const MeshSurface&) const { return {}; }
    Text operator()(const BezierSurface&) const { return {}; }
    Text operator()(const TubeSurface&) const { return {}; }
    Text operator()(const RibbonSurface&) const { return {}; }
    Text operator()(const ArrowSurface&) const { return {}; }
    Text operator()(const FaceGeometry&) const { return {}; }
    Text operator()(const WireFrame&) const { return {}; }
    Text operator()(const Isosurfaces&) const { return {}; }
};

std::string distance_to(const SceneSurface& surface) {
    if (const std::optional<std::string> distance = std::visit(DistanceTo(), surface.geometry)) {
        return *distance;
    }
    throw Error("expression",
                join({"distance(", surface.name, "): distances are known of planes, spheres, tori, cylinders and cones"}));
}

const SceneSurface& surface_named(const std::string& name, std::span<const SceneSurface> surfaces) {
    std::vector<std::string> names;
    for (const SceneSurface& surface : surfaces) {
        if (surface.name == name && !name.empty()) {
            return surface;
        }
        if (!surface.name.empty()) {
            names.push_back(surface.name);
        }
    }
    const std::string nearest = names.empty() ? std::string() : join({"; the nearest is '", nearest_word(name, names), "'"});
    throw Error("expression", join({"distance(", name, "): no surface of the scene has this name", nearest}));
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

} // namespace

std::string with_distances(const std::string& text, std::span<const SceneSurface> surfaces) {
    static const std::string function = "distance(";
    std::string result;
    char quote = 0;
    for (std::size_t i = 0; i < text.size();) {
        const bool starts = quote == 0 && text.compare(i, function.size(), function) == 0 && (i == 0 || !is_word(text[i - 1]));
        const std::size_t end = starts ? text.find(')', i) : std::string::npos;
        if (end != std::string::npos) {
            const std::size_t first = i + function.size();
            result += distance_to(surface_named(text.substr(first, end - first), surfaces));
            i = end + 1;
            continue;
        }
        quote = quote == 0 && (text[i] == '"' || text[i] == '\'') ? text[i] : text[i] == quote ? char{0} : quote;
        result += text[i++];
    }
    return result;
}

} // namespace elvis
