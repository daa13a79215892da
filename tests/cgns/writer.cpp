// Writes the files of the tests with the CGNS library, in a program of its own: the library has its own HDF5.
// usage: cgns_writer KIND CONTAINER FILE, where CONTAINER is hdf5 or adf
#include "closed_forms.hpp"
#include "node_tables.hpp"

#include <cgns_io.h>
#include <cgnslib.h>

#include <cstring>
#include <iostream>
#include <map>
#include <stdexcept>
#include <utility>

using namespace cgns_test;

namespace {

void check(int status) {
    if (status != CG_OK) {
        throw std::runtime_error(cg_get_error());
    }
}

/** An open file with one base. */
class File {
public:
    File(const std::string& path, const std::string& container, int dimension, int n_coordinates) {
        check(cg_set_file_type(container == "adf" ? CG_FILE_ADF : CG_FILE_HDF5));
        check(cg_open(path.c_str(), CG_MODE_WRITE, &m_file));
        check(cg_base_write(m_file, "Base", dimension, n_coordinates, &m_base));
    }
    ~File() { cg_close(m_file); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    int id() const { return m_file; }
    int base() const { return m_base; }

    int unstructured_zone(const std::string& name, std::size_t n_vertices, std::size_t n_cells) {
        const std::array<cgsize_t, 3> sizes{static_cast<cgsize_t>(n_vertices), static_cast<cgsize_t>(n_cells), 0};
        int zone = 0;
        check(cg_zone_write(m_file, m_base, name.c_str(), sizes.data(), CGNS_ENUMV(Unstructured), &zone));
        return zone;
    }

    void coordinates(int zone, const std::vector<Point>& points, std::size_t n_coordinates) {
        constexpr std::array names{"CoordinateX", "CoordinateY", "CoordinateZ"};
        for (std::size_t axis = 0; axis < n_coordinates; ++axis) {
            const std::vector<double> values = column(points, axis);
            int coordinate = 0;
            check(cg_coord_write(m_file, m_base, zone, CGNS_ENUMV(RealDouble), names[axis], values.data(), &coordinate));
        }
    }

    void section(int zone, const std::string& name, CGNS_ENUMT(ElementType_t) type, cgsize_t first, cgsize_t last,
                 const std::vector<cgsize_t>& nodes) {
        int section = 0;
        check(cg_section_write(m_file, m_base, zone, name.c_str(), type, first, last, 0, nodes.data(), &section));
    }

    /** Elements of different numbers of nodes: also where each one begins. */
    void section(int zone, const std::string& name, CGNS_ENUMT(ElementType_t) type, cgsize_t first,
                 const std::vector<std::vector<cgsize_t>>& elements) {
        std::vector<cgsize_t> nodes, offsets{0};
        for (const std::vector<cgsize_t>& element : elements) {
            nodes.insert(nodes.end(), element.begin(), element.end());
            offsets.push_back(static_cast<cgsize_t>(nodes.size()));
        }
        const cgsize_t last = first + static_cast<cgsize_t>(elements.size()) - 1;
        int section = 0;
        check(cg_poly_section_write(m_file, m_base, zone, name.c_str(), type, first, last, 0, nodes.data(), offsets.data(),
                                    &section));
    }

    int solution(int zone, const std::string& name, CGNS_ENUMT(GridLocation_t) location) {
        int solution = 0;
        check(cg_sol_write(m_file, m_base, zone, name.c_str(), location, &solution));
        return solution;
    }

    void array(int zone, int solution, const std::string& name, const std::vector<double>& values) {
        int field = 0;
        check(cg_field_write(m_file, m_base, zone, solution, CGNS_ENUMV(RealDouble), name.c_str(), values.data(), &field));
    }

    int condition(int zone, const std::string& name, CGNS_ENUMT(PointSetType_t) kind, const std::vector<cgsize_t>& points,
                  std::size_t n_indices, CGNS_ENUMT(GridLocation_t) location, const std::string& family = "") {
        int condition = 0;
        check(cg_boco_write(m_file, m_base, zone, name.c_str(),
                            family.empty() ? CGNS_ENUMV(BCWall) : CGNS_ENUMV(FamilySpecified), kind,
                            static_cast<cgsize_t>(points.size() / n_indices), points.data(), &condition));
        // For elements the library itself writes where they lie.
        if (kind == CGNS_ENUMV(PointRange) || kind == CGNS_ENUMV(PointList)) {
            check(cg_boco_gridlocation_write(m_file, m_base, zone, condition, location));
        }
        if (!family.empty()) {
            check(cg_goto(m_file, m_base, "Zone_t", zone, "ZoneBC_t", 1, "BC_t", condition, "end"));
            check(cg_famname_write(family.c_str()));
        }
        return condition;
    }

    void times(int zone, const std::vector<double>& times, const std::vector<std::string>& solutions,
               const std::string& pointers = "FlowSolutionPointers") {
        const cgsize_t n = static_cast<cgsize_t>(times.size());
        if (zone == 1) {
            check(cg_simulation_type_write(m_file, m_base, CGNS_ENUMV(TimeAccurate)));
            check(cg_biter_write(m_file, m_base, "Times", static_cast<int>(n)));
            check(cg_goto(m_file, m_base, "BaseIterativeData_t", 1, "end"));
            check(cg_array_write("TimeValues", CGNS_ENUMV(RealDouble), 1, &n, times.data()));
        }
        check(cg_ziter_write(m_file, m_base, zone, "ZoneIterativeData"));
        check(cg_goto(m_file, m_base, "Zone_t", zone, "ZoneIterativeData_t", 1, "end"));
        std::string names(32 * times.size(), ' ');
        for (std::size_t step = 0; step < solutions.size(); ++step) {
            names.replace(32 * step, solutions[step].size(), solutions[step]);
        }
        const std::array<cgsize_t, 2> shape{32, n};
        check(cg_array_write(pointers.c_str(), CGNS_ENUMV(Character), 2, shape.data(), names.data()));
    }

    static std::vector<double> column(const std::vector<Point>& points, std::size_t axis) {
        std::vector<double> values;
        for (const Point& point : points) {
            values.push_back(point[axis]);
        }
        return values;
    }

private:
    int m_file = 0;
    int m_base = 0;
};

CGNS_ENUMT(ElementType_t) type_of(const std::string& name) {
    for (int type = 0; type < NofValidElementTypes; ++type) {
        if (name == ElementTypeName[type]) {
            return static_cast<CGNS_ENUMT(ElementType_t)>(type);
        }
    }
    throw std::runtime_error("no such type of elements: " + name);
}

std::vector<cgsize_t> counted(std::size_t n) {
    std::vector<cgsize_t> numbers(n);
    for (std::size_t index = 0; index < n; ++index) {
        numbers[index] = static_cast<cgsize_t>(index + 1);
    }
    return numbers;
}

/** A zone of one element for each type: 001, 002, ... */
void write_elements(const std::string& container, const std::string& path, int dimension) {
    File file(path, container, dimension, dimension);
    int place = 0;
    for (const ElementTable& table : element_tables()) {
        if (table.dimension != dimension) {
            continue;
        }
        const int degree = table.is_complete ? table.order : std::min(table.order, 2);
        std::vector<Point> points;
        std::vector<double> values;
        for (const Point& node : table.nodes) {
            points.push_back(bent(degree, dimension, node, place));
            values.push_back(value(degree, node));
        }
        const std::string name = std::to_string(1000 + place).substr(1);
        const int zone = file.unstructured_zone(name, points.size(), 1);
        file.coordinates(zone, points, static_cast<std::size_t>(dimension));
        file.section(zone, table.name, type_of(table.name), 1, 1, counted(points.size()));
        const int at_vertices = file.solution(zone, "AtVertices", CGNS_ENUMV(Vertex));
        file.array(zone, at_vertices, "Density", values);
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
            file.array(zone, at_vertices, std::string("Velocity") + "XYZ"[axis], File::column(points, axis));
        }
        const int in_cells = file.solution(zone, "InCells", CGNS_ENUMV(CellCenter));
        file.array(zone, in_cells, "Density", {place + 0.5});
        ++place;
    }
}

/** Vertices of a grid of boxes with edges of length 1, the first index the fastest. */
std::vector<Point> grid(const std::array<std::size_t, 3>& n, const Point& origin) {
    std::vector<Point> points;
    for (std::size_t k = 0; k < n[2]; ++k) {
        for (std::size_t j = 0; j < n[1]; ++j) {
            for (std::size_t i = 0; i < n[0]; ++i) {
                points.push_back({origin[0] + static_cast<double>(i), origin[1] + static_cast<double>(j),
                                  origin[2] + static_cast<double>(k)});
            }
        }
    }
    return points;
}

void write_fields(File& file, int zone, int solution, const std::vector<Point>& points, double time) {
    std::vector<double> pressures;
    std::vector<Point> velocities;
    for (const Point& point : points) {
        pressures.push_back(pressure(point));
        velocities.push_back(velocity(point, time));
    }
    file.array(zone, solution, "Pressure", pressures);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        file.array(zone, solution, std::string("Velocity") + "XYZ"[axis], File::column(velocities, axis));
    }
}

/** Two structured zones of 2 x 3 x 1 and 1 x 3 x 1 cells side by side, three time steps, boundary conditions of each kind. */
void write_structured(const std::string& container, const std::string& path) {
    File file(path, container, 3, 3);
    for (std::size_t side = 0; side < 2; ++side) {
        const std::array<std::size_t, 3> n{side == 0 ? 3u : 2u, 4, 2};
        std::array<cgsize_t, 9> sizes{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sizes[axis] = static_cast<cgsize_t>(n[axis]);
            sizes[3 + axis] = sizes[axis] - 1;
        }
        int zone = 0;
        check(cg_zone_write(file.id(), file.base(), side == 0 ? "Left" : "Right", sizes.data(), CGNS_ENUMV(Structured), &zone));
        const std::vector<Point> points = grid(n, {side == 0 ? 0.0 : 2.0, 0, 0});
        file.coordinates(zone, points, 3);
        for (int step = 0; step < 3; ++step) {
            const int solution = file.solution(zone, "Step" + std::to_string(step), CGNS_ENUMV(Vertex));
            write_fields(file, zone, solution, points, 0.5 * step);
        }
        file.times(zone, {0, 0.5, 1}, {"Step0", "Step1", "Step2"});
        const cgsize_t i = sizes[0], j = sizes[1], k = sizes[2];
        if (side == 0) {
            file.condition(zone, "Inflow", CGNS_ENUMV(PointRange), {1, 1, 1, 1, j, k}, 3, CGNS_ENUMV(Vertex));
            file.condition(zone, "Low", CGNS_ENUMV(PointRange), {1, 1, 1, i - 1, j - 1, 1}, 3, CGNS_ENUMV(KFaceCenter),
                           "Walls");
        } else {
            file.condition(zone, "Outflow", CGNS_ENUMV(PointList), {i, 1, 1, i, 2, 1, i, 3, 1}, 3, CGNS_ENUMV(IFaceCenter));
            file.condition(zone, "High", CGNS_ENUMV(PointRange), {1, 1, k, i - 1, j - 1, k}, 3, CGNS_ENUMV(KFaceCenter),
                           "Walls");
        }
    }
}

/** Values in cells of one structured zone in the plane, with a rind of one cell on the first and two on the last side of i. */
void write_rind(const std::string& container, const std::string& path) {
    File file(path, container, 2, 2);
    const std::array<cgsize_t, 6> sizes{4, 3, 3, 2, 0, 0};
    int zone = 0;
    check(cg_zone_write(file.id(), file.base(), "Plane", sizes.data(), CGNS_ENUMV(Structured), &zone));
    file.coordinates(zone, grid({4, 3, 1}, {0, 0, 0}), 2);
    const int solution = file.solution(zone, "InCells", CGNS_ENUMV(CellCenter));
    check(cg_goto(file.id(), file.base(), "Zone_t", zone, "FlowSolution_t", solution, "end"));
    const std::array<int, 4> rind{1, 2, 0, 0};
    check(cg_rind_write(rind.data()));
    std::vector<double> values;
    for (int j = 0; j < 2; ++j) {
        for (int i = -1; i < 5; ++i) {
            values.push_back(i < 0 || i > 2 ? -999 : 10 * j + i);
        }
    }
    file.array(zone, solution, "Temperature", values);
}

/** Hexahedra between vertices of a grid of 3 x 2 x 2, counted from 1. */
std::vector<cgsize_t> box(cgsize_t first) {
    return {first, first + 1, first + 4, first + 3, first + 6, first + 7, first + 10, first + 9};
}

/** A mixed section of two hexahedra and a quadrilateral, further faces in sections and boundary conditions of each kind. */
void write_boundaries(const std::string& container, const std::string& path) {
    File file(path, container, 3, 3);
    const std::vector<Point> points = grid({3, 2, 2}, {0, 0, 0});
    const int zone = file.unstructured_zone("Boxes", points.size(), 2);
    file.coordinates(zone, points, 3);
    std::vector<std::vector<cgsize_t>> mixed{box(1), {1, 7, 10, 4}, box(2)};
    for (std::vector<cgsize_t>& nodes : mixed) {
        nodes.insert(nodes.begin(), nodes.size() == 8 ? CGNS_ENUMV(HEXA_8) : CGNS_ENUMV(QUAD_4));
    }
    file.section(zone, "Mixed", CGNS_ENUMV(MIXED), 1, mixed);
    file.section(zone, "East", CGNS_ENUMV(QUAD_4), 4, 4, {3, 6, 12, 9});
    file.section(zone, "South", CGNS_ENUMV(QUAD_4), 5, 6, {1, 2, 8, 7, 2, 3, 9, 8});
    const int solution = file.solution(zone, "Solution", CGNS_ENUMV(Vertex));
    write_fields(file, zone, solution, points, 0);
    file.condition(zone, "West", CGNS_ENUMV(PointList), {2}, 1, CGNS_ENUMV(FaceCenter));
    file.condition(zone, "Wall", CGNS_ENUMV(PointRange), {5, 6}, 1, CGNS_ENUMV(FaceCenter), "Walls");
    file.condition(zone, "Bottom", CGNS_ENUMV(PointList), {1, 2, 3, 4, 5, 6}, 1, CGNS_ENUMV(Vertex));
    // All vertices: also those of the face between the boxes.
    file.condition(zone, "Rest", CGNS_ENUMV(PointRange), {1, 12}, 1, CGNS_ENUMV(Vertex));
}

/** Two triangles and two quadrilaterals in the plane, with edges. */
void write_plane(const std::string& container, const std::string& path) {
    File file(path, container, 2, 2);
    const std::vector<Point> points = grid({3, 3, 1}, {0, 0, 0});
    const int zone = file.unstructured_zone("Plane", points.size(), 4);
    file.coordinates(zone, points, 2);
    file.section(zone, "Quadrilaterals", CGNS_ENUMV(QUAD_4), 1, 2, {1, 2, 5, 4, 2, 3, 6, 5});
    file.section(zone, "Triangles", CGNS_ENUMV(TRI_3), 3, 4, {4, 5, 8, 5, 6, 9});
    file.section(zone, "Low", CGNS_ENUMV(BAR_2), 5, 6, {1, 2, 2, 3});
    const int solution = file.solution(zone, "Cells", CGNS_ENUMV(CellCenter));
    file.array(zone, solution, "Temperature", {1, 2, 3, 4});
}

/** A surface in space in a base of its own, and a box in single precision, whose lower and upper side ranges of elements name.
 */
void write_bases(const std::string& container, const std::string& path) {
    File file(path, container, 3, 3);
    const std::vector<Point> points = grid({2, 2, 2}, {0, 0, 0});
    const int zone = file.unstructured_zone("Box", points.size(), 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<float> values;
        for (const Point& point : points) {
            values.push_back(static_cast<float>(point[axis]));
        }
        int coordinate = 0;
        const std::string name = std::string("Coordinate") + "XYZ"[axis];
        check(cg_coord_write(file.id(), file.base(), zone, CGNS_ENUMV(RealSingle), name.c_str(), values.data(), &coordinate));
    }
    file.section(zone, "Cells", CGNS_ENUMV(HEXA_8), 3, 3, {1, 2, 4, 3, 5, 6, 8, 7});
    file.section(zone, "Sides", CGNS_ENUMV(QUAD_4), 1, 2, {1, 2, 4, 3, 5, 6, 8, 7});
    file.condition(zone, "Low", CGNS_ENUMV(ElementRange), {1, 1}, 1, CGNS_ENUMV(FaceCenter));
    file.condition(zone, "High", CGNS_ENUMV(ElementList), {2}, 1, CGNS_ENUMV(FaceCenter));
    int base = 0;
    check(cg_base_write(file.id(), "ASurface", 2, 3, &base));
}

/** An array that has grown after it was written: in ADF files its data are in two runs. */
void write_runs(const std::string& container, const std::string& path) {
    File file(path, container, 3, 3);
    const std::vector<Point> points = grid({2, 2, 2}, {0, 0, 0});
    const int zone = file.unstructured_zone("Box", points.size(), 1);
    file.coordinates(zone, points, 3);
    file.section(zone, "Cells", CGNS_ENUMV(HEXA_8), 1, 1, {1, 2, 4, 3, 5, 6, 8, 7});
    const int solution = file.solution(zone, "Solution", CGNS_ENUMV(Vertex));
    int library = 0;
    double parent = 0, node = 0;
    check(cg_get_cgio(file.id(), &library));
    check(cg_goto(file.id(), file.base(), "Zone_t", zone, "FlowSolution_t", solution, "end"));
    std::vector<double> values;
    for (const Point& point : points) {
        values.push_back(pressure(point));
    }
    double root = 0;
    check(cgio_get_root_id(library, &root));
    check(cgio_get_node_id(library, root, "/Base/Box/Solution", &parent));
    check(cgio_create_node(library, parent, "Pressure", &node));
    check(cgio_set_label(library, node, "DataArray_t"));
    for (const cgsize_t n : {cgsize_t{3}, cgsize_t{8}}) {
        check(cgio_set_dimensions(library, node, "R8", 1, &n));
        check(cgio_write_all_data(library, node, values.data()));
    }
}

/** A square that stands upright in space. */
void write_upright(const std::string& container, const std::string& path) {
    File file(path, container, 2, 3);
    const std::vector<Point> points = grid({2, 1, 2}, {0, 5, 0});
    const int zone = file.unstructured_zone("Square", points.size(), 1);
    file.coordinates(zone, points, 3);
    file.section(zone, "Cells", CGNS_ENUMV(QUAD_4), 1, 1, {1, 2, 4, 3});
    write_fields(file, zone, file.solution(zone, "Solution", CGNS_ENUMV(Vertex)), points, 0);
}

/** Values at faces beside values at vertices. */
void write_location(const std::string& container, const std::string& path) {
    File file(path, container, 3, 3);
    const std::array<cgsize_t, 9> sizes{2, 2, 2, 1, 1, 1, 0, 0, 0};
    int zone = 0;
    check(cg_zone_write(file.id(), file.base(), "Box", sizes.data(), CGNS_ENUMV(Structured), &zone));
    const std::vector<Point> points = grid({2, 2, 2}, {0, 0, 0});
    file.coordinates(zone, points, 3);
    write_fields(file, zone, file.solution(zone, "AtVertices", CGNS_ENUMV(Vertex)), points, 0);
    file.array(zone, file.solution(zone, "AtFaces", CGNS_ENUMV(IFaceCenter)), "Flux", {1, 2});
}

/** Files that are refused, by what is wrong with them. */
void write_refused(const std::string& kind, const std::string& container, const std::string& path) {
    File file(path, container, kind == "lines" ? 1 : 3, 3);
    const std::vector<Point> points = grid({2, 2, 2}, {0, 0, 0});
    const int zone = file.unstructured_zone("Box", points.size(), kind == "cells" ? 2 : 1);
    if (kind != "coordinates") {
        file.coordinates(zone, points, 3);
    }
    const std::vector<cgsize_t> nodes{1, 2, 4, 3, 5, 6, 8, kind == "vertex" ? 9 : 7};
    if (kind == "ngon") {
        file.section(zone, "Faces", CGNS_ENUMV(NGON_n), 1,
                     {{1, 3, 4, 2}, {1, 2, 6, 5}, {2, 4, 8, 6}, {4, 3, 7, 8}, {3, 1, 5, 7}, {5, 6, 8, 7}});
        file.section(zone, "Cells", CGNS_ENUMV(NFACE_n), 7, {{1, 2, 3, 4, 5, 6}});
    } else {
        file.section(zone, "Cells", CGNS_ENUMV(HEXA_8), 1, 1, nodes);
    }
    if (kind == "solution") {
        file.times(zone, {0, 1}, {"There", "NotThere"});
        file.array(zone, file.solution(zone, "There", CGNS_ENUMV(Vertex)), "Pressure", std::vector<double>(8, 1.0));
    }
    if (kind == "moving") {
        file.times(zone, {0, 1}, {"GridCoordinates", "GridCoordinates#1"}, "GridCoordinatesPointers");
    }
    if (kind == "interpolation") {
        // Nodes that this version of the library does not know.
        int family = 0, library = 0;
        double root = 0, parent = 0, node = 0;
        check(cg_family_write(file.id(), file.base(), "HighOrder", &family));
        check(cg_get_cgio(file.id(), &library));
        check(cgio_get_root_id(library, &root));
        check(cgio_get_node_id(library, root, "/Base/HighOrder", &parent));
        check(cgio_create_node(library, parent, "Hexahedra", &node));
        check(cgio_set_label(library, node, "ElementInterpolation_t"));
    }
    if (kind == "face") {
        file.condition(zone, "Wall", CGNS_ENUMV(PointList), {1}, 1, CGNS_ENUMV(FaceCenter));
    }
}

/** A zone whose coordinates and elements lie in another file. */
void write_links(const std::string& container, const std::string& path, const std::string& other) {
    File file(path, container, 3, 3);
    const std::vector<Point> points = grid({3, 2, 2}, {0, 0, 0});
    const int zone = file.unstructured_zone("Boxes", points.size(), 2);
    check(cg_goto(file.id(), file.base(), "Zone_t", zone, "end"));
    for (const char* const name : {"GridCoordinates", "Mixed", "East", "South"}) {
        check(cg_link_write(name, other.c_str(), (std::string("/Base/Boxes/") + name).c_str()));
    }
    write_fields(file, zone, file.solution(zone, "Solution", CGNS_ENUMV(Vertex)), points, 2);
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        std::cerr << "usage: cgns_writer KIND CONTAINER FILE [LINKED FILE]\n";
        return 2;
    }
    const std::string kind = argv[1], container = argv[2], path = argv[3];
    try {
        if (kind == "volumes" || kind == "surfaces") {
            write_elements(container, path, kind == "volumes" ? 3 : 2);
        } else if (kind == "structured") {
            write_structured(container, path);
        } else if (kind == "rind") {
            write_rind(container, path);
        } else if (kind == "boundaries") {
            write_boundaries(container, path);
        } else if (kind == "plane") {
            write_plane(container, path);
        } else if (kind == "bases") {
            write_bases(container, path);
        } else if (kind == "runs") {
            write_runs(container, path);
        } else if (kind == "upright") {
            write_upright(container, path);
        } else if (kind == "location") {
            write_location(container, path);
        } else if (kind == "links" && argc == 5) {
            write_links(container, path, argv[4]);
        } else {
            write_refused(kind, container, path);
        }
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
    return 0;
}
