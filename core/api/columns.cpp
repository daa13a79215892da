#include "columns.hpp"
#include "call.hpp"

#include <core/expression/expression.hpp>
#include <core/probe/cpu_evaluator.hpp>

namespace elvis::library {

Columns columns_of(const RuntimeVolume& volume, const elvis_string* fields, std::uint32_t n_fields) {
    Columns all;
    all.wishes.fields.emplace(volume.fields().size(), false);
    if (n_fields > 0) {
        need(fields, "fields");
    }
    for (std::uint32_t index = 0; index < n_fields; ++index) {
        need(fields[index], "fields");
        Column column;
        for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
            if (volume.fields()[field].name == fields[index]) {
                column = {field, 0, true, volume.fields()[field].n_components};
                (*all.wishes.fields)[field] = true;
            }
        }
        if (!column.is_field) {
            column.expression = all.wishes.expressions.size();
            all.wishes.expressions.push_back(
                std::make_shared<const Expression>(fields[index], volume.fields(), volume.dimension()));
        }
        all.n_values += column.n_values;
        all.columns.push_back(column);
    }
    return all;
}

std::vector<std::vector<double>> values_at(const RuntimeVolume& volume, const Columns& columns, std::uint32_t time_step,
                                           const std::vector<ReferencePoint>& points) {
    CpuEvaluator evaluator(volume);
    std::vector<std::vector<double>> values(points.size());
    for (const Column& column : columns.columns) {
        if (column.is_field) {
            const std::vector<FieldSample> samples = evaluator.evaluate(column.field, time_step, points, false);
            for (std::size_t i = 0; i < points.size(); ++i) {
                values[i].insert(values[i].end(), samples[i].values.begin(), samples[i].values.end());
            }
        } else {
            const std::vector<ExpressionSample> samples =
                evaluator.evaluate(columns.wishes.expressions[column.expression], time_step, points, false);
            for (std::size_t i = 0; i < points.size(); ++i) {
                values[i].push_back(samples[i].value);
            }
        }
    }
    return values;
}

} // namespace elvis::library
