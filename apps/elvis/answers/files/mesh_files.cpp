#include "mesh_files.hpp"

#include <core/base/counted.hpp>

#include <algorithm>
#include <cstdio>

namespace elvis::commands {

namespace {

/** A text with one number. */
std::string with(const char* format, double number) {
    char text[160];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

double deviation(const elvis_mesh_info& info) { return std::max(info.mesh_to_surface, info.surface_to_mesh); }

} // namespace

std::vector<MeshColumn> mesh_columns(const data& volume, const std::vector<std::string>& fields) {
    std::vector<MeshColumn> columns;
    std::size_t first = 0;
    for (const std::string& field : fields) {
        const elvis_string name = field.c_str();
        columns.push_back({field, volume.count_values(&name, 1), first});
        first += columns.back().n_components;
    }
    return columns;
}

void write_mesh(const extracted& mesh, const std::vector<MeshColumn>& columns, const std::string& path) {
    if (path.ends_with(".vtp")) {
        write_mesh_vtp(mesh, columns, path);
    } else if (path.ends_with(".ply")) {
        write_ply(mesh, columns, path);
    } else if (path.ends_with(".stl")) {
        write_stl(mesh, path);
    } else {
        write_glb(mesh, columns, path);
    }
}

std::vector<std::string> report_of(const elvis_mesh_info& info) {
    const bool has_lines = info.n_lines > 0;
    std::vector<std::string> report = {has_lines ? counted(info.n_lines, "line") + " of " + counted(info.n_vertices, "point")
                                                 : counted(info.n_triangles, "triangle") + " of " +
                                                       std::to_string(info.n_vertices) + " vertices"};
    report.push_back(with(has_lines ? "length %.9g" : "area %.9g", info.measure));
    if (!has_lines && info.n_triangles > 0 && info.n_rim_edges + info.n_inner_edges == 0) {
        report.push_back(with("closed, around a volume of %.9g; Euler number ", info.volume) +
                         std::to_string(info.euler_number));
    }
    report.push_back(with("off by at most %.3g of the true one, seen at samples; wanted: ", deviation(info)) +
                     with("%.3g", info.tolerance));
    if (info.n_rim_edges > 0) {
        report.push_back(counted(info.n_rim_edges, "edge") + " where the surface ends");
    }
    report.emplace_back(info.is_certified != 0 ? "no part of it is missing: certified"
                                               : "that no part of it is missing rests on samples, or is undecided");
    return report;
}

std::vector<std::string> doubts_of(const elvis_mesh_info& info) {
    std::vector<std::string> doubts;
    if (info.n_inner_edges > 0) {
        doubts.push_back(counted(info.n_inner_edges, "open edge") +
                         " inside of the volume: there the field jumps, or elements do not meet face to face");
    }
    if (info.n_open_ends > 0) {
        doubts.push_back("lines have " + counted(info.n_open_ends, "open end") + " within the surface");
    }
    if (deviation(info) > info.tolerance) {
        doubts.push_back(with("the mesh is farther from the surface than was wanted: %.3g", deviation(info)) +
                         with(", not %.3g", info.tolerance));
    }
    return doubts;
}

} // namespace elvis::commands
