#include "variables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis_exodus {

namespace {

std::vector<std::string> names_of(const NetCdf& file, const char* count, const char* variable) {
    const std::uint64_t n = file.dimension(count).value_or(0);
    if (n == 0) {
        return {};
    }
    std::vector<std::string> names = file.texts(variable);
    if (names.size() != n) {
        file.fail(variable, "has not as many names as there are variables");
    }
    return names;
}

/** What two names have in common but for the last letter, if these are x and the wanted axis. */
std::string stem_of(const std::string& name) {
    const std::string stem = name.substr(0, name.size() - 1);
    return !stem.empty() && stem.back() == '_' ? stem.substr(0, stem.size() - 1) : stem;
}

bool ends_with_axis(const std::string& name, const std::string& first, char axis) {
    const bool is_upper = first.back() == 'X';
    return name.size() == first.size() && name.starts_with(first.substr(0, first.size() - 1)) &&
           name.back() == (is_upper ? static_cast<char>(axis - 'x' + 'X') : axis);
}

} // namespace

Variables::Variables(const NetCdf& file, const Mesh& mesh) : m_file(file), m_mesh(mesh) {
    add_fields(names_of(file, "num_nod_var", "name_nod_var"), false);
    const std::vector<std::string> of_elements = names_of(file, "num_elem_var", "name_elem_var");
    m_n_element_variables = of_elements.size();
    add_fields(of_elements, true);
    if (file.has("elem_var_tab")) {
        m_truth_table = file.integers("elem_var_tab");
    }
    if (file.has("time_whole")) {
        m_times = file.reals("time_whole");
    }
    if (m_times.empty()) {
        m_times = {0};
        m_fields.clear(); // Names without any step.
    }
    if (!std::ranges::all_of(m_times, [](double time) { return std::isfinite(time); })) {
        file.fail("time_whole", "is not finite");
    }
}

/** Names that differ in their last letter alone, x, y and z, are components of one field. */
void Variables::add_fields(const std::vector<std::string>& names, bool is_of_elements) {
    for (std::size_t variable = 0; variable < names.size(); ++variable) {
        const std::string& first = names[variable];
        Field field{first, is_of_elements, {variable}};
        const bool may_begin = first.size() > 1 && (first.back() == 'x' || first.back() == 'X');
        for (std::size_t next = variable + 1; may_begin && next < names.size() && field.variables.size() < m_mesh.dimension();
             ++next) {
            if (!ends_with_axis(names[next], first, static_cast<char>('x' + field.variables.size()))) {
                break;
            }
            field.variables.push_back(next);
        }
        if (field.variables.size() > 1) {
            field.name = stem_of(first);
        }
        variable = field.variables.back();
        m_fields.push_back(std::move(field));
    }
}

bool Variables::has(std::size_t variable, const Block& block) const {
    const std::size_t place = (block.number - 1) * m_n_element_variables + variable;
    return place >= m_truth_table.size() || m_truth_table[place] != 0;
}

std::vector<double> Variables::nodal(std::size_t variable, std::size_t step) const {
    std::vector<double> values(m_mesh.n_nodes());
    const std::string own = "vals_nod_var" + std::to_string(variable + 1);
    if (m_file.has(own)) {
        m_file.read(own, {step, 0}, {1, values.size()}, values);
    } else {
        m_file.read("vals_nod_var", {step, variable, 0}, {1, 1, values.size()}, values);
    }
    return values;
}

/** NaN in blocks that do not have the variable. */
std::vector<double> Variables::elemental(std::size_t variable, std::size_t step) const {
    std::vector<double> values(m_mesh.n_elements(), std::numeric_limits<double>::quiet_NaN());
    for (const Block& block : m_mesh.blocks()) {
        if (has(variable, block)) {
            const std::string name = "vals_elem_var" + std::to_string(variable + 1) + "eb" + std::to_string(block.number);
            m_file.read(name, {step, 0}, {1, block.n_elements},
                        std::span(values).subspan(block.first_element, block.n_elements));
        }
    }
    return values;
}

std::shared_ptr<const StepValues> Variables::values(std::size_t step) const {
    const std::lock_guard lock(m_mutex);
    if (m_step != step) {
        m_values.reset();
        auto values = std::make_shared<StepValues>();
        for (const Field& field : m_fields) {
            for (const std::size_t variable : field.variables) {
                values->components.push_back(field.is_of_elements ? elemental(variable, step) : nodal(variable, step));
            }
        }
        m_values = std::move(values);
        m_step = step;
    }
    return m_values;
}

} // namespace elvis_exodus
