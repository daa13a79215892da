#include "solution_file.hpp"

#include <algorithm>
#include <array>

namespace elvis_pyfr {

namespace {

/** The kind in a name such as `p4-hex`; none in others. */
const Kind* kind_of(const std::string& name) {
    const std::size_t dash = name.find('-');
    const bool has_order =
        dash != std::string::npos && dash > 1 && name[0] == 'p' && name.find_first_not_of("0123456789", 1) == dash;
    return has_order ? find_kind(std::string_view(name).substr(dash + 1)) : nullptr;
}

/**
 * What layout 1 calls the variables of a member of layout 2's records. Gradients have a variable for each direction.
 * Source: PyFR, pyfr/writers/upgrade.py.
 */
std::vector<std::string> names_of(const std::string& group, const std::string& variable, int dimension) {
    constexpr std::array<std::array<const char*, 2>, 5> prefixes = {
        {{"soln", ""}, {"avg", "avg-"}, {"avg-std", "std-"}, {"fun-avg", "fun-avg-"}, {"fun-avg-std", "std-fun-avg-"}}};
    if (group == "grad") {
        std::vector<std::string> names;
        for (int axis = 0; axis < dimension; ++axis) {
            names.push_back("grad_" + variable + "_" + std::string(1, static_cast<char>('x' + axis)));
        }
        return names;
    }
    const auto found = std::ranges::find(prefixes, group, [](const auto& pair) { return std::string(pair[0]); });
    return {(found == prefixes.end() ? group + "-" : (*found)[1]) + variable};
}

} // namespace

SolutionFile::SolutionFile(elvis::hdf5::File file, int layout, elvis::nodal::NodalSpaces& spaces)
    : Solution(std::move(file), spaces), m_layout(layout) {
    if (layout == 1) {
        m_names = split(m_stats.find("data", "fields").value_or(""), ',');
        if (m_names.empty()) {
            m_file.fail("stats", "names no fields: [data] fields is missing");
        }
    }
    if (!m_file.has(m_prefix)) {
        m_file.fail(m_prefix, "is missing, which 'stats' says holds the data");
    }
    for (const std::string& name : m_file.names(m_prefix)) {
        if (const Kind* const kind = kind_of(name)) {
            add_values(m_prefix + "/" + name, *kind);
        }
    }
    if (m_values.empty()) {
        m_file.fail(m_prefix, "has no datasets of elements");
    }
}

void SolutionFile::add_values(const std::string& name, const Kind& kind) {
    if (m_values.contains(&kind)) {
        m_file.fail(name, "is a second order on the same kind of elements, which is not supported");
    }
    Values values{name, m_file.dataset(name), std::nullopt};
    const std::vector<std::uint64_t>& shape = values.data.shape();
    if (shape.size() != (m_layout == 1 ? 3u : 1u)) {
        m_file.fail(name, "has " + std::to_string(shape.size()) + " dimensions");
    }
    set_space(kind, to_native(kind, m_file.numbers_of_attribute(name, "pts")), name + "@pts");
    const std::size_t n_points = space(kind)->size();
    if (m_layout == 2) {
        read_names(values, kind);
        for (const auto& [group, n_variables] : m_groups) {
            note_mantissa(values.data.mantissa_bits({group}));
        }
    } else if (shape[1] != m_names.size() || shape[2] != n_points) {
        m_file.fail(name, "has " + std::to_string(shape[1]) + " variables at " + std::to_string(shape[2]) +
                              " points instead of " + std::to_string(m_names.size()) + " at " + std::to_string(n_points));
    } else {
        note_mantissa(values.data.mantissa_bits({}));
    }
    if (m_file.has(name + "-idxs")) {
        values.elements = read_elements(name + "-idxs", shape[0]);
    }
    m_values.emplace(&kind, std::move(values));
}

void SolutionFile::read_names(const Values& values, const Kind& kind) {
    const int dimension = elvis::native::dimension(kind.shape);
    std::vector<std::string> names;
    std::vector<std::pair<std::string, std::size_t>> groups;
    for (const std::string& group : values.data.members({})) {
        // Numbers of the program's own, such as the partition.
        if (group == "aux") {
            continue;
        }
        const std::size_t n_before = names.size();
        for (const std::string& variable : values.data.members({group})) {
            const auto added = names_of(group, variable, dimension);
            names.insert(names.end(), added.begin(), added.end());
        }
        groups.emplace_back(group, names.size() - n_before);
        if (names.size() == n_before || values.data.entry_size({group}) != groups.back().second * space(kind)->size()) {
            m_file.fail(values.name, "has in '" + group + "' not one value for each variable and solution point");
        }
    }
    if (m_values.empty()) {
        m_names = names;
        m_groups = groups;
    }
    if (names.empty() || names != m_names || groups != m_groups) {
        m_file.fail(values.name, "has no variables, or others than " + m_values.begin()->second.name);
    }
}

std::vector<std::int64_t> SolutionFile::read_elements(const std::string& name, std::uint64_t n_rows) const {
    const elvis::hdf5::Dataset data = m_file.dataset(name);
    if (data.shape() != std::vector{n_rows}) {
        m_file.fail(name, "has not one number for each of " + std::to_string(n_rows) + " elements");
    }
    std::vector<std::int64_t> elements(n_rows);
    data.read({0}, {n_rows}, std::span(elements));
    if (std::ranges::adjacent_find(elements, std::greater_equal<>()) != elements.end()) {
        m_file.fail(name, "does not ascend");
    }
    return elements;
}

void SolutionFile::check(const Mesh& mesh) const {
    for (const auto& [kind, values] : m_values) {
        const auto set = std::ranges::find(mesh.sets(), kind, &ElementSet::kind);
        const std::uint64_t n = set == mesh.sets().end() ? 0 : set->count, n_rows = values.data.shape()[0];
        if (!values.elements && n_rows != n) {
            m_file.fail(values.name, "has values of " + std::to_string(n_rows) + " elements, but the mesh " + mesh.path() +
                                         " has " + std::to_string(n));
        }
        if (values.elements && n_rows > 0 &&
            (values.elements->front() < 0 || static_cast<std::uint64_t>(values.elements->back()) >= n)) {
            m_file.fail(values.name + "-idxs", "has elements that the mesh " + mesh.path() + " does not have");
        }
    }
}

std::vector<double> SolutionFile::read(const ElementSet& set, std::uint64_t first, std::uint64_t count) const {
    const Values& values = m_values.at(set.kind);
    const std::size_t n_points = space(*set.kind)->size(), n_numbers = n_points * m_names.size();
    if (!values.elements) {
        return read_rows(values, n_points, first, count);
    }
    std::vector<double> all(count * n_numbers, std::numeric_limits<double>::quiet_NaN());
    const auto from = std::ranges::lower_bound(*values.elements, static_cast<std::int64_t>(first));
    const auto to = std::ranges::lower_bound(*values.elements, static_cast<std::int64_t>(first + count));
    const std::vector<double> rows = read_rows(values, n_points, static_cast<std::uint64_t>(from - values.elements->begin()),
                                               static_cast<std::uint64_t>(to - from));
    for (auto element = from; element != to; ++element) {
        const auto row = static_cast<std::size_t>(element - from) * n_numbers;
        std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(row), n_numbers,
                    all.begin() + static_cast<std::ptrdiff_t>((static_cast<std::uint64_t>(*element) - first) * n_numbers));
    }
    return all;
}

std::vector<double> SolutionFile::read_rows(const Values& values, std::size_t n_points, std::uint64_t first,
                                            std::uint64_t count) const {
    const std::size_t n_numbers = n_points * m_names.size();
    std::vector<double> all(count * n_numbers);
    if (m_layout == 1) {
        values.data.read({first, 0, 0}, {count, m_names.size(), n_points}, std::span(all));
        return all;
    }
    std::vector<double> block;
    std::size_t offset = 0;
    for (const auto& [group, n_variables] : m_groups) {
        const std::size_t n = n_variables * n_points;
        block.resize(count * n);
        values.data.read({first}, {count}, std::span(block), {group});
        for (std::uint64_t row = 0; row < count; ++row) {
            std::copy_n(block.begin() + static_cast<std::ptrdiff_t>(row * n), n,
                        all.begin() + static_cast<std::ptrdiff_t>(row * n_numbers + offset));
        }
        offset += n;
    }
    return all;
}

} // namespace elvis_pyfr
