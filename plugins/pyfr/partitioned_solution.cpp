#include "partitioned_solution.hpp"

#include "points.hpp"

#include <stdexcept>

namespace elvis_pyfr {

PartitionedSolution::PartitionedSolution(elvis::hdf5::File file, elvis::nodal::NodalSpaces& spaces)
    : Solution(std::move(file), spaces) {
    m_names = split(m_stats.find("data", "fields").value_or(""), ',');
    if (m_names.empty()) {
        m_file.fail("stats", "names no fields: [data] fields is missing");
    }
    const Ini config(m_file.text("config"));
    for (const Kind& kind : kinds()) {
        add_parts(kind, config);
    }
    if (m_parts.empty()) {
        m_file.fail("", "has no datasets " + m_prefix + "_hex_p0 or the like");
    }
}

void PartitionedSolution::add_parts(const Kind& kind, const Ini& config) {
    std::vector<Part> parts = find_parts(m_file, m_prefix + "_", kind, 2);
    if (parts.empty()) {
        return;
    }
    const std::string& place = parts.front().name;
    const std::vector<std::uint64_t>& shape = parts.front().data.shape();
    if (shape[1] != m_names.size()) {
        m_file.fail(place,
                    "has " + std::to_string(shape[1]) + " variables, but 'stats' names " + std::to_string(m_names.size()));
    }
    const std::string section = "solver-elements-" + std::string(kind.name);
    const std::optional<std::string> rule = config.find(section, "soln-pts");
    if (!rule) {
        m_file.fail("config", "does not say where the solution points of " + std::string(kind.name) + " are: [" + section +
                                  "] soln-pts is missing");
    }
    try {
        set_space(kind, to_native(kind, solution_points(kind, *rule, shape[0])), place);
    } catch (const std::invalid_argument& error) {
        m_file.fail("config", "[" + section + "] soln-pts: " + error.what());
    }
    for (const Part& part : parts) {
        note_mantissa(part.data.mantissa_bits({}));
    }
    m_parts.emplace(&kind, std::move(parts));
}

void PartitionedSolution::check(const Mesh& mesh) const {
    for (const auto& [kind, parts] : m_parts) {
        const auto set = std::ranges::find(mesh.sets(), kind, &ElementSet::kind);
        if (set == mesh.sets().end() || set->parts != sizes(parts)) {
            m_file.fail(parts.front().name, "and its like have other partitions than the mesh " + mesh.path());
        }
    }
}

std::vector<double> PartitionedSolution::read(const ElementSet& set, std::uint64_t first, std::uint64_t count) const {
    const std::size_t n_points = space(*set.kind)->size(), n_numbers = n_points * m_names.size();
    std::vector<double> all(count * n_numbers), block;
    for_each_part_in(m_parts.at(set.kind), first, count,
                     [&](const Part& part, std::uint64_t from, std::uint64_t n, std::uint64_t offset) {
                         block.resize(n * n_numbers);
                         part.data.read({0, 0, from}, {n_points, m_names.size(), n}, std::span(block));
                         for (std::size_t point = 0; point < n_points; ++point) {
                             for (std::size_t variable = 0; variable < m_names.size(); ++variable) {
                                 const double* const row = &block[(point * m_names.size() + variable) * n];
                                 for (std::uint64_t element = 0; element < n; ++element) {
                                     all[((offset + element) * m_names.size() + variable) * n_points + point] = row[element];
                                 }
                             }
                         }
                     });
    return all;
}

} // namespace elvis_pyfr
