#include "state.hpp"

#include "line_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis_hopr {

namespace {

constexpr const char* solution = "DG_Solution";

/** Datasets with values at nodes, and the attributes with their names. */
constexpr std::array<std::array<const char*, 2>, 4> nodal_datasets = {{{solution, "VarNames"},
                                                                       {"Mean", "VarNames_Mean"},
                                                                       {"MeanSquare", "VarNames_MeanSquare"},
                                                                       {"FieldData", "VarNamesAddField"}}};

/** Widths of cells are right to the digits of the file. */
constexpr double width_tolerance = 1e-6;

std::vector<double> widths_of_cells(const elvis::hdf5::File& file, std::size_t n) {
    if (file.has_attribute("/", "FV_w")) {
        std::vector<double> widths = file.numbers_of_attribute("/", "FV_w");
        double sum = 0;
        for (const double width : widths) {
            sum += width > 0 ? width : std::nan("");
        }
        if (widths.size() == n && std::abs(sum - 2) < width_tolerance) {
            return widths;
        }
        file.fail("/@FV_w", "is not the widths of " + std::to_string(n) + " cells that fill [-1, 1]");
    }
    return std::vector<double>(n, 2.0 / static_cast<double>(n));
}

} // namespace

bool is_state(const elvis::hdf5::File& file) {
    return file.has_attribute("/", "NodeType") &&
           std::ranges::any_of(nodal_datasets, [&](const auto& one) { return file.has(one[0]); });
}

State::State(elvis::hdf5::File file, elvis::nodal::NodalSpaces& spaces) : m_file(std::move(file)) {
    if (m_file.has_attribute("/", "Time")) {
        const std::vector<double> time = m_file.numbers_of_attribute("/", "Time");
        m_time = time.size() == 1 && std::isfinite(time.front()) ? time.front() : 0;
    }
    const std::vector<std::string> mesh = names_in("MeshFile");
    m_mesh_file = mesh.empty() ? "" : mesh.front();
    for (const auto& [dataset, attribute] : nodal_datasets) {
        if (m_file.has(dataset)) {
            std::vector<std::string> names = names_in(attribute);
            add_nodal(dataset, names.empty() ? names_in(dataset) : names, spaces);
        }
    }
    if (!m_nodes) {
        m_file.fail(solution, "is missing");
    }
    m_n_nodal = m_names.size();
    m_cells = std::make_unique<const FiniteVolumeCells>(widths_of_cells(m_file, m_nodes->order() + 1));
    if (m_file.has("ElemData")) {
        add_constants();
    }
}

std::vector<std::string> State::names_in(const std::string& attribute) const {
    return m_file.has_attribute("/", attribute) ? m_file.texts_of_attribute("/", attribute) : std::vector<std::string>{};
}

void State::add_name(const std::string& name, const std::string& dataset) {
    const bool is_new = std::ranges::find(m_names, name) == m_names.end();
    m_names.push_back(is_new ? name : name + " (" + dataset + ")");
}

void State::add_nodal(const std::string& name, const std::vector<std::string>& names, elvis::nodal::NodalSpaces& spaces) {
    elvis::hdf5::Dataset data = m_file.dataset(name);
    const std::vector<std::uint64_t>& shape = data.shape();
    if (shape.size() != 5 || shape[2] != shape[3] || (shape[1] != shape[2] && shape[1] != 1)) {
        data.fail("is not of the size (elements, N+1, N+1, N+1, variables)");
    }
    if (shape[2] == 0 || shape[2] > most_order + 1) {
        data.fail("has " + std::to_string(shape[2]) + " nodes in a direction; 1 to " + std::to_string(most_order + 1) +
                  " are read");
    }
    if (shape[4] == 0 || names.size() != shape[4]) {
        data.fail("has " + std::to_string(shape[4]) + " variables, and names of " + std::to_string(names.size()));
    }
    const auto order = static_cast<std::uint32_t>(shape[2] - 1);
    if (!m_nodes) {
        const std::vector<std::string> type = names_in("NodeType");
        const std::vector<double> line = line_nodes(type.size() == 1 ? type.front() : "", order);
        if (line.empty()) {
            m_file.fail("/@NodeType",
                        "is '" + (type.empty() ? "" : type.front()) +
                            "'; known are GAUSS, GAUSS-LOBATTO and CHEBYSHEV-GAUSS-LOBATTO, the last two from order 1");
        }
        m_n_elements = shape[0];
        m_nodes = spaces.get(elvis::native::Shape::hexahedron, order, cube_of(line));
    }
    if (shape[0] != m_n_elements || order != m_nodes->order()) {
        data.fail("has other elements or another order than the dataset before it");
    }
    m_mantissa_bits = std::min(m_mantissa_bits, data.mantissa_bits({}));
    const std::size_t first_variable = m_names.size(), n_variables = names.size();
    for (const std::string& one : names) {
        add_name(one, name);
    }
    const bool is_flat = shape[1] != shape[2];
    m_groups.push_back({std::move(data), first_variable, n_variables, is_flat});
}

void State::add_constants() {
    const std::vector<std::string> names = names_in("VarNamesAdd");
    m_constants = m_file.dataset("ElemData");
    if (m_constants->shape() != std::vector<std::uint64_t>{m_n_elements, names.size()}) {
        m_constants->fail("is not of the size (elements, variables in VarNamesAdd)");
    }
    for (std::size_t column = 0; column < names.size(); ++column) {
        if (names[column] == "FV_Elems") {
            m_finite_volume_column = column;
        }
        add_name(names[column], "ElemData");
    }
}

std::vector<bool> State::read_finite_volume() const {
    if (!m_finite_volume_column) {
        return {};
    }
    std::vector<double> values(m_n_elements);
    m_constants->read({0, *m_finite_volume_column}, {m_n_elements, 1}, std::span(values));
    std::vector<bool> is_finite_volume;
    for (const double value : values) {
        is_finite_volume.push_back(value > 0.5);
    }
    return is_finite_volume;
}

void State::read_group(const Group& group, std::uint64_t first, std::uint64_t count, std::vector<double>& all) const {
    const std::uint64_t n_line = m_nodes->order() + 1, n_layers = group.is_flat ? 1 : n_line, n_layer = n_line * n_line;
    std::vector<double> block(count * n_layers * n_layer * group.n_variables);
    group.data.read({first, 0, 0, 0, 0}, {count, n_layers, n_line, n_line, group.n_variables}, std::span(block));
    for (std::uint64_t element = 0; element < count; ++element) {
        for (std::size_t variable = 0; variable < group.n_variables; ++variable) {
            double* const out = &all[element * size() + (group.first_variable + variable) * m_nodes->size()];
            for (std::uint64_t node = 0; node < m_nodes->size(); ++node) {
                const std::uint64_t in_file = group.is_flat ? node % n_layer : node;
                out[node] = block[(element * n_layers * n_layer + in_file) * group.n_variables + variable];
            }
        }
    }
}

std::vector<double> State::read(std::uint64_t first, std::uint64_t count) const {
    std::vector<double> all(count * size());
    for (const Group& group : m_groups) {
        read_group(group, first, count, all);
    }
    if (n_constant() > 0) {
        std::vector<double> constants(count * n_constant());
        m_constants->read({first, 0}, {count, n_constant()}, std::span(constants));
        for (std::uint64_t element = 0; element < count; ++element) {
            std::copy_n(&constants[element * n_constant()], n_constant(), &all[(element + 1) * size() - n_constant()]);
        }
    }
    return all;
}

} // namespace elvis_hopr
