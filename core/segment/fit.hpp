/**
 * @file fit.hpp
 * Samples to polynomial, one sample at a time: the CPU's twin of shaders/segments/fit.glsl, where the method and the
 * error estimate are explained.
 */
#pragma once

#include <core/segment/polynomial.hpp>

namespace elvis::segment {

enum class FitStatus : std::uint32_t {
    wants = 0,
    done = 1,
    /** Not good enough: halve the segment, or go on with the fit and its error. */
    split = 2,
    /** A sample was NaN or infinite. */
    not_finite = 3
};

/** From the last two coefficients to the two behind them. Faster decay is not believed, slower decay is none. */
template <class Real> constexpr Real fastest_decay = Real(0.25);
template <class Real> constexpr Real slowest_decay = Real(0.75);

template <class Real> struct Fit {
    /** In the basis T_k(2 t - 1), filled with zeros to the plan's degree. */
    Polynomial<Real> chebyshev;
    /** Between field and polynomial, arithmetic on its Bernstein form included. */
    Real error = 0;
    int degree = 0;
};

template <class Real> class FitSamples {
public:
    /** The plan must outlive it. */
    explicit FitSamples(SamplePlan&&) = delete;
    explicit FitSamples(const SamplePlan& plan) : m_plan(&plan) { m_samples.resize(plan.parameters.size()); }

    FitStatus status() const { return m_status; }
    std::size_t n_samples() const { return m_n_samples; }
    /** Where the next sample is wanted. */
    Real parameter() const { return static_cast<Real>(m_plan->parameters[m_n_samples]); }

    /** `value` at parameter(), with an absolute error of `sample_error` at most. */
    void add(Real value, Real sample_error, Real tolerance) {
        m_samples[m_n_samples] = value;
        m_n_samples += 1;
        m_sample_error = std::max(m_sample_error, sample_error);
        m_status = m_n_samples == m_samples.size() ? FitStatus::split : FitStatus::wants;
        for (const Level& level : m_plan->levels) {
            if (m_n_samples == static_cast<std::size_t>(level.n_samples) && fit(level).error <= tolerance) {
                m_status = FitStatus::done;
            }
        }
        if (!std::isfinite(value)) {
            m_status = FitStatus::not_finite;
        }
    }

    /** The highest degree that the samples allow to judge. */
    Fit<Real> fit() const {
        Fit<Real> best;
        best.chebyshev.degree = m_plan->degree;
        for (const Level& level : m_plan->levels) {
            if (m_n_samples >= static_cast<std::size_t>(level.n_samples)) {
                best = fit(level);
            }
        }
        return best;
    }

    /** One half (0 or 1), with the samples at its ends; the third sample must be at 1/2. */
    FitSamples half(int which) const {
        FitSamples half(*m_plan);
        half.m_samples[0] = m_samples[which == 0 ? 0 : 2];
        half.m_samples[1] = m_samples[which == 0 ? 2 : 1];
        half.m_n_samples = 2;
        half.m_sample_error = m_sample_error;
        return half;
    }

private:
    Real product(const std::vector<double>& row) const {
        Real sum = 0;
        for (std::size_t i = 0; i < m_samples.size(); ++i) {
            sum += static_cast<Real>(row[i]) * m_samples[i];
        }
        return sum;
    }

    Fit<Real> fit(const Level& level) const {
        Fit<Real> fit;
        fit.degree = level.degree;
        fit.chebyshev.degree = m_plan->degree;
        // Of the coefficient at hand, and together with the one before.
        Real size = 0, last = 0;
        for (int k = 0; k <= level.degree; ++k) {
            fit.chebyshev[k] = product(level.fit[static_cast<std::size_t>(k)]);
            last = size + std::abs(fit.chebyshev[k]);
            size = std::abs(fit.chebyshev[k]);
        }
        Real misfit = 0;
        for (const std::vector<double>& row : level.misfit) {
            misfit += std::abs(product(row));
        }
        const Real ratio = std::clamp(misfit < last ? misfit / last : Real(1), fastest_decay<Real>, slowest_decay<Real>);
        // Lebesgue constant: at most 1 + 2 / pi log(n + 1) (Trefethen, theorem 15.2).
        fit.error = misfit / (1 - ratio) + Real(2.75) * m_sample_error + bernstein_rounding(fit.chebyshev);
        return fit;
    }

    const SamplePlan* m_plan;
    std::vector<Real> m_samples;
    std::size_t m_n_samples = 0;
    FitStatus m_status = FitStatus::wants;
    Real m_sample_error = 0;
};

} // namespace elvis::segment
