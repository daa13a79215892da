#include "solutions.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace elvis_cgns {

namespace {

/** What an array is told by: solution ("" for that of the time step), location, name. */
struct ArrayKey {
    std::string solution;
    bool is_of_cells;
    std::string name;

    friend auto operator<=>(const ArrayKey&, const ArrayKey&) = default; // NOLINT(modernize-use-nullptr): clang-tidy's own 0
};

/** Whether a solution can be read; a reason if it cannot. */
std::string reason_against(Tree& tree, const Node& solution) {
    const std::string location = grid_location(tree, solution);
    if (location != "Vertex" && location != "CellCenter") {
        return "its values lie at " + location;
    }
    for (const Node& child : tree.children(solution)) {
        if (child.name == "PointRange" || child.name == "PointList") {
            return "it has values at a part of the zone only";
        }
    }
    return "";
}

/** X, Y and Z at the end of names mark the components of a vector. */
constexpr std::string_view axes = "XYZ";

/** Fields of arrays: those that are components of a vector together. */
std::vector<Field> combine(const std::set<ArrayKey>& arrays, std::size_t n_components) {
    std::vector<Field> fields;
    std::set<ArrayKey> done;
    for (const ArrayKey& key : arrays) {
        if (done.contains(key)) {
            continue;
        }
        std::vector<std::string> components;
        const std::string stem = key.name.empty() ? "" : key.name.substr(0, key.name.size() - 1);
        for (std::size_t axis = 0; axis < n_components && !stem.empty() && axes.find(key.name.back()) != axes.npos; ++axis) {
            const ArrayKey component{key.solution, key.is_of_cells, stem + axes[axis]};
            if (arrays.contains(component)) {
                components.push_back(component.name);
            }
        }
        // What has the name of the vector itself stays apart from it.
        const bool is_vector = components.size() == n_components &&
                               std::ranges::find(components, key.name) != components.end() &&
                               !arrays.contains({key.solution, key.is_of_cells, stem});
        const std::vector<std::string> all = is_vector ? components : std::vector{key.name};
        for (const std::string& name : all) {
            done.insert({key.solution, key.is_of_cells, name});
        }
        fields.push_back({is_vector ? stem : key.name, key.is_of_cells, key.solution, all});
    }
    return fields;
}

/** Names that several have get what tells them apart. */
void make_unique(std::vector<Field>& fields) {
    const std::vector<Field> before = fields;
    for (Field& field : fields) {
        const std::string name = field.name;
        const auto is_same = [&](const Field& other) { return other.name == name; };
        if (std::ranges::count_if(before, is_same) == 1) {
            continue;
        }
        const bool has_both = std::ranges::any_of(
            before, [&](const Field& other) { return is_same(other) && other.is_of_cells != field.is_of_cells; });
        const bool has_several = std::ranges::any_of(before, [&](const Field& other) {
            return is_same(other) && other.is_of_cells == field.is_of_cells && other.solution != field.solution;
        });
        if (has_several) {
            field.name += " (" + field.solution + ")";
        }
        if (has_both && field.is_of_cells) {
            field.name += " (cells)";
        }
    }
}

} // namespace

Solutions::Solutions(Tree& tree, const Base& base, TimeSteps steps, const elvis::api::Host& host)
    : m_tree(tree), m_base(base), m_steps(std::move(steps)) {
    std::map<ArrayKey, std::size_t> n_zones;
    std::set<std::string> warnings;
    for (std::size_t zone = 0; zone < base.zones.size(); ++zone) {
        for (const Node& solution : solutions_of(0, zone)) {
            if (const std::string reason = reason_against(tree, solution); !reason.empty()) {
                warnings.insert(tree.path() + ": " + solution.name + " is left out: " + reason);
                continue;
            }
            const bool is_of_cells = grid_location(tree, solution) == "CellCenter";
            for (const Node& array : tree.children(solution, "DataArray_t")) {
                if (array.holds_numbers() && array.size() > 0) {
                    ++n_zones[{m_steps.solutions.empty() ? solution.name : "", is_of_cells, array.name}];
                    m_mantissa_bits = std::min(m_mantissa_bits, elvis_cgns::mantissa_bits(array));
                }
            }
        }
    }
    std::set<ArrayKey> arrays;
    for (const auto& [key, n] : n_zones) {
        if (n == base.zones.size()) {
            arrays.insert(key);
        } else {
            warnings.insert(tree.path() + ": " + key.name + " is left out: " + std::to_string(base.zones.size() - n) + " of " +
                            std::to_string(base.zones.size()) + " zones do not have it");
        }
    }
    for (const std::string& warning : warnings) {
        host.log(ELVIS_LOG_WARNING, warning);
    }
    m_fields = combine(arrays, base.n_coordinates);
    make_unique(m_fields);
    // What is wrong with the first step is said when the file is opened.
    m_values = std::make_shared<const StepValues>(read(0));
}

std::vector<Node> Solutions::solutions_of(std::size_t step, std::size_t zone) const {
    std::vector<Node> all = m_tree.children(m_base.zones[zone].node, "FlowSolution_t");
    if (m_steps.solutions.empty()) {
        return all;
    }
    const std::string& name = m_steps.solutions[step][zone];
    std::erase_if(all, [&](const Node& solution) { return solution.name != name; });
    return all;
}

std::vector<double> Solutions::read_component(std::size_t step, const Field& field, const std::string& array) const {
    std::vector<double> values;
    for (std::size_t index = 0; index < m_base.zones.size(); ++index) {
        const Zone& zone = m_base.zones[index];
        bool is_found = false;
        for (const Node& solution : solutions_of(step, index)) {
            if ((!field.solution.empty() && solution.name != field.solution) ||
                grid_location(m_tree, solution) != (field.is_of_cells ? "CellCenter" : "Vertex")) {
                continue;
            }
            if (const auto node = m_tree.named(solution, array)) {
                const std::vector<double> of_zone =
                    read_array(m_tree, solution, *node, zone, field.is_of_cells ? zone.n_cells : zone.n_vertices);
                values.insert(values.end(), of_zone.begin(), of_zone.end());
                is_found = true;
                break;
            }
        }
        if (!is_found) {
            zone.node.fail("has no " + array + " at time step " + std::to_string(step));
        }
    }
    return values;
}

StepValues Solutions::read(std::size_t step) const {
    StepValues values;
    for (const Field& field : m_fields) {
        for (const std::string& array : field.arrays) {
            values.components.push_back(read_component(step, field, array));
        }
    }
    return values;
}

std::shared_ptr<const StepValues> Solutions::values(std::size_t step) const {
    const std::lock_guard lock(m_mutex);
    if (!m_values || m_step != step) {
        // The old one goes first: two need not fit.
        m_values.reset();
        m_values = std::make_shared<const StepValues>(read(step));
        m_step = step;
    }
    return m_values;
}

} // namespace elvis_cgns
