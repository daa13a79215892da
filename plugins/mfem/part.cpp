#include "part.hpp"

#include "band.hpp"
#include "field.hpp"
#include "nurbs/nurbs_function.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace elvis_mfem {

namespace {

/** Meshes without nodes are linear: a grid function of the vertices. */
GridFunction linear_nodes(std::vector<double> coordinates) {
    GridFunction nodes;
    nodes.n_components = 3;
    nodes.is_interleaved = true;
    nodes.values = std::move(coordinates);
    return nodes;
}

} // namespace

Part::Part(const elvis::api::Host& host, const std::vector<SavedCycle>& cycles, std::size_t part)
    : m_mesh(read_mesh(cycles.front().meshes[part])) {
    const std::string& path = cycles.front().meshes[part];
    GridFunction nodes = m_mesh.nodes ? std::move(*m_mesh.nodes) : linear_nodes(std::move(m_mesh.coordinates));
    m_has_corner_ids = nodes.collection.family == Family::h1;
    m_mapping = make_function("nodes", path, std::move(nodes));
    m_digits = cycles.front().fields.empty() ? m_mesh.digits : 0;
    for (const SavedCycle& cycle : cycles) {
        read_step(host, cycle, part);
    }
}

void Part::read_step(const elvis::api::Host& host, const SavedCycle& cycle, std::size_t part) {
    Functions functions;
    if (m_mesh.solution) {
        functions.push_back(make_function("solution", cycle.meshes[part], std::move(*m_mesh.solution)));
        m_digits = std::max(m_digits, m_mesh.digits);
    }
    for (std::size_t index = 0; index < cycle.fields.size(); ++index) {
        host.check_cancelled();
        const std::string& path = cycle.fields[index].paths[part];
        int digits = 0;
        GridFunction function = on_mesh(read_solution(path, &digits), path);
        m_digits = std::max(m_digits, digits);
        check_space(index, function, path);
        functions.push_back(make_function(cycle.fields[index].name, path, std::move(function)));
    }
    if (functions.empty()) {
        functions.push_back(std::make_unique<AttributeFunction>(m_mesh));
    }
    m_steps.push_back(std::move(functions));
}

GridFunction Part::on_mesh(GridFunction function, const std::string& path) const {
    try {
        return m_mesh.segments ? on_band(function, *m_mesh.segments) : std::move(function);
    } catch (const std::invalid_argument& error) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, error.what());
    }
}

/** Fields keep their space over time. */
void Part::check_space(std::size_t field, const GridFunction& function, const std::string& path) {
    GridFunction space{.collection = function.collection,
                       .nurbs_order = function.nurbs_order,
                       .n_components = function.n_components,
                       .is_interleaved = false,
                       .values = {}};
    if (m_steps.empty()) {
        m_spaces.push_back(std::move(space));
    } else if (const GridFunction& first = m_spaces[field]; first.collection != space.collection ||
                                                            first.nurbs_order != space.nurbs_order ||
                                                            first.n_components != space.n_components) {
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                                "the space of the field is another one than at the first time step, which is not supported");
    }
}

void Part::check_dimension(const Collection& collection, const std::string& path) const {
    if (collection.dimension != 0 && collection.dimension != m_mesh.dimension) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                "the finite element collection is of dimension " + std::to_string(collection.dimension) +
                                    ", but the mesh of dimension " + std::to_string(m_mesh.dimension));
    }
    if (collection.is_vector() && m_mesh.dimension < m_mesh.space_dimension) {
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                                "Nedelec and Raviart-Thomas fields on surfaces in space are not supported");
    }
}

std::unique_ptr<const ElementFunction> Part::make_function(std::string name, const std::string& path, GridFunction function) {
    if (function.nurbs_order > 0) {
        return std::make_unique<NurbsFunction>(std::move(name), path, std::move(function), m_mesh);
    }
    check_dimension(function.collection, path);
    try {
        if (!m_topology && Space::needs_topology(function.collection)) {
            m_topology.emplace(m_mesh);
        }
    } catch (const std::invalid_argument& error) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, error.what());
    }
    return std::make_unique<Field>(std::move(name), path, std::move(function), m_mesh, m_topology ? &*m_topology : nullptr);
}

} // namespace elvis_mfem
