/**
 * @file extract.hpp
 * Meshes of surfaces for C++17 and later. What the functions do stands in extract.h.
 *
 *     auto wanted = elvis::detail::sized<elvis_extraction>();
 *     wanted.domain = ELVIS_DOMAIN_BOUNDARY;
 *     const elvis::extracted wall = elvis::extract(context, ball, wanted);
 */
#ifndef ELVIS_EXTRACT_HPP
#define ELVIS_EXTRACT_HPP

#include "elvis.hpp"
#include "extract.h"

namespace elvis {

/** See elvis_mesh_arrays, of which these are the arrays. */
struct extracted {
    elvis_mesh_info info{};
    std::vector<double> positions, normals, xi;
    std::vector<std::int64_t> elements;
    std::vector<double> values;
    std::vector<std::uint32_t> triangles;
    std::vector<std::int64_t> triangle_elements;
    std::vector<std::uint64_t> line_first;
    std::vector<std::uint32_t> line_vertices;
    std::vector<double> line_values;
};

/** See elvis_data_extract. `library`: the one that the data is of. */
inline extracted extract(const context& library, const data& volume, const elvis_extraction& extraction,
                         const task& watch = {}) {
    const auto check = [&](elvis_result result) { detail::check(result, library.get()); };
    struct release_mesh {
        void operator()(elvis_mesh* handle) const { elvis_mesh_release(handle); }
    };
    elvis_mesh* handle = nullptr;
    const elvis_task c_watch = detail::c_task(watch);
    check(elvis_data_extract(volume.get(), &extraction, &c_watch, &handle));
    const std::unique_ptr<elvis_mesh, release_mesh> mesh(handle);
    extracted all;
    all.info = detail::sized<elvis_mesh_info>();
    check(elvis_mesh_get_info(handle, &all.info));
    all.positions.resize(3 * all.info.n_vertices);
    all.normals.resize(3 * all.info.n_vertices);
    all.xi.resize(3 * all.info.n_vertices);
    all.elements.resize(all.info.n_vertices);
    all.values.resize(all.info.n_vertices * all.info.n_values);
    all.triangles.resize(3 * all.info.n_triangles);
    all.triangle_elements.resize(all.info.n_triangles);
    all.line_first.resize(all.info.n_lines + 1);
    all.line_vertices.resize(all.info.n_line_vertices);
    all.line_values.resize(all.info.n_lines);
    auto arrays = detail::sized<elvis_mesh_arrays>();
    arrays.positions = all.positions.data();
    arrays.normals = all.normals.data();
    arrays.xi = all.xi.data();
    arrays.elements = all.elements.data();
    arrays.values = all.values.data();
    arrays.triangles = all.triangles.data();
    arrays.triangle_elements = all.triangle_elements.data();
    arrays.line_first = all.line_first.data();
    arrays.line_vertices = all.line_vertices.data();
    arrays.line_values = all.line_values.data();
    check(elvis_mesh_read(handle, &arrays));
    return all;
}

} // namespace elvis

#endif
