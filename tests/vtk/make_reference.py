#!/usr/bin/python3
"""Writes tests/data/vtk: one cell of each kind, distorted, with fields, and what VTK itself says of them at some points.

Needs VTK's Python module (Debian: python3-vtk9). Lines of a .ref file: cell, type, VTK's parametric coordinates (3), position (3),
value of u, values of v (3).
"""
import os
import random
import sys

import vtk

OUT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "vtk")
FIXED = {
    3: [vtk.VTK_TETRA, vtk.VTK_VOXEL, vtk.VTK_HEXAHEDRON, vtk.VTK_WEDGE, vtk.VTK_PYRAMID, vtk.VTK_QUADRATIC_TETRA,
        vtk.VTK_QUADRATIC_HEXAHEDRON, vtk.VTK_QUADRATIC_WEDGE, vtk.VTK_QUADRATIC_PYRAMID, vtk.VTK_TRIQUADRATIC_HEXAHEDRON,
        vtk.VTK_QUADRATIC_LINEAR_WEDGE, vtk.VTK_BIQUADRATIC_QUADRATIC_WEDGE, vtk.VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON],
    2: [vtk.VTK_TRIANGLE, vtk.VTK_PIXEL, vtk.VTK_QUAD, vtk.VTK_QUADRATIC_TRIANGLE, vtk.VTK_QUADRATIC_QUAD,
        vtk.VTK_BIQUADRATIC_QUAD, vtk.VTK_QUADRATIC_LINEAR_QUAD, vtk.VTK_BIQUADRATIC_TRIANGLE],
}
LAGRANGE = {3: ["HEXAHEDRON", "WEDGE", "TETRAHEDRON"], 2: ["QUADRILATERAL", "TRIANGLE"]}


def n_points(shape, d):
    p, q, r = (k + 1 for k in d)
    return {"HEXAHEDRON": p * q * r, "WEDGE": p * (p + 1) // 2 * r, "TETRAHEDRON": p * (p + 1) * (p + 2) // 6,
            "QUADRILATERAL": p * q, "TRIANGLE": p * (p + 1) // 2}[shape]


def cells_of(dimension):
    """(type, number of points, degrees) of all cells."""
    cells = [(t, vtk.vtkGenericCell.InstantiateCell(t).GetNumberOfPoints(), (1, 1, 1)) for t in FIXED[dimension]]
    for family in ("LAGRANGE", "BEZIER"):
        for shape in LAGRANGE[dimension]:
            kind = getattr(vtk, f"VTK_{family}_{shape}")
            degrees = [(n, n, n) for n in range(1, 8 if shape in ("TETRAHEDRON", "TRIANGLE") else 6)]
            if shape in ("HEXAHEDRON", "QUADRILATERAL"):
                degrees += [(2, 3, 4), (4, 1, 3)]
            if shape == "WEDGE":
                degrees += [(2, 2, 4), (4, 4, 1), (4, 4, 3)]
            cells += [(kind, n_points(shape, d), d) for d in degrees]
            special = {"TETRAHEDRON": (15, 2), "WEDGE": (21, 2), "TRIANGLE": (7, 2)}.get(shape)
            if family == "LAGRANGE" and special:
                cells.append((kind, special[0], (special[1],) * 3))
    return cells


def parametric_points(kind, count, degrees):
    """Where VTK says the nodes lie."""
    cell = vtk.vtkGenericCell.InstantiateCell(kind)
    cell.GetPoints().SetNumberOfPoints(count)
    cell.GetPointIds().SetNumberOfIds(count)
    if hasattr(cell, "SetOrder"):
        if isinstance(cell, vtk.vtkHigherOrderQuadrilateral):
            cell.SetOrder(degrees[0], degrees[1])
        else:
            cell.SetOrder(*degrees, *([count] if isinstance(cell, vtk.vtkHigherOrderWedge) else []))
    cell.Initialize()
    # The pointer that VTK returns is opaque to Python: ask the cell's functions instead of its table.
    return cell


def lattice(kind, count, degrees):
    """Nodes from the shape functions: those points of a fine lattice where one function is 1."""
    cell = parametric_points(kind, count, degrees)
    for node in range(count):
        cell.GetPoints().SetPoint(node, 0, 0, 0)
    # Not InterpolateFunctions, whose Python form knows wrong numbers of functions for some wedges.
    values, nowhere = [0.0] * count, [0.0] * 3
    steps = set()
    for d in degrees:
        steps.update(i / d for i in range(d + 1))
    steps.update((0.0, 0.5, 1.0, 1 / 3, 0.25))
    steps = sorted(steps)
    nodes = [None] * count
    for r in steps:
        for s in steps:
            for t in steps if cell.GetCellDimension() == 3 else (0.0,):
                cell.EvaluateLocation(vtk.reference(0), (r, s, t), nowhere, values)
                for node, value in enumerate(values):
                    others = sum(abs(v) for i, v in enumerate(values) if i != node)
                    if abs(value - 1) < 1e-9 and others < 1e-9 and nodes[node] is None:
                        nodes[node] = (r, s, t)
    return nodes


def nodes_of(kind, count, degrees):
    bezier_to_lagrange = {vtk.VTK_BEZIER_HEXAHEDRON: vtk.VTK_LAGRANGE_HEXAHEDRON, vtk.VTK_BEZIER_WEDGE: vtk.VTK_LAGRANGE_WEDGE,
                          vtk.VTK_BEZIER_TETRAHEDRON: vtk.VTK_LAGRANGE_TETRAHEDRON,
                          vtk.VTK_BEZIER_QUADRILATERAL: vtk.VTK_LAGRANGE_QUADRILATERAL,
                          vtk.VTK_BEZIER_TRIANGLE: vtk.VTK_LAGRANGE_TRIANGLE}
    nodes = lattice(bezier_to_lagrange.get(kind, kind), count, degrees)
    if None in nodes:
        sys.exit(f"type {kind}, {count} points: no place for node {nodes.index(None)}")
    return nodes


def make_grid(dimension, cells, with_weights):
    grid = vtk.vtkUnstructuredGrid()
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    grid.SetPoints(points)
    arrays = {}
    for name, n in (("u", 1), ("v", 3), ("weights", 1)):
        arrays[name] = vtk.vtkDoubleArray()
        arrays[name].SetName(name)
        arrays[name].SetNumberOfComponents(n)
    degrees_array = vtk.vtkDoubleArray()
    degrees_array.SetName("degrees")
    degrees_array.SetNumberOfComponents(3)
    number = vtk.vtkIntArray()
    number.SetName("number")
    for index, (kind, count, degrees) in enumerate(cells):
        ids = vtk.vtkIdList()
        for r, s, t in nodes_of(kind, count, degrees):
            if kind in (vtk.VTK_PYRAMID, vtk.VTK_QUADRATIC_PYRAMID):
                # Their r and s are collapsed.
                r, s = 0.5 + (r - 0.5) * (1 - t), 0.5 + (s - 0.5) * (1 - t)
            if kind in (vtk.VTK_WEDGE, vtk.VTK_QUADRATIC_WEDGE, vtk.VTK_QUADRATIC_LINEAR_WEDGE,
                        vtk.VTK_BIQUADRATIC_QUADRATIC_WEDGE):
                r, s = s, r
            x = [3 * (index % 8) + r, 3 * (index // 8) + s, t]
            # Pixels and voxels have edges along the axes, or VTK's own functions differ from its positions.
            if kind not in (vtk.VTK_PIXEL, vtk.VTK_VOXEL):
                x = [c + random.uniform(-0.03, 0.03) for c in x]
            ids.InsertNextId(points.InsertNextPoint(x))
            arrays["u"].InsertNextValue(random.uniform(-1, 1))
            arrays["v"].InsertNextTuple([random.uniform(-1, 1) for _ in range(3)])
            arrays["weights"].InsertNextValue(random.uniform(0.5, 1.5) if with_weights else 1.0)
        grid.InsertNextCell(kind, ids)
        degrees_array.InsertNextTuple(degrees)
        number.InsertNextValue(index)
    grid.GetPointData().AddArray(arrays["u"])
    grid.GetPointData().AddArray(arrays["v"])
    grid.GetCellData().AddArray(number)
    grid.GetCellData().SetHigherOrderDegrees(degrees_array)
    if with_weights:
        grid.GetPointData().SetRationalWeights(arrays["weights"])
    return grid


def write(grid, name, mode="appended", compressor="zlib", header=64, big_endian=False, encode=False, block=None):
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(os.path.join(OUT, name))
    writer.SetInputData(grid)
    getattr(writer, {"ascii": "SetDataModeToAscii", "binary": "SetDataModeToBinary", "appended": "SetDataModeToAppended"}[mode])()
    getattr(writer, {"zlib": "SetCompressorTypeToZLib", "lz4": "SetCompressorTypeToLZ4", "none": "SetCompressorTypeToNone"}[compressor])()
    (writer.SetHeaderTypeToUInt64 if header == 64 else writer.SetHeaderTypeToUInt32)()
    (writer.SetByteOrderToBigEndian if big_endian else writer.SetByteOrderToLittleEndian)()
    writer.SetEncodeAppendedData(encode)
    if block:
        writer.SetBlockSize(block)
    writer.Write()


def write_reference(grid, name):
    with open(os.path.join(OUT, name), "w", encoding="ascii") as out:
        out.write(f"# VTK {vtk.vtkVersion.GetVTKVersion()}: cell, type, parametric coordinates, position, u, v\n")
        u, v = grid.GetPointData().GetArray("u"), grid.GetPointData().GetArray("v")
        for index in range(grid.GetNumberOfCells()):
            # A new cell each time: a reused one keeps its order.
            cell = vtk.vtkGenericCell()
            grid.GetCell(index, cell)
            count = cell.GetNumberOfPoints()
            for _ in range(4):
                r, s, t = (random.random() for _ in range(3))
                flat = grid.GetCellType(index) in (5, 22, 34, 69, 76)
                wedge = grid.GetCellType(index) in (13, 26, 31, 32, 73, 80)
                solid = grid.GetCellType(index) in (10, 24, 71, 78)
                if (flat or wedge) and r + s > 1:
                    r, s = 1 - r, 1 - s
                while solid and r + s + t > 1:
                    r, s, t = (random.random() for _ in range(3))
                if cell.GetCellDimension() == 2:
                    t = 0.0
                x, weights = [0.0] * 3, [0.0] * count
                cell.EvaluateLocation(vtk.reference(0), (r, s, t), x, weights)
                ids = [cell.GetPointId(i) for i in range(count)]
                value = sum(w * u.GetValue(i) for w, i in zip(weights, ids))
                vector = [sum(w * v.GetComponent(i, c) for w, i in zip(weights, ids)) for c in range(3)]
                out.write(" ".join([str(index), str(grid.GetCellType(index))] +
                                   [f"{number:.17g}" for number in [r, s, t] + x + [value] + vector]) + "\n")


def main():
    random.seed(1)
    os.makedirs(OUT, exist_ok=True)
    for dimension in (3, 2):
        grid = make_grid(dimension, cells_of(dimension), False)
        write(grid, f"cells{dimension}.vtu")
        write_reference(grid, f"cells{dimension}.ref")
    bezier = [cell for cell in cells_of(3) if 78 <= cell[0] <= 80 and max(cell[2]) <= 2 and cell[0] != vtk.VTK_LAGRANGE_WEDGE]
    grid = make_grid(3, bezier, True)
    write(grid, "rational.vtu")
    write_reference(grid, "rational.ref")
    small = make_grid(3, [(vtk.VTK_LAGRANGE_HEXAHEDRON, 27, (2, 2, 2)), (vtk.VTK_QUADRATIC_TETRA, 10, (2, 2, 2))], False)
    write_reference(small, "small.ref")
    write(small, "small_ascii.vtu", "ascii", "none")
    write(small, "small_binary.vtu", "binary", "none", 32)
    write(small, "small_binary_zlib.vtu", "binary", "zlib", 32, block=512)
    write(small, "small_binary_lz4_big.vtu", "binary", "lz4", 64, big_endian=True, block=256)
    write(small, "small_raw.vtu", "appended", "none", 64)
    write(small, "small_raw_big.vtu", "appended", "none", 32, big_endian=True)
    write(small, "small_raw_lz4.vtu", "appended", "lz4", 32, block=256)
    write(small, "small_base64.vtu", "appended", "none", 32, encode=True)
    write(small, "small_base64_zlib.vtu", "appended", "zlib", 64, encode=True, block=256)

    wedge = make_grid(3, [(vtk.VTK_LAGRANGE_WEDGE, 60, (4, 4, 3))], False)
    write(wedge, "wedge.vtu")
    write_reference(wedge, "wedge.ref")
    # The order of VTK 9.0: rows of the face r = 0 the other way round.
    ids = vtk.vtkIdList()
    wedge.GetCellPoints(0, ids)
    nodes = [ids.GetId(i) for i in range(60)]
    first = 6 + 6 * 3 + 3 * 2 + 2 * 3 + 2 * 6
    for row in (first, first + 3):
        nodes[row:row + 3] = reversed(nodes[row:row + 3])
    old = vtk.vtkUnstructuredGrid()
    old.DeepCopy(wedge)
    old.GetCells().ReplaceCellAtId(0, 60, nodes)
    write(old, "wedge_old.vtu")


main()
