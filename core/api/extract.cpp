#include "mesh_handle.hpp"

#include "call.hpp"
#include "columns.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace elvis::library {

namespace {

constexpr double least_extraction_tolerance = 1e-9;
constexpr double default_extraction_tolerance = 1e-3;

void need_all_finite(std::span<const double> numbers, const char* name) {
    if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); })) {
        throw InvalidArgument(name, "is not finite");
    }
}

ExtractionRequest extraction_of(const elvis_extraction& wanted) {
    ExtractionRequest request;
    switch (wanted.domain) {
    case ELVIS_DOMAIN_BOUNDARY:
        request.surface = ExtractionRequest::Surface::boundary;
        break;
    case ELVIS_DOMAIN_PLANE:
        request.surface = ExtractionRequest::Surface::plane;
        std::ranges::copy(wanted.plane, request.plane.begin());
        need_all_finite(request.plane, "plane");
        if (request.plane[0] == 0 && request.plane[1] == 0 && request.plane[2] == 0) {
            throw InvalidArgument("plane", "has a normal of length zero");
        }
        break;
    case ELVIS_DOMAIN_ISOSURFACE:
        request.surface = ExtractionRequest::Surface::isosurface;
        need(wanted.level_field, "level_field");
        need_all_finite({&wanted.isovalue, 1}, "isovalue");
        request.level_field = wanted.level_field;
        request.isovalue = wanted.isovalue;
        break;
    default:
        throw InvalidArgument("domain", "is none of ELVIS_DOMAIN_BOUNDARY, _PLANE and _ISOSURFACE");
    }
    request.groups = texts(wanted.groups, wanted.n_groups, "groups");
    request.time_step = wanted.time_step;
    if (wanted.n_contours > 0) {
        need(wanted.contours, "contours");
        need(wanted.contour_field, "contour_field");
        request.contour_field = wanted.contour_field;
        request.contours.assign(wanted.contours, wanted.contours + wanted.n_contours);
        need_all_finite(request.contours, "contours");
    }
    request.tolerance = wanted.tolerance == 0 ? default_extraction_tolerance : wanted.tolerance;
    if (!(request.tolerance >= least_extraction_tolerance && request.tolerance < 1)) {
        throw InvalidArgument("tolerance", "is not in [1e-9, 1)");
    }
    return request;
}

void look_up_values(const RuntimeVolume& volume, const Columns& columns, std::uint32_t time_step, elvis_mesh& mesh) {
    std::vector<std::int64_t> numbers(volume.n_elements());
    volume.element_numbers(0, numbers.size(), numbers);
    for (const ReferencePoint& place : mesh.mesh.places) {
        mesh.elements.push_back(numbers[place.element]);
    }
    for (const std::uint64_t element : mesh.mesh.elements) {
        mesh.triangle_elements.push_back(numbers[element]);
    }
    mesh.n_values = columns.n_values;
    for (const std::vector<double>& values : values_at(volume, columns, time_step, mesh.mesh.places)) {
        mesh.values.insert(mesh.values.end(), values.begin(), values.end());
    }
}

/** Vectors side by side. */
void read_vectors(const std::vector<Vector3>& vectors, double* to) {
    for (std::size_t i = 0; to != nullptr && i < vectors.size(); ++i) {
        std::ranges::copy(vectors[i], to + 3 * i);
    }
}

template <class From, class To> void read_numbers(const From& from, To* to) {
    if (to != nullptr) {
        std::ranges::copy(from, to);
    }
}

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_data_extract(elvis_data* data, const elvis_extraction* extraction, const elvis_task* task,
                                elvis_mesh** mesh) {
    return call(data, [&] {
        need(mesh, "mesh");
        *mesh = nullptr;
        const elvis_extraction known = known_part(extraction, "extraction");
        const ExtractionRequest request = extraction_of(known);
        Data& state = *data->state;
        const DataTask running(state, task);
        const Columns columns = columns_of(state.volume, known.fields, known.n_fields);
        auto found = std::make_unique<elvis_mesh>();
        found->context = state.context;
        found->mesh = extract(state.volume, request, *state.control);
        look_up_values(state.volume, columns, request.time_step, *found);
        *mesh = found.release();
    });
}

elvis_result elvis_mesh_get_info(const elvis_mesh* mesh, elvis_mesh_info* info) {
    return call(mesh, [&] {
        const SurfaceMesh& found = mesh->mesh;
        elvis_mesh_info ours{};
        ours.n_values = mesh->n_values;
        ours.n_vertices = found.positions.size();
        ours.n_triangles = found.triangles.size();
        ours.n_lines = found.line_values.size();
        ours.n_line_vertices = found.line_vertices.size();
        ours.measure = found.measure;
        ours.volume = found.volume;
        ours.mesh_to_surface = found.mesh_to_surface;
        ours.surface_to_mesh = found.surface_to_mesh;
        ours.tolerance = found.tolerance;
        ours.euler_number = found.euler_number;
        ours.n_rim_edges = found.n_rim_edges;
        ours.n_inner_edges = found.n_inner_edges;
        ours.n_branching_edges = found.n_branching_edges;
        ours.n_open_ends = found.n_open_ends;
        ours.is_certified = found.is_certified ? 1 : 0;
        ours.n_sampled_elements = found.n_sampled_elements;
        ours.n_undecided = found.n_undecided;
        ours.n_elements = found.n_elements;
        ours.n_evaluations = found.n_evaluations;
        give(ours, info, "info");
    });
}

elvis_result elvis_mesh_read(const elvis_mesh* mesh, const elvis_mesh_arrays* arrays) {
    return call(mesh, [&] {
        const elvis_mesh_arrays to = known_part(arrays, "arrays");
        const SurfaceMesh& found = mesh->mesh;
        read_vectors(found.positions, to.positions);
        read_vectors(found.normals, to.normals);
        for (std::size_t i = 0; to.xi != nullptr && i < found.places.size(); ++i) {
            std::ranges::copy(found.places[i].xi, to.xi + 3 * i);
        }
        read_numbers(mesh->elements, to.elements);
        read_numbers(mesh->values, to.values);
        for (std::size_t i = 0; to.triangles != nullptr && i < found.triangles.size(); ++i) {
            std::ranges::copy(found.triangles[i], to.triangles + 3 * i);
        }
        read_numbers(mesh->triangle_elements, to.triangle_elements);
        if (to.line_first != nullptr && found.line_first.empty()) {
            to.line_first[0] = 0;
        }
        read_numbers(found.line_first, to.line_first);
        read_numbers(found.line_vertices, to.line_vertices);
        read_numbers(found.line_values, to.line_values);
    });
}

void elvis_mesh_release(elvis_mesh* mesh) { delete mesh; }
