/**
 * @file mfem.hpp
 * As much of MFEM's interface as elvis/mfem.hpp calls, with MFEM's names and types, over a mesh and functions in closed form:
 * MFEM is no package of Debian 12. Names and types are those of MFEM 4.5.
 */
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace mfem {

template <class T> class Array {
public:
    Array() = default;
    Array(std::initializer_list<T> list) : m_all(list) {}
    int Size() const { return static_cast<int>(m_all.size()); }
    const T& operator[](int i) const { return m_all[static_cast<std::size_t>(i)]; }
    T* begin() { return m_all.data(); }
    T* end() { return m_all.data() + m_all.size(); }
    const T* begin() const { return m_all.data(); }
    const T* end() const { return m_all.data() + m_all.size(); }
    void Set(std::vector<T> all) { m_all = std::move(all); }

private:
    std::vector<T> m_all;
};

class Vector {
public:
    Vector() = default;
    explicit Vector(int size) { SetSize(size); }
    void SetSize(int size) { m_all.resize(static_cast<std::size_t>(size)); }
    int Size() const { return static_cast<int>(m_all.size()); }
    double& operator()(int i) { return m_all[static_cast<std::size_t>(i)]; }

private:
    std::vector<double> m_all;
};

struct IntegrationPoint {
    double x = 0, y = 0, z = 0;
    void Set3(double x1, double x2, double x3) {
        x = x1;
        y = x2;
        z = x3;
    }
};

class Geometry {
public:
    enum Type { INVALID = -1, POINT = 0, SEGMENT, TRIANGLE, SQUARE, TETRAHEDRON, CUBE, PRISM, PYRAMID };
};

class FiniteElement {
public:
    enum RangeType { UNKNOWN_RANGE_TYPE = -1, SCALAR, VECTOR };
    enum MapType { UNKNOWN_MAP_TYPE = -1, VALUE, INTEGRAL, H_DIV, H_CURL };
    FiniteElement(int order, int range, int map) : m_order(order), m_range(range), m_map(map) {}
    int GetOrder() const { return m_order; }
    int GetRangeType() const { return m_range; }
    int GetMapType() const { return m_map; }

private:
    int m_order, m_range, m_map;
};

class FiniteElementCollection {
public:
    enum { CONTINUOUS, TANGENTIAL, NORMAL, DISCONTINUOUS };
    explicit FiniteElementCollection(int type) : m_type(type) {}
    int GetContType() const { return m_type; }

private:
    int m_type;
};

class FiniteElementSpace {
public:
    /** Elements have the orders in turn. */
    FiniteElementSpace(const std::vector<int>& orders, int continuity, int range = FiniteElement::SCALAR,
                       int map = FiniteElement::VALUE)
        : m_collection(continuity) {
        for (const int order : orders) {
            m_elements.emplace_back(order, range, map);
        }
    }
    const FiniteElement* GetFE(int i) const { return &m_elements[static_cast<std::size_t>(i) % m_elements.size()]; }
    const FiniteElementCollection* FEColl() const { return &m_collection; }

private:
    FiniteElementCollection m_collection;
    std::vector<FiniteElement> m_elements;
};

using Point = std::array<double, 3>;
class Mesh;

/** Values of a function of where a point was before the mesh was bent. */
class GridFunction {
public:
    using Function = std::function<std::vector<double>(const Point&)>;
    GridFunction(const Mesh& mesh, const FiniteElementSpace& space, Function function)
        : m_mesh(&mesh), m_space(&space), m_function(std::move(function)) {}
    const FiniteElementSpace* FESpace() const { return m_space; }
    int VectorDim() const { return static_cast<int>(m_function({0, 0, 0}).size()); }
    void GetVectorValue(int i, const IntegrationPoint& ip, Vector& val) const;

private:
    const Mesh* m_mesh;
    const FiniteElementSpace* m_space;
    Function m_function;
};

class ElementTransformation {
public:
    void Transform(const IntegrationPoint& ip, Vector& position);

    const Mesh* mesh = nullptr;
    int element = 0;
};

/** Elements by their vertices, bent by one function. */
class Mesh {
public:
    struct Element {
        Geometry::Type geometry;
        std::vector<int> vertices;
    };
    struct BoundaryElement {
        int attribute;
        std::vector<int> vertices;
    };

    int Dimension() const { return dimension; }
    int SpaceDimension() const { return dimension; }
    int GetNE() const { return static_cast<int>(elements.size()); }
    int GetNBE() const { return static_cast<int>(boundary.size()); }
    Geometry::Type GetElementBaseGeometry(int i) const { return elements[static_cast<std::size_t>(i)].geometry; }
    void GetElementVertices(int i, Array<int>& v) const { v.Set(elements[static_cast<std::size_t>(i)].vertices); }
    void GetBdrElementVertices(int i, Array<int>& v) const { v.Set(boundary[static_cast<std::size_t>(i)].vertices); }
    int GetBdrAttribute(int i) const { return boundary[static_cast<std::size_t>(i)].attribute; }
    GridFunction* GetNodes() { return nodes; }
    ElementTransformation* GetElementTransformation(int i) {
        m_transformation = {this, i};
        return &m_transformation;
    }
    /** Before it was bent. */
    Point straight(int element, const IntegrationPoint& ip) const;

    int dimension = 3;
    std::vector<Point> vertices;
    std::vector<Element> elements;
    std::vector<BoundaryElement> boundary;
    Array<int> bdr_attributes;
    std::function<Point(const Point&)> bend = [](const Point& x) { return x; };
    GridFunction* nodes = nullptr;
    void* NURBSext = nullptr;

private:
    ElementTransformation m_transformation;
};

/** Functions that are 1 at one vertex of MFEM's reference shape, and 0 at the others. */
inline std::vector<double> vertex_functions(Geometry::Type geometry, const IntegrationPoint& ip) {
    const double x = ip.x, y = ip.y, z = ip.z;
    switch (geometry) {
    case Geometry::TRIANGLE:
        return {1 - x - y, x, y};
    case Geometry::SQUARE:
        return {(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y};
    case Geometry::TETRAHEDRON:
        return {1 - x - y - z, x, y, z};
    case Geometry::PRISM:
        return {(1 - x - y) * (1 - z), x * (1 - z), y * (1 - z), (1 - x - y) * z, x * z, y * z};
    case Geometry::PYRAMID: {
        const double top = 1 - z;
        if (top <= 0) {
            return {0, 0, 0, 0, 1};
        }
        return {(top - x) * (top - y) / top, x * (top - y) / top, x * y / top, (top - x) * y / top, z};
    }
    default:
        return {(1 - x) * (1 - y) * (1 - z), x * (1 - y) * (1 - z), x * y * (1 - z), (1 - x) * y * (1 - z),
                (1 - x) * (1 - y) * z,       x * (1 - y) * z,       x * y * z,       (1 - x) * y * z};
    }
}

inline Point Mesh::straight(int element, const IntegrationPoint& ip) const {
    const Element& of = elements[static_cast<std::size_t>(element)];
    const std::vector<double> weights = vertex_functions(of.geometry, ip);
    Point sum{};
    for (std::size_t i = 0; i < weights.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sum[axis] += weights[i] * vertices[static_cast<std::size_t>(of.vertices[i])][axis];
        }
    }
    return sum;
}

inline void ElementTransformation::Transform(const IntegrationPoint& ip, Vector& position) {
    const Point x = mesh->bend(mesh->straight(element, ip));
    position.SetSize(mesh->SpaceDimension());
    for (int axis = 0; axis < position.Size(); ++axis) {
        position(axis) = x[static_cast<std::size_t>(axis)];
    }
}

inline void GridFunction::GetVectorValue(int i, const IntegrationPoint& ip, Vector& val) const {
    const std::vector<double> values = m_function(m_mesh->straight(i, ip));
    val.SetSize(static_cast<int>(values.size()));
    for (std::size_t component = 0; component < values.size(); ++component) {
        val(static_cast<int>(component)) = values[component];
    }
}

} // namespace mfem
