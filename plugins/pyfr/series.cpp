#include "series.hpp"

#include <elvis/plugin.hpp>

namespace elvis_pyfr {

Series::Series(const std::vector<std::string>& paths, const Mesh& mesh) {
    for (const std::string& path : paths) {
        add(*open_solution(elvis::hdf5::File(path), m_spaces), mesh);
    }
}

void Series::add(const Solution& solution, const Mesh& mesh) {
    const auto refuse = [&](const std::string& what) {
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, solution.path(), what);
    };
    if (solution.uuid() != mesh.uuid()) {
        refuse("belongs to the mesh with the id '" + solution.uuid() + "', not to " + mesh.path() + ", whose id is '" +
               mesh.uuid() + "'");
    }
    solution.check(mesh);
    std::map<const Kind*, std::uint32_t> orders;
    for (const Kind& kind : kinds()) {
        if (const auto space = solution.space(kind)) {
            orders[&kind] = space->order();
        }
    }
    if (m_steps.size() == 0) {
        m_first = solution.path();
        m_names = solution.names();
        m_orders = orders;
    }
    if (solution.names() != m_names) {
        refuse("has other variables than " + m_first);
    }
    if (orders != m_orders) {
        refuse("has other orders than " + m_first + ": orders that change in time are not supported");
    }
    m_mantissa_bits = std::min(m_mantissa_bits, solution.mantissa_bits());
    m_steps.add(solution.path(), solution.time().value_or(static_cast<double>(m_steps.size())));
}

std::optional<std::uint32_t> Series::order(const Kind& kind) const {
    const auto found = m_orders.find(&kind);
    return found == m_orders.end() ? std::nullopt : std::optional(found->second);
}

std::shared_ptr<const Solution> Series::step(std::size_t step) const {
    return m_steps.get(step, [&](const std::string& path) { return open_solution(elvis::hdf5::File(path), m_spaces); });
}

} // namespace elvis_pyfr
