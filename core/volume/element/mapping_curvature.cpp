#include <core/base/vector3.hpp>
#include <core/volume/element/mapping_curvature.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <vector>

namespace elvis {

namespace {

/** Elements that are computed at once. */
constexpr std::size_t lanes = 4;
/** A hexahedron of order 9 has as many. */
constexpr std::size_t most_nodes = 1000;
/** A bound is close enough if it is no more than this times larger than what a point shows. Parts take time. */
constexpr double close_enough = 1.5;
/** Parts of an element that are looked at: three levels where only one place is bent. */
constexpr std::size_t most_parts = 128;
/** Larger ones take long, and say little. */
constexpr double most_curvature = most_measured_curvature;
/** Of the Jacobian, relative to that at the centroid: an element with a smaller determinant folds. */
constexpr double folded_determinant = -1e-6;
/** For the rounding of sums, by far. */
constexpr double mapping_margin = 1 + 1e-6;

using Matrix3 = std::array<double, 9>;

/** Not finite if there is none. */
Matrix3 inverse_of(const Matrix3& m) {
    const Vector3 row0{m[0], m[1], m[2]}, row1{m[3], m[4], m[5]}, row2{m[6], m[7], m[8]};
    const Vector3 c0 = cross(row1, row2), c1 = cross(row2, row0), c2 = cross(row0, row1);
    const double d = dot(row0, c0);
    return {c0[0] / d, c1[0] / d, c2[0] / d, c0[1] / d, c1[1] / d, c2[1] / d, c0[2] / d, c1[2] / d, c2[2] / d};
}

Matrix3 product(const Matrix3& a, const Matrix3& b) {
    Matrix3 result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            result[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
        }
    }
    return result;
}

double norm(const Matrix3& m) {
    double largest = 0;
    for (std::size_t i = 0; i < 9; i += 3) {
        largest = std::max(largest, std::abs(m[i]) + std::abs(m[i + 1]) + std::abs(m[i + 2]));
    }
    return largest;
}

bool is_finite(const Matrix3& m) {
    return std::ranges::all_of(m, [](double entry) { return std::isfinite(entry); });
}

double determinant(const Matrix3& m) { return dot({m[0], m[1], m[2]}, cross({m[3], m[4], m[5]}, {m[6], m[7], m[8]})); }

/**
 * Raises `largest` to sup |H(u, v)| of symmetric forms H = (h[0] h[1] h[2]; . h[3] h[4]; . . h[5]): the largest is taken where
 * all of u are 1 or -1. `n` side by side.
 */
template <std::size_t n> void raise_to_norm(const std::array<const double*, 6>& h, double* largest) {
    for (std::size_t k = 0; k < n; ++k) {
        double most = 0;
        for (const double s : {-1.0, 1.0}) {
            for (const double t : {-1.0, 1.0}) {
                const double sum = std::abs(h[0][k] + s * h[1][k] + t * h[2][k]) +
                                   std::abs(h[1][k] + s * h[3][k] + t * h[4][k]) +
                                   std::abs(h[2][k] + s * h[4][k] + t * h[5][k]);
                most = sum > most ? sum : most;
            }
        }
        largest[k] = most > largest[k] ? most : largest[k];
    }
}

/** A cube of reference space, as far as it lies in the shape. */
struct Part {
    Vector3 middle;
    double half_side;
    /** Where the mapping is looked at, and no point of the part is farther away. */
    Vector3 point;
    double radius;
    double bound = 0;

    bool operator<(const Part& other) const { return bound < other.bound; }
};

/** None if there is nothing of it in the shape. */
std::optional<Part> part_of(elvis_shape shape, const Vector3& middle, double half_side) {
    Part part{middle, half_side, middle, half_side};
    const auto& [x, y, z] = middle;
    const bool is_prism = shape == ELVIS_SHAPE_PRISM;
    if (shape != ELVIS_SHAPE_HEXAHEDRON) {
        // Onto the slanted face. The coordinates of that face cannot all be as large as in the cube's last corner.
        const double shift = is_prism ? std::max(x + z, 0.0) / 2 : std::max(x + y + z + 1, 0.0) / 3;
        if (shift >= half_side) {
            return {};
        }
        part.point = {x - shift, is_prism ? y : y - shift, z - shift};
        part.radius = is_prism ? half_side : std::min(half_side + shift, 2 * (half_side - shift));
    }
    return part;
}

double extent(elvis_shape shape) { return shape == ELVIS_SHAPE_HEXAHEDRON ? 1.0 : shape == ELVIS_SHAPE_PRISM ? 4.0 / 3 : 1.5; }

float rounded_up(double curvature) {
    const double with_margin = mapping_margin * curvature;
    return with_margin <= most_curvature ? std::nextafter(static_cast<float>(with_margin), unknown_curvature)
                                         : unknown_curvature;
}

/** Of J0, its inverse, and the s_m. */
ElementBends bends_of(const Matrix3& jacobian, const Matrix3& inverse, const Vector3& most) {
    ElementBends bends{};
    for (std::size_t entry = 0; entry < 9 && is_finite(inverse); ++entry) {
        const std::size_t m = entry / 3, i = entry % 3;
        bends.vectors[entry] = static_cast<float>(most[m] * jacobian[3 * i + m]);
    }
    return bends;
}

/** Of the part in which the Jacobian changes by 2 curvature radius at most. */
double bound_on(double curvature, double radius) {
    const double change = 2 * curvature * radius;
    return change < 1 ? curvature / (1 - change) : std::numeric_limits<double>::infinity();
}

} // namespace

/** Of `lanes` elements, side by side. */
struct CurvatureBounder::Group {
    const ElementMapping& mapping;
    std::vector<double> numbers, positions;
    std::uint64_t first = 0;
    std::size_t count = 0;

    Group(const ElementMapping& of, const SecondDerivatives& derivatives)
        : mapping(of), numbers(3 * lanes * derivatives.size()), positions(3 * derivatives.n_nodes()) {}

    double& at(std::size_t slot, std::size_t component, std::size_t lane) {
        return numbers[(3 * slot + component) * lanes + lane];
    }
};

/** One that bends so much that it is looked at in parts. */
struct CurvatureBounder::Element {
    const ElementMapping& mapping;
    std::uint64_t number;
    /** Of the Jacobian at the centroid, J0. */
    Matrix3 inverse;
    /** A coefficient of J0^-1 D^2x, and its norm: six entries of three components each. */
    struct Form {
        double norm = 0;
        std::array<double, 18> entries{};
    };
    /** The largest come first. */
    std::vector<Form> forms;

    /** |a^-1 J0^-1 D^2x| / 2. */
    double curvature(const Matrix3& a) const {
        const Matrix3 to = inverse_of(a);
        if (!is_finite(to)) {
            return std::numeric_limits<double>::infinity();
        }
        const double stretch = norm(to);
        double largest = 0;
        for (const Form& form : forms) {
            if (form.norm * stretch <= largest) {
                break;
            }
            raise_to_norm_of(form, to, largest);
        }
        return 0.5 * largest;
    }

    /** `jacobian`: J0. */
    BendForm bend_form(const Matrix3& jacobian) const {
        std::vector<MappingHessian> hessians(forms.size());
        for (std::size_t coefficient = 0; coefficient < forms.size(); ++coefficient) {
            for (std::size_t entry = 0; entry < SecondDerivatives::n_derivatives; ++entry) {
                const double* const of = &forms[coefficient].entries[3 * entry];
                for (std::size_t i = 0; i < 3; ++i) {
                    hessians[coefficient][i][entry] =
                        jacobian[3 * i] * of[0] + jacobian[3 * i + 1] * of[1] + jacobian[3 * i + 2] * of[2];
                }
            }
        }
        return bend_form_of(hessians, jacobian);
    }

    static void raise_to_norm_of(const Form& form, const Matrix3& to, double& largest) {
        for (std::size_t row = 0; row < 9; row += 3) {
            std::array<double, 6> h{};
            for (std::size_t entry = 0; entry < 6; ++entry) {
                const double* const of = &form.entries[3 * entry];
                h[entry] = to[row] * of[0] + to[row + 1] * of[1] + to[row + 2] * of[2];
            }
            raise_to_norm<1>({&h[0], &h[1], &h[2], &h[3], &h[4], &h[5]}, &largest);
        }
    }
};

bool CurvatureBounder::can_bound(const ClassInfo& element_class) {
    const auto& order = element_class.geometry_order;
    const auto shape = element_class.shape;
    if (order[0] < 1 || order[1] < 1 || order[2] < 1) {
        return false;
    }
    const std::size_t triangle = std::max(order[0], order[2]) + std::size_t{1};
    const std::size_t simplex = std::max({order[0], order[1], order[2]}) + std::size_t{1};
    return shape == ELVIS_SHAPE_HEXAHEDRON ? (order[0] + std::size_t{1}) * (order[1] + 1) * (order[2] + 1) <= most_nodes
           : shape == ELVIS_SHAPE_PRISM
               ? triangle * (triangle + 1) / 2 * (order[1] + 1) <= most_nodes
               : shape == ELVIS_SHAPE_TETRAHEDRON && simplex * (simplex + 1) * (simplex + 2) / 6 <= most_nodes;
}

CurvatureBounder::CurvatureBounder(elvis_shape shape, std::span<const std::uint32_t, 3> order)
    : m_shape(shape), m_derivatives(shape, order) {}

void CurvatureBounder::operator()(const ElementMapping& mapping, std::uint64_t first, std::span<float> curvatures,
                                  std::span<ElementBends> bends) const {
    Group group(mapping, m_derivatives);
    for (std::size_t done = 0; done < curvatures.size(); done += lanes) {
        group.first = first + done;
        group.count = std::min(lanes, curvatures.size() - done);
        bound_group(group, curvatures.subspan(done, group.count), bends.subspan(done, group.count));
    }
}

void CurvatureBounder::bound_group(Group& group, std::span<float> curvatures, std::span<ElementBends> bends) const {
    const std::size_t n_nodes = m_derivatives.n_nodes(), polynomial = m_derivatives.polynomial_at();
    for (std::size_t lane = 0; lane < group.count; ++lane) {
        std::vector<double>& x = group.positions;
        group.mapping(group.first + lane, m_derivatives.nodes(), x, {});
        for (std::size_t node = 0; node < n_nodes; ++node) {
            for (std::size_t i = 0; i < 3; ++i) {
                group.at(node, i, lane) = x[3 * node + i] - x[i];
            }
        }
    }
    m_derivatives.interpolate<3 * lanes>(group.numbers.data());

    std::array<Matrix3, lanes> jacobians{}, inverses{};
    const std::span<const double> weights = m_derivatives.gradient_weights();
    for (std::size_t lane = 0; lane < group.count; ++lane) {
        Matrix3& jacobian = jacobians[lane];
        for (std::size_t slot = 0; slot < n_nodes; ++slot) {
            for (std::size_t entry = 0; entry < 9; ++entry) {
                jacobian[entry] += group.at(polynomial + slot, entry / 3, lane) * weights[3 * slot + entry % 3];
            }
        }
        inverses[lane] = inverse_of(jacobian);
        for (std::size_t slot = polynomial; slot < polynomial + n_nodes; ++slot) {
            const Vector3 x{group.at(slot, 0, lane), group.at(slot, 1, lane), group.at(slot, 2, lane)};
            for (std::size_t i = 0; i < 3; ++i) {
                group.at(slot, i, lane) =
                    inverses[lane][3 * i] * x[0] + inverses[lane][3 * i + 1] * x[1] + inverses[lane][3 * i + 2] * x[2];
            }
        }
    }
    m_derivatives.differentiate<3 * lanes>(group.numbers.data());

    const auto entry_at = [&](std::size_t coefficient, std::size_t i) {
        std::array<const double*, 6> h{};
        for (std::size_t derivative = 0; derivative < h.size(); ++derivative) {
            h[derivative] = &group.at(m_derivatives.derivative_at(derivative) + coefficient, i, 0);
        }
        return h;
    };
    std::array<std::array<double, lanes>, 3> rows{};
    for (std::size_t coefficient = 0; coefficient < m_derivatives.n_coefficients(); ++coefficient) {
        for (std::size_t i = 0; i < 3; ++i) {
            raise_to_norm<lanes>(entry_at(coefficient, i), rows[i].data());
        }
    }
    for (std::size_t lane = 0; lane < group.count; ++lane) {
        const Vector3 most{rows[0][lane], rows[1][lane], rows[2][lane]};
        bends[lane] = bends_of(jacobians[lane], inverses[lane], most);
        const double curvature = 0.5 * std::max({most[0], most[1], most[2]}), bound = bound_on(curvature, extent(m_shape));
        if (!is_finite(inverses[lane]) || bound <= close_enough * curvature) {
            curvatures[lane] = is_finite(inverses[lane]) ? rounded_up(bound) : unknown_curvature;
            continue;
        }
        Element element{group.mapping, group.first + lane, inverses[lane], {}};
        for (std::size_t coefficient = 0; coefficient < m_derivatives.n_coefficients(); ++coefficient) {
            Element::Form& form = element.forms.emplace_back();
            for (std::size_t entry = 0; entry < form.entries.size(); ++entry) {
                form.entries[entry] = group.at(m_derivatives.derivative_at(entry / 3) + coefficient, entry % 3, lane);
            }
            Element::raise_to_norm_of(form, {1, 0, 0, 0, 1, 0, 0, 0, 1}, form.norm);
        }
        std::ranges::sort(element.forms, std::greater{}, &Element::Form::norm);
        const double in_parts = bound_in_parts(element, curvature);
        const bool is_folded = std::isnan(in_parts) || (in_parts > most_curvature && folds(element));
        curvatures[lane] = is_folded ? unknown_curvature : rounded_up(in_parts);
        if (is_folded) {
            bends[lane] = {};
        } else if (curvatures[lane] == unknown_curvature) {
            bends[lane].form = element.bend_form(jacobians[lane]);
        }
    }
}

bool CurvatureBounder::folds(const Element& element) const {
    const std::span<const double> nodes = m_derivatives.nodes();
    std::vector<double> jacobians(3 * nodes.size());
    element.mapping(element.number, nodes, {}, jacobians);
    for (std::size_t at = 0; at < jacobians.size(); at += 9) {
        Matrix3 jacobian{};
        std::copy_n(&jacobians[at], 9, jacobian.begin());
        if (!(determinant(product(element.inverse, jacobian)) > folded_determinant)) {
            return true;
        }
    }
    return false;
}

/** Not a number if the element is seen to fold. */
double CurvatureBounder::bound_in_parts(const Element& element, double shown) const {
    std::priority_queue<Part> parts;
    Part part = *part_of(m_shape, {0, 0, 0}, 1);
    part.bound = std::numeric_limits<double>::infinity();
    parts.push(part);
    std::vector<Part> halves;
    std::vector<double> points, jacobians;
    for (std::size_t n_parts = 0; n_parts < most_parts && parts.top().bound > close_enough * shown && shown < most_curvature;) {
        const Part whole = parts.top();
        parts.pop();
        halves.clear();
        points.clear();
        for (unsigned corner = 0; corner < 8; ++corner) {
            const double half = 0.5 * whole.half_side;
            const auto moved = [&](std::size_t axis) {
                return whole.middle[axis] + ((corner >> axis) % 2 == 0 ? -half : half);
            };
            if (const std::optional<Part> found = part_of(m_shape, {moved(0), moved(1), moved(2)}, half)) {
                halves.push_back(*found);
                points.insert(points.end(), found->point.begin(), found->point.end());
            }
        }
        jacobians.resize(3 * points.size());
        element.mapping(element.number, points, {}, jacobians);
        for (std::size_t index = 0; index < halves.size(); ++index) {
            Matrix3 jacobian{};
            std::copy_n(&jacobians[9 * index], 9, jacobian.begin());
            const Matrix3 relative = product(element.inverse, jacobian);
            const double curvature = element.curvature(relative);
            if (!(determinant(relative) > 0) || !std::isfinite(curvature)) {
                return std::numeric_limits<double>::quiet_NaN();
            }
            halves[index].bound = bound_on(curvature, halves[index].radius);
            shown = std::max(shown, curvature);
            parts.push(halves[index]);
        }
        n_parts += halves.size();
    }
    return parts.top().bound;
}

} // namespace elvis
