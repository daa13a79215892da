#include "solution.hpp"

#include "partitioned_solution.hpp"
#include "solution_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace elvis_pyfr {

namespace {

std::optional<double> number(const std::optional<std::string>& text) {
    double value = 0;
    if (!text) {
        return std::nullopt;
    }
    const auto read = std::from_chars(text->data(), text->data() + text->size(), value);
    return read.ec == std::errc() && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

} // namespace

Solution::Solution(elvis::hdf5::File file, elvis::nodal::NodalSpaces& spaces)
    : m_file(std::move(file)), m_stats(m_file.text("stats")), m_prefix(m_stats.find("data", "prefix").value_or("soln")),
      m_uuid(find_uuid(m_file)), m_time(number(m_stats.find("solver-time-integrator", "tcurr"))), m_known_spaces(&spaces) {}

std::shared_ptr<const elvis::nodal::NodalSpace> Solution::space(const Kind& kind) const {
    const auto found = m_spaces.find(&kind);
    return found == m_spaces.end() ? nullptr : found->second;
}

void Solution::set_space(const Kind& kind, std::vector<double> points, const std::string& place) {
    const std::size_t n = points.size() / 3;
    const int order = elvis::nodal::order_of(kind.shape, n, most_order(kind));
    if (order < 0) {
        m_file.fail(place, "has " + std::to_string(n) + " solution points an element, which is the number of no order up to " +
                               std::to_string(most_order(kind)));
    }
    try {
        m_spaces[&kind] = m_known_spaces->get(kind.shape, static_cast<std::uint32_t>(order), std::move(points));
    } catch (const std::invalid_argument& error) {
        m_file.fail(place, std::string("has ") + error.what());
    }
}

std::unique_ptr<const Solution> open_solution(elvis::hdf5::File file, elvis::nodal::NodalSpaces& spaces) {
    const int layout = find_layout(file);
    if (layout == 0) {
        return std::make_unique<PartitionedSolution>(std::move(file), spaces);
    }
    return std::make_unique<SolutionFile>(std::move(file), layout, spaces);
}

} // namespace elvis_pyfr
