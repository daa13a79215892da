#include "columns.hpp"
#include "call.hpp"

#include <core/expression/expression.hpp>

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

} // namespace elvis::library
