/**
 * @file mfem.hpp
 * MFEM's meshes and grid functions as a program's arrays (arrays.h), for elvis_data_from_arrays and elvis_insitu_open. For
 * C++17 and later. It is compiled with the program, which includes its own mfem.hpp before; libelvis is not linked to MFEM.
 *
 *     #include <mfem.hpp>
 *     #include <elvis/mfem.hpp>
 *
 *     elvis::mfem_arrays volume(mesh);                   // a Mesh or a ParMesh: the elements of this rank
 *     volume.add("u", u);                                // a GridFunction or a ParGridFunction
 *     elvis_insitu_open(context, &ranks.table, &volume.arrays(), plan, NULL, &insitu);
 *     for (...) {
 *         advance(u);
 *         volume.update();                               // on all ranks, before the step
 *         elvis_insitu_step(insitu, step, time);
 *     }
 *
 * Positions and values are evaluated at as many points of an element as its space has functions. These values determine the
 * element's polynomial, which is drawn as it is. Taken are all orders up to 16, also such that differ by element:
 *  - meshes of triangles, quadrilaterals, tetrahedra, hexahedra and prisms, mixed, curved, in the plane or in space; pyramids
 *    with straight edges;
 *  - continuous and discontinuous fields whose values are mapped by nothing (H1_FECollection, L2_FECollection and the like),
 * with one component or several; on pyramids those of order 1 at most. All else throws std::invalid_argument: NURBS, segments,
 * fields of Nedelec and Raviart-Thomas spaces, densities. Boundary groups are MFEM's boundary attributes, "attribute 3" for
 * one.
 *
 * On several ranks, classes of elements must be the same on all. Where ranks may differ in shapes or orders of their elements,
 * the program gathers kinds() from all ranks, and hands them to add_kinds().
 *
 * Since 0.2.
 */
#ifndef ELVIS_MFEM_HPP
#define ELVIS_MFEM_HPP

#include <elvis/arrays.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

namespace detail {

/** What arrays.h and MFEM call a shape, and which of MFEM's vertices its corners are. */
struct mfem_shape {
    elvis_shape shape;
    std::vector<int> corners;
    /** By corners of arrays.h. */
    std::vector<std::vector<int>> faces;
};

inline mfem_shape mfem_shape_of(mfem::Geometry::Type geometry) {
    switch (geometry) {
    case mfem::Geometry::TRIANGLE:
        return {ELVIS_SHAPE_TRIANGLE, {0, 1, 2}, {{0, 1}, {1, 2}, {0, 2}}};
    case mfem::Geometry::SQUARE:
        return {ELVIS_SHAPE_QUADRILATERAL, {0, 1, 2, 3}, {{0, 1}, {1, 2}, {3, 2}, {0, 3}}};
    case mfem::Geometry::TETRAHEDRON:
        return {ELVIS_SHAPE_TETRAHEDRON, {0, 1, 2, 3}, {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}};
    case mfem::Geometry::CUBE:
        return {ELVIS_SHAPE_HEXAHEDRON,
                {0, 1, 2, 3, 4, 5, 6, 7},
                {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {3, 2, 6, 7}, {0, 3, 7, 4}, {4, 5, 6, 7}}};
    case mfem::Geometry::PRISM:
        return {ELVIS_SHAPE_PRISM, {3, 4, 1, 0, 5, 2}, {{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 5, 4}, {3, 2, 5}, {0, 3, 5, 4}}};
    case mfem::Geometry::PYRAMID:
        return {ELVIS_SHAPE_PYRAMID, {0, 1, 2, 3, 4}, {{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}, {3, 2, 4}, {0, 3, 4}}};
    default:
        throw std::invalid_argument("elements of MFEM's geometry " + std::to_string(static_cast<int>(geometry)) +
                                    " cannot be shown");
    }
}

/** A point in MFEM's reference coordinates, as arrays.h has it. */
inline std::array<double, 3> from_mfem(elvis_shape shape, const std::array<double, 3>& x) {
    if (shape == ELVIS_SHAPE_PRISM) {
        return {2 * x[0] - 1, 1 - 2 * x[2], 2 * x[1] - 1};
    }
    const bool is_flat = shape == ELVIS_SHAPE_TRIANGLE || shape == ELVIS_SHAPE_QUADRILATERAL;
    return {2 * x[0] - 1, 2 * x[1] - 1, is_flat ? 0 : 2 * x[2] - 1};
}

/** The i-th of order + 1 points of [0, 1], denser towards the ends: extrema of a Chebyshev polynomial. */
inline double point_on_line(int i, int order) {
    const double pi = 3.14159265358979323846;
    return 0.5 * (1 - std::cos(pi * i / order));
}

/**
 * In MFEM's reference coordinates: points that determine a polynomial of that order. On triangles and tetrahedra those of
 * Blyth and Pozrikidis, "A Lobatto interpolation grid over the triangle", 2006, with other points on the edges.
 */
inline std::vector<std::array<double, 3>> points_of(elvis_shape shape, int order) {
    std::vector<std::array<double, 3>> points;
    if (order == 0) {
        return {{0.25, 0.25, shape == ELVIS_SHAPE_TRIANGLE || shape == ELVIS_SHAPE_QUADRILATERAL ? 0 : 0.25}};
    }
    const auto at = [order](int i) { return point_on_line(i, order); };
    const auto in_triangle = [&](int i, int j) {
        const double a = at(i), b = at(j), c = at(order - i - j);
        return std::array<double, 2>{(1 + 2 * a - b - c) / 3, (1 + 2 * b - a - c) / 3};
    };
    const bool is_flat = shape == ELVIS_SHAPE_TRIANGLE || shape == ELVIS_SHAPE_QUADRILATERAL;
    const bool is_triangular = shape == ELVIS_SHAPE_TRIANGLE || shape == ELVIS_SHAPE_PRISM;
    if (shape == ELVIS_SHAPE_PYRAMID) {
        return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
    }
    for (int k = 0; k <= (is_flat ? 0 : order); ++k) {
        const int n_across = shape == ELVIS_SHAPE_TETRAHEDRON ? order - k : order;
        for (int j = 0; j <= n_across; ++j) {
            for (int i = 0; i <= (is_triangular || shape == ELVIS_SHAPE_TETRAHEDRON ? n_across - j : order); ++i) {
                const double z = is_flat ? 0 : at(k);
                if (is_triangular) {
                    const std::array<double, 2> p = in_triangle(i, j);
                    points.push_back({p[0], p[1], z});
                } else if (shape == ELVIS_SHAPE_TETRAHEDRON) {
                    const double a = at(i), b = at(j), c = z, d = at(order - i - j - k);
                    points.push_back({(1 + 3 * a - b - c - d) / 4, (1 + 3 * b - a - c - d) / 4, (1 + 3 * c - a - b - d) / 4});
                } else {
                    points.push_back({at(i), at(j), z});
                }
            }
        }
    }
    return points;
}

} // namespace detail

/** Arrays of a mesh and of fields on it. Mesh and fields must outlive it. */
class mfem_arrays {
public:
    /** Shapes and orders, of geometry and then of each field in the order in which they are added, that a class has. */
    struct kind {
        mfem::Geometry::Type geometry;
        std::vector<int> orders;

        friend bool operator<(const kind& a, const kind& b) {
            return std::pair(a.geometry, a.orders) < std::pair(b.geometry, b.orders);
        }
    };

    explicit mfem_arrays(mfem::Mesh& mesh) : m_mesh(mesh) {
        if (mesh.NURBSext != nullptr) {
            throw std::invalid_argument("NURBS meshes are not polynomial and cannot be handed over; they can be converted");
        }
        if (mesh.Dimension() < 2) {
            throw std::invalid_argument("meshes of segments cannot be shown");
        }
    }
    mfem_arrays(const mfem_arrays&) = delete;
    mfem_arrays& operator=(const mfem_arrays&) = delete;

    /** Before the first call of arrays(). */
    void add(const std::string& name, const mfem::GridFunction& values, const std::string& unit = {}) {
        if (m_is_built) {
            throw std::logic_error("fields are added before arrays are asked for");
        }
        m_fields.push_back({name, unit, &values, {}, {}, {}});
    }

    /** Those that elements of this mesh have. After all fields are added. */
    std::vector<kind> kinds() const {
        std::vector<kind> all;
        for (int element = 0; element < m_mesh.GetNE(); ++element) {
            const kind of = kind_of(element);
            const auto at = std::lower_bound(all.begin(), all.end(), of);
            if (at == all.end() || of < *at) {
                all.insert(at, of);
            }
        }
        return all;
    }
    /** What other ranks have. Before the first call of arrays(). */
    void add_kinds(const std::vector<kind>& more) { m_more.insert(m_more.end(), more.begin(), more.end()); }

    /** Valid as long as this is. */
    const elvis_arrays& arrays() {
        if (!m_is_built) {
            build();
        }
        return m_arrays;
    }

    /** Evaluates the fields again, into the same arrays. The mesh, and where its nodes are, must not have changed. */
    void update() {
        arrays();
        for (field& each : m_fields) {
            evaluate(each);
        }
    }

private:
    struct element_class {
        kind of;
        detail::mfem_shape shape;
        std::vector<int> elements;
        std::vector<double> geometry;
        std::vector<std::int32_t> face_groups;
    };
    struct field {
        std::string name, unit;
        const mfem::GridFunction* function;
        std::vector<elvis_space> spaces;
        std::vector<std::vector<double>> values;
        std::vector<const double*> pointers;
    };

    int geometry_order(int element) const {
        const mfem::GridFunction* const nodes = m_mesh.GetNodes();
        return nodes != nullptr ? std::max(1, nodes->FESpace()->GetFE(element)->GetOrder()) : 1;
    }

    static int field_order(const field& of, int element) {
        const mfem::FiniteElement& finite_element = *of.function->FESpace()->GetFE(element);
        if (finite_element.GetRangeType() != mfem::FiniteElement::SCALAR ||
            finite_element.GetMapType() != mfem::FiniteElement::VALUE) {
            throw std::invalid_argument("the field '" + of.name +
                                        "' is mapped with the geometry (Nedelec, Raviart-Thomas or a density): it is no "
                                        "polynomial of the element, and cannot be handed over; its file can be converted");
        }
        return finite_element.GetOrder();
    }

    void need_order(mfem::Geometry::Type geometry, int order, const std::string& what) const {
        constexpr int most = 16;
        if (order > most || (geometry == mfem::Geometry::PYRAMID && order > 1)) {
            throw std::invalid_argument(what + " has order " + std::to_string(order) + " in an element of MFEM's geometry " +
                                        std::to_string(static_cast<int>(geometry)) + "; at most " +
                                        std::to_string(geometry == mfem::Geometry::PYRAMID ? 1 : most) + " can be shown");
        }
    }

    kind kind_of(int element) const {
        kind of{m_mesh.GetElementBaseGeometry(element), {geometry_order(element)}};
        need_order(of.geometry, of.orders[0], "the mesh");
        for (const field& each : m_fields) {
            of.orders.push_back(field_order(each, element));
            need_order(of.geometry, of.orders.back(), "the field '" + each.name + "'");
        }
        return of;
    }

    /** Points of a space are the same for all classes that have it. */
    const std::vector<std::array<double, 3>>& points_of(elvis_shape shape, int order) {
        auto& points = m_points[{shape, order}];
        if (points.empty()) {
            points = detail::points_of(shape, order);
        }
        return points;
    }

    elvis_space space_of(elvis_shape shape, int order) {
        std::vector<double>& nodes = m_nodes[{shape, order}];
        if (nodes.empty()) {
            for (const std::array<double, 3>& point : points_of(shape, order)) {
                const std::array<double, 3> xi = detail::from_mfem(shape, point);
                nodes.insert(nodes.end(), xi.begin(), xi.end());
            }
        }
        const bool is_flat = shape == ELVIS_SHAPE_TRIANGLE || shape == ELVIS_SHAPE_QUADRILATERAL;
        const auto n = static_cast<std::uint32_t>(order);
        elvis_space space{};
        space.struct_size = sizeof space;
        space.basis = ELVIS_BASIS_MODIFIED;
        space.order[0] = space.order[1] = n;
        space.order[2] = is_flat ? 0 : n;
        space.nodes = nodes.data();
        return space;
    }

    static mfem::IntegrationPoint point(const std::array<double, 3>& at) {
        mfem::IntegrationPoint result;
        result.Set3(at[0], at[1], at[2]);
        return result;
    }

    void place(element_class& of) {
        const auto& points = points_of(of.shape.shape, of.of.orders[0]);
        of.geometry.resize(of.elements.size() * 3 * points.size());
        mfem::Vector position(m_mesh.SpaceDimension());
        for (std::size_t i = 0; i < of.elements.size(); ++i) {
            mfem::ElementTransformation* const mapping = m_mesh.GetElementTransformation(of.elements[i]);
            for (std::size_t k = 0; k < points.size(); ++k) {
                mapping->Transform(point(points[k]), position);
                for (int axis = 0; axis < position.Size(); ++axis) {
                    of.geometry[(3 * i + static_cast<std::size_t>(axis)) * points.size() + k] = position(axis);
                }
            }
        }
    }

    void evaluate(field& of) {
        const auto n_components = static_cast<std::size_t>(of.function->VectorDim());
        mfem::Vector value;
        for (std::size_t number = 0; number < m_classes.size(); ++number) {
            const element_class& own = m_classes[number];
            const int order = own.of.orders[1 + static_cast<std::size_t>(&of - m_fields.data())];
            const auto& points = points_of(own.shape.shape, order);
            std::vector<double>& values = of.values[number];
            values.resize(own.elements.size() * n_components * points.size());
            for (std::size_t i = 0; i < own.elements.size(); ++i) {
                for (std::size_t k = 0; k < points.size(); ++k) {
                    of.function->GetVectorValue(own.elements[i], point(points[k]), value);
                    for (std::size_t component = 0; component < n_components; ++component) {
                        values[(n_components * i + component) * points.size() + k] = value(static_cast<int>(component));
                    }
                }
            }
        }
    }

    /** Boundary groups by the vertices of faces. */
    std::map<std::vector<int>, std::int32_t> groups() {
        for (int i = 0; i < m_mesh.bdr_attributes.Size(); ++i) {
            m_group_names.push_back("attribute " + std::to_string(m_mesh.bdr_attributes[i]));
        }
        std::map<std::vector<int>, std::int32_t> of_face;
        mfem::Array<int> vertices;
        for (int i = 0; i < m_mesh.GetNBE(); ++i) {
            m_mesh.GetBdrElementVertices(i, vertices);
            std::vector<int> key(vertices.begin(), vertices.end());
            std::sort(key.begin(), key.end());
            const int* const begin = m_mesh.bdr_attributes.begin();
            const int* const end = m_mesh.bdr_attributes.end();
            of_face[key] = static_cast<std::int32_t>(std::find(begin, end, m_mesh.GetBdrAttribute(i)) - begin);
        }
        return of_face;
    }

    void find_groups(const std::map<std::vector<int>, std::int32_t>& of_face, element_class& own) {
        mfem::Array<int> vertices;
        for (const int element : own.elements) {
            m_mesh.GetElementVertices(element, vertices);
            for (const std::vector<int>& corners : own.shape.faces) {
                std::vector<int> key;
                for (const int corner : corners) {
                    key.push_back(vertices[own.shape.corners[static_cast<std::size_t>(corner)]]);
                }
                std::sort(key.begin(), key.end());
                const auto found = of_face.find(key);
                own.face_groups.push_back(found != of_face.end() ? found->second : ELVIS_GROUP_NONE);
            }
        }
    }

    void build() {
        std::map<kind, std::vector<int>> elements;
        for (const kind& other : m_more) {
            elements[other];
        }
        for (int element = 0; element < m_mesh.GetNE(); ++element) {
            elements[kind_of(element)].push_back(element);
        }
        for (const auto& [of, own] : elements) {
            m_classes.push_back({of, detail::mfem_shape_of(of.geometry), own, {}, {}});
        }
        const std::map<std::vector<int>, std::int32_t> of_face = groups();
        for (element_class& own : m_classes) {
            place(own);
            find_groups(of_face, own);
            m_geometry_spaces.push_back(space_of(own.shape.shape, own.of.orders[0]));
        }
        for (std::size_t number = 0; number < m_fields.size(); ++number) {
            field& of = m_fields[number];
            of.values.resize(m_classes.size());
            evaluate(of);
            for (std::size_t i = 0; i < m_classes.size(); ++i) {
                of.spaces.push_back(space_of(m_classes[i].shape.shape, m_classes[i].of.orders[1 + number]));
                of.pointers.push_back(of.values[i].data());
            }
        }
        fill();
        m_is_built = true;
    }

    void fill() {
        for (std::size_t i = 0; i < m_classes.size(); ++i) {
            const element_class& own = m_classes[i];
            elvis_array_class as{};
            as.struct_size = sizeof as;
            as.shape = own.shape.shape;
            as.n_elements = own.elements.size();
            as.geometry_space = &m_geometry_spaces[i];
            as.geometry = own.geometry.data();
            as.face_groups = own.face_groups.data();
            m_array_classes.push_back(as);
        }
        for (const field& each : m_fields) {
            elvis_array_field as{};
            as.struct_size = sizeof as;
            as.n_components = static_cast<std::uint32_t>(each.function->VectorDim());
            as.name = each.name.c_str();
            as.unit = each.unit.empty() ? nullptr : each.unit.c_str();
            const bool is_continuous =
                each.function->FESpace()->FEColl()->GetContType() == mfem::FiniteElementCollection::CONTINUOUS;
            as.continuity = is_continuous ? ELVIS_CONTINUITY_CONTINUOUS : ELVIS_CONTINUITY_DISCONTINUOUS;
            as.spaces = each.spaces.data();
            as.values = each.pointers.data();
            m_array_fields.push_back(as);
        }
        for (const std::string& name : m_group_names) {
            m_groups.push_back(name.c_str());
        }
        m_arrays.struct_size = sizeof m_arrays;
        m_arrays.dimension = static_cast<std::uint32_t>(m_mesh.Dimension());
        m_arrays.n_classes = static_cast<std::uint32_t>(m_array_classes.size());
        m_arrays.classes = m_array_classes.data();
        m_arrays.n_fields = static_cast<std::uint32_t>(m_array_fields.size());
        m_arrays.fields = m_array_fields.data();
        m_arrays.n_boundary_groups = static_cast<std::uint32_t>(m_groups.size());
        m_arrays.boundary_groups = m_groups.data();
    }

    mfem::Mesh& m_mesh;
    std::vector<kind> m_more;
    std::vector<field> m_fields;
    bool m_is_built = false;
    std::map<std::pair<elvis_shape, int>, std::vector<std::array<double, 3>>> m_points;
    std::map<std::pair<elvis_shape, int>, std::vector<double>> m_nodes;
    std::deque<element_class> m_classes;
    std::deque<elvis_space> m_geometry_spaces;
    std::vector<std::string> m_group_names;
    std::vector<elvis_string> m_groups;
    std::vector<elvis_array_class> m_array_classes;
    std::vector<elvis_array_field> m_array_fields;
    elvis_arrays m_arrays{};
};

} // namespace elvis

#endif
