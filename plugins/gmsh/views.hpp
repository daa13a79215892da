/**
 * @file views.hpp
 * Gmsh's views: fields by name, with their time steps, and how their values are to be read in an element.
 */
#pragma once

#include "basis.hpp"
#include "mesh.hpp"
#include "view_sections.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace gmsh {

/** One time step of a view. Numbers of entity `entities[i]` (node or element) are values[first[i]] .. values[first[i+1]-1]. */
class StepData {
public:
    explicit StepData(double time) : m_time(time) {}

    double time() const { return m_time; }
    /** Number of entities that have values. */
    std::size_t size() const { return m_entities.size(); }
    /** Values of one entity; empty if there are none. */
    std::span<const double> find(std::uint32_t entity) const;

    /** Adds what a section holds; `entities` ascend where the section's records are taken in `order`. */
    void add(const DataSection& section, std::span<const std::pair<std::uint32_t, std::size_t>> records);

private:
    double m_time;
    std::vector<std::uint32_t> m_entities;
    std::vector<std::size_t> m_first{0};
    std::vector<double> m_values;
};

/** Bases of the element types that occur. */
class BasisSet {
public:
    explicit BasisSet(const Mesh& mesh);

    const Basis& lagrange(const ElementType& type) const { return *m_lagrange.at(type); }
    const Basis& linear(Topology topology) const { return *m_lagrange.at({topology, 1, false}); }
    const Basis& constant(Topology topology) const { return *m_constant.at(topology); }

private:
    std::map<ElementType, std::unique_ptr<const Basis>> m_lagrange;
    std::map<Topology, std::unique_ptr<const Basis>> m_constant;
};

/** As many fields as the host accepts. */
constexpr std::size_t max_views = 4096;

struct View {
    DataKind kind = DataKind::node;
    std::string name;
    std::uint32_t n_components = 1;
    /** Empty: none. */
    Scheme scheme;
    std::map<std::int32_t, StepData> steps;

    /**
     * The functions that the values of an element at a step belong to; none if it has no values. `nodal`, if given, gets the
     * values: for each function, the components.
     */
    const Basis* read(const Mesh& mesh, const BasisSet& bases, const StepData& step, std::uint32_t element,
                      std::vector<double>* nodal) const;
};

/**
 * Views of all sections. Fails where a section does not fit the mesh. Views without a value on a converted element are left
 * out, with a warning. Names are made unique.
 */
std::vector<View> collect_views(const Mesh& mesh, const BasisSet& bases, const std::vector<DataSection>& sections,
                                const std::map<std::string, Scheme>& schemes, const elvis::api::Host& host);

/** A time step of the data set. */
struct TimeStep {
    std::int32_t index = 0;
    double time = 0;

    friend auto operator<=>(const TimeStep&, const TimeStep&) = default;
};

/** The steps of all views that have more than one; one step if there is none such. */
std::vector<TimeStep> time_steps(const std::vector<View>& views);

/** A view's data at a step of the data set; views with just one step have it always. None: no data then. */
const StepData* data_at(const View& view, const TimeStep& step);

} // namespace gmsh
