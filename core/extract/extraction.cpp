#include <core/extract/extraction.hpp>

#include <core/base/error.hpp>
#include <core/extract/contour_lines.hpp>
#include <core/extract/merged_mesh.hpp>
#include <core/extract/mesh_distance.hpp>
#include <core/extract/shape_division.hpp>
#include <core/integrate/domain_parts.hpp>
#include <core/integrate/polynomial_degree.hpp>
#include <core/plugin_host/all_bounds.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/probe/element_finder.hpp>
#include <core/volume/boundary/element_faces.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace elvis {

namespace {

using Surface = ExtractionRequest::Surface;

/** Of functions that are no polynomials, or not known to be. */
constexpr unsigned unknown_degree = 6;
/** After cells were judged by linear models, what is measured calls for few more. */
constexpr int most_rounds = 12;

double diagonal_of(const RuntimeVolume& volume) {
    const std::vector<double> boxes = all_bounds(volume);
    Vector3 lower{HUGE_VAL, HUGE_VAL, HUGE_VAL}, upper{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (std::size_t at = 0; at < boxes.size(); at += 6) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower[axis] = std::min(lower[axis], boxes[at + axis]);
            upper[axis] = std::max(upper[axis], boxes[at + 3 + axis]);
        }
    }
    return length(minus(upper, lower));
}

/** Halvings of all directions, after which a polynomial of that degree is about a parabola. */
unsigned depth_for(unsigned degree, unsigned dimension) {
    return dimension * static_cast<unsigned>(std::bit_width(degree > 2 ? (degree - 1) / 2 : 0u));
}

/** Elements without neighbour beyond a face; all faces where the volume does not tell. */
std::vector<std::uint32_t> outer_faces_of(const RuntimeVolume& volume, const TaskControl& control) {
    std::vector<std::uint32_t> outer(volume.n_elements(), volume.n_faces() == 0 ? ~0u : 0u);
    if (volume.n_faces() > 0) {
        for (const ElementFace& face : boundary_faces(volume, {}, &control)) {
            outer[face.element] |= 1u << face.local_face;
        }
    }
    return outer;
}

class Extraction {
public:
    Extraction(const RuntimeVolume& volume, const ExtractionRequest& request, const TaskControl& control)
        : m_volume(volume), m_request(as_contours(volume, request)), m_control(control),
          m_tolerance(request.tolerance * diagonal_of(volume)), m_outer_faces(outer_faces_of(volume, control)) {
        IntegralRequest parts;
        parts.groups = m_request.groups;
        parts.plane = m_request.plane;
        parts.level_field = m_request.level_field;
        parts.isovalue = m_request.isovalue;
        parts.time_step = m_request.time_step;
        parts.domain = m_request.surface == Surface::plane        ? IntegralRequest::Domain::plane
                       : m_request.surface == Surface::isosurface ? IntegralRequest::Domain::isosurface
                       : volume.dimension() == 2                  ? IntegralRequest::Domain::volume
                                                                  : IntegralRequest::Domain::boundary;
        LevelSet level;
        m_parts = domain_parts(volume, parts, control);
        if (m_request.surface != Surface::boundary) {
            level = level_set(volume, parts);
            m_parts = met_parts(volume, parts, level, std::move(m_parts));
        }
        std::shared_ptr<const Expression> contour;
        if (!m_request.contours.empty()) {
            contour = std::make_shared<const Expression>(m_request.contour_field, volume.fields(), volume.dimension());
            std::ranges::for_each(contour->fields(), [&](std::uint32_t field) { volume.need_own(field); });
            if (!contour->gradient()) {
                throw Error(m_request.contour_field, "has no gradient that could be evaluated, which contours need");
            }
        }
        m_sampler.emplace(volume, level.expression, level.isovalue, contour, m_request.time_step);
    }

    SurfaceMesh find() {
        const CellJudge judge(*m_sampler, m_request.contours, m_tolerance);
        CellMesh cells(*m_sampler, judge, mesh_elements(), m_tolerance, m_request.most_cells, m_control);
        SurfaceMesh mesh;
        MergedMesh merged;
        ContourLines contours;
        MeshDistance distance;
        const double same_place = weld_share * m_tolerance;
        for (int round = 0; round < most_rounds; ++round) {
            cells.refine();
            merged = merge_triangles(cells, same_place);
            distance = measure_distance(*m_sampler, cells, merged, m_tolerance);
            if (!m_request.contours.empty()) {
                contours = contour_lines(*m_sampler, cells, merged, m_request.contours, same_place, m_tolerance);
            }
            if (!cells.has_wanted()) {
                break;
            }
        }
        m_request.contours.empty() ? fill_surface(cells, merged, distance, mesh) : fill_lines(cells, contours, mesh);
        mesh.tolerance = m_tolerance;
        mesh.n_cells = cells.n_cells();
        mesh.n_elements = m_n_elements;
        mesh.n_evaluations = m_sampler->n_evaluations();
        mesh.n_sampled_elements = cells.n_sampled_elements();
        for (const ElementCells& element : cells.elements()) {
            mesh.n_undecided += static_cast<std::uint64_t>(
                std::ranges::count_if(element.cells(), [](const Cell& cell) { return cell.is_undecided; }));
        }
        mesh.is_certified = mesh.n_sampled_elements == 0 && mesh.n_undecided == 0 && m_request.contours.empty();
        return mesh;
    }

private:
    static constexpr double weld_share = 1e-3;

    /** In two dimensions what cuts is a contour on the elements. */
    static ExtractionRequest as_contours(const RuntimeVolume& volume, const ExtractionRequest& request) {
        ExtractionRequest other = request;
        if (volume.dimension() == 3 || request.surface == Surface::boundary) {
            return other;
        }
        if (!request.contours.empty()) {
            throw UsageError(volume.path(), "has two dimensions, where planes and isosurfaces are lines, without contours");
        }
        const bool is_plane = request.surface == Surface::plane;
        IntegralRequest level;
        level.domain = is_plane ? IntegralRequest::Domain::plane : IntegralRequest::Domain::isosurface;
        level.plane = request.plane;
        level.level_field = request.level_field;
        level.isovalue = request.isovalue;
        const LevelSet set = level_set(volume, level);
        other.surface = Surface::boundary;
        other.contour_field = set.expression->text();
        other.contours = {set.isovalue};
        return other;
    }

    std::vector<MeshElement> mesh_elements() {
        std::vector<MeshElement> elements;
        for (const DomainPart& part : m_parts) {
            const ClassInfo& info = m_volume.classes()[part.element_class];
            if (elements.empty() || elements.back().element != part.element) {
                MeshElement& element = elements.emplace_back();
                element.element = part.element;
                element.shape = info.shape;
                element.outer_faces = m_outer_faces[part.element];
                const unsigned geometry = info.is_affine ? 1 : mapping_degree(m_volume, part.element_class).value_or(4);
                element.least_depth = depth_for(geometry, m_sampler->has_level() ? 3 : 2);
            }
            if (m_request.surface == Surface::boundary && m_volume.dimension() == 3) {
                elements.back().faces.push_back(part.part.local_face);
            }
        }
        m_n_elements = elements.size();
        find_bends(elements);
        return elements;
    }

    void find_bends(std::vector<MeshElement>& elements) {
        std::vector<double> certified;
        if (m_sampler->has_level()) {
            std::vector<std::uint64_t> numbers;
            for (const MeshElement& element : elements) {
                numbers.push_back(element.element);
            }
            certified = certified_bends(m_volume, *m_sampler->level(), m_request.time_step, numbers);
        }
        ClassBends of_class;
        std::uint32_t element_class = ~0u;
        for (std::size_t index = 0; index < elements.size(); ++index) {
            MeshElement& element = elements[index];
            m_control.check();
            const std::uint32_t its_class = class_of(element.element);
            if (its_class != element_class) {
                element_class = its_class;
                of_class = class_bends(element_class);
            }
            bool is_certified = !certified.empty() && std::isfinite(certified[index]);
            double level = is_certified ? certified[index] : 0;
            if (m_sampler->has_level() && !is_certified && of_class.polynomial) {
                level = of_class.polynomial->of(*m_sampler, element.element);
                is_certified = std::isfinite(level);
            }
            if (m_sampler->has_contour() || (m_sampler->has_level() && !is_certified)) {
                element.bend = sampled_bend(*m_sampler, element.element, element.shape, of_class.degree);
            }
            if (is_certified) {
                element.bend.level = level;
                element.bend.is_certified = true;
            }
        }
    }

    /** What is known of functions in a class. */
    struct ClassBends {
        /** Of level and contours: the larger one, or what stands for it. */
        unsigned degree = unknown_degree;
        /** Of the level, where it is a polynomial. */
        std::optional<PolynomialBend> polynomial;
    };
    ClassBends class_bends(std::uint32_t element_class) const {
        ClassBends bends;
        bends.degree = 0;
        for (const auto& function : {m_sampler->level(), m_sampler->contour()}) {
            if (function) {
                bends.degree =
                    std::max(bends.degree, polynomial_degree(*function, m_volume, element_class).value_or(unknown_degree));
            }
        }
        if (m_sampler->has_level()) {
            const elvis_shape shape = m_volume.classes()[element_class].shape;
            const std::optional<unsigned> degree = polynomial_degree(*m_sampler->level(), m_volume, element_class);
            if (degree && PolynomialBend::can_bound(shape, *degree)) {
                bends.polynomial.emplace(shape, *degree);
            }
        }
        return bends;
    }
    std::uint32_t class_of(std::uint64_t element) const {
        std::uint32_t index = 0;
        while (element >= m_volume.classes()[index].first_element + m_volume.classes()[index].n_elements) {
            ++index;
        }
        return index;
    }

    /** Unit normals of points, each with its place in an element. */
    void fill_normals(const std::vector<Vector3>& face_normals, SurfaceMesh& mesh) const {
        std::vector<std::size_t> order(mesh.places.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        std::ranges::stable_sort(order, {}, [&](std::size_t i) { return mesh.places[i].element; });
        mesh.normals.resize(order.size());
        for (std::size_t begin = 0; begin < order.size();) {
            std::size_t end = begin;
            std::vector<Vector3> xi;
            while (end < order.size() && mesh.places[order[end]].element == mesh.places[order[begin]].element) {
                xi.push_back(mesh.places[order[end++]].xi);
            }
            std::vector<SurfacePoint> points = m_sampler->at(mesh.places[order[begin]].element, xi, {});
            for (std::size_t i = begin; i < end; ++i) {
                SurfacePoint& point = points[i - begin];
                const Vector3 normal = point.world(m_sampler->has_level() ? point.level.slope : face_normals[order[i]]);
                const double size = length(normal);
                mesh.normals[order[i]] = size > 0 && std::isfinite(size) ? scaled(normal, 1 / size) : Vector3{};
            }
            begin = end;
        }
    }

    void fill_surface(const CellMesh& cells, const MergedMesh& merged, const MeshDistance& distance, SurfaceMesh& mesh) const {
        std::vector<Vector3> face_normals(merged.vertices.size());
        for (std::uint32_t vertex = 0; vertex < merged.vertices.size(); ++vertex) {
            const CellPoint& point = merged.point(cells, vertex);
            mesh.positions.push_back(point.position);
            mesh.places.push_back({cells.elements()[merged.vertices[vertex].element].element(), point.xi});
        }
        long double area = 0, volume = 0;
        for (const MergedTriangle& triangle : merged.triangles) {
            const ElementCells& element = cells.elements()[triangle.element];
            mesh.triangles.push_back(triangle.vertices);
            mesh.elements.push_back(element.element());
            for (const std::uint32_t vertex : triangle.vertices) {
                if (merged.vertices[vertex].element == triangle.element) {
                    face_normals[vertex] = surface_element(element, element.cells()[triangle.cell]).face_normal;
                }
            }
            const auto& [a, b, c] = triangle.vertices;
            const Vector3 vector =
                cross(minus(mesh.positions[b], mesh.positions[a]), minus(mesh.positions[c], mesh.positions[a]));
            area += 0.5 * length(vector);
            volume += dot(mesh.positions[a], vector) / 6;
        }
        for (const auto& [key, edge] : merged.edges) {
            mesh.n_branching_edges += edge.n_triangles > 2 ? 1 : 0;
            if (edge.n_triangles == 1) {
                const MergedTriangle& triangle = merged.triangles[edge.sides[0].triangle];
                const ElementCells& element = cells.elements()[triangle.element];
                const bool is_rim = is_in_rim(element, triangle, edge.sides[0].side);
                ++(is_rim ? mesh.n_rim_edges : mesh.n_inner_edges);
            }
        }
        mesh.measure = static_cast<double>(area);
        // Normals of isosurfaces point to larger values, which is not always out.
        mesh.volume = static_cast<double>(std::abs(volume));
        mesh.mesh_to_surface = distance.mesh_to_surface;
        mesh.surface_to_mesh = distance.surface_to_mesh;
        mesh.euler_number = static_cast<std::int64_t>(mesh.positions.size()) - static_cast<std::int64_t>(merged.edges.size()) +
                            static_cast<std::int64_t>(mesh.triangles.size());
        fill_normals(face_normals, mesh);
    }

    /** Where a surface ends: in a face without neighbour. Boundaries end where the chosen faces do. */
    bool is_in_rim(const ElementCells& element, const MergedTriangle& triangle, std::size_t side) const {
        if (m_request.surface == Surface::boundary && m_volume.dimension() == 3) {
            return true;
        }
        const std::uint32_t faces = faces_of_side(element, triangle, side);
        if (m_volume.n_faces() == 0 || (faces & m_outer_faces[element.element()]) != 0) {
            return m_volume.n_faces() > 0;
        }
        // In an edge of the element: the outer face there may be another element's.
        return std::popcount(faces) > 1 &&
               is_on_outer_face(scaled(plus(element.points()[triangle.points[side]].position,
                                            element.points()[triangle.points[(side + 1) % 3]].position),
                                       0.5));
    }

    bool is_on_outer_face(const Vector3& position) const {
        // What Newton's method leaves of reference coordinates.
        constexpr double rounding = 1e-7;
        if (!m_finder) {
            m_finder.emplace(m_volume);
        }
        return std::ranges::any_of(m_finder->holders(m_volume, position), [&](const ReferencePoint& place) {
            const elvis_shape shape = m_volume.classes()[class_of(place.element)].shape;
            return (shape_faces(shape).holding(place.xi, rounding) & m_outer_faces[place.element]) != 0;
        });
    }

    void fill_lines(const CellMesh& cells, const ContourLines& contours, SurfaceMesh& mesh) const {
        mesh.line_first.push_back(0);
        for (const ContourPoint& point : contours.points) {
            mesh.positions.push_back(point.at.position);
            mesh.places.push_back({cells.elements()[point.element].element(), point.at.xi});
            const double size = elvis::length(point.normal);
            mesh.normals.push_back(size > 0 ? scaled(point.normal, 1 / size) : Vector3{});
        }
        for (const ContourLine& line : contours.lines) {
            mesh.line_vertices.insert(mesh.line_vertices.end(), line.points.begin(), line.points.end());
            mesh.line_first.push_back(mesh.line_vertices.size());
            mesh.line_values.push_back(line.isovalue);
        }
        mesh.measure = contours.length;
        mesh.mesh_to_surface = mesh.surface_to_mesh = contours.distance;
        mesh.n_open_ends = contours.n_open_ends;
    }

    const RuntimeVolume& m_volume;
    ExtractionRequest m_request;
    const TaskControl& m_control;
    double m_tolerance;
    std::vector<std::uint32_t> m_outer_faces;
    std::vector<DomainPart> m_parts;
    std::optional<SurfaceSampler> m_sampler;
    std::uint64_t m_n_elements = 0;
    /** Made when it is first asked. */
    mutable std::optional<ElementFinder> m_finder;
};

} // namespace

SurfaceMesh extract(const RuntimeVolume& volume, const ExtractionRequest& request, const TaskControl& control) {
    if (!volume.has_evaluation()) {
        throw Error(volume.path(), "the plugin " + volume.plugin().id() + " cannot evaluate on the CPU, which meshes need");
    }
    if (volume.is_cut()) {
        throw Error(volume.path(), "has elements that are only parts of their reference shape, which are not extracted");
    }
    if (request.time_step >= volume.times().size()) {
        throw UsageError(volume.path(), "there is no time step " + std::to_string(request.time_step) + "; the volume has " +
                                            std::to_string(volume.times().size()));
    }
    if (volume.dimension() == 2 && !request.groups.empty()) {
        throw UsageError(volume.path(), "has two dimensions, where a boundary is a line; it is not extracted");
    }
    return Extraction(volume, request, control).find();
}

} // namespace elvis
