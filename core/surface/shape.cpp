#include <core/base/error.hpp>
#include <core/expression/expression.hpp>
#include <core/surface/shape.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

class Check {
public:
    explicit Check(const std::string& place) : m_place(place) {}

    void operator()(const Sphere& sphere) const {
        finite("center", sphere.center);
        positive("radius", sphere.radius);
    }
    void operator()(const Cylinder& cylinder) const {
        ends(cylinder.from, cylinder.to);
        positive("radius", cylinder.radius);
    }
    void operator()(const Cone& cone) const {
        ends(cone.from, cone.to);
        const bool are_radii = std::isfinite(cone.from_radius) && std::isfinite(cone.to_radius) && cone.from_radius >= 0 &&
                               cone.to_radius >= 0 && cone.from_radius + cone.to_radius > 0;
        if (!are_radii) {
            throw Error(m_place, "the radii of a cone must be at least 0, and not both 0");
        }
    }
    void operator()(const Quadric& quadric) const {
        const auto& all = quadric.coefficients;
        const bool is_surface = std::any_of(all.begin(), all.end() - 1, [](double number) { return number != 0; });
        if (!is_surface || !std::all_of(all.begin(), all.end(), [](double number) { return std::isfinite(number); })) {
            throw Error(m_place, "a quadric needs ten finite coefficients of xx yy zz xy yz zx x y z 1, "
                                 "not all of the first nine 0");
        }
    }
    void operator()(const Torus& torus) const {
        finite("center", torus.center);
        finite("axis", torus.axis);
        if (torus.axis == Vector3{}) {
            throw Error(m_place, "'axis' is zero, which is no direction");
        }
        positive("major_radius", torus.major_radius);
        positive("minor_radius", torus.minor_radius);
    }

    void operator()(const ImplicitSurface& surface) const {
        try {
            Expression::implicit(surface.expression);
        } catch (const Error& error) {
            throw Error(m_place, error.what());
        }
    }
    /** The file's reader has checked. */
    void operator()(const MeshSurface&) const {}
    void operator()(const BezierSurface&) const {}
    void operator()(const TubeSurface&) const {}
    void operator()(const RibbonSurface&) const {}
    void operator()(const ArrowSurface&) const {}

private:
    void finite(const char* key, const Vector3& vector) const {
        if (!std::all_of(vector.begin(), vector.end(), [](double number) { return std::isfinite(number); })) {
            throw Error(m_place, std::string("'") + key + "' has a number that is not finite");
        }
    }
    void positive(const char* key, double number) const {
        if (!std::isfinite(number) || number <= 0) {
            throw Error(m_place, std::string("'") + key + "' must be more than 0");
        }
    }
    void ends(const Vector3& from, const Vector3& to) const {
        finite("from", from);
        finite("to", to);
        if (from == to) {
            throw Error(m_place, "'from' and 'to' are the same point");
        }
    }

    const std::string& m_place;
};

} // namespace

void check_shape(const CutShape& shape, const std::string& place) { std::visit(Check(place), shape); }

} // namespace elvis
