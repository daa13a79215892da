#include <core/integrate/integral.hpp>

#include <core/base/background.hpp>
#include <core/base/error.hpp>
#include <core/base/in_parts.hpp>
#include <core/integrate/domain_parts.hpp>
#include <core/integrate/polynomial_degree.hpp>
#include <core/plugin_host/plugin.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

namespace elvis {

namespace {

using Expressions = std::vector<std::shared_ptr<const Expression>>;

/** Vectors in the plane have none. */
bool has_third_component(const RuntimeVolume& volume, const std::string& vector) {
    if (volume.dimension() == 3) {
        return true;
    }
    try {
        const Expression third("(" + vector + ")[2]", volume.fields(), 2);
        return true;
    } catch (const Error&) {
        return false;
    }
}

/** None for the number 1; the components of a vector if its flux is wanted. */
Expressions integrand_of(const RuntimeVolume& volume, const IntegralRequest& request) {
    Expressions expressions;
    const auto add = [&](const std::string& text) {
        expressions.push_back(std::make_shared<const Expression>(text, volume.fields(), volume.dimension()));
    };
    if (request.is_flux) {
        add("(" + request.field + ")[0]");
        add("(" + request.field + ")[1]");
        add(has_third_component(volume, request.field) ? "(" + request.field + ")[2]" : "0");
    } else if (!request.field.empty()) {
        add(request.field);
    }
    return expressions;
}

/** What another volume's elements hold is smooth in these alone: dividing finds their faces slowly, and each point takes a
 * search. */
constexpr unsigned most_depth_by_place = 1;

bool is_by_place(const RuntimeVolume& volume, const Expressions& expressions) {
    return std::ranges::any_of(expressions, [&](const auto& expression) {
        return std::ranges::any_of(expression->fields(),
                                   [&](std::uint32_t field) { return volume.fields()[field].is_by_place; });
    });
}

Integrand::Kind kind_of(const Expressions& expressions) {
    return expressions.empty()       ? Integrand::Kind::one
           : expressions.size() == 1 ? Integrand::Kind::scalar
                                     : Integrand::Kind::flux;
}

/** What rules the parts of one class take. */
class Rules {
public:
    Rules(const RuntimeVolume& volume, const IntegralRequest& request, const Expressions& integrand)
        : m_is_boundary(request.domain == IntegralRequest::Domain::boundary), m_is_flux(request.is_flux),
          m_is_by_place(is_by_place(volume, integrand)) {
        for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
            m_rules.push_back(of_class(volume, index, integrand));
        }
    }
    const PartRule& of(const DomainPart& part) const { return m_rules[part.element_class]; }

private:
    /** Points that integrate this degree in each collapsed coordinate, and up to 2 of what collapses. */
    static unsigned points_for(unsigned degree) { return std::min(most_gauss_points - 2, degree / 2 + 2); }

    PartRule of_class(const RuntimeVolume& volume, std::uint32_t index, const Expressions& integrand) const {
        const ClassInfo& info = volume.classes()[index];
        const std::optional<unsigned> mapping = mapping_degree(volume, index);
        unsigned degree = 0;
        bool is_polynomial = mapping.has_value();
        for (const auto& expression : integrand) {
            const std::optional<unsigned> of_expression = polynomial_degree(*expression, volume, index);
            is_polynomial = is_polynomial && of_expression;
            degree = std::max(degree, of_expression.value_or(default_degree));
        }
        const unsigned of_measure = (m_is_boundary ? 2 : 3) * mapping.value_or(default_degree);
        // Lengths of vectors are no polynomials, unless they are constant.
        const bool is_volume = !m_is_boundary && volume.dimension() == 3;
        PartRule rule;
        rule.is_measure_exact = mapping && (is_volume || info.is_affine);
        rule.is_value_exact = is_polynomial && (is_volume || info.is_affine || (m_is_flux && volume.dimension() == 3));
        rule.n_points = points_for(degree + of_measure);
        const bool is_one_exact = integrand.empty() && rule.is_measure_exact;
        rule.is_value_exact = integrand.empty() ? is_one_exact : rule.is_value_exact;
        // What is not exact begins with less, and is divided.
        rule.n_points =
            rule.is_value_exact && rule.is_measure_exact ? rule.n_points : std::min(rule.n_points, most_adaptive_points);
        rule.most_depth = m_is_by_place ? most_depth_by_place : rule.most_depth;
        rule.is_value_exact = rule.is_value_exact && degree + of_measure <= 2 * rule.n_points - 3;
        return rule;
    }

    static constexpr unsigned default_degree = 4;
    static constexpr unsigned most_adaptive_points = 16;
    bool m_is_boundary, m_is_flux, m_is_by_place;
    std::vector<PartRule> m_rules;
};

/** One integral: all parts once, then those again that are off too much. */
class Integration {
public:
    Integration(const RuntimeVolume& volume, const IntegralRequest& request, const TaskControl& control)
        : m_volume(volume), m_request(request), m_control(control), m_expressions(integrand_of(volume, request)),
          m_sampler(volume, m_expressions, request.time_step), m_integrand(m_sampler, kind_of(m_expressions)),
          m_rules(volume, request, m_expressions), m_parts(domain_parts(volume, request, control)) {
        const bool has_level =
            request.domain == IntegralRequest::Domain::plane || request.domain == IntegralRequest::Domain::isosurface;
        if (has_level) {
            m_level = level_set(volume, request);
            m_level_sampler.emplace(volume, Expressions{m_level->expression}, request.time_step);
            m_parts = met_parts(volume, request, *m_level, std::move(m_parts));
        }
        m_sums.resize(m_parts.size());
        const auto needs_facts = [](const auto& expression) { return expression->needs_element_facts(); };
        m_is_one_at_a_time = std::ranges::any_of(m_expressions, needs_facts) || (m_level && needs_facts(m_level->expression));
    }

    Integral find() {
        std::vector<std::size_t> chosen(m_parts.size());
        for (std::size_t index = 0; index < chosen.size(); ++index) {
            chosen[index] = index;
        }
        sum(chosen, {}, "integrating");
        const Integral first = total();
        const bool has_searches = is_by_place(m_volume, m_expressions);
        if (has_searches && std::isnan(first.value)) {
            throw Error(m_request.field,
                        "has no integral: parts of what it is integrated over lie outside of the volume in which "
                        "its fields are found by place");
        }
        const auto n_parts = static_cast<double>(std::max<std::uint64_t>(1, first.n_parts));
        SumTolerance tolerance{m_request.tolerance * m_size / n_parts, m_request.tolerance * first.measure / n_parts};
        std::erase_if(chosen, [&](std::size_t index) {
            return m_sums[index].value_error <= tolerance.value && m_sums[index].measure_error <= tolerance.measure;
        });
        if (has_searches && m_level) {
            tolerance.value = std::numeric_limits<double>::infinity();
        }
        sum(chosen, tolerance, "refining");
        return total();
    }

private:
    void sum(const std::vector<std::size_t>& chosen, const SumTolerance& tolerance, const char* activity) {
        constexpr std::uint64_t some_parts = 16;
        const std::uint64_t parts_at_once = m_is_one_at_a_time ? std::max<std::uint64_t>(1, chosen.size()) : some_parts;
        std::atomic<std::uint64_t> n_evaluations = 0, n_done = 0;
        const auto check = [&] {
            m_control.check();
            m_control.progress(static_cast<double>(n_done.load()) / static_cast<double>(chosen.size()), activity);
        };
        in_parts(
            m_background, chosen.size(), parts_at_once,
            [&](std::uint64_t first, std::uint64_t count) {
                std::uint64_t n = 0;
                for (std::uint64_t at = first; at < first + count; ++at) {
                    m_control.check();
                    m_sums[chosen[at]] = of_part(m_parts[chosen[at]], tolerance, n);
                }
                n_evaluations += n;
                n_done += count;
            },
            check);
        m_n_evaluations += n_evaluations;
    }

    PartSums of_part(const DomainPart& part, const SumTolerance& tolerance, std::uint64_t& n_evaluations) const {
        return m_level ? integrate_level(m_integrand, part, *m_level_sampler, m_level->isovalue, tolerance, n_evaluations)
                       : integrate_part(m_integrand, part, m_rules.of(part), tolerance, n_evaluations);
    }

    /** In the order of the parts, whoever summed them: the same bits each time. */
    Integral total() {
        Integral integral;
        long double value = 0, size = 0, measure = 0, value_error = 0, measure_error = 0;
        integral.is_exact = !m_level && !m_parts.empty();
        for (std::size_t index = 0; index < m_parts.size(); ++index) {
            const PartSums& sums = m_sums[index];
            value += sums.sums.value;
            size += sums.sums.size;
            measure += sums.sums.measure;
            value_error += sums.value_error;
            measure_error += sums.measure_error;
            integral.n_unresolved += sums.n_unresolved;
            integral.n_inverted += sums.sums.is_inverted ? 1 : 0;
            integral.n_parts += sums.sums.measure > 0 ? 1 : 0;
            integral.is_exact = integral.is_exact && m_rules.of(m_parts[index]).is_value_exact;
        }
        m_size = static_cast<double>(size);
        integral.value = static_cast<double>(value);
        integral.measure = static_cast<double>(measure);
        integral.error = static_cast<double>(value_error) + sum_rounding * m_size;
        integral.measure_error = static_cast<double>(measure_error) + sum_rounding * integral.measure;
        integral.is_converged = integral.error <= std::max(m_request.tolerance, 2 * sum_rounding) * m_size &&
                                integral.measure_error <= std::max(m_request.tolerance, 2 * sum_rounding) * integral.measure;
        integral.n_evaluations = m_n_evaluations;
        return integral;
    }

    const RuntimeVolume& m_volume;
    const IntegralRequest& m_request;
    const TaskControl& m_control;
    Expressions m_expressions;
    ElementSampler m_sampler;
    Integrand m_integrand;
    Rules m_rules;
    std::vector<DomainPart> m_parts;
    std::optional<LevelSet> m_level;
    std::optional<ElementSampler> m_level_sampler;
    std::vector<PartSums> m_sums;
    bool m_is_one_at_a_time = false;
    double m_size = 0;
    std::uint64_t m_n_evaluations = 0;
    Background m_background{std::max(1u, std::thread::hardware_concurrency())};
};

} // namespace

Integral integrate(const RuntimeVolume& volume, const IntegralRequest& request, const TaskControl& control) {
    if (!volume.has_evaluation()) {
        throw Error(volume.path(), "the plugin " + volume.plugin().id() + " cannot evaluate on the CPU, which integrals need");
    }
    if (volume.is_cut()) {
        throw Error(volume.path(),
                    "has elements that are only parts of their reference shape, over which integrals are not computed");
    }
    if (request.is_flux && request.domain == IntegralRequest::Domain::volume) {
        throw UsageError(volume.path(), "a flux goes through a boundary, a plane or an isosurface, not through a volume");
    }
    if (request.time_step >= volume.times().size()) {
        throw UsageError(volume.path(), "there is no time step " + std::to_string(request.time_step) + "; the volume has " +
                                            std::to_string(volume.times().size()));
    }
    return Integration(volume, request, control).find();
}

} // namespace elvis
