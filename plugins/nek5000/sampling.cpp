#include "data_set.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace elvis_nek5000 {

namespace {

std::string shown(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
}

} // namespace

void DataSet::evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) const {
    const std::size_t block = *geometry().content().coordinates();
    const NodeSet set = geometry().nodes(block);
    std::vector<double> at_nodes(dimension() * set.size());
    geometry().read(block, element, at_nodes);
    const auto table = m_tables.at(set).table(xi);
    std::ranges::fill(positions, 0.0);
    for (std::size_t axis = 0; axis < dimension(); ++axis) {
        table->interpolate(std::span(at_nodes).subspan(axis * set.size(), set.size()), &positions[axis], 3);
    }
}

void DataSet::begin_step(std::size_t step) const {
    const std::size_t last = m_current.exchange(step);
    if (last != step && m_steps[last] != m_geometry) {
        m_steps[last]->forget();
    }
}

void DataSet::check_element(const Snapshot& step, std::uint64_t element) const {
    const auto block = step.content().coordinates();
    if (!block || &step == m_geometry.get()) {
        return;
    }
    const auto fail = [&](const std::string& cause) {
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, step.path(), "element " + std::to_string(element + 1) + " " + cause);
    };
    const Content &here = step.content(), &there = geometry().content();
    std::vector<double> own(dimension() * here.n_points()), first(dimension() * there.n_points());
    step.read(*block, element, own);
    geometry().read(*there.coordinates(), element, first);
    // One number may have been rounded twice.
    const double tolerance = 2 * std::max(step.precision().spacing, geometry().precision().spacing) * m_largest_coordinate;
    double distance = 0;
    const bool has_same_nodes = step.nodes(*block) == geometry().nodes(*there.coordinates());
    const std::size_t n_checks = has_same_nodes ? here.n_points() : std::size_t{1} << dimension();
    for (std::size_t axis = 0; axis < dimension(); ++axis) {
        for (std::size_t check = 0; check < n_checks; ++check) {
            const std::size_t a = has_same_nodes ? check : here.corner_node(check);
            const std::size_t b = has_same_nodes ? check : there.corner_node(check);
            const double moved = std::abs(own[axis * here.n_points() + a] - first[axis * there.n_points() + b]);
            if (!std::isfinite(moved)) {
                fail("has a coordinate that is not finite");
            }
            distance = std::max(distance, moved);
        }
    }
    if (distance > tolerance) {
        fail("lies elsewhere than in " + geometry().path() + " (by " + shown(distance) +
             "); meshes that move are not supported, so convert time steps one by one");
    }
}

void DataSet::sample(std::size_t step, std::uint64_t element, std::span<const double> xi, double* values) const {
    begin_step(step);
    const Snapshot& snapshot = *m_steps[step];
    check_element(snapshot, element);
    std::vector<double> at_nodes;
    for (const Block& field : m_fields) {
        const std::size_t block = *snapshot.content().find(field);
        const std::size_t n_points = snapshot.content().n_points();
        at_nodes.resize(n_components(field) * n_points);
        snapshot.read(block, element, at_nodes);
        const NodeSet set = snapshot.nodes(block);
        const auto table = m_tables.at(set).table(xi);
        for (std::size_t component = 0; component < n_components(field); ++component, ++values) {
            // Of pressure at Gauss-Legendre points only the first numbers mean something.
            table->interpolate(std::span(at_nodes).subspan(component * n_points, set.size()), values, m_n_values);
        }
    }
}

} // namespace elvis_nek5000
