#include <core/base/error.hpp>
#include <core/convert/projection/field_plan.hpp>

namespace elvis {

std::vector<FieldPlan> plan_fields(const SourceVolume& source, const ConvertOptions& options) {
    std::vector<FieldPlan> all;
    std::size_t first_value = 0;
    for (std::uint32_t index = 0; index < source.fields().size(); ++index) {
        const SourceField& field = source.fields()[index];
        all.push_back({index, first_value, field.n_components, options.continuity.value_or(field.continuity), field.transform});
        first_value += field.n_components;
    }
    if (options.fields.empty()) {
        return all;
    }
    std::vector<FieldPlan> chosen;
    for (const std::string& name : options.fields) {
        const auto found =
            std::ranges::find_if(all, [&](const FieldPlan& plan) { return source.fields()[plan.source_index].name == name; });
        if (found == all.end()) {
            std::string known;
            for (const SourceField& field : source.fields()) {
                known += (known.empty() ? "" : ", ") + field.name;
            }
            throw Error(source.paths().front(),
                        "has no field '" + name + "'; its fields are: " + (known.empty() ? "none" : known));
        }
        if (std::ranges::any_of(chosen, [&](const FieldPlan& other) { return other.source_index == found->source_index; })) {
            throw Error(source.paths().front(), "field '" + name + "' is asked for twice");
        }
        chosen.push_back(*found);
    }
    return chosen;
}

} // namespace elvis
