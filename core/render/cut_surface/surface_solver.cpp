#include <core/base/float_rounding.hpp>
#include <core/base/infinity.hpp>
#include <core/expression/glsl.hpp>
#include <core/hierarchy/hierarchy.hpp>
#include <core/render/cut_surface/surface_solver.hpp>
#include <core/render/tiles/tile_list.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <sstream>

namespace elvis {

namespace {

/** What a solver needs besides its library file. */
struct SolverKind {
    std::string file;
    std::vector<std::pair<std::string, std::string>> defines;
    /** Pixels of a column that one invocation looks for: few where each may take many iterations. */
    std::uint32_t hit_rows = surface_tile_height;
};

SolverKind kind_of(const std::string& solver) {
    if (solver == "round") {
        return {"quadric", {{"CORE_HAS_ENDS", "1"}}};
    }
    if (solver == "mesh" || solver == "bezier" || solver == "tubes" || solver == "ribbons" || solver == "arrows" ||
        solver == "implicit") {
        return {solver, {}, 4};
    }
    return {solver, {{"CORE_HAS_ENDS", "0"}}};
}

struct SolvedBox {
    Vector3 lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
};

/** Adds a point's coordinates about the middle, which the device rounds, and makes the box hold it. */
void add_point(const Vector3& point, const Vector3& middle, SolvedBox& box, std::vector<double>& numbers) {
    for (std::size_t i = 0; i < 3; ++i) {
        box.lower[i] = std::min(box.lower[i], point[i]);
        box.upper[i] = std::max(box.upper[i], point[i]);
        numbers.push_back(point[i] - middle[i]);
    }
}

/** Adds a box, and what single precision may move its points. */
void add_box(const SolvedBox& box, const Vector3& middle, std::vector<double>& numbers) {
    Vector3 rounding{};
    for (std::size_t i = 0; i < 3; ++i) {
        rounding[i] = 1.2e-7 * std::max(std::abs(box.lower[i] - middle[i]), std::abs(box.upper[i] - middle[i]));
        numbers.push_back(box.lower[i] - rounding[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        numbers.push_back(box.upper[i] + rounding[i]);
    }
}

/**
 * Where coordinates of functions begin: 0 for a volume near the origin, else a point near the volume, exact in single
 * precision, that stays where it is while the volume moves a little.
 */
Vector3 origin_near(const std::array<double, 6>& bounds) {
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        size = std::max(size, bounds[i + 3] - bounds[i]);
    }
    const double step = std::exp2(std::ceil(std::log2(2 * size)));
    Vector3 origin{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double middle = 0.5 * (bounds[i] + bounds[i + 3]);
        origin[i] = step > 0 && std::isfinite(step) ? exact_in_float(step * std::round(middle / step)) : 0;
    }
    return origin;
}

double distance(const Vector3& a, const Vector3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/**
 * Into how many parts each direction of a patch is divided: so many that second differences of control points, which fall with
 * the square of the number, are small compared with first ones, which fall with the number.
 */
int bezier_parts(const BezierPatch& patch) {
    const auto& p = patch.points;
    double first = 0, second = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            const auto along = [&](std::size_t index, std::size_t step) {
                const Vector3 middle = {0.5 * (p[index][0] + p[index + 2 * step][0]),
                                        0.5 * (p[index][1] + p[index + 2 * step][1]),
                                        0.5 * (p[index][2] + p[index + 2 * step][2])};
                second = std::max(second, 2 * distance(middle, p[index + step]));
            };
            if (i < 2) {
                along(4 * i + j, 4);
            }
            if (j < 2) {
                along(4 * i + j, 1);
            }
            first = std::max({first, i < 3 ? distance(p[4 * i + j], p[4 * i + j + 4]) : 0.0,
                              j < 3 ? distance(p[4 * i + j], p[4 * i + j + 1]) : 0.0});
        }
    }
    int n = 1;
    while (n < 8 && second > 0.1 * first * n) {
        n *= 2;
    }
    return n;
}

} // namespace

std::string solver_key(const CutShape& shape) {
    std::ostringstream key;
    key << shape_solver(shape);
    if (const auto* surface = std::get_if<MeshSurface>(&shape)) {
        key << ' ' << static_cast<const void*>(surface->mesh.get());
    } else if (const auto* function = std::get_if<ImplicitSurface>(&shape)) {
        key << ' ' << function->expression;
    } else if (const auto* patches = std::get_if<BezierSurface>(&shape)) {
        key << ' ' << static_cast<const void*>(patches->mesh.get());
    } else if (const auto* tubes = std::get_if<TubeSurface>(&shape)) {
        key << ' ' << static_cast<const void*>(tubes->tubes.get());
    } else if (const auto* ribbons = std::get_if<RibbonSurface>(&shape)) {
        key << ' ' << static_cast<const void*>(ribbons->ribbons.get());
    } else if (const auto* arrows = std::get_if<ArrowSurface>(&shape)) {
        key << ' ' << static_cast<const void*>(arrows->arrows.get());
    }
    return key.str();
}

SurfaceSolver::SurfaceSolver(const Device& device, Precision precision, const CutShape& shape,
                             const std::array<double, 6>& bounds)
    : m_device(device), m_precision(precision) {
    const ShapeFrame frame = shape_frame(shape, {});
    m_n_rows = 2 + static_cast<std::uint32_t>(frame.rows.size());
    m_rows.emplace(device, m_n_rows * 4 * real_bytes(precision), Buffer::Use::uniform);
    const SolverKind kind = kind_of(frame.solver);
    m_hit_rows = kind.hit_rows;
    m_is_quadric = frame.solver == "quadric";
    KernelRequest request;
    request.name = "surface_hits of " + frame.solver;
    request.kernel = request.name;
    request.kernel_text = "#include \"surface/" + kind.file + ".glsl\"\n#include \"surface/hits.comp\"\n";
    request.precision = precision;
    request.defines = kind.defines;
    request.defines.insert(request.defines.end(), {{"CORE_TILE_WIDTH", std::to_string(tile_width_on(device)) + "u"},
                                                   {"CORE_TILE_HEIGHT", std::to_string(surface_tile_height) + "u"},
                                                   {"CORE_HIT_ROWS", std::to_string(m_hit_rows) + "u"},
                                                   {"CORE_SHAPE_ROWS", std::to_string(m_n_rows)}});
    if (const auto* function = std::get_if<ImplicitSurface>(&shape)) {
        m_origin = origin_near(bounds);
        request.text = implicit_glsl(Expression::implicit(function->expression), m_origin);
    } else if (const auto* surface = std::get_if<MeshSurface>(&shape)) {
        m_mesh = surface->mesh;
        upload(*surface->mesh, shape_middle(shape));
        request.buffers = {{"core_triangles", m_items.get()}, {"core_nodes", m_nodes.get()}};
    } else if (const auto* patches = std::get_if<BezierSurface>(&shape)) {
        m_mesh = patches->mesh;
        upload(*patches->mesh, shape_middle(shape));
        request.buffers = {{"core_patches", m_items.get()}, {"core_nodes", m_nodes.get()}};
    } else if (const auto* tubes = std::get_if<TubeSurface>(&shape)) {
        m_mesh = tubes->tubes;
        upload(*tubes->tubes, shape_middle(shape));
        request.buffers = {{"core_tubes", m_items.get()}, {"core_nodes", m_nodes.get()}};
    } else if (const auto* ribbons = std::get_if<RibbonSurface>(&shape)) {
        m_mesh = ribbons->ribbons;
        upload(*ribbons->ribbons, shape_middle(shape));
        request.buffers = {{"core_ribbons", m_items.get()}, {"core_nodes", m_nodes.get()}};
    } else if (const auto* arrows = std::get_if<ArrowSurface>(&shape)) {
        m_mesh = arrows->arrows;
        upload(*arrows->arrows, shape_middle(shape));
        request.buffers = {
            {"core_arrows", m_items.get()}, {"core_arrow_numbers", m_numbers.get()}, {"core_nodes", m_nodes.get()}};
    }
    request.bindings = buffer_bindings({.uniform = 2, .storage = has_own_values() ? 8u : 7u});
    request.push_constant_bytes = sizeof(HitsParameters);
    m_kernel = std::make_unique<ComposedKernel>(device, request);
}

/** Corners, and a hierarchy over the triangles. */
void SurfaceSolver::upload(const TriangleMesh& mesh, const Vector3& middle) {
    std::vector<double> corners, boxes;
    corners.reserve(9 * mesh.triangles.size());
    boxes.reserve(6 * mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        SolvedBox box;
        for (const std::uint32_t corner : triangle) {
            add_point(mesh.points[corner], middle, box, corners);
        }
        add_box(box, middle, boxes);
    }
    upload_nodes(boxes, middle);
    m_items = std::make_unique<RecordBuffer>(m_device, RecordKind::real, m_precision, mesh.triangles.size(), 9);
    m_items->write_reals(0, corners);
}

/** Parts of patches that are nearly flat, whose hulls are tight, and a hierarchy over them. */
void SurfaceSolver::upload(const PatchMesh& mesh, const Vector3& middle) {
    std::vector<double> points, boxes;
    for (const BezierPatch& patch : mesh.patches) {
        const int n = bezier_parts(patch);
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                SolvedBox box;
                for (const auto& point : patch.part(static_cast<double>(i) / n, static_cast<double>(j) / n, 1.0 / n).points) {
                    add_point(point, middle, box, points);
                }
                add_box(box, middle, boxes);
            }
        }
    }
    upload_nodes(boxes, middle);
    m_items = std::make_unique<RecordBuffer>(m_device, RecordKind::real, m_precision, points.size() / 48, 48);
    m_items->write_reals(0, points);
}

void SurfaceSolver::upload(const TubeSet& tubes, const Vector3& middle) {
    std::vector<double> points, boxes;
    for (const TubeSet::Piece& piece : tubes.pieces) {
        for (const Vector3& point : piece) {
            for (std::size_t i = 0; i < 3; ++i) {
                points.push_back(point[i] - middle[i]);
            }
        }
        SolvedBox box;
        std::vector<double> corners;
        for (const double side : {-tubes.radius, tubes.radius}) {
            add_point(plus(piece[1], {side, side, side}), middle, box, corners);
            add_point(plus(piece[2], {side, side, side}), middle, box, corners);
        }
        add_box(box, middle, boxes);
    }
    upload_nodes(boxes, middle);
    m_items = std::make_unique<RecordBuffer>(m_device, RecordKind::real, m_precision, tubes.pieces.size(), 12);
    m_items->write_reals(0, points);
}

void SurfaceSolver::upload(const RibbonSet& ribbons, const Vector3& middle) {
    std::vector<double> corners, boxes;
    for (const RibbonSet::Piece& piece : ribbons.pieces) {
        SolvedBox box;
        for (const Vector3& corner : piece) {
            add_point(corner, middle, box, corners);
        }
        add_box(box, middle, boxes);
    }
    upload_nodes(boxes, middle);
    m_items = std::make_unique<RecordBuffer>(m_device, RecordKind::real, m_precision, ribbons.pieces.size(), 12);
    m_items->write_reals(0, corners);
}

void SurfaceSolver::upload(const ArrowSet& set, const Vector3& middle) {
    std::vector<double> numbers, boxes;
    std::vector<std::uint32_t> elements;
    for (const ArrowSet::Arrow& arrow : set.arrows) {
        for (const Vector3& end : {arrow.from, arrow.to}) {
            for (std::size_t i = 0; i < 3; ++i) {
                numbers.push_back(end[i] - middle[i]);
            }
        }
        numbers.insert(numbers.end(), {arrow.value, 0});
        elements.push_back(arrow.number);
        const std::array<double, 6> bounds = bounds_of(arrow);
        SolvedBox box;
        std::vector<double> corners;
        add_point({bounds[0], bounds[1], bounds[2]}, middle, box, corners);
        add_point({bounds[3], bounds[4], bounds[5]}, middle, box, corners);
        add_box(box, middle, boxes);
    }
    upload_nodes(boxes, middle);
    m_items = std::make_unique<RecordBuffer>(m_device, RecordKind::real, m_precision, set.arrows.size(), 8);
    m_items->write_reals(0, numbers);
    m_numbers = std::make_unique<RecordBuffer>(m_device, RecordKind::uint, m_precision, elements.size(), 1);
    m_numbers->write_uints(0, elements);
}

void SurfaceSolver::upload_nodes(std::span<const double> boxes, const Vector3& middle) {
    const Hierarchy hierarchy(boxes, middle);
    m_nodes = std::make_unique<RecordBuffer>(m_device, RecordKind::uint, m_precision, hierarchy.nodes().size(), node_size);
    m_nodes->write_uints(0, node_words(hierarchy.nodes()));
}

void SurfaceSolver::begin(const CutShape& shape, const CutPlaneGeometry& view, const std::array<double, 6>& bounds,
                          double most_error, bool ends_in_box) const {
    const std::array<double, 4>& at = view.rows[6];
    const Vector3 reference = {at[0], at[1], at[2]};
    const ShapeFrame frame = shape_frame(shape, minus(reference, m_origin));
    std::vector<std::array<double, 4>> rows = {
        {bounds[0] - reference[0], bounds[1] - reference[1], bounds[2] - reference[2], most_error},
        {bounds[3] - reference[0], bounds[4] - reference[1], bounds[5] - reference[2], ends_in_box ? 1.0 : 0.0}};
    rows.insert(rows.end(), frame.rows.begin(), frame.rows.end());
    assert(rows.size() == m_n_rows);
    write_reals(*m_rows, m_precision, std::span<const double>(rows.front().data(), 4 * rows.size()));
}

void SurfaceSolver::find(const Buffer& frame, std::span<const Buffer* const> buffers, std::span<const std::byte> parameters,
                         std::uint32_t tiles_a_row, std::uint32_t tile_rows) const {
    std::vector<const Buffer*> bindings = {&frame, &*m_rows};
    bindings.insert(bindings.end(), buffers.begin(), buffers.end());
    m_kernel->dispatch(bindings, parameters, tiles_a_row, tile_rows * boxes_a_tile());
}

} // namespace elvis
