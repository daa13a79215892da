#include <core/plugin_host/selected_volume.hpp>

#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/selection_table.hpp>

#include <elvis/demand.h>

#include <memory>
#include <utility>

namespace elvis {

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
    return {Plugin::of_program(table_like<SelectionTable>(whole), whole.plugin().id(), apex_bounds), whole.path(), open};
}

} // namespace elvis
