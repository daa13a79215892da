#include "time_steps.hpp"

#include <algorithm>

namespace elvis_cgns {

namespace {

/** A file has a name of 32 characters for each, hence no more than this. */
constexpr std::int64_t most_steps = 1 << 24;

/** Of BaseIterativeData_t; nothing where there is no such node. */
std::vector<double> read_times(Tree& tree, const Base& base) {
    const auto data = tree.child(base.node, "BaseIterativeData_t");
    if (!data) {
        return {};
    }
    const std::vector<std::int64_t> count = integers(*data);
    if (count.size() != 1 || count[0] < 1 || count[0] > most_steps) {
        data->fail("does not say how many time steps there are");
    }
    const auto n_steps = static_cast<std::size_t>(count[0]);
    for (const char* const name : {"TimeValues", "IterationValues"}) {
        if (const auto values = tree.named(*data, name)) {
            std::vector<double> times = numbers(*values);
            if (times.size() != n_steps) {
                values->fail("has " + std::to_string(times.size()) + " numbers for " + std::to_string(n_steps) + " time steps");
            }
            return times;
        }
    }
    data->fail("has neither TimeValues nor IterationValues");
}

/** Names of all steps, of a node of a zone's ZoneIterativeData_t; none where there is no such node. */
std::vector<std::string> read_names(Tree& tree, const Zone& zone, const std::string& name, std::size_t n_steps) {
    const auto data = tree.child(zone.node, "ZoneIterativeData_t");
    const auto node = data ? tree.named(*data, name) : std::nullopt;
    if (!node) {
        return {};
    }
    std::vector<std::string> names = texts(*node);
    if (names.size() != n_steps) {
        node->fail("has " + std::to_string(names.size()) + " names for " + std::to_string(n_steps) + " time steps");
    }
    return names;
}

/** All zones have to be there at all times, with the same coordinates. */
void check_mesh(Tree& tree, const Base& base, TimeSteps& steps) {
    std::optional<std::string> first;
    for (const Zone& zone : base.zones) {
        for (const std::string& name : read_names(tree, zone, "GridCoordinatesPointers", steps.times.size())) {
            if (name != first.value_or(name)) {
                zone.node.fail("has other coordinates at other time steps (" + *first + ", " + name +
                               "): meshes that move are not read");
            }
            first = name;
        }
    }
    steps.coordinates = first.value_or(steps.coordinates);
    const auto data = tree.child(base.node, "BaseIterativeData_t");
    const auto zones = data ? tree.named(*data, "ZonePointers") : std::nullopt;
    if (zones) {
        const std::vector<std::string> names = texts(*zones);
        for (const Zone& zone : base.zones) {
            if (std::ranges::count(names, zone.node.name) != static_cast<std::ptrdiff_t>(steps.times.size())) {
                zones->fail("does not name the zone " + zone.node.name +
                            " once for each time step: meshes that change in time are not read");
            }
        }
    }
}

void check_solutions(Tree& tree, const Zone& zone, const std::vector<std::string>& names) {
    const std::vector<Node> solutions = tree.children(zone.node, "FlowSolution_t");
    for (std::size_t step = 0; step < names.size(); ++step) {
        if (std::ranges::find(solutions, names[step], &Node::name) == solutions.end()) {
            zone.node.fail("has no solution '" + names[step] + "', which time step " + std::to_string(step) + " is to have");
        }
    }
}

} // namespace

TimeSteps read_time_steps(Tree& tree, const Base& base, const elvis::api::Host& host) {
    TimeSteps steps;
    const std::vector<double> times = read_times(tree, base);
    if (times.empty()) {
        return steps;
    }
    steps.times = times;
    check_mesh(tree, base, steps);
    std::vector<std::vector<std::string>> by_zone;
    for (const Zone& zone : base.zones) {
        by_zone.push_back(read_names(tree, zone, "FlowSolutionPointers", times.size()));
        check_solutions(tree, zone, by_zone.back());
    }
    if (std::ranges::any_of(by_zone, &std::vector<std::string>::empty)) {
        if (times.size() > 1) {
            host.log(ELVIS_LOG_WARNING, tree.path() + ": there are " + std::to_string(times.size()) +
                                            " time steps, but no FlowSolutionPointers in each zone that say what belongs to "
                                            "them: all solutions are taken as those of the last one");
        }
        steps.times = {times.back()};
        return steps;
    }
    steps.solutions.resize(times.size());
    for (std::size_t step = 0; step < times.size(); ++step) {
        for (const std::vector<std::string>& names : by_zone) {
            steps.solutions[step].push_back(names[step]);
        }
    }
    return steps;
}

} // namespace elvis_cgns
