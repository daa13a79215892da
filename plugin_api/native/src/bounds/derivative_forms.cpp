#include "derivative_forms.hpp"

#include "../file/runs.hpp"
#include "numbers.hpp"

#include <cassert>
#include <cmath>
#include <limits>

namespace elvis::native {
Sizes storage_places(Shape shape) {
    const Directions axis = directions(shape);
    Sizes places{};
    places[axis.outer] = 0;
    places[axis.mid] = 1;
    places[axis.inner] = 2;
    return places;
}

/** Writes the steps down, and carries a bound of the coefficients and of their error along. */
class DerivativeForms::Planner {
public:
    Planner(DerivativeForms& forms, Shape shape) : m_forms(forms), m_places(storage_places(shape)) {
        const BernsteinTables& x = forms.m_tables;
        forms.m_size = x.size();
        m_position = {{x.size_outer, x.size_mid, x.size_inner}, 0, 1, x.gamma};
    }

    const Column& position() const { return m_position; }

    /** d/deta of the direction: (n/2) (b_{k+1} - b_k). */
    Column derivative(const Column& f, std::size_t direction) {
        const std::size_t degree = f.sizes[m_places[direction]] - 1;
        Matrix matrix{degree, {}};
        const double half = static_cast<double>(degree) / 2;
        for (std::size_t k = 0; k < degree; ++k) {
            matrix.entries.push_back({k, k, -half});
            matrix.entries.push_back({k, k + 1, half});
        }
        return apply(f, direction, matrix);
    }

    Column divided_by_l(const Column& f, std::size_t direction) {
        const std::size_t degree = f.sizes[m_places[direction]] - 1;
        Matrix matrix{degree, {}};
        for (std::size_t k = 0; k < degree; ++k)
            matrix.entries.push_back({k, k, ratio(degree, degree - k)});
        return apply(f, direction, matrix);
    }

    Column times_r(const Column& f, std::size_t direction) {
        const std::size_t raised = f.sizes[m_places[direction]];
        Matrix matrix{raised + 1, {}};
        for (std::size_t k = 1; k <= raised; ++k)
            matrix.entries.push_back({k, k - 1, ratio(k, raised)});
        return apply(f, direction, matrix);
    }

    Column elevated(const Column& f, std::size_t direction) {
        const std::size_t raised = f.sizes[m_places[direction]];
        Matrix matrix{raised + 1, {}};
        for (std::size_t k = 0; k <= raised; ++k) {
            if (k > 0)
                matrix.entries.push_back({k, k - 1, ratio(k, raised)});
            if (k < raised)
                matrix.entries.push_back({k, k, ratio(raised - k, raised)});
        }
        return apply(f, direction, matrix);
    }

    /**
     * The same function by one degree less: b_k = (k/n) c_{k-1} + (1 - k/n) c_k, solved for c from either end to the middle,
     * which keeps the growth of errors least.
     */
    Column reduced(const Column& f, std::size_t direction) {
        const std::size_t n = f.sizes[m_places[direction]] - 1;
        std::vector<std::vector<long double>> rows(n, std::vector<long double>(n + 1, 0));
        const auto real = [](std::size_t i) { return static_cast<long double>(i); };
        const std::size_t middle = (n + 1) / 2;
        for (std::size_t k = 0; k < middle; ++k) {
            rows[k][k] += real(n) / real(n - k);
            for (std::size_t i = 0; k > 0 && i <= n; ++i)
                rows[k][i] -= real(k) / real(n - k) * rows[k - 1][i];
        }
        for (std::size_t k = n; k > middle; --k) {
            rows[k - 1][k] += real(n) / real(k);
            for (std::size_t i = 0; k < n && i <= n; ++i)
                rows[k - 1][i] -= real(n - k) / real(k) * rows[k][i];
        }
        Matrix matrix{n, {}};
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t i = 0; i <= n; ++i)
                if (rows[k][i] != 0)
                    matrix.entries.push_back({k, i, static_cast<double>(rows[k][i])});
        return apply(f, direction, matrix);
    }

    /** Adds the identity's result to f, which is used no more. */
    Column sum(const Column& f, const Column& g) {
        assert(f.sizes == g.sizes);
        Matrix identity{g.sizes[0], {}};
        for (std::size_t k = 0; k < g.sizes[0]; ++k)
            identity.entries.push_back({k, k, 1});
        m_forms.m_steps.push_back({g.sizes, 0, g.sizes[0], g.offset, f.offset, identity.entries});
        return {f.sizes, f.offset, f.bound + g.bound, f.error + g.error + unit * (f.bound + g.bound)};
    }

private:
    static double ratio(std::size_t a, std::size_t b) { return static_cast<double>(a) / static_cast<double>(b); }

    Column apply(const Column& f, std::size_t direction, const Matrix& matrix) {
        const std::size_t place = m_places[direction];
        Column result = f;
        result.sizes[place] = matrix.n_rows;
        result.offset = m_forms.m_size;
        m_forms.m_size += product(result.sizes);
        m_forms.m_steps.push_back({f.sizes, place, matrix.n_rows, f.offset, result.offset, matrix.entries});
        std::vector<double> sums(matrix.n_rows, 0.0);
        std::vector<double> counts(matrix.n_rows, 0.0);
        for (const Entry& entry : matrix.entries) {
            sums[entry.row] += std::abs(entry.value);
            counts[entry.row] += 1;
        }
        const double norm = *std::max_element(sums.begin(), sums.end());
        // A term is rounded in its matrix entry, its product and the additions.
        const double n_roundings = *std::max_element(counts.begin(), counts.end()) + 2;
        result.error = norm * (f.error + n_roundings * unit * (f.bound + f.error)) * (1 + 100 * unit);
        result.bound = norm * f.bound * (1 + 100 * unit) + result.error;
        return result;
    }

    DerivativeForms& m_forms;
    Sizes m_places;
    Column m_position{};
};

DerivativeForms::DerivativeForms(const Space& space) : m_tables(space) {
    assert(dimension(space.shape) == 3 && !is_constant(space));
    Planner plan(*this, space.shape);
    const Column& x = plan.position();
    const auto& order = space.order;
    switch (space.shape) {
    case Shape::hexahedron:
        for (std::size_t direction = 0; direction < 3; ++direction)
            m_columns[direction] = plan.derivative(x, direction);
        break;
    case Shape::prism: {
        const Column d1 = plan.divided_by_l(plan.derivative(x, 0), 2);
        Column third = plan.sum(plan.derivative(x, 2), plan.times_r(d1, 0));
        // Of total degree R - 1 in xi1 and xi3.
        if (order[0] == order[2])
            third = plan.reduced(third, 0);
        m_columns = {d1, plan.derivative(x, 1), third};
        break;
    }
    case Shape::pyramid: {
        const Column d1 = plan.divided_by_l(plan.derivative(x, 0), 2);
        const Column d2 = plan.divided_by_l(plan.derivative(x, 1), 2);
        m_columns = {d1, d2, plan.sum(plan.sum(plan.derivative(x, 2), plan.times_r(d1, 0)), plan.times_r(d2, 1))};
        break;
    }
    case Shape::tetrahedron: {
        const Column d1 = plan.divided_by_l(plan.divided_by_l(plan.derivative(x, 0), 1), 2);
        const Column d2 = plan.divided_by_l(plan.derivative(x, 1), 2);
        const Column r1d1 = plan.times_r(d1, 0);
        const Column r2d2 = plan.times_r(d2, 1);
        Column third = plan.sum(plan.sum(plan.derivative(x, 2), r2d2), plan.elevated(r1d1, 1));
        Column second = plan.sum(d2, r1d1);
        // The derivatives of xi1^a xi2^b xi3^c with a <= P, a + b <= Q, a + b + c <= R; the degree in eta1 is a, in eta2 a + b.
        if (order[0] == order[1])
            second = plan.reduced(second, 0);
        if (order[0] == order[2])
            third = plan.reduced(third, 0);
        if (order[1] == order[2])
            third = plan.reduced(third, 1);
        m_columns = {d1, second, third};
        break;
    }
    case Shape::quadrilateral:
    case Shape::triangle:
        break;
    }
}

} // namespace elvis::native
