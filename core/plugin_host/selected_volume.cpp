#include <core/plugin_host/selected_volume.hpp>

#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/selection_table.hpp>

#include <elvis/demand.h>

#include <memory>
#include <utility>

namespace elvis {

namespace {

/** What the whole lacks, a selection lacks, too: the host then finds the same other ways. */
elvis_runtime table_like(const RuntimeVolume& whole) {
    elvis_runtime table = *api::runtime_table<SelectionTable>();
    if (!whole.has_field_ranges()) {
        table.get_field_ranges = nullptr;
    }
    if (!whole.has_derivative_bounds()) {
        table.get_field_derivative_bounds = nullptr;
    }
    if (!whole.has_jacobian_checks()) {
        table.check_jacobians = nullptr;
    }
    if (!whole.has_evaluation()) {
        table.evaluate_mapping = nullptr;
        table.evaluate_field = nullptr;
    }
    return table;
}

} // namespace

bool can_select(const RuntimeVolume& whole) {
    for (std::uint32_t index = 0; index < whole.classes().size(); ++index) {
        if ((whole.snippet(index).capabilities & ELVIS_SNIPPET_ELEMENT_RECORDS) == 0) {
            return false;
        }
    }
    return true;
}

RuntimeVolume selected_volume(const RuntimeVolume& whole, std::vector<std::uint64_t> elements, SelectedFaces faces) {
    const elvis_apex_bounds* const apex_bounds = whole.has_apex_bounds() ? api::apex_bounds_table<SelectionTable>() : nullptr;
    const auto open = [&](const elvis_host* host) {
        return reinterpret_cast<elvis_volume*>(new SelectionTable(api::Host(host), whole, std::move(elements), faces));
    };
    return {Plugin::of_program(table_like(whole), whole.plugin().id(), apex_bounds), whole.path(), open};
}

} // namespace elvis
