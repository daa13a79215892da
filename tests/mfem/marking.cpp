#include "marking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>
#include <vector>

namespace {

struct Element {
    int attribute = 0;
    int geometry = 0;
    std::vector<int> vertices;
};

using Edge = std::pair<int, int>;
/** Place of each edge among all, by length, then by number. */
using EdgeOrder = std::map<Edge, int>;

Edge edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

std::vector<std::pair<int, int>> local_edges(int geometry) {
    switch (geometry) {
    case 4:
        return {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    case 5:
        return {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {4, 5}, {5, 6}, {7, 6}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
    default:
        return {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
    }
}

void mark(std::vector<int>& v, const EdgeOrder& order) {
    const auto place = [&](int a, int b) {
        return order.at(edge(v[static_cast<std::size_t>(a)], v[static_cast<std::size_t>(b)]));
    };
    constexpr std::array<std::array<int, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
    constexpr std::array<std::array<std::size_t, 4>, 6> turns{
        {{0, 1, 2, 3}, {1, 2, 0, 3}, {2, 0, 1, 3}, {3, 0, 2, 1}, {1, 3, 2, 0}, {2, 3, 0, 1}}};
    const auto length = [&](const std::array<int, 2>& e) { return place(e[0], e[1]); };
    const auto longest = static_cast<std::size_t>(std::ranges::max_element(edges, {}, length) - edges.begin());
    const std::vector<int> old = v;
    for (std::size_t i = 0; i < 4; ++i) {
        v[i] = old[turns[longest][i]];
    }
    // Longest edges of the two faces that do not hold edge 0-1: opposite to vertices 1 and 0.
    const std::array<std::array<int, 2>, 3> first{{{0, 2}, {0, 3}, {2, 3}}}, second{{{1, 2}, {1, 3}, {2, 3}}};
    const auto a = std::ranges::max_element(first, {}, length) - first.begin();
    const auto b = std::ranges::max_element(second, {}, length) - second.begin();
    if ((a == 1 && b >= 1) || (a == 2 && b == 1)) {
        std::swap(v[0], v[1]);
        std::swap(v[2], v[3]);
    }
}

} // namespace

std::string marked_mesh(const std::string& mesh_text) {
    const auto section = [&](const std::string& name) {
        std::istringstream text(mesh_text.substr(mesh_text.find("\n" + name + "\n") + name.size() + 2));
        return text;
    };
    std::istringstream in = section("elements");
    std::size_t n_elements = 0, n_vertices = 0;
    in >> n_elements;
    std::vector<Element> elements(n_elements);
    for (Element& element : elements) {
        in >> element.attribute >> element.geometry;
        element.vertices.resize(element.geometry == 4 ? 4 : element.geometry == 5 ? 8 : 6);
        for (int& vertex : element.vertices) {
            in >> vertex;
        }
    }
    section("vertices") >> n_vertices;
    // Nodes by VDIM: the vertices' come first.
    const std::string ordering = "Ordering: 1\n";
    std::istringstream nodes(mesh_text.substr(mesh_text.find(ordering) + ordering.size()));
    std::vector<std::array<double, 3>> x(n_vertices);
    for (auto& point : x) {
        nodes >> point[0] >> point[1] >> point[2];
    }

    std::map<Edge, int> numbers;
    std::vector<std::pair<double, Edge>> lengths;
    for (const Element& element : elements) {
        for (const auto& [a, b] : local_edges(element.geometry)) {
            const Edge key = edge(element.vertices[static_cast<std::size_t>(a)], element.vertices[static_cast<std::size_t>(b)]);
            if (numbers.emplace(key, static_cast<int>(numbers.size())).second) {
                const auto& p = x[static_cast<std::size_t>(key.first)];
                const auto& q = x[static_cast<std::size_t>(key.second)];
                lengths.emplace_back(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]), key);
            }
        }
    }
    std::ranges::stable_sort(lengths, {}, &std::pair<double, Edge>::first);
    EdgeOrder order;
    for (const auto& [length, key] : lengths) {
        order.emplace(key, static_cast<int>(order.size()));
    }

    std::ostringstream out;
    out << "MFEM mesh v1.0\n\ndimension\n3\n\nelements\n" << n_elements << '\n';
    for (Element& element : elements) {
        if (element.geometry == 4) {
            mark(element.vertices, order);
        }
        out << element.attribute << ' ' << element.geometry;
        for (int vertex : element.vertices) {
            out << ' ' << vertex;
        }
        out << '\n';
    }
    out << "\nboundary\n0\n\nvertices\n" << n_vertices << "\n3\n";
    out.precision(17);
    for (const auto& point : x) {
        out << point[0] << ' ' << point[1] << ' ' << point[2] << '\n';
    }
    return out.str();
}
