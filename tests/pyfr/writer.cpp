#include "writer.hpp"

#include <tests/support/written_hdf5.hpp>

#include <algorithm>
#include <array>
#include <cmath>

using namespace elvis::test;

namespace {

void write_points(WrittenFile& file, const std::string& object, const std::vector<Coordinates>& points) {
    std::vector<double> numbers;
    for (const Coordinates& point : points) {
        numbers.insert(numbers.end(), point.begin(), point.end());
    }
    file.attribute(object, "pts", {points.size(), points.front().size()}, numbers);
}

/** Elements of a kind in a partition. */
std::vector<std::size_t> elements_in(const WrittenKind& kind, int partition) {
    std::vector<std::size_t> elements;
    for (std::size_t element = 0; element < kind.elements.size(); ++element) {
        if (kind.partition[element] == partition) {
            elements.push_back(element);
        }
    }
    return elements;
}

constexpr int n_partitions = 2;

void write_partition(WrittenFile& file, const WrittenKind& kind, int partition) {
    const std::vector<std::size_t> elements = elements_in(kind, partition);
    if (elements.empty()) {
        return;
    }
    const std::size_t dimension = kind.shape_points.front().size();
    std::vector<double> positions;
    for (std::size_t node = 0; node < kind.shape_points.size(); ++node) {
        for (const std::size_t element : elements) {
            const Coordinates& x = kind.elements[element][node];
            positions.insert(positions.end(), x.begin(), x.end());
        }
    }
    file.dataset("spt_" + kind.name + "_p" + std::to_string(partition), number_type(H5T_NATIVE_DOUBLE),
                 {kind.shape_points.size(), elements.size(), dimension}, positions.data());
}

void write_partitioned_mesh(WrittenFile& file, const WrittenMesh& mesh) {
    file.text("mesh_uuid", mesh.uuid);
    std::map<std::pair<std::string, int>, std::pair<Bytes, hsize_t>> boundary;
    for (const WrittenKind& kind : mesh.kinds) {
        for (int partition = 0; partition < n_partitions; ++partition) {
            write_partition(file, kind, partition);
            const std::vector<std::size_t> elements = elements_in(kind, partition);
            for (std::size_t local = 0; local < elements.size(); ++local) {
                const std::vector<std::string>& groups = kind.boundary[elements[local]];
                for (std::size_t face = 0; face < groups.size(); ++face) {
                    if (!groups[face].empty()) {
                        auto& [bytes, n] = boundary[{groups[face], partition}];
                        bytes.add_text(kind.name, 4);
                        bytes.add(static_cast<std::int64_t>(local));
                        bytes.add(static_cast<std::int8_t>(face));
                        bytes.add(std::int16_t{0});
                        ++n;
                    }
                }
            }
        }
    }
    for (const auto& [place, faces] : boundary) {
        auto members = list(member("f0", text_type(4)));
        members.push_back(member("f1", number_type(H5T_STD_I64LE)));
        members.push_back(member("f2", number_type(H5T_STD_I8LE)));
        members.push_back(member("f3", number_type(H5T_STD_I16LE)));
        file.dataset("bcon_" + place.first + "_p" + std::to_string(place.second), record_of(std::move(members)), {faces.second},
                     faces.first.data());
    }
}

/** Numbers of the nodes: equal where positions are. */
class NodeNumbers {
public:
    std::int64_t operator()(const Coordinates& x) {
        const auto found = std::ranges::find_if(m_nodes, [&](const Coordinates& one) {
            return std::ranges::equal(one, x, [](double a, double b) { return std::abs(a - b) < 1e-9; });
        });
        const auto number = found - m_nodes.begin();
        if (found == m_nodes.end()) {
            m_nodes.push_back(x);
        }
        return number;
    }
    const std::vector<Coordinates>& nodes() const { return m_nodes; }

private:
    std::vector<Coordinates> m_nodes;
};

void write_elements(WrittenFile& file, const WrittenKind& kind, NodeNumbers& number, std::vector<std::string>& codec) {
    const auto code_of = [&](const std::string& code) {
        const auto found = std::ranges::find(codec, code);
        const auto index = found - codec.begin();
        if (found == codec.end()) {
            codec.push_back(code);
        }
        return static_cast<std::int16_t>(index);
    };
    Bytes bytes;
    for (std::size_t element = 0; element < kind.elements.size(); ++element) {
        for (const Coordinates& x : kind.elements[element]) {
            bytes.add(number(x));
        }
        for (const std::string& group : kind.boundary[element]) {
            bytes.add(code_of(group.empty() ? "eles/" + kind.name + "/0" : "bc/" + group));
            bytes.add(std::int64_t{-1});
        }
    }
    auto face = list(member("cidx", number_type(H5T_STD_I16LE)));
    face.push_back(member("off", number_type(H5T_STD_I64LE)));
    auto members = list(member("nodes", array_of(number_type(H5T_STD_I64LE), {kind.shape_points.size()})));
    members.push_back(member("faces", array_of(record_of(std::move(face)), {kind.boundary.front().size()})));
    file.dataset("eles/" + kind.name, record_of(std::move(members)), {kind.elements.size()}, bytes.data());
    write_points(file, "eles/" + kind.name, kind.shape_points);
}

void write_global_mesh(WrittenFile& file, const WrittenMesh& mesh, int version) {
    file.text("mesh-uuid", mesh.uuid);
    file.integer("version", version);
    file.group("eles");
    NodeNumbers number;
    std::vector<std::string> codec;
    for (const WrittenKind& kind : mesh.kinds) {
        write_elements(file, kind, number, codec);
    }
    file.texts("codec", codec);
    Bytes nodes;
    for (const Coordinates& x : number.nodes()) {
        for (const double coordinate : x) {
            nodes.add(coordinate);
        }
        nodes.add(std::uint16_t{1});
    }
    auto members = list(member(
        "location", array_of(number_type(H5T_IEEE_F64LE), {number.nodes().empty() ? 2 : number.nodes().front().size()})));
    members.push_back(member("valency", number_type(H5T_STD_U16LE)));
    file.dataset("nodes", record_of(std::move(members)), {number.nodes().size()}, nodes.data());
}

void write_partitioned_values(WrittenFile& file, const WrittenKind& kind, const WrittenSolution& solution) {
    for (int partition = 0; partition < n_partitions; ++partition) {
        const std::vector<std::size_t> elements = elements_in(kind, partition);
        if (elements.empty()) {
            continue;
        }
        Bytes bytes;
        for (const Coordinates& x : kind.solution_points) {
            for (std::size_t variable = 0; variable < solution.names.size(); ++variable) {
                for (const std::size_t element : elements) {
                    bytes.add_real(solution.values(kind.name, element, variable, x), solution.is_single);
                }
            }
        }
        file.dataset(solution.prefix + "_" + kind.name + "_p" + std::to_string(partition),
                     number_type(solution.is_single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE),
                     {kind.solution_points.size(), solution.names.size(), elements.size()}, bytes.data());
    }
}

/** The type of one of layout 2's records. */
Handle record_type(const WrittenKind& kind, const WrittenSolution& solution) {
    std::vector<Member> members;
    for (const WrittenSolution::Group& group : solution.groups) {
        std::vector<Member> variables;
        for (const std::string& name : group.names) {
            std::vector<hsize_t> extent = {kind.solution_points.size()};
            if (group.n_directions > 0) {
                extent.insert(extent.begin(), group.n_directions);
            }
            variables.push_back(
                member(name, array_of(number_type(solution.is_single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE), extent)));
        }
        members.push_back(member(group.name, record_of(std::move(variables))));
    }
    members.push_back(member("aux", record_of(list(member("part-id", number_type(H5T_STD_I64LE))))));
    return record_of(std::move(members));
}

void write_global_values(WrittenFile& file, const WrittenKind& kind, const WrittenSolution& solution, int version) {
    std::vector<std::size_t> elements(kind.elements.size());
    for (std::size_t element = 0; element < elements.size(); ++element) {
        elements[element] = element;
    }
    const std::string name = solution.prefix + "/p2-" + kind.name;
    if (const auto only = solution.only.find(kind.name); only != solution.only.end()) {
        elements = only->second;
        const std::vector<std::int64_t> numbers(elements.begin(), elements.end());
        file.dataset(name + "-idxs", number_type(H5T_STD_I64LE), {numbers.size()}, numbers.data());
    }
    Bytes bytes;
    for (const std::size_t element : elements) {
        for (std::size_t variable = 0; variable < solution.names.size(); ++variable) {
            for (const Coordinates& x : kind.solution_points) {
                bytes.add_real(solution.values(kind.name, element, variable, x), solution.is_single);
            }
        }
        if (version == 2) {
            bytes.add(std::int64_t{0});
        }
    }
    if (version == 1) {
        file.dataset(name, number_type(solution.is_single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE),
                     {elements.size(), solution.names.size(), kind.solution_points.size()}, bytes.data());
    } else {
        file.dataset(name, record_type(kind, solution), {elements.size()}, bytes.data());
    }
    write_points(file, name, kind.solution_points);
}

std::string joined(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) {
        all += (all.empty() ? "" : ",") + name;
    }
    return all;
}

std::vector<Coordinates> quadratic_nodes(bool is_triangle) {
    std::vector<Coordinates> nodes;
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < (is_triangle ? 3 - j : 3); ++i) {
            nodes.push_back({i - 1.0, j - 1.0});
        }
    }
    return nodes;
}

/** Nodes of an element with the corners at (-1,-1), (1,-1) and (-1,1). */
std::vector<Coordinates> bent_nodes(const std::vector<Coordinates>& points, const std::array<Coordinates, 3>& corners) {
    std::vector<Coordinates> nodes;
    for (const Coordinates& point : points) {
        const double s = (1 + point[0]) / 2, t = (1 + point[1]) / 2;
        const auto at = [&](std::size_t axis) {
            return corners[0][axis] + s * (corners[1][axis] - corners[0][axis]) + t * (corners[2][axis] - corners[0][axis]);
        };
        nodes.push_back(bent(at(0), at(1)));
    }
    return nodes;
}

} // namespace

Coordinates bent(double x, double y) { return {x + 0.1 * y * y, y - 0.05 * x * x + 0.1 * x * y}; }

WrittenMesh plane_mesh() {
    const double g = std::sqrt(0.6), a = -0.81684757298044, b = 0.63369514596088, c = -0.108103018168072,
                 d = -0.783793963663856;
    WrittenKind quads{"quad", quadratic_nodes(false), {}, {}, {{"low", "", "", "left"}, {"", "high", "high", "left"}}, {0, 1}};
    for (const double y : {-g, 0.0, g}) {
        for (const double x : {-g, 0.0, g}) {
            quads.solution_points.push_back({x, y});
        }
    }
    quads.elements = {bent_nodes(quads.shape_points, {{{0, 0}, {1, 0}, {0, 1}}}),
                      bent_nodes(quads.shape_points, {{{0, 1}, {1, 1}, {0, 2}}})};
    WrittenKind triangles{"tri",
                          quadratic_nodes(true),
                          {{a, b}, {b, a}, {a, a}, {c, d}, {d, c}, {c, c}},
                          {},
                          {{"low", "", ""}, {"high", "", "high"}},
                          {1, 0}};
    triangles.elements = {bent_nodes(triangles.shape_points, {{{1, 0}, {2, 0}, {1, 1}}}),
                          bent_nodes(triangles.shape_points, {{{2, 1}, {1, 1}, {2, 0}}})};
    return {"0123", {quads, triangles}};
}

void write_mesh(const std::string& path, const WrittenMesh& mesh, int layout) {
    WrittenFile file(path);
    if (layout == 0) {
        write_partitioned_mesh(file, mesh);
    } else {
        write_global_mesh(file, mesh, layout);
    }
}

void write_solution(const std::string& path, const WrittenMesh& mesh, const WrittenSolution& solution, int layout) {
    WrittenFile file(path);
    file.text("stats", "[data]\nfields = " + joined(solution.names) + "\nprefix = " + solution.prefix +
                           "\n\n[solver-time-integrator]\ntcurr = " + std::to_string(solution.time) + "\n");
    std::string config = "[solver]\nsystem = euler\norder = 2\n";
    for (const auto& [kind, rule] : solution.rules) {
        config += "\n[solver-elements-" + kind + "]\nsoln-pts = " + rule + "\n";
    }
    file.text("config", config);
    file.text(layout == 0 ? "mesh_uuid" : "mesh-uuid", mesh.uuid);
    if (layout > 0) {
        file.integer("version", layout);
        file.group(solution.prefix);
    }
    for (const WrittenKind& kind : mesh.kinds) {
        if (layout == 0) {
            write_partitioned_values(file, kind, solution);
        } else {
            write_global_values(file, kind, solution, layout);
        }
    }
}
