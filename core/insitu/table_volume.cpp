#include "table_volume.hpp"

#include <core/api/call.hpp>
#include <core/plugin_host/plugin.hpp>

#include <numeric>

namespace elvis::library {

TableVolume::TableVolume(const elvis_runtime& table, elvis_volume* volume, const std::string& name)
    : m_volume(Plugin::of_program(table, name), volume, name) {
    if (m_volume.times().size() > 1) {
        throw InvalidArgument("runtime", "has more than one time step; it shows the one at which the solver is");
    }
}

void TableVolume::set_values(std::uint32_t, std::uint32_t, const double*) {
    throw InvalidArgument("field", "has its values from the table's functions; only those of arrays can be at another place");
}

std::vector<std::uint32_t> TableVolume::share_values() {
    std::vector<std::uint32_t> all(m_volume.fields().size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

} // namespace elvis::library
