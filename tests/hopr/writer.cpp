#include "writer.hpp"

#include <tests/support/written_hdf5.hpp>

#include <map>

using namespace elvis::test;

namespace {

constexpr std::size_t fortran_text = 255;

void write_integers(WrittenFile& file, const std::string& name, std::vector<hsize_t> shape,
                    const std::vector<std::int32_t>& numbers) {
    file.dataset(name, number_type(H5T_STD_I32LE), std::move(shape), numbers.data());
}

void integer_attribute(WrittenFile& file, const std::string& name, std::size_t value) {
    const auto number = static_cast<std::int32_t>(value);
    file.attribute("/", name, number_type(H5T_STD_I32LE), {1}, &number);
}

} // namespace

WrittenMesh two_cubes() {
    WrittenMesh mesh;
    mesh.elements = {{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {1, 1, 1}}};
    // k=0, j=0, i=N, j=N, i=0, k=N; element 1 is its own neighbour along y.
    mesh.sides = {{{}, {1, 3}, {2, 0}, {1, 3}, {0, 1}, {}}, {{}, {2, 3}, {0, 2}, {2, 3}, {1, 4}, {}}};
    mesh.conditions = {"inflow", "outflow", "periodic", "between"};
    mesh.types = {2, 24, 1, 100};
    return mesh;
}

WrittenMesh mortar() {
    WrittenMesh mesh;
    mesh.elements = {{{0, 0, 0}, {1, 1, 1}}};
    mesh.sides = {{{0, 1}, {0, 1}, {-1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {0, 1}, {0, 2}, {0, 1}}};
    for (const double z : {0.0, 0.5}) {
        for (const double y : {0.0, 0.5}) {
            mesh.elements.push_back({{1, y, z}, {1, 0.5, 0.5}});
            mesh.sides.push_back({{0, 0}, {0, 0}, {0, 3}, {0, 0}, {1, 0}, {0, 0}});
        }
    }
    mesh.conditions = {"wall", "left", "right"};
    mesh.types = {4, 2, 2};
    return mesh;
}

void write_mesh(const std::string& path, const WrittenMesh& mesh) {
    WrittenFile file(path);
    std::vector<std::int32_t> elements, sides, ids;
    std::vector<double> coordinates;
    std::map<std::array<double, 3>, std::int32_t> id_of;
    std::int32_t first_side = 0, first_node = 0;
    for (std::size_t element = 0; element < mesh.elements.size(); ++element) {
        const auto n_sides = static_cast<std::int32_t>(mesh.sides[element].size());
        elements.insert(elements.end(), {mesh.element_type, 1, first_side, first_side + n_sides, first_node, first_node + 8});
        first_side += n_sides;
        first_node += 8;
        for (const WrittenMesh::Side& side : mesh.sides[element]) {
            sides.insert(sides.end(), {8, 1, side.neighbour, 0, side.condition});
        }
        for (int node = 0; node < 8; ++node) {
            const WrittenMesh::Box& box = mesh.elements[element];
            const std::array<double, 3> x = {box.low[0] + box.width[0] * (node & 1),
                                             box.low[1] + box.width[1] * (node >> 1 & 1),
                                             box.low[2] + box.width[2] * (node >> 2)};
            coordinates.insert(coordinates.end(), x.begin(), x.end());
            ids.push_back(id_of.try_emplace(x, static_cast<std::int32_t>(id_of.size()) + 1).first->second);
        }
    }
    integer_attribute(file, "Ngeo", 1);
    integer_attribute(file, "nElems", mesh.elements.size());
    const std::size_t n = mesh.elements.size();
    write_integers(file, "ElemInfo", {n, 6}, elements);
    write_integers(file, "SideInfo", {sides.size() / 5, 5}, sides);
    write_integers(file, "GlobalNodeIDs", {ids.size()}, ids);
    file.dataset("NodeCoords", number_type(H5T_IEEE_F64LE), {8 * n, 3}, coordinates.data());
    std::vector<std::int32_t> types;
    Bytes names;
    for (std::size_t condition = 0; condition < mesh.conditions.size(); ++condition) {
        types.insert(types.end(), {mesh.types[condition], 0, 0, 0});
        std::string name = mesh.conditions[condition];
        name.resize(fortran_text, ' ');
        names.add_text(name, fortran_text);
    }
    write_integers(file, "BCType", {mesh.conditions.size(), 4}, types);
    file.dataset("BCNames", text_type(fortran_text), {mesh.conditions.size()}, names.data());
}

void write_state(const std::string& path, const WrittenMesh& mesh, const WrittenState& state) {
    WrittenFile file(path);
    std::vector<double> numbers;
    const std::size_t n_layers = state.is_flat ? 1 : state.line.size();
    for (std::size_t element = 0; element < mesh.elements.size(); ++element) {
        for (std::size_t k = 0; k < n_layers; ++k) {
            for (const double y : state.line) {
                for (const double x : state.line) {
                    for (std::size_t variable = 0; variable < state.names.size(); ++variable) {
                        numbers.push_back(state.value(variable, element, {x, y, state.line[k]}));
                    }
                }
            }
        }
    }
    const hsize_t n = mesh.elements.size(), n_line = state.line.size();
    file.dataset("DG_Solution", number_type(H5T_IEEE_F64LE), {n, n_layers, n_line, n_line, state.names.size()}, numbers.data());
    file.texts_attribute("/", "VarNames", state.names, fortran_text);
    file.texts_attribute("/", "NodeType", {state.node_type}, fortran_text);
    file.texts_attribute("/", "MeshFile", {state.mesh_file}, fortran_text);
    file.texts_attribute("/", "File_Type", {"State"}, fortran_text);
    file.attribute("/", "Time", {1}, {state.time});
    integer_attribute(file, "N", state.line.size() - 1);
    if (!state.cell_widths.empty()) {
        file.attribute("/", "FV_w", {state.cell_widths.size()}, state.cell_widths);
    }
    if (!state.added_names.empty()) {
        file.texts_attribute("/", "VarNamesAdd", state.added_names, fortran_text);
        std::vector<double> added;
        for (const std::vector<double>& row : state.added) {
            added.insert(added.end(), row.begin(), row.end());
        }
        file.dataset("ElemData", number_type(H5T_IEEE_F64LE), {n, state.added_names.size()}, added.data());
    }
}
