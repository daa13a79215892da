#include "views.hpp"

#include <algorithm>

namespace gmsh {

namespace {

[[noreturn]] void fail(const DataSection& section, const std::string& what) {
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, section.path,
                            section_name(section.kind) + " of view '" + section.view + "', step " +
                                std::to_string(section.step) + ": " + what);
}

/** Position of an entity and of its record in the section, in order of the entity. Those of other dimensions are left out. */
std::vector<std::pair<std::uint32_t, std::size_t>> resolve(const Mesh& mesh, const DataSection& section) {
    std::vector<std::pair<std::uint32_t, std::size_t>> records;
    const bool of_nodes = section.kind == DataKind::node;
    for (std::size_t record = 0; record < section.tags.size(); ++record) {
        const std::uint64_t tag = section.tags[record];
        const std::optional<std::uint32_t> entity = of_nodes ? mesh.find_node(tag) : mesh.find_element(tag);
        if (entity) {
            records.emplace_back(*entity, record);
        } else if (of_nodes || !mesh.has_element(tag)) {
            fail(section, std::string("there is no ") + (of_nodes ? "node " : "element ") + std::to_string(tag));
        }
    }
    std::ranges::sort(records);
    // A record that repeats an earlier one replaces it, as in Gmsh; copies of elements have the same records.
    std::vector<std::pair<std::uint32_t, std::size_t>> last;
    for (const auto& record : records) {
        if (!last.empty() && last.back().first == record.first) {
            last.back() = record;
        } else {
            last.push_back(record);
        }
    }
    return last;
}

/** The scheme's basis for a topology; none where Gmsh takes that of the element. */
const Basis* scheme_of(const View& view, Topology topology) {
    const auto found = view.scheme.find(topology);
    return found == view.scheme.end() ? nullptr : found->second.get();
}

/** Fails unless each scheme basis of a view on nodes has as many functions as the elements have nodes. */
void check_scheme_on_nodes(const Mesh& mesh, const View& view, const DataSection& section) {
    for (std::uint32_t element = 0; !view.scheme.empty() && element < mesh.n_elements(); ++element) {
        const Basis* const basis = scheme_of(view, mesh.type(element).topology);
        if (basis && basis->size() != mesh.nodes(element).size()) {
            fail(section, "scheme '" + section.scheme + "' has " + std::to_string(basis->size()) +
                              " functions for the elements of type " + name(mesh.type(element)));
        }
    }
}

/** Fails unless the values of each element are as many as some basis has functions. */
void check_counts(const Mesh& mesh, const View& view, const DataSection& section,
                  std::span<const std::pair<std::uint32_t, std::size_t>> records) {
    for (const auto& [element, record] : records) {
        const ElementType& type = mesh.type(element);
        const std::size_t count = (section.first[record + 1] - section.first[record]) / section.n_components;
        const auto place = [&] {
            return "element " + std::to_string(section.tags[record]) + " (" + name(type) + ") has " + std::to_string(count) +
                   " values a component; ";
        };
        if (const Basis* const basis = scheme_of(view, type.topology)) {
            if (count != basis->size()) {
                fail(section, place() + "scheme '" + section.scheme + "' has " + std::to_string(basis->size()) + " functions");
            }
        } else if (section.kind == DataKind::element_node && count != 1 && count != n_nodes(type) &&
                   count != static_cast<std::size_t>(n_corners(type.topology))) {
            fail(section, place() + "without a scheme, one for each node, one for each corner, or a single one is expected");
        }
    }
}

bool has_values(const Mesh& mesh, const BasisSet& bases, const View& view) {
    for (const auto& [index, step] : view.steps) {
        for (std::uint32_t element = 0; element < mesh.n_elements(); ++element) {
            if (view.read(mesh, bases, step, element, nullptr)) {
                return true;
            }
        }
    }
    return false;
}

/** A view while it is put together. */
struct Growing {
    View view;
    std::string scheme;
    std::set<std::pair<std::int32_t, std::int32_t>> partitions;
};

/** The view that a section belongs to: of the same name and kind, and without this partition of this step yet. */
Growing& view_of(const DataSection& section, const std::map<std::string, Scheme>& schemes, std::vector<Growing>& views) {
    for (Growing& candidate : views) {
        if (candidate.view.kind == section.kind && candidate.view.name == section.view &&
            !candidate.partitions.contains({section.step, section.partition})) {
            if (candidate.view.n_components != section.n_components) {
                fail(section, std::to_string(section.n_components) + " components, where earlier steps have " +
                                  std::to_string(candidate.view.n_components));
            }
            if (candidate.scheme != section.scheme) {
                fail(section, "another interpolation scheme than in earlier steps");
            }
            return candidate;
        }
    }
    if (views.size() == max_views) {
        fail(section, "more than " + std::to_string(max_views) + " views");
    }
    Growing added;
    added.view.kind = section.kind;
    added.view.name = section.view;
    added.view.n_components = section.n_components;
    added.scheme = section.scheme;
    if (!section.scheme.empty()) {
        const auto scheme = schemes.find(section.scheme);
        if (scheme == schemes.end()) {
            fail(section, "there is no $InterpolationScheme named '" + section.scheme + "'");
        }
        added.view.scheme = scheme->second;
    }
    return views.emplace_back(std::move(added));
}

void make_names_unique(std::vector<View>& views) {
    std::set<std::string> taken;
    for (View& view : views) {
        std::string name = view.name;
        for (int copy = 2; !taken.insert(name).second; ++copy) {
            name = view.name + " (" + std::to_string(copy) + ")";
        }
        view.name = std::move(name);
    }
}

} // namespace

std::span<const double> StepData::find(std::uint32_t entity) const {
    std::size_t at = entity;
    // Where every entity has values, positions and entities are the same.
    if (at >= m_entities.size() || m_entities[at] != entity) {
        const auto found = std::ranges::lower_bound(m_entities, entity);
        if (found == m_entities.end() || *found != entity) {
            return {};
        }
        at = static_cast<std::size_t>(found - m_entities.begin());
    }
    return {m_values.data() + m_first[at], m_values.data() + m_first[at + 1]};
}

void StepData::add(const DataSection& section, std::span<const std::pair<std::uint32_t, std::size_t>> records) {
    const StepData before = std::move(*this);
    *this = StepData(before.m_time);
    const auto append = [&](std::uint32_t entity, std::span<const double> values) {
        m_entities.push_back(entity);
        m_values.insert(m_values.end(), values.begin(), values.end());
        m_first.push_back(m_values.size());
    };
    const auto append_before = [&](std::size_t at) {
        append(before.m_entities[at],
               {before.m_values.data() + before.m_first[at], before.m_values.data() + before.m_first[at + 1]});
    };
    std::size_t at = 0;
    for (const auto& [entity, record] : records) {
        for (; at < before.m_entities.size() && before.m_entities[at] < entity; ++at) {
            append_before(at);
        }
        if (at < before.m_entities.size() && before.m_entities[at] == entity) {
            ++at;
        }
        append(entity, {section.values.data() + section.first[record], section.values.data() + section.first[record + 1]});
    }
    for (; at < before.m_entities.size(); ++at) {
        append_before(at);
    }
}

BasisSet::BasisSet(const Mesh& mesh) {
    for (std::size_t element = 0; element < mesh.n_elements(); ++element) {
        const ElementType& type = mesh.type(element);
        if (m_lagrange.contains(type)) {
            continue;
        }
        m_lagrange[type] = lagrange_basis(type);
        const ElementType linear{type.topology, 1, false};
        if (!m_lagrange.contains(linear)) {
            m_lagrange[linear] = lagrange_basis(linear);
        }
        if (!m_constant.contains(type.topology)) {
            m_constant[type.topology] = constant_basis(type.topology);
        }
    }
}

const Basis* View::read(const Mesh& mesh, const BasisSet& bases, const StepData& step, std::uint32_t element,
                        std::vector<double>* nodal) const {
    const ElementType& type = mesh.type(element);
    const Basis* const from_scheme = scheme_of(*this, type.topology);
    if (nodal) {
        nodal->clear();
    }
    if (kind != DataKind::node) {
        const std::span<const double> values = step.find(element);
        if (values.empty()) {
            return nullptr;
        }
        if (nodal) {
            nodal->assign(values.begin(), values.end());
        }
        const std::size_t count = values.size() / n_components;
        if (from_scheme) {
            return from_scheme;
        }
        if (kind == DataKind::element || count == 1) {
            return &bases.constant(type.topology);
        }
        return count == n_nodes(type) ? &bases.lagrange(type) : &bases.linear(type.topology);
    }
    const std::span<const std::uint32_t> nodes = mesh.nodes(element);
    // All nodes have values: no need to look.
    std::size_t n_found = !nodal && step.size() == mesh.n_nodes() ? nodes.size() : 0;
    for (; n_found < nodes.size(); ++n_found) {
        const std::span<const double> values = step.find(nodes[n_found]);
        if (values.empty()) {
            break;
        }
        if (nodal) {
            nodal->insert(nodal->end(), values.begin(), values.end());
        }
    }
    if (n_found == nodes.size()) {
        return from_scheme ? from_scheme : &bases.lagrange(type);
    }
    // Corners come first. Gmsh draws values at corners alone as linear.
    const auto n_corners = static_cast<std::size_t>(gmsh::n_corners(type.topology));
    if (n_found < n_corners || from_scheme) {
        return nullptr;
    }
    if (nodal) {
        nodal->resize(n_corners * n_components);
    }
    return &bases.linear(type.topology);
}

std::vector<View> collect_views(const Mesh& mesh, const BasisSet& bases, const std::vector<DataSection>& sections,
                                const std::map<std::string, Scheme>& schemes, const elvis::api::Host& host) {
    std::vector<Growing> growing;
    for (const DataSection& section : sections) {
        host.check_cancelled();
        Growing& target = view_of(section, schemes, growing);
        const auto records = resolve(mesh, section);
        if (section.kind == DataKind::node) {
            if (target.view.steps.empty()) {
                check_scheme_on_nodes(mesh, target.view, section);
            }
        } else {
            check_counts(mesh, target.view, section, records);
        }
        target.partitions.insert({section.step, section.partition});
        target.view.steps.try_emplace(section.step, section.time).first->second.add(section, records);
    }
    std::vector<View> views;
    for (Growing& done : growing) {
        if (has_values(mesh, bases, done.view)) {
            views.push_back(std::move(done.view));
        } else {
            host.log(ELVIS_LOG_WARNING, "view '" + done.view.name + "' has no values in elements of dimension " +
                                            std::to_string(mesh.dimension()) + " and is left out");
        }
    }
    make_names_unique(views);
    return views;
}

std::vector<TimeStep> time_steps(const std::vector<View>& views) {
    std::set<TimeStep> steps;
    for (const View& view : views) {
        if (view.steps.size() > 1) {
            for (const auto& [index, data] : view.steps) {
                steps.insert({index, data.time()});
            }
        }
    }
    if (steps.empty()) {
        return {views.empty() ? TimeStep{} : TimeStep{views[0].steps.begin()->first, views[0].steps.begin()->second.time()}};
    }
    return {steps.begin(), steps.end()};
}

const StepData* data_at(const View& view, const TimeStep& step) {
    if (view.steps.size() == 1) {
        return &view.steps.begin()->second;
    }
    const auto found = view.steps.find(step.index);
    return found != view.steps.end() && found->second.time() == step.time ? &found->second : nullptr;
}

} // namespace gmsh
