#include "msh_mesh.hpp"

#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <sstream>

namespace {

std::string section(const std::string& text, const std::string& name) {
    const std::size_t begin = text.find("$" + name + "\n");
    const std::size_t end = text.find("$End" + name);
    if (begin == std::string::npos) {
        return {};
    }
    REQUIRE(end != std::string::npos);
    return text.substr(begin + name.size() + 2, end - begin - name.size() - 2);
}

void read_4(const std::string& text, MshMesh& mesh) {
    std::istringstream nodes(section(text, "Nodes"));
    std::int64_t n_blocks = 0, ignored = 0;
    nodes >> n_blocks >> ignored >> ignored >> ignored;
    for (std::int64_t block = 0; block < n_blocks; ++block) {
        std::int64_t count = 0;
        nodes >> ignored >> ignored >> ignored >> count;
        std::vector<std::int64_t> tags(static_cast<std::size_t>(count));
        for (auto& tag : tags) {
            nodes >> tag;
        }
        for (const auto tag : tags) {
            auto& x = mesh.nodes[tag];
            nodes >> x[0] >> x[1] >> x[2];
        }
    }
    REQUIRE(nodes);
    std::istringstream elements(section(text, "Elements"));
    elements >> n_blocks >> ignored >> ignored >> ignored;
    for (std::int64_t block = 0; block < n_blocks; ++block) {
        MshElement element;
        std::int64_t count = 0;
        elements >> ignored >> element.label >> element.type >> count;
        element.nodes.resize(static_cast<std::size_t>(facts(element.type).n_nodes));
        for (; count > 0; --count) {
            elements >> element.tag;
            for (auto& node : element.nodes) {
                elements >> node;
            }
            mesh.elements.push_back(element);
        }
    }
    REQUIRE(elements);
}

void read_2(const std::string& text, MshMesh& mesh) {
    std::istringstream nodes(section(text, "Nodes"));
    std::int64_t count = 0;
    for (nodes >> count; count > 0; --count) {
        std::int64_t tag = 0;
        nodes >> tag;
        auto& x = mesh.nodes[tag];
        nodes >> x[0] >> x[1] >> x[2];
    }
    REQUIRE(nodes);
    std::istringstream elements(section(text, "Elements"));
    for (elements >> count; count > 0; --count) {
        MshElement element;
        int n_labels = 0, ignored = 0;
        elements >> element.tag >> element.type >> n_labels >> element.label;
        for (int label = 1; label < n_labels; ++label) {
            elements >> ignored;
        }
        element.nodes.resize(static_cast<std::size_t>(facts(element.type).n_nodes));
        for (auto& node : element.nodes) {
            elements >> node;
        }
        mesh.elements.push_back(element);
    }
    REQUIRE(elements);
}

} // namespace

std::vector<MshElement> MshMesh::of_dimension(int dimension) const {
    std::vector<MshElement> found;
    for (const MshElement& element : elements) {
        if (facts(element.type).dimension == dimension) {
            found.push_back(element);
        }
    }
    return found;
}

MshMesh read_mesh(const std::string& path) {
    const std::string text = read_file(path);
    MshMesh mesh;
    mesh.is_4 = text.find("$MeshFormat\n4.1 0 8") != std::string::npos;
    REQUIRE((mesh.is_4 || text.find("$MeshFormat\n2.2 0 8") != std::string::npos));
    mesh.is_4 ? read_4(text, mesh) : read_2(text, mesh);
    for (const std::string name : {"PhysicalNames", "Entities"}) {
        const std::string content = section(text, name);
        if (!content.empty()) {
            mesh.head += "$" + name + "\n" + content + "$End" + name + "\n";
        }
    }
    return mesh;
}

// The numbers are those of the manual and of GmshDefines.h, one by one.
TypeFacts facts(int type) {
    static const std::map<int, TypeFacts> all = [] {
        std::map<int, TypeFacts> known{{15, {0, 1, 1, 1, false}}};
        const int line[] = {1, 8, 26, 27, 28, 62, 63, 64, 65, 66};
        const int triangle[] = {2, 9, 21, 23, 25, 42, 43, 44, 45, 46};
        const int quadrilateral[] = {3, 10, 36, 37, 38, 47, 48, 49, 50, 51};
        const int tetrahedron[] = {4, 11, 29, 30, 31, 71, 72, 73, 74, 75};
        const int pyramid[] = {7, 14, 118, 119, 120, 121, 122, 123, 124};
        const int prism[] = {6, 13, 90, 91, 106, 107, 108, 109, 110};
        const int hexahedron[] = {5, 12, 92, 93, 94, 95, 96, 97, 98};
        const auto add = [&](const auto& types, int dimension, int topology, auto n_nodes) {
            int order = 0;
            for (const int number : types) {
                ++order;
                known[number] = {dimension, n_nodes(order), topology, order, false};
            }
        };
        add(line, 1, 2, [](int n) { return n + 1; });
        add(triangle, 2, 3, [](int n) { return (n + 1) * (n + 2) / 2; });
        add(quadrilateral, 2, 4, [](int n) { return (n + 1) * (n + 1); });
        add(tetrahedron, 3, 5, [](int n) { return (n + 1) * (n + 2) * (n + 3) / 6; });
        add(pyramid, 3, 6, [](int n) { return (n + 1) * (n + 2) * (2 * n + 3) / 6; });
        add(prism, 3, 7, [](int n) { return (n + 1) * (n + 1) * (n + 2) / 2; });
        add(hexahedron, 3, 8, [](int n) { return (n + 1) * (n + 1) * (n + 1); });
        const int triangle_s[] = {20, 22, 24, 52, 53, 54, 55, 56}; // from order 3
        const int quadrilateral_s[] = {16, 39, 40, 41, 57, 58, 59, 60, 61};
        const int tetrahedron_s[] = {137, 32, 33, 79, 80, 81, 82, 83}; // from order 3
        const int pyramid_s[] = {19};
        const int prism_s[] = {18, 111, 112, 113, 114, 115, 116, 117};
        const int hexahedron_s[] = {17, 99, 100, 101, 102, 103, 104, 105};
        const auto add_s = [&](const auto& types, int first, int dimension, int topology, int corners, int edges) {
            int order = first - 1;
            for (const int number : types) {
                ++order;
                known[number] = {dimension, corners + edges * (order - 1), topology, order, true};
            }
        };
        add_s(triangle_s, 3, 2, 3, 3, 3);
        add_s(quadrilateral_s, 2, 2, 4, 4, 4);
        add_s(tetrahedron_s, 3, 3, 5, 4, 6);
        add_s(pyramid_s, 2, 3, 6, 5, 8);
        add_s(prism_s, 2, 3, 7, 6, 9);
        add_s(hexahedron_s, 2, 3, 8, 8, 12);
        return known;
    }();
    INFO("element type " << type);
    REQUIRE(all.contains(type));
    return all.at(type);
}
