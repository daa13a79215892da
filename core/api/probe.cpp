#include "call.hpp"
#include "columns.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace elvis::library {

namespace {

/** Writes the answers of one point into the caller's arrays. */
class Writer {
public:
    Writer(const elvis_probe& probe, const Columns& columns) : m_probe(probe), m_columns(columns) {}

    void write(std::uint64_t at, const ProbedPoint& point) {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        if (m_probe.elements != nullptr) {
            m_probe.elements[at] = point.element ? *point.element : point.n_failures > 0 ? -2 : -1;
        }
        if (m_probe.n_failures != nullptr) {
            m_probe.n_failures[at] = point.n_failures;
        }
        for (std::size_t axis = 0; m_probe.xi != nullptr && axis < 3; ++axis) {
            m_probe.xi[3 * at + axis] = point.element ? point.xi[axis] : nan;
        }
        for (std::uint32_t index = 0; m_probe.also != nullptr && index < m_probe.most_also; ++index) {
            m_probe.also[at * m_probe.most_also + index] = index < point.also.size() ? point.also[index] : -1;
        }
        m_at = at * m_columns.n_values;
        for (const Column& column : m_columns.columns) {
            for (std::uint32_t component = 0; component < column.n_values; ++component) {
                if (!point.element) {
                    put(nan, {nan, nan, nan}, 0);
                } else if (column.is_field) {
                    const FieldSample& sample = point.fields[column.field];
                    put(sample.values[component], gradient_of(sample, component),
                        sample.gradient_is_estimated ? ELVIS_ESTIMATED_GRADIENT : 0);
                } else {
                    const ExpressionSample& sample = point.expressions[column.expression];
                    put(sample.value, sample.gradient,
                        (sample.value_is_estimated ? ELVIS_ESTIMATED_VALUE : 0) |
                            (sample.gradient_is_estimated ? ELVIS_ESTIMATED_GRADIENT : 0));
                }
            }
        }
    }

private:
    static Vector3 gradient_of(const FieldSample& sample, std::uint32_t component) {
        const std::size_t first = 3 * std::size_t{component};
        return sample.gradients.empty()
                   ? Vector3{}
                   : Vector3{sample.gradients[first], sample.gradients[first + 1], sample.gradients[first + 2]};
    }
    void put(double value, const Vector3& gradient, std::uint32_t estimated) {
        if (m_probe.values != nullptr) {
            m_probe.values[m_at] = value;
        }
        for (std::size_t axis = 0; m_probe.gradients != nullptr && axis < 3; ++axis) {
            m_probe.gradients[3 * m_at + axis] = gradient[axis];
        }
        if (m_probe.estimated != nullptr) {
            m_probe.estimated[m_at] = static_cast<std::uint8_t>(estimated);
        }
        ++m_at;
    }

    const elvis_probe& m_probe;
    const Columns& m_columns;
    std::uint64_t m_at = 0;
};

/**
 * Points that are asked for at once: few at first, so that a task soon says how far it is; then each time twice as many, until
 * many are in each element, which takes some 40 MB.
 */
constexpr std::uint64_t least_block = 1u << 13, most_block = 1u << 17;

void probe_all(Data& data, const elvis_probe& probe) {
    check_time_step(data.volume, probe.time_step);
    if (probe.evaluation > ELVIS_EVALUATION_DEVICE) {
        throw InvalidArgument("evaluation", "is not known");
    }
    Columns columns = columns_of(data.volume, probe.fields, probe.n_fields);
    columns.wishes.with_gradients = probe.gradients != nullptr || probe.estimated != nullptr;
    Prober& prober = data.prober(static_cast<ProbeOptions::Evaluation>(probe.evaluation));
    Writer writer(probe, columns);
    std::vector<Vector3> positions;
    for (std::uint64_t first = 0, block = least_block; first < probe.n_points;
         first += block, block = std::min(2 * block, most_block)) {
        data.control->check();
        data.control->progress(static_cast<double>(first) / static_cast<double>(probe.n_points), "probing");
        const std::uint64_t n = std::min(block, probe.n_points - first);
        positions.clear();
        for (std::uint64_t point = first; point < first + n; ++point) {
            positions.push_back({probe.positions[3 * point], probe.positions[3 * point + 1], probe.positions[3 * point + 2]});
        }
        const std::vector<ProbedPoint> points = prober.probe(positions, probe.time_step, columns.wishes);
        for (std::uint64_t point = 0; point < n; ++point) {
            writer.write(first + point, points[point]);
        }
    }
}

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_data_count_values(elvis_data* data, const elvis_string* fields, uint32_t n_fields, uint32_t* n_values) {
    return call(data, [&] {
        need(n_values, "n_values");
        *n_values = columns_of(data->state->volume, fields, n_fields).n_values;
    });
}

elvis_result elvis_data_probe(elvis_data* data, const elvis_probe* probe, const elvis_task* task) {
    return call(data, [&] {
        const elvis_probe known = known_part(probe, "probe");
        if (known.n_points > 0) {
            need(known.positions, "positions");
        }
        const DataTask running(*data->state, task);
        probe_all(*data->state, known);
    });
}
