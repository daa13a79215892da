/**
 * @file part.hpp
 * A mesh with the functions on it: all of a data set, or what one process of a parallel program has written of it.
 */
#pragma once

#include "element/space.hpp"
#include "element_function.hpp"
#include "saved_cycle.hpp"

#include <elvis/plugin.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace elvis_mfem {

class Part {
public:
    /** Of all cycles, that part. Throws elvis::api::Error. */
    Part(const elvis::api::Host& host, const std::vector<SavedCycle>& cycles, std::size_t part);
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

    const Mesh& mesh() const { return m_mesh; }
    /** Whether elements that share a vertex number touch there; not so with discontinuous nodes, as of periodic meshes. */
    bool has_corner_ids() const { return m_has_corner_ids; }
    const ElementFunction& mapping() const { return *m_mapping; }
    /** The fields at a step; those of all steps have the same names and spaces. */
    const std::vector<std::unique_ptr<const ElementFunction>>& fields(std::size_t step) const { return m_steps[step]; }
    /** Most significant decimal digits of the values, or of the coordinates if there are no values. */
    int digits() const { return m_digits; }

private:
    using Functions = std::vector<std::unique_ptr<const ElementFunction>>;

    void read_step(const elvis::api::Host& host, const SavedCycle& cycle, std::size_t part);
    /** As it is, or, of a curve, on the band that the mesh is read as. */
    GridFunction on_mesh(GridFunction function, const std::string& path) const;
    void check_space(std::size_t field, const GridFunction& function, const std::string& path);
    void check_dimension(const Collection& collection, const std::string& path) const;
    std::unique_ptr<const ElementFunction> make_function(std::string name, const std::string& path, GridFunction function);

    Mesh m_mesh;
    std::optional<Topology> m_topology;
    bool m_has_corner_ids = true;
    int m_digits = 0;
    std::unique_ptr<const ElementFunction> m_mapping;
    std::vector<Functions> m_steps;
    /** Of the fields, without values. */
    std::vector<GridFunction> m_spaces;
};

} // namespace elvis_mfem
