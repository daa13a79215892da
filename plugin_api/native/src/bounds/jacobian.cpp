/*
 * First stage: with G any regular matrix, det J = det (G J) / det G. G J is computed for the columns' Bernstein coefficients,
 * G = adj(mean of J). If in column j of every coefficient the diagonal entry exceeds the sum of the others' magnitudes, then so
 * it does in every mean of coefficients with weights >= 0, thus everywhere, and det (G J) >= prod_j min (m_jj - sum |m_ij|) > 0
 * (A. M. Ostrowski, Bull. Sci. Math. 61, 1937). G may be as rounded as it likes; only det G > 0 must be sure.
 *
 * Between the stages, the corners: the Jacobians there are known already, and a tangled element is mostly tangled at a corner.
 *
 * Second stage: subdivision.hpp.
 */
#include "../file/runs.hpp"
#include "derivative_forms.hpp"
#include "determinant_form.hpp"
#include "numbers.hpp"
#include "subdivision.hpp"

#include <elvis/native/jacobian.hpp>

#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace elvis::native {
namespace {

constexpr std::size_t lanes = 8;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/** Products of three numbers stay clear of overflow and of what underflow could spoil (at most 5e-324 a product). */
constexpr double smallest_product = 1e-260;
constexpr double largest_product = 1e260;
/** See jacobian.hpp: a thousand times what conversions leave, far less than anyone would draw. */
constexpr double apex_tolerance = 1e-9;

/*
 * The loops over lanes, once more for processors with twice the vector length. Without fused multiply-add, so that every
 * machine gives the same bits.
 */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&                       \
    !defined(__SANITIZE_THREAD__)
#define ELVIS_NATIVE_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define ELVIS_NATIVE_CLONES
#endif

ELVIS_NATIVE_CLONES void evaluate_forms(const DerivativeForms& forms, const double* coefficients, double* workspace,
                                        double* result, double* magnitudes) {
    forms.evaluate<lanes>(coefficients, workspace, result, magnitudes);
}

ELVIS_NATIVE_CLONES void evaluate_determinant(const DeterminantForm& form, const std::array<const double*, 9>& columns,
                                              double* workspace, double* result) {
    form.evaluate<lanes>(columns, workspace, result);
}

/** Of a matrix by columns or by rows. */
double determinant(const std::array<double, 9>& m) {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}
/** Five roundings a term, and some for the bound. */
constexpr double determinant_gamma = 8 * unit;

/** Modes that add up to 1 where each has the coefficient 1. */
std::vector<std::size_t> modes_of_one(const Space& space) {
    std::vector<std::size_t> result;
    const bool nodal = space.basis == Basis::gll_lagrange || space.basis == Basis::gauss_lagrange;
    for_each_run(space, [&](const Run& run) {
        for (int i = 0; i < run.count; ++i) {
            Factor inner = run.inner;
            inner.index += i;
            const auto is_vertex = [](const Factor& factor) { return degree(factor, 0) <= 1; };
            if (nodal || (space.basis != Basis::orthogonal && is_vertex(run.outer) && is_vertex(run.mid) && is_vertex(inner)))
                result.push_back(run.first + static_cast<std::size_t>(i));
        }
    });
    // The first orthogonal mode is a constant, though not 1: it is left out altogether.
    return space.basis == Basis::orthogonal ? std::vector<std::size_t>{0} : result;
}

/** Modes of tensor pyramids that do not vanish at the apex; none elsewhere. */
std::vector<std::size_t> apex_modes(const Space& space) {
    std::vector<std::size_t> result;
    if (space.basis == Basis::tensor)
        for_each_run(space, [&](const Run& run) { result.push_back(run.first + 1); });
    return result;
}

} // namespace

class JacobianChecker::Impl {
public:
    Impl(const Space& space, const JacobianOptions& options);

    void check(std::span<const double> coefficients, std::span<JacobianCheck> checks);

private:
    using Lanes = std::array<double, lanes>;

    /** Columns' forms of these elements, one a lane. */
    void load(std::span<const double> coefficients, const std::array<std::size_t, lanes>& elements);
    /** The adjugate of the Jacobian's mean over the forms' coefficients. */
    std::array<Lanes, 9> mean_adjugate() const;
    /** The first stage; whether each lane is positive, with its lower bound. */
    void test_dominance(std::array<bool, lanes>& is_positive, Lanes& lower) const;
    /** Between the stages: whether an element that is not positive is surely negative at a corner; then writes its check. */
    bool is_negative_at_corner(std::size_t lane, JacobianCheck& check) const;
    /** The second stage. */
    void test_determinant(std::size_t n_used, const std::array<std::size_t, lanes>& elements, std::span<JacobianCheck> checks);

    const double* column(std::size_t j, std::size_t i) const {
        return m_forms_of[i].data() + m_forms.columns()[j].offset * lanes;
    }

    /** Of component k % 3 of column k / 3. */
    double column_error(std::size_t k, std::size_t lane) const {
        return m_forms.columns()[k / 3].error * m_magnitudes[k % 3][lane];
    }

    Space m_space;
    Sizes m_places;
    JacobianOptions m_options;
    DerivativeForms m_forms;
    DeterminantForm m_determinant;
    Subdivision m_subdivision;
    std::vector<std::size_t> m_modes_of_one, m_apex_modes;

    std::vector<double> m_coefficients, m_workspace, m_product_workspace, m_product, m_single;
    std::array<std::vector<double>, 3> m_forms_of; // by component
    /** Weighted magnitudes of the coefficients, by component and lane. */
    std::array<std::array<double, lanes>, 3> m_magnitudes{};
    std::array<bool, lanes> m_is_broken{};
};

JacobianChecker::Impl::Impl(const Space& space, const JacobianOptions& options)
    : m_space(space), m_places(storage_places(space.shape)), m_options(options), m_forms(space),
      m_determinant(m_forms.columns()), m_subdivision(space.shape, m_determinant.sizes(), options),
      m_modes_of_one(modes_of_one(space)), m_apex_modes(apex_modes(space)) {
    m_coefficients.resize(m_forms.n_modes() * lanes);
    m_workspace.resize(m_forms.workspace_size() * lanes);
    for (auto& forms : m_forms_of)
        forms.resize(m_forms.size() * lanes);
}

void JacobianChecker::Impl::load(std::span<const double> coefficients, const std::array<std::size_t, lanes>& elements) {
    const std::size_t n_modes = m_forms.n_modes();
    m_is_broken.fill(false);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const double* const from = coefficients.data() + (elements[lane] * 3 + i) * n_modes;
            for (std::size_t mode = 0; mode < n_modes; ++mode)
                m_coefficients[mode * lanes + lane] = from[mode];
            // Derivatives do not see a constant, errors do: small elements may lie far from the origin.
            const double origin = from[m_modes_of_one[0]];
            for (const std::size_t mode : m_modes_of_one)
                m_coefficients[mode * lanes + lane] -= origin;
        }
        std::array<double, lanes> apex{};
        for (const std::size_t mode : m_apex_modes) {
            // Relative to the vertex at the apex, which all of them share.
            const bool is_vertex = std::binary_search(m_modes_of_one.begin(), m_modes_of_one.end(), mode);
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                const double reference = is_vertex ? m_coefficients[m_apex_modes[0] * lanes + lane] : 0;
                apex[lane] = std::max(apex[lane], std::abs(m_coefficients[mode * lanes + lane] - reference));
            }
        }
        for (const std::size_t mode : m_apex_modes)
            if (std::binary_search(m_modes_of_one.begin(), m_modes_of_one.end(), mode))
                for (std::size_t lane = 0; lane < lanes; ++lane)
                    m_coefficients[mode * lanes + lane] = m_coefficients[m_apex_modes[0] * lanes + lane];
            else
                std::fill_n(m_coefficients.begin() + static_cast<std::ptrdiff_t>(mode * lanes), lanes, 0.0);
        evaluate_forms(m_forms, m_coefficients.data(), m_workspace.data(), m_forms_of[i].data(), m_magnitudes[i].data());
        for (std::size_t lane = 0; lane < lanes; ++lane)
            m_is_broken[lane] =
                m_is_broken[lane] || apex[lane] > apex_tolerance * m_magnitudes[i][lane] || !(m_magnitudes[i][lane] < 1e200);
    }
}

std::array<JacobianChecker::Impl::Lanes, 9> JacobianChecker::Impl::mean_adjugate() const {
    std::array<Lanes, 9> mean{}; // entry 3 i + j
    for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t n = product(m_forms.columns()[j].sizes);
        for (std::size_t i = 0; i < 3; ++i) {
            const double* values = column(j, i);
            Lanes& sum = mean[3 * i + j];
            for (std::size_t k = 0; k < n; ++k, values += lanes)
                for (std::size_t lane = 0; lane < lanes; ++lane)
                    sum[lane] += values[lane];
            for (std::size_t lane = 0; lane < lanes; ++lane)
                sum[lane] /= static_cast<double>(n);
        }
    }
    std::array<Lanes, 9> g; // entry 3 i + j
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            for (std::size_t lane = 0; lane < lanes; ++lane)
                g[3 * i + j][lane] =
                    mean[3 * a + c][lane] * mean[3 * b + d][lane] - mean[3 * a + d][lane] * mean[3 * b + c][lane];
        }
    return g;
}

void JacobianChecker::Impl::test_dominance(std::array<bool, lanes>& is_positive, Lanes& lower) const {
    const std::array<Lanes, 9> g = mean_adjugate();
    Lanes margins;
    margins.fill(1);
    is_positive.fill(true);
    for (std::size_t j = 0; j < 3; ++j) {
        const DerivativeForms::Column& form = m_forms.columns()[j];
        const std::size_t n = product(form.sizes);
        const double *const x = column(j, 0), *const y = column(j, 1), *const z = column(j, 2);
        const std::size_t p = (j + 1) % 3, q = (j + 2) % 3;
        Lanes least;
        least.fill(infinity);
        for (std::size_t k = 0; k < n * lanes; k += lanes)
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                const double u = x[k + lane], v = y[k + lane], w = z[k + lane];
                const double diagonal = g[3 * j][lane] * u + g[3 * j + 1][lane] * v + g[3 * j + 2][lane] * w;
                const double first = g[3 * p][lane] * u + g[3 * p + 1][lane] * v + g[3 * p + 2][lane] * w;
                const double second = g[3 * q][lane] * u + g[3 * q + 1][lane] * v + g[3 * q + 2][lane] * w;
                const double margin = diagonal - std::abs(first) - std::abs(second);
                least[lane] = margin < least[lane] ? margin : least[lane];
            }
        // 3 products, 2 additions and 2 for the margin are 7 roundings of terms |g| |column|; the columns' own error is
        // `error`.
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            double error = 0;
            for (std::size_t i = 0; i < 3; ++i)
                error += (std::abs(g[i][lane]) + std::abs(g[3 + i][lane]) + std::abs(g[6 + i][lane])) * m_magnitudes[i][lane];
            error *= (form.error + 8 * unit * form.bound) * (1 + 100 * unit);
            const double margin = least[lane] - error;
            is_positive[lane] = is_positive[lane] && margin > 0;
            margins[lane] *= margin;
        }
    }
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        std::array<double, 9> matrix{}, magnitudes{};
        for (std::size_t k = 0; k < 9; ++k) {
            matrix[k] = g[k][lane];
            magnitudes[k] = std::abs(g[k][lane]);
        }
        const double det_g = determinant(matrix);
        const double error = determinant_gamma * permanent(magnitudes);
        is_positive[lane] = is_positive[lane] && !m_is_broken[lane] && det_g > error && det_g > smallest_product &&
                            det_g < largest_product && margins[lane] > smallest_product && margins[lane] < largest_product;
        lower[lane] = margins[lane] / (det_g + error) * (1 - 16 * unit);
    }
}

bool JacobianChecker::Impl::is_negative_at_corner(std::size_t lane, JacobianCheck& check) const {
    if (m_is_broken[lane])
        return false;
    // At corners of the cube of eta, the form's corner coefficients are its values.
    double least = 0;
    std::size_t least_corner = 8;
    std::array<double, 9> least_matrix{};
    for (std::size_t corner = 0; corner < 8; ++corner) {
        // xi cannot tell the directions at the apex of a pyramid apart.
        if (m_space.shape == Shape::pyramid && (corner & 4) != 0)
            continue;
        std::array<double, 9> matrix{};
        for (std::size_t j = 0; j < 3; ++j) {
            const Sizes& n = m_forms.columns()[j].sizes;
            Sizes at{};
            for (std::size_t direction = 0; direction < 3; ++direction)
                at[m_places[direction]] = (corner >> direction) % 2 != 0 ? n[m_places[direction]] - 1 : 0;
            const std::size_t k = (at[0] * n[1] + at[1]) * n[2] + at[2];
            for (std::size_t i = 0; i < 3; ++i)
                matrix[3 * j + i] = column(j, i)[k * lanes + lane];
        }
        const double value = determinant(matrix);
        if (value < least) {
            least = value;
            least_corner = corner;
            least_matrix = matrix;
        }
    }
    if (least_corner == 8)
        return false;
    std::array<double, 9> errors{};
    for (std::size_t k = 0; k < 9; ++k) {
        errors[k] = column_error(k, lane);
        least_matrix[k] = std::abs(least_matrix[k]) + errors[k];
    }
    const double size = permanent(least_matrix);
    if (!(size > smallest_product && size < largest_product) ||
        !(least < -determinant_error(least_matrix, errors, determinant_gamma)))
        return false;
    Point eta{};
    for (std::size_t direction = 0; direction < 3; ++direction)
        eta[direction] = (least_corner >> direction) % 2 != 0 ? 1 : -1;
    check = {JacobianSign::negative, nan, expand(m_space.shape, eta), least};
    return true;
}

void JacobianChecker::Impl::test_determinant(std::size_t n_used, const std::array<std::size_t, lanes>& elements,
                                             std::span<JacobianCheck> checks) {
    m_product_workspace.resize(m_determinant.workspace_size() * lanes);
    m_product.resize(m_determinant.size() * lanes);
    m_single.resize(m_determinant.size());
    std::array<const double*, 9> columns{};
    std::array<std::array<double, lanes>, 9> largest{}; // entry 3 j + i: of component i of column j
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 3; ++i) {
            columns[3 * j + i] = column(j, i);
            const std::size_t n = product(m_forms.columns()[j].sizes);
            for (std::size_t k = 0; k < n; ++k)
                for (std::size_t lane = 0; lane < lanes; ++lane)
                    largest[3 * j + i][lane] =
                        std::max(largest[3 * j + i][lane], std::abs(columns[3 * j + i][k * lanes + lane]));
        }
    evaluate_determinant(m_determinant, columns, m_product_workspace.data(), m_product.data());
    for (std::size_t lane = 0; lane < n_used; ++lane) {
        JacobianCheck& check = checks[elements[lane]];
        std::array<double, 9> whole{}, error{};
        for (std::size_t k = 0; k < 9; ++k) {
            error[k] = column_error(k, lane);
            whole[k] = largest[k][lane] + error[k];
        }
        const double bound = determinant_error(whole, error, m_determinant.gamma());
        const double size = permanent(whole);
        if (m_is_broken[lane] || !(size > smallest_product && size < largest_product)) {
            check = {JacobianSign::undecided, size == 0 && !m_is_broken[lane] ? 0 : -infinity, expand(m_space.shape, {0, 0, 0}),
                     nan};
            continue;
        }
        for (std::size_t k = 0; k < m_single.size(); ++k)
            m_single[k] = m_product[k * lanes + lane];
        check = m_subdivision.decide(m_single, bound);
    }
}

void JacobianChecker::Impl::check(std::span<const double> coefficients, std::span<JacobianCheck> checks) {
    assert(coefficients.size() == checks.size() * 3 * m_forms.n_modes());
    std::array<std::size_t, lanes> rest{}; // elements that wait for the second stage
    std::size_t n_rest = 0;
    const auto decide_rest = [&] {
        if (n_rest == 0)
            return;
        std::fill(rest.begin() + static_cast<std::ptrdiff_t>(n_rest), rest.end(), rest[0]);
        load(coefficients, rest);
        test_determinant(n_rest, rest, checks);
        n_rest = 0;
    };
    for (std::size_t first = 0; first < checks.size(); first += lanes) {
        const std::size_t n = std::min(lanes, checks.size() - first);
        std::array<std::size_t, lanes> elements{};
        for (std::size_t lane = 0; lane < lanes; ++lane)
            elements[lane] = first + std::min(lane, n - 1);
        load(coefficients, elements);
        std::array<bool, lanes> is_positive{};
        std::array<double, lanes> lower{};
        test_dominance(is_positive, lower);
        std::array<bool, lanes> is_open{};
        for (std::size_t lane = 0; lane < n; ++lane) {
            JacobianCheck& check = checks[elements[lane]];
            if (is_positive[lane])
                check = {JacobianSign::positive, lower[lane], {nan, nan, nan}, nan};
            else
                is_open[lane] = !is_negative_at_corner(lane, check);
        }
        // Only now, because it loads other elements.
        for (std::size_t lane = 0; lane < n; ++lane)
            if (is_open[lane]) {
                rest[n_rest++] = elements[lane];
                if (n_rest == lanes)
                    decide_rest();
            }
    }
    decide_rest();
}

namespace {

const Space& checked(const Space& space) {
    check(space);
    if (dimension(space.shape) != 3 || is_constant(space))
        throw std::invalid_argument("a Jacobian determinant needs a mapping of a three-dimensional shape, of order 1 at least");
    return space;
}

} // namespace

JacobianChecker::JacobianChecker(const Space& geometry, const JacobianOptions& options)
    : m_impl(std::make_unique<Impl>(checked(geometry), options)) {}
JacobianChecker::~JacobianChecker() = default;
JacobianChecker::JacobianChecker(const JacobianChecker& other) : m_impl(std::make_unique<Impl>(*other.m_impl)) {}
JacobianChecker& JacobianChecker::operator=(const JacobianChecker& other) {
    *m_impl = *other.m_impl;
    return *this;
}

void JacobianChecker::operator()(std::span<const double> coefficients, std::span<JacobianCheck> checks) {
    m_impl->check(coefficients, checks);
}

} // namespace elvis::native
