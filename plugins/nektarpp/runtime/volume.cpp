#include "volume.hpp"

#include "faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nektarpp {

namespace native = elvis::native;

namespace {

/** Elements between two looks at the user's wish to stop. */
constexpr std::uint64_t elements_at_once = 1024;

/** Half a unit in the last place of single precision. */
constexpr double single_rounding = 6e-8;
/** What rounding moves positions by at most, relative to the sum of coefficients: 64 units in the last place. */
constexpr double evaluation_rounding = 1.5e-14;

/** Sum of coefficients times modes, and of their derivatives, at one point. */
struct Sum {
    double value = 0;
    native::Point gradient{};
};

} // namespace

/** The coefficients of one field at one step, in the order of each class's space. */
class Volume::FieldReader {
public:
    FieldReader(Volume& volume, std::size_t field, std::size_t step)
        : m_volume(volume), m_field(field), m_file(volume.m_series.step(step)) {}

    /** Zero where a space has more modes than the file, NaN where the file has no data. */
    std::span<const double> operator()(const ElementClass& of, std::uint64_t position) {
        const std::uint64_t element = m_volume.m_classes.number_of[position];
        const Space& space = of.fields[m_field];
        const ModeSet* modes = m_file->modes(m_field, element);
        if (&space != m_space || modes != m_modes) {
            m_space = &space;
            m_modes = modes;
            m_places = modes ? native_modes(*modes, space) : std::vector<std::size_t>();
            m_coefficients.assign(native::n_modes(space), modes ? 0 : std::numeric_limits<double>::quiet_NaN());
        }
        if (modes) {
            const std::span<const double> from = m_file->coefficients(m_field, element);
            for (std::size_t mode = 0; mode < from.size(); ++mode) {
                m_coefficients[m_places[mode]] = from[mode];
            }
        }
        return m_coefficients;
    }

private:
    Volume& m_volume;
    std::size_t m_field;
    std::shared_ptr<const FieldFile> m_file;
    const Space* m_space = nullptr;
    const ModeSet* m_modes = nullptr;
    std::vector<std::size_t> m_places;
    std::vector<double> m_coefficients;
};

Volume::Volume(const elvis::api::Host& host, Input input)
    : m_host(host), m_mesh(input.geometry), m_series(host, std::move(input.steps), m_mesh, FieldContent::modes),
      m_classes(m_mesh, m_series), m_faces(find_faces(m_mesh)) {
    for (elvis_face& face : m_faces) {
        for (std::int64_t* element : {&face.element, &face.neighbour}) {
            if (*element >= 0) {
                *element = static_cast<std::int64_t>(m_classes.position_of[static_cast<std::size_t>(*element)]);
            }
        }
    }
}

template <class Visit> void Volume::for_each_element(std::uint64_t first, std::uint64_t count, Visit visit) const {
    for (std::uint64_t position = first; position < first + count;) {
        const ElementClass& of = m_classes.at_position(position);
        const std::uint64_t end = std::min(first + count, of.first + of.n_elements);
        for (; position < end; ++position) {
            if ((position - first) % elements_at_once == 0) {
                m_host.check_cancelled();
            }
            visit(of, position);
        }
    }
}

void Volume::bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) const {
    const ElementClass* before = nullptr;
    std::optional<native::RangeBounder> bounder;
    std::vector<double> coefficients;
    for_each_element(first, count, [&](const ElementClass& of, std::uint64_t position) {
        if (&of != before) {
            before = &of;
            bounder.emplace(of.geometry);
        }
        m_mesh.mapping_coefficients(element(position), coefficients);
        const std::size_t n_modes = coefficients.size() / 3;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto own = std::span(coefficients).subspan(axis * n_modes, n_modes);
            const native::Range range = (*bounder)(own);
            double size = 0;
            for (const double coefficient : own) {
                size += std::abs(coefficient);
            }
            bounds[6 * (position - first) + axis] = range.lower - evaluation_rounding * size;
            bounds[6 * (position - first) + 3 + axis] = range.upper + evaluation_rounding * size;
        }
    });
}

void Volume::field_ranges(std::size_t field, std::size_t step, std::uint64_t first, std::uint64_t count,
                          std::span<double> ranges) {
    FieldReader read(*this, field, step);
    const ElementClass* before = nullptr;
    std::optional<native::RangeBounder> bounder;
    for_each_element(first, count, [&](const ElementClass& of, std::uint64_t position) {
        if (&of != before) {
            before = &of;
            bounder.emplace(of.fields[field]);
        }
        const native::Range range = (*bounder)(read(of, position));
        ranges[2 * (position - first)] = range.lower;
        ranges[2 * (position - first) + 1] = range.upper;
    });
}

native::Extrema Volume::extrema(std::size_t field, std::size_t step) {
    std::vector<Space> spaces;
    for (const ElementClass& of : classes()) {
        spaces.push_back(of.fields[field]);
    }
    native::ExtremaSearch search(spaces, 1);
    FieldReader read(*this, field, step);
    for_each_element(0, numbers().size(), [&](const ElementClass& of, std::uint64_t position) {
        search.add(static_cast<std::size_t>(&of - classes().data()), position - of.first, 1, read(of, position));
    });
    return search.finish([&](std::size_t index, std::uint64_t first, std::uint64_t count, std::span<double> coefficients) {
        const ElementClass& of = classes()[index];
        for (std::uint64_t local = first; local < first + count; ++local) {
            std::ranges::copy(read(of, of.first + local),
                              coefficients.begin() +
                                  static_cast<std::ptrdiff_t>((local - first) * coefficients.size() / count));
        }
    })[0];
}

Volume::Derivatives::Derivatives(const Space& space, native::SecondDerivatives second) : bounder(space, second) {
    std::vector<double> unit(native::n_modes(space), 0.0);
    for (double& coefficient : unit) {
        coefficient = 1;
        of_modes.push_back(bounder(unit));
        coefficient = 0;
    }
}

const Volume::Derivatives& Volume::derivatives(const Space& space, native::SecondDerivatives second) const {
    const std::lock_guard lock(m_mutex);
    for (const KnownDerivatives& known : m_derivatives) {
        if (known.space == space && known.second == second) {
            return *known.derivatives;
        }
    }
    m_derivatives.push_back({space, second, std::make_unique<const Derivatives>(space, second)});
    return *m_derivatives.back().derivatives;
}

double Volume::largest_coefficient(std::size_t field, std::size_t step) {
    const std::lock_guard lock(m_mutex);
    const auto [found, is_new] = m_largest.try_emplace({field, step}, 0.0);
    if (is_new) {
        const std::shared_ptr<const FieldFile> file = m_series.step(step);
        for (std::uint64_t element = 0; element < m_mesh.elements().size(); ++element) {
            if (file->modes(field, element)) {
                for (const double coefficient : file->coefficients(field, element)) {
                    // Not of NaN.
                    found->second = std::abs(coefficient) > found->second ? std::abs(coefficient) : found->second;
                }
            }
        }
    }
    return found->second;
}

void Volume::derivative_bounds(std::size_t field, std::size_t step, native::SecondDerivatives second, std::uint64_t first,
                               std::uint64_t count, std::span<double> bounds) {
    FieldReader read(*this, field, step);
    // The device rounds coefficients after an offset has been subtracted, one of the field's values: at most twice the largest
    // coefficient in bases with vertices or nodes, whose coefficients there are values.
    const double largest_offset = 2 * largest_coefficient(field, step);
    const ElementClass* before = nullptr;
    const Derivatives* known = nullptr;
    std::vector<double> one;
    for_each_element(first, count, [&](const ElementClass& of, std::uint64_t position) {
        if (&of != before) {
            before = &of;
            known = &derivatives(of.fields[field], second);
            one = Record(of.fields[field], 1).one();
        }
        const std::span<const double> coefficients = read(of, position);
        native::DerivativeBound bound = known->bounder(coefficients);
        for (std::size_t mode = 0; mode < coefficients.size(); ++mode) {
            const double rounding = single_rounding * (std::abs(coefficients[mode]) + std::abs(one[mode]) * largest_offset);
            bound.first += rounding * known->of_modes[mode].first;
            // Not known of some modes: then neither is that of any sum with them.
            bound.second += rounding == 0 ? 0 : rounding * known->of_modes[mode].second;
        }
        bounds[2 * (position - first)] = bound.first;
        bounds[2 * (position - first) + 1] = bound.second;
    });
}

void Volume::check_jacobians(std::uint64_t first, double tolerance, std::span<native::JacobianCheck> checks) const {
    const ElementClass* before = nullptr;
    std::optional<native::JacobianChecker> checker;
    std::vector<double> coefficients;
    for_each_element(first, checks.size(), [&](const ElementClass& of, std::uint64_t position) {
        if (&of != before) {
            before = &of;
            checker.emplace(of.geometry, native::JacobianOptions{.tolerance = tolerance});
        }
        m_mesh.mapping_coefficients(element(position), coefficients);
        (*checker)(coefficients, checks.subspan(position - first, 1));
    });
}

void Volume::fill_geometry(std::uint64_t first, std::uint64_t count, const double* origins, double* records) const {
    const ElementClass* before = nullptr;
    std::optional<Record> record;
    std::vector<double> coefficients;
    for_each_element(first, count, [&](const ElementClass& of, std::uint64_t position) {
        if (&of != before) {
            before = &of;
            record.emplace(of.geometry, 3);
        }
        std::fill_n(records, record->size(), 0.0);
        m_mesh.mapping_coefficients(element(position), coefficients);
        const std::size_t n_modes = coefficients.size() / 3;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double origin = origins ? origins[3 * position + axis] : 0;
            record->write(std::span(coefficients).subspan(axis * n_modes, n_modes), origin, axis, records);
        }
        records += record->size();
    });
}

void Volume::fill_field(std::size_t field, std::size_t step, std::uint64_t first, std::uint64_t count, double offset,
                        double* records) {
    FieldReader read(*this, field, step);
    const ElementClass* before = nullptr;
    std::optional<Record> record;
    for_each_element(first, count, [&](const ElementClass& of, std::uint64_t position) {
        if (&of != before) {
            before = &of;
            record.emplace(of.fields[field], 1);
        }
        std::fill_n(records, record->size(), 0.0);
        record->write(read(of, position), offset, 0, records);
        records += record->size();
    });
}

namespace {

/** Sums at each point: `n_sums` sets of coefficients one after the other. */
template <class Use>
void evaluate(const Space& space, std::span<const double> coefficients, std::span<const double> xi, Use use) {
    const std::size_t n_modes = native::n_modes(space);
    std::vector<double> values(n_modes), gradients(3 * n_modes);
    for (std::size_t point = 0; point < xi.size() / 3; ++point) {
        native::evaluate_modes(space, {xi[3 * point], xi[3 * point + 1], xi[3 * point + 2]}, values, gradients);
        for (std::size_t of = 0; of < coefficients.size() / n_modes; ++of) {
            Sum sum;
            for (std::size_t mode = 0; mode < n_modes; ++mode) {
                const double coefficient = coefficients[of * n_modes + mode];
                sum.value += coefficient * values[mode];
                for (std::size_t direction = 0; direction < 3; ++direction) {
                    sum.gradient[direction] += coefficient * gradients[3 * mode + direction];
                }
            }
            use(point, of, sum);
        }
    }
}

} // namespace

void Volume::evaluate_mapping(std::uint64_t position, std::span<const double> xi, double* positions, double* jacobians) const {
    std::vector<double> coefficients;
    m_mesh.mapping_coefficients(element(position), coefficients);
    evaluate(m_classes.at_position(position).geometry, coefficients, xi,
             [&](std::size_t point, std::size_t axis, const Sum& sum) {
                 if (positions) {
                     positions[3 * point + axis] = sum.value;
                 }
                 if (jacobians) {
                     std::ranges::copy(sum.gradient, jacobians + 9 * point + 3 * axis);
                 }
             });
}

void Volume::evaluate_field(std::size_t field, std::size_t step, std::uint64_t position, std::span<const double> xi,
                            double* values, double* gradients) {
    FieldReader read(*this, field, step);
    const ElementClass& of = m_classes.at_position(position);
    evaluate(of.fields[field], read(of, position), xi, [&](std::size_t point, std::size_t, const Sum& sum) {
        if (values) {
            values[point] = sum.value;
        }
        if (gradients) {
            std::ranges::copy(sum.gradient, gradients + 3 * point);
        }
    });
}

} // namespace nektarpp
