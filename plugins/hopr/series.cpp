#include "series.hpp"

#include <algorithm>

namespace elvis_hopr {

namespace {

/** Whether `name` is that of a vector's first component, and the next two names are those of the others. */
bool begins_vector(std::span<const std::string> names) {
    if (names.size() < 3 || names[0].size() < 2 || names[0].back() != 'X') {
        return false;
    }
    const std::string stem = names[0].substr(0, names[0].size() - 1);
    return names[1] == stem + 'Y' && names[2] == stem + 'Z';
}

std::vector<SourceField> fields_of(const State& state) {
    std::vector<SourceField> fields;
    const std::span<const std::string> names(state.names());
    for (std::size_t at = 0; at < names.size();) {
        const bool is_constant = at >= state.n_nodal();
        if (!is_constant && begins_vector(names.subspan(at, state.n_nodal() - at))) {
            std::string stem = names[at].substr(0, names[at].size() - 1);
            const bool is_taken = std::ranges::find(names, stem) != names.end();
            fields.push_back({is_taken ? stem + "XYZ" : stem, 3, false});
            at += 3;
        } else {
            fields.push_back({names[at], 1, is_constant});
            ++at;
        }
    }
    return fields;
}

} // namespace

Series::Series(const std::vector<std::string>& paths, const Mesh& mesh) {
    for (const std::string& path : paths) {
        add(State(elvis::hdf5::File(path), m_spaces), mesh);
    }
}

void Series::add(const State& state, const Mesh& mesh) {
    const auto refuse = [&](const std::string& what) { throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, state.path(), what); };
    if (state.n_elements() != mesh.n_elements()) {
        refuse("has values of " + std::to_string(state.n_elements()) + " elements, but the mesh " + mesh.path() + " has " +
               std::to_string(mesh.n_elements()));
    }
    if (m_steps.size() == 0) {
        m_first = state.path();
        m_names = state.names();
        m_n_nodal = state.n_nodal();
        m_order = state.nodes().order();
        m_fields = fields_of(state);
    }
    if (state.names() != m_names || state.n_nodal() != m_n_nodal) {
        refuse("has other variables than " + m_first);
    }
    if (state.nodes().order() != m_order) {
        refuse("has another order than " + m_first + ": orders that change in time are not supported");
    }
    m_mantissa_bits = std::min(m_mantissa_bits, state.mantissa_bits());
    m_steps.add(state.path(), state.time());
    const std::vector<bool> finite_volume = state.read_finite_volume();
    m_ever.resize(std::max(m_ever.size(), finite_volume.size()));
    for (std::size_t element = 0; element < finite_volume.size(); ++element) {
        m_ever[element] = m_ever[element] || finite_volume[element];
    }
}

std::uint64_t Series::n_ever_finite_volume() const { return static_cast<std::uint64_t>(std::ranges::count(m_ever, true)); }

std::shared_ptr<const Series::Step> Series::step(std::size_t step) const {
    return m_steps.get(step, [&](const std::string& path) {
        State state(elvis::hdf5::File(path), m_spaces);
        std::vector<bool> finite_volume = state.read_finite_volume();
        return std::make_shared<const Step>(Step{std::move(state), std::move(finite_volume)});
    });
}

} // namespace elvis_hopr
