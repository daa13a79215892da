#include "shape_tables.hpp"

#include <vector>

namespace nektarpp {

namespace {

constexpr IndexRule i{0, 1, 0};
constexpr IndexRule j{0, 0, 1};
constexpr IndexRule i_less_1{-1, 1, 0};
constexpr IndexRule j_less_1{-1, 0, 1};
constexpr IndexRule zero{0, 0, 0};
constexpr IndexRule one{1, 0, 0};

struct Tables {
    std::vector<LocalEdge> edges;
    std::vector<ModeRule> edge_modes;
    std::vector<ModeRule> face_modes;
    std::vector<ModeIndex> corner_modes;
};

const Tables hexahedron{{{0, 1}, {1, 2}, {3, 2}, {0, 3}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 5}, {5, 6}, {7, 6}, {4, 7}},
                        {{i, zero, zero},
                         {one, i, zero},
                         {i, one, zero},
                         {zero, i, zero},
                         {zero, zero, i},
                         {one, zero, i},
                         {one, one, i},
                         {zero, one, i},
                         {i, zero, one},
                         {one, i, one},
                         {i, one, one},
                         {zero, i, one}},
                        {{i, j, zero}, {i, zero, j}, {one, i, j}, {i, one, j}, {zero, i, j}, {i, j, one}},
                        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

const Tables prism{{{0, 1}, {1, 2}, {3, 2}, {0, 3}, {0, 4}, {1, 4}, {2, 5}, {3, 5}, {4, 5}},
                   {{i, zero, zero},
                    {one, i, zero},
                    {i, one, zero},
                    {zero, i, zero},
                    {zero, zero, i},
                    {one, zero, i_less_1},
                    {one, one, i_less_1},
                    {zero, one, i},
                    {zero, i, one}},
                   {{i, j, zero}, {i, zero, j}, {one, i, j_less_1}, {i, one, j}, {zero, i, j}},
                   {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}}};

const Tables pyramid{{{0, 1}, {1, 2}, {3, 2}, {0, 3}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
                     {{i, zero, zero},
                      {one, i, zero},
                      {i, one, zero},
                      {zero, i, zero},
                      {zero, zero, i},
                      {one, zero, i_less_1},
                      {one, one, i_less_1},
                      {zero, one, i_less_1}},
                     {{i, j, zero}, {i, zero, j}, {one, i, j}, {i, one, j}, {zero, i, j}},
                     {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}};

const Tables tetrahedron{
    {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}},
    {{i, zero, zero}, {one, i_less_1, zero}, {zero, i, zero}, {zero, zero, i}, {one, zero, i_less_1}, {zero, one, i_less_1}},
    {{i, j, zero}, {i, zero, j}, {one, i_less_1, j}, {zero, i, j}},
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

const Tables quadrilateral{{{0, 1}, {1, 2}, {3, 2}, {0, 3}},
                           {{i, zero, zero}, {one, i, zero}, {i, one, zero}, {zero, i, zero}},
                           {{i, j, zero}},
                           {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};

const Tables triangle{{{0, 1}, {1, 2}, {0, 2}},
                      {{i, zero, zero}, {one, i_less_1, zero}, {zero, i, zero}},
                      {{i, j, zero}},
                      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};

const Tables& tables(Shape shape) {
    switch (shape) {
    case Shape::hexahedron:
        return hexahedron;
    case Shape::prism:
        return prism;
    case Shape::pyramid:
        return pyramid;
    case Shape::tetrahedron:
        return tetrahedron;
    case Shape::quadrilateral:
        return quadrilateral;
    case Shape::triangle:
        break;
    }
    return triangle;
}

} // namespace

std::span<const LocalEdge> local_edges(Shape shape) { return tables(shape).edges; }

const ModeRule& edge_modes(Shape shape, int edge) { return tables(shape).edge_modes[static_cast<std::size_t>(edge)]; }

const ModeRule& face_modes(Shape shape, int face) { return tables(shape).face_modes[static_cast<std::size_t>(face)]; }

ModeIndex corner_mode(Shape shape, int corner) { return tables(shape).corner_modes[static_cast<std::size_t>(corner)]; }

ModeIndex apply(const ModeRule& rule, std::uint32_t at_i, std::uint32_t at_j) {
    ModeIndex index{};
    for (std::size_t direction = 0; direction < 3; ++direction) {
        const IndexRule& one_index = rule[direction];
        index[direction] = static_cast<std::uint32_t>(one_index.constant + one_index.on_i * static_cast<int>(at_i) +
                                                      one_index.on_j * static_cast<int>(at_j));
    }
    return index;
}

} // namespace nektarpp
