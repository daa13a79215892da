#include "inversion.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis::oracle {
namespace {

constexpr int max_newton_steps = 50;
constexpr int max_halvings = 6;
// Boxes that one search may look at; searches on the curved meshes of the tests need some hundreds.
constexpr std::uint64_t max_boxes = 20000;
// Solutions closer than this in every reference coordinate are the same one.
constexpr double same_solution = 1e-7;
// Half-width of the reference box, in units of the local reference coordinates, from which Newton is tried on a box. Smaller
// boxes try again whenever they have shrunk by another factor of four.
constexpr double first_attempt = 0.5;
// On a box of this size, whose Jacobian does not vanish, the mapping is one to one, the box's surroundings included.
constexpr double one_to_one = 0.02;

Vector clamp(const Vector& xi) { return xi.cwiseMax(-1.0).cwiseMin(1.0); }

struct Box {
    Patch patch;
    Vector eta_lower;
    Vector eta_upper;
    double attempted_size = std::numeric_limits<double>::infinity();
};

struct Extent {
    /** No point of the patch is x. */
    bool is_excluded = false;
    /** In reference units. */
    double size = 0;
};

Extent extent(const Patch& patch, const Matrix& to_reference, std::span<const FaceConstraint> faces, const Vector& x,
              double margin) {
    Extent result;
    for (const FaceConstraint& face : faces) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        const Eigen::RowVector3d row = face.normal.transpose() * to_reference;
        for (const Vector& p : patch.points) {
            const double value = row * (p - x);
            low = std::min(low, value);
            high = std::max(high, value);
        }
        result.is_excluded = result.is_excluded || low > margin || high < -margin;
        result.size = std::max(result.size, high - low);
    }
    return result;
}

} // namespace

Inverter::Inverter(const Volume& volume, const std::vector<Enclosure>& enclosures)
    : m_volume(&volume), m_enclosures(&enclosures),
      m_last(volume.n_elements(), Vector::Constant(std::numeric_limits<double>::quiet_NaN())) {}

bool Inverter::newton(std::size_t element, const Vector& x, Vector xi, Solution& solution) const {
    Vector residual = x - m_volume->position(element, xi, &solution.jacobian);
    double previous_step = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < max_newton_steps; ++iteration) {
        const Vector step = solution.jacobian.inverse() * residual;
        const double size = step.lpNorm<Eigen::Infinity>();
        if (!std::isfinite(size))
            return false;
        // At the rounding floor steps no longer shrink; above 1e-9 that would be slow convergence, not rounding.
        const bool is_last = size < 1e-15 || (size < 1e-9 && size > 0.25 * previous_step);
        if (is_last) {
            solution.xi = xi;
            solution.excess = excess(m_volume->shape(element), xi);
            return true;
        }
        previous_step = size;

        // Damped by the residual, except close to the solution, where rounding makes residuals incomparable.
        const Eigen::FullPivLU<Matrix> here(solution.jacobian);
        double factor = 1;
        Vector next = xi + step;
        Vector next_residual = x - m_volume->position(element, next, &solution.jacobian);
        for (int halving = 0; halving < max_halvings && size > 1e-6; ++halving) {
            if (here.solve(next_residual).lpNorm<Eigen::Infinity>() < size)
                break;
            factor /= 2;
            next = xi + factor * step;
            next_residual = x - m_volume->position(element, next, &solution.jacobian);
        }
        xi = next;
        residual = next_residual;
        if (xi.lpNorm<Eigen::Infinity>() > 50)
            return false;
    }
    return false;
}

void Inverter::subdivide(std::size_t element, const Vector& x, double tolerance, std::vector<Solution>& solutions) {
    const Enclosure& enclosure = (*m_enclosures)[element];
    const native::Shape shape = m_volume->shape(element);
    const auto faces = face_constraints(shape);
    std::vector<Box> stack{{enclosure.patch, Vector::Constant(-1), Vector::Constant(1)}};
    for (std::uint64_t n_boxes = 0; !stack.empty(); ++n_boxes) {
        if (n_boxes == max_boxes) {
            ++m_counts.unresolved;
            return;
        }
        Box box = std::move(stack.back());
        stack.pop_back();

        // Any invertible matrix gives a valid exclusion; the local inverse gives the tightest one. Next to a fold it is
        // useless.
        const Vector eta = 0.5 * (box.eta_lower + box.eta_upper);
        const native::Point middle = native::expand(shape, {eta.x(), eta.y(), eta.z()});
        const Vector xi(middle[0], middle[1], middle[2]);
        Matrix jacobian;
        m_volume->position(element, xi, &jacobian);
        Matrix to_reference = jacobian.inverse();
        if (!to_reference.allFinite() || to_reference.norm() > 1e3 * enclosure.to_reference.norm())
            to_reference = enclosure.to_reference;
        // Rounding of positions, in reference units, on top of the tolerance.
        const double margin =
            2 * tolerance + 1e-12 + 1e-15 * to_reference.cwiseAbs().maxCoeff() * (x.lpNorm<Eigen::Infinity>() + 1);

        const auto [is_excluded, size] = extent(box.patch, to_reference, faces, x, margin);
        if (is_excluded)
            continue;

        if (size < 2 * first_attempt && size < 0.25 * box.attempted_size) {
            box.attempted_size = size;
            Solution solution;
            const bool converged = newton(element, x, xi, solution);
            if (converged && solution.excess <= tolerance) {
                const bool is_known = std::any_of(solutions.begin(), solutions.end(), [&](const Solution& known) {
                    return (known.xi - solution.xi).lpNorm<Eigen::Infinity>() < same_solution;
                });
                if (!is_known)
                    solutions.push_back(solution);
                if (!enclosure.is_folded)
                    return;
            } else if (converged && !enclosure.is_folded && size < one_to_one &&
                       (solution.xi - xi).lpNorm<Eigen::Infinity>() < 2 * (size + margin)) {
                // The only solution that the neighbourhood of this box can have lies too far outside.
                continue;
            }
        }
        // Smaller than what tells two solutions apart, and Newton has seen it.
        if (size < same_solution)
            continue;
        const std::size_t direction = box.patch.longest_direction(to_reference);
        std::array<Patch, 2> halves = box.patch.split(direction);
        const auto d = static_cast<Eigen::Index>(direction);
        for (std::size_t half = 0; half < 2; ++half) {
            Box child{std::move(halves[half]), box.eta_lower, box.eta_upper, box.attempted_size};
            (half == 0 ? child.eta_upper : child.eta_lower)[d] = eta[d];
            stack.push_back(std::move(child));
        }
    }
}

std::vector<Solution> Inverter::find(std::size_t element, const Vector& x, double tolerance) {
    const Enclosure& enclosure = (*m_enclosures)[element];
    const native::Shape shape = m_volume->shape(element);
    std::vector<Solution> solutions;
    if (!enclosure.may_contain(shape, x, 4 * tolerance))
        return solutions;
    ++m_counts.queries;

    if (!enclosure.is_folded) {
        Vector start = m_last[element];
        if (!start.allFinite())
            start = clamp(centre(shape) + enclosure.to_reference * (x - enclosure.centre));
        for (const Vector& xi : {start, centre(shape)}) {
            Solution solution;
            if (newton(element, x, xi, solution) && solution.excess <= tolerance) {
                m_last[element] = solution.xi;
                return {solution};
            }
        }
    }
    ++m_counts.subdivided;
    subdivide(element, x, tolerance, solutions);
    if (solutions.size() == 1)
        m_last[element] = solutions.front().xi;
    return solutions;
}

} // namespace elvis::oracle
