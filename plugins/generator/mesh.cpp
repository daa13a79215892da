#include "mesh.hpp"

#include <algorithm>

namespace generator {
namespace {

// Lattice direction of the layers; 0, 1, 2 are those of the core.
constexpr int outward = 3;

// Boundary groups by index into Mesh::groups: the outermost layer's side, and the second group of hemisphere and shell.
constexpr std::int32_t outer_group = 0;
constexpr std::int32_t second_group = 1;

CellSplit split_cell(Split split, int prism_direction, bool left_handed) {
    switch (split) {
    case Split::prism:
        return two_prisms(prism_direction, left_handed);
    case Split::tetrahedron:
        return six_tetrahedra(left_handed);
    case Split::pyramid:
        return six_pyramids(left_handed);
    default:
        return one_hexahedron(left_handed);
    }
}

// Layers on the x sides count (y, z, outward), on the y sides (x, z, outward), on the z sides (x, y, outward): right-handed on
// x+, y- and z+.
bool is_left_handed(int side) { return (side % 2 == 0) != (side / 2 == 1); }

std::vector<std::string> group_names(MeshKind mesh) {
    switch (mesh) {
    case MeshKind::box:
    case MeshKind::waves:
        return {"x-", "x+", "y-", "y+", "z-", "z+"};
    case MeshKind::ball:
        return {"sphere"};
    case MeshKind::hemisphere:
        return {"sphere", "flat"};
    case MeshKind::shell:
        return {"outer", "inner"};
    case MeshKind::torus:
        return {"surface"};
    default:
        return {"boundary"};
    }
}

bool has_layers(MeshKind mesh) {
    return mesh == MeshKind::ball || mesh == MeshKind::hemisphere || mesh == MeshKind::shell || mesh == MeshKind::torus;
}

bool has_layers_on(MeshKind mesh, int side) {
    if (mesh == MeshKind::torus)
        return side < 4;
    return mesh != MeshKind::hemisphere || side != 4;
}

} // namespace

Mesh::Mesh(const Parameters& parameters)
    : m_cells(parameters.elements), m_is_ring(parameters.mesh == MeshKind::torus), m_groups(group_names(parameters.mesh)) {
    if (parameters.mesh != MeshKind::shell)
        add_core(parameters);
    if (has_layers(parameters.mesh)) {
        m_layers = parameters.layers;
        for (int side = 0; side < 6; ++side)
            if (has_layers_on(parameters.mesh, side))
                add_layers(parameters, side);
    }
}

void Mesh::add_core(const Parameters& parameters) {
    Block block;
    block.count = m_cells;
    if (parameters.mesh == MeshKind::box || parameters.mesh == MeshKind::waves)
        block.groups = {0, 1, 2, 3, 4, 5};
    if (parameters.mesh == MeshKind::hemisphere)
        block.groups[4] = second_group;

    if (parameters.mesh == MeshKind::twisted_tetrahedron) {
        block.split = corner_tetrahedron();
        // The slanted face lies in no side of the cell; it belongs to the boundary like the others.
        std::ranges::replace(block.split[0].sides, -1, 5);
        block.groups.fill(outer_group);
        add_block(std::move(block));
    } else if (parameters.split != Split::mixed) {
        block.split = split_cell(parameters.split, 2, false);
        add_block(std::move(block));
    } else if (has_layers(parameters.mesh)) {
        block.split = six_tetrahedra(false);
        add_block(std::move(block));
    } else {
        add_slabs(block);
    }
}

// Four slabs along x: hexahedra, prisms, the pyramids that lead over, tetrahedra. Inner sides of slabs carry no group.
void Mesh::add_slabs(const Block& whole) {
    const std::uint32_t n = m_cells[0];
    const std::uint32_t third = (n - 1) / 3;
    const std::array<std::uint32_t, 5> bounds{0, n - 1 - 2 * third, n - 1 - third, n - third, n};
    const std::array<CellSplit, 4> splits{one_hexahedron(false), two_prisms(2, false), five_pyramids_two_tetrahedra(1, false),
                                          six_tetrahedra(false)};
    for (std::size_t slab = 0; slab < 4; ++slab) {
        Block block = whole;
        block.start[0] = bounds[slab];
        block.count[0] = bounds[slab + 1] - bounds[slab];
        if (slab > 0)
            block.groups[0] = ELVIS_GROUP_NONE;
        if (slab < 3)
            block.groups[1] = ELVIS_GROUP_NONE;
        block.split = splits[slab];
        add_block(std::move(block));
    }
}

void Mesh::add_layers(const Parameters& parameters, int side) {
    const int axis = side / 2;
    const bool left_handed = is_left_handed(side);
    Block block;
    block.side = side;
    block.directions = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2, outward};
    block.count = {m_cells[static_cast<std::size_t>(block.directions[0])],
                   m_cells[static_cast<std::size_t>(block.directions[1])], m_layers};
    block.groups[5] = outer_group;
    if (parameters.mesh == MeshKind::shell)
        block.groups[4] = second_group;
    if (parameters.mesh == MeshKind::hemisphere && axis != 2)
        block.groups[2] = second_group;

    // Prisms are stacked along closed columns of cells, so that their triangles meet: through core and z sides along z, and
    // along the belt of x and y sides around it; in a torus along the ring.
    const int belt_direction = parameters.mesh == MeshKind::torus ? 1 : 0;
    const int prism_direction = axis == 2 ? 2 : belt_direction;
    if (parameters.split != Split::mixed) {
        block.split = split_cell(parameters.split, prism_direction, left_handed);
        add_block(std::move(block));
        return;
    }

    // Tetrahedra in the core, pyramids that lead over, then prisms and hexahedra. The torus has no z sides: there the x sides
    // hold the prisms and the y sides the hexahedra.
    Block first = block;
    first.count[2] = 1;
    first.groups[5] = ELVIS_GROUP_NONE;
    first.split = five_pyramids_two_tetrahedra(4, left_handed);
    add_block(std::move(first));
    block.start[2] = 1;
    block.count[2] = m_layers - 1;
    block.groups[4] = ELVIS_GROUP_NONE;
    const bool hexahedra = parameters.mesh == MeshKind::torus ? axis == 1 : axis == 2;
    block.split = hexahedra ? one_hexahedron(left_handed) : two_prisms(prism_direction, left_handed);
    add_block(std::move(block));
}

void Mesh::add_block(Block block) {
    const std::uint64_t cells = std::uint64_t{block.count[0]} * block.count[1] * block.count[2];
    block.first_element = m_n_elements;
    block.first_cell = m_n_cells;
    m_n_elements += cells * block.split.size();
    m_n_cells += cells;
    m_blocks.push_back(std::move(block));
}

// Corners of cells by lattice position and layer (with gaps: layers keep numbers for the inside of the core), then centres.
std::uint64_t Mesh::n_lattice_corners() const {
    const std::uint64_t third = m_is_ring ? m_cells[2] : m_cells[2] + 1;
    return std::uint64_t{m_cells[0] + 1} * (m_cells[1] + 1) * third;
}

std::uint64_t Mesh::n_corner_ids() const { return n_lattice_corners() * (m_layers + 1) + m_n_cells; }

ElementPlace Mesh::place(std::uint64_t element) const {
    const auto after = std::ranges::upper_bound(m_blocks, element, {}, &Block::first_element);
    const Block& block = *std::prev(after);
    const std::uint64_t local = element - block.first_element;
    const std::uint64_t cell = local / block.split.size();
    const std::uint64_t row = cell / block.count[0];
    return {&block,
            &block.split[local % block.split.size()],
            {static_cast<std::uint32_t>(cell % block.count[0]), static_cast<std::uint32_t>(row % block.count[1]),
             static_cast<std::uint32_t>(row / block.count[1])},
            block.first_cell + cell};
}

std::int64_t Mesh::corner_id(const ElementPlace& place, CellCorner corner) const {
    const std::uint64_t n_lattice = n_lattice_corners();
    if (corner == cell_centre)
        return static_cast<std::int64_t>(n_lattice * (m_layers + 1) + place.cell_number);
    const Block& block = *place.block;
    std::array<std::uint64_t, 4> position{};
    if (block.side >= 0 && block.side % 2 == 1)
        position[static_cast<std::size_t>(block.side / 2)] = m_cells[static_cast<std::size_t>(block.side / 2)];
    for (std::size_t d = 0; d < 3; ++d)
        position[static_cast<std::size_t>(block.directions[d])] =
            std::uint64_t{block.start[d]} + place.cell[d] + static_cast<std::uint64_t>(corner >> d & 1);
    if (m_is_ring)
        position[2] %= m_cells[2];
    return static_cast<std::int64_t>(position[0] + (m_cells[0] + 1) * (position[1] + (m_cells[1] + 1) * position[2]) +
                                     n_lattice * position[outward]);
}

std::int32_t Mesh::group(const ElementPlace& place, std::size_t local_face) const {
    const int side = place.element->sides[local_face];
    if (side < 0)
        return ELVIS_GROUP_NONE;
    const auto d = static_cast<std::size_t>(side / 2);
    const std::uint32_t last = side % 2 == 1 ? place.block->count[d] - 1 : 0;
    return place.cell[d] == last ? place.block->groups[static_cast<std::size_t>(side)] : ELVIS_GROUP_NONE;
}

LatticePoint Mesh::lattice_point(const ElementPlace& place, const double* xi) const {
    const Block& block = *place.block;
    LatticePoint point;
    if (block.side >= 0 && block.side % 2 == 1)
        point.u[static_cast<std::size_t>(block.side / 2)] = 1;
    for (std::size_t d = 0; d < 3; ++d) {
        double c = place.element->origin[d];
        for (std::size_t e = 0; e < 3; ++e)
            c += 0.5 * (1 + xi[e]) * place.element->axes[e][d];
        const auto direction = static_cast<std::size_t>(block.directions[d]);
        const double position = block.start[d] + (place.cell[d] + c);
        if (direction == outward)
            point.t = position / m_layers;
        else
            point.u[direction] = position / m_cells[direction];
    }
    return point;
}

} // namespace generator
