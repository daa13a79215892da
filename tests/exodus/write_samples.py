#!/usr/bin/env python3
"""Writes the sample files of tests/data/exodus with netCDF's own library: usage: write_samples.py FOLDER.

Each block has one element, away from the others. Nodes lie at straight places s, which the field `s` tells. Elements of order 2 are bent:
their third coordinate (in two dimensions the second) is s plus 0.1 q(s), with the quadratic q; of order 1 they are straight. The field `u`
is (1 + t) (1 + s0 - 2 s1 + 0.5 s2), in elements of order 2 plus (1 + t) q(s).
"""

import sys
from pathlib import Path

import netCDF4
import numpy as np

SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
HEX = [(x, y, -1) for x, y in SQUARE] + [(x, y, 1) for x, y in SQUARE]
TET = [(-1, -1, -1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
WEDGE = [(-1, -1, -1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (-1, 1, 1)]
PYRAMID = [(x, y, -1) for x, y in SQUARE] + [(0, 0, 1)]
TRI = [(-1, -1), (1, -1), (-1, 1)]

# Edges, then faces and middles, by corners from 1, in the order of the Exodus II manual.
HEX_EDGES = [(1, 2), (2, 3), (3, 4), (4, 1), (1, 5), (2, 6), (3, 7), (4, 8), (5, 6), (6, 7), (7, 8), (8, 5)]
HEX_MIDDLES = [tuple(range(1, 9)), (1, 2, 3, 4), (5, 6, 7, 8), (1, 4, 5, 8), (2, 3, 6, 7), (1, 2, 5, 6), (3, 4, 7, 8)]
TET_EDGES = [(1, 2), (2, 3), (3, 1), (1, 4), (2, 4), (3, 4)]
WEDGE_EDGES = [(1, 2), (2, 3), (3, 1), (1, 4), (2, 5), (3, 6), (4, 5), (5, 6), (6, 4)]
WEDGE_MIDDLES = [(1, 2, 4, 5), (2, 3, 5, 6), (1, 3, 4, 6)]
PYRAMID_EDGES = [(1, 2), (2, 3), (3, 4), (4, 1), (1, 5), (2, 5), (3, 5), (4, 5)]
SQUARE_EDGES = [(1, 2), (2, 3), (3, 4), (4, 1)]
TRI_EDGES = [(1, 2), (2, 3), (3, 1)]

SOLID = [("HEX8", HEX, []), ("HEX20", HEX, HEX_EDGES), ("HEX", HEX, HEX_EDGES + HEX_MIDDLES), ("TETRA4", TET, []), ("TETRA10", TET, TET_EDGES),
         ("WEDGE6", WEDGE, []), ("WEDGE15", WEDGE, WEDGE_EDGES), ("wedge", WEDGE, WEDGE_EDGES + WEDGE_MIDDLES), ("PYRAMID5", PYRAMID, []),
         ("PYRAMID13", PYRAMID, PYRAMID_EDGES), ("PYRA14", PYRAMID, PYRAMID_EDGES + [(1, 2, 3, 4)])]
FLAT = [("QUAD4", SQUARE, []), ("QUAD8", SQUARE, SQUARE_EDGES), ("QUAD9", SQUARE, SQUARE_EDGES + [(1, 2, 3, 4)]), ("TRI3", TRI, []),
        ("TRI6", TRI, TRI_EDGES)]


def q(s):
    return s[..., 0] ** 2 - 0.5 * s[..., 0] * s[..., 1] + 0.25 * s[..., -1] ** 2 + s[..., 1] * s[..., -1]


def texts(file, name, dims, rows):
    variable = file.createVariable(name, "S1", dims)
    for row, text in enumerate(rows):
        letters = np.zeros(33, "S1")
        letters[:len(text)] = list(text)
        variable[row] = letters


def write(path, kind, blocks, dimension, one_array):
    straight, connectivity = [], []
    skew = np.array([[1.0, 0.2, 0.1], [-0.1, 0.9, 0.15], [0.05, -0.2, 1.1]])[:dimension, :dimension]
    for number, (_, corners, others) in enumerate(blocks):
        corners = np.array(corners, float)
        points = np.vstack([corners] + [corners[np.array(middle) - 1].mean(axis=0)[None] for middle in others])
        offset = np.zeros(dimension)
        offset[0] = 4 * number
        first = sum(map(len, straight))
        straight.append(0.5 * points @ skew.T + offset)
        connectivity.append(np.arange(first, first + len(points)) + 1)
    is_bent = np.concatenate([np.full(len(points), len(others) > 0) for points, (_, _, others) in zip(straight, blocks)])
    s = np.vstack(straight)
    x = s.copy()
    x[is_bent, -1] += 0.1 * q(s)[is_bent]
    u = 1 + s[:, 0] - 2 * s[:, 1] + (0.5 * s[:, 2] if dimension == 3 else 0)
    u[is_bent] += q(s)[is_bent]

    with netCDF4.Dataset(path, "w", format=kind) as file:
        file.title = "sample"
        file.version = np.float32(8.03)
        file.floating_point_word_size = np.int32(8)
        file.createDimension("time_step", None)
        for name, size in [("len_name", 33), ("len_string", 33), ("num_dim", dimension), ("num_nodes", len(s)), ("num_elem", len(blocks)),
                           ("num_el_blk", len(blocks) + 1), ("num_side_sets", 2), ("num_nod_var", 1 + dimension), ("num_elem_var", 2)]:
            file.createDimension(name, size)

        if one_array:
            file.createVariable("coord", "f8", ("num_dim", "num_nodes"))[:] = x.T
        else:
            for axis in range(dimension):
                file.createVariable("coord" + "xyz"[axis], "f8", ("num_nodes",))[:] = x[:, axis]
        file.createVariable("time_whole", "f8", ("time_step",))[:] = [0.0, 0.5, 2.0]
        file.createVariable("eb_prop1", "i4", ("num_el_blk",))[:] = 100 + np.arange(len(blocks) + 1)
        texts(file, "eb_names", ("num_el_blk", "len_name"), [name for name, _, _ in blocks] + [""])
        for number, ((name, _, _), nodes) in enumerate(zip(blocks, connectivity), 1):
            file.createDimension(f"num_el_in_blk{number}", 1)
            file.createDimension(f"num_nod_per_el{number}", len(nodes))
            variable = file.createVariable(f"connect{number}", "i4", (f"num_el_in_blk{number}", f"num_nod_per_el{number}"))
            variable.elem_type = name
            variable[0] = nodes
        # The last block is empty: it has no dimension of its own.
        texts(file, "name_nod_var", ("num_nod_var", "len_name"), ["u"] + ["s_" + axis for axis in "xyz"[:dimension]])
        texts(file, "name_elem_var", ("num_elem_var", "len_name"), ["quality", "material"])
        table = np.ones((len(blocks) + 1, 2), int)
        table[1, 1] = 0
        file.createVariable("elem_var_tab", "i4", ("num_el_blk", "num_elem_var"))[:] = table
        for step, time in enumerate([0.0, 0.5, 2.0]):
            for variable in range(1 + dimension):
                name = f"vals_nod_var{variable + 1}"
                target = file.variables.get(name) or file.createVariable(name, "f8", ("time_step", "num_nodes"))
                target[step] = (1 + time) * u if variable == 0 else s[:, variable - 1]
            for variable in range(2):
                for number in range(1, len(blocks) + 1):
                    if table[number - 1, variable]:
                        name = f"vals_elem_var{variable + 1}eb{number}"
                        target = file.variables.get(name) or file.createVariable(name, "f8", ("time_step", f"num_el_in_blk{number}"))
                        target[step] = 10 * number + variable + time
        texts(file, "ss_names", ("num_side_sets", "len_name"), ["wall", ""])
        file.createVariable("ss_prop1", "i4", ("num_side_sets",))[:] = [7, 8]
        # Side 1 of all elements, and side 3 of all.
        for number, side in [(1, 1), (2, 3)]:
            file.createDimension(f"num_side_ss{number}", len(blocks))
            file.createVariable(f"elem_ss{number}", "i4", (f"num_side_ss{number}",))[:] = np.arange(len(blocks)) + 1
            file.createVariable(f"side_ss{number}", "i4", (f"num_side_ss{number}",))[:] = side


def write_part(path, part):
    """One of two cubes beside each other, 0 <= x <= 2, as a parallel program writes its own nodes and elements. `u` is x + 2 y - z + t."""
    points = (np.array(HEX, float) + 1) / 2 + [part, 0, 0]
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as file:
        file.createDimension("time_step", None)
        for name, size in [("len_name", 33), ("num_dim", 3), ("num_nodes", 8), ("num_elem", 1), ("num_el_blk", 2), ("num_side_sets", 2),
                           ("num_nod_var", 1), ("num_elem_var", 1), ("num_el_in_blk2", 1), ("num_nod_per_el2", 8), (f"num_side_ss{part + 1}", 1)]:
            file.createDimension(name, size)

        for axis in range(3):
            file.createVariable("coord" + "xyz"[axis], "f8", ("num_nodes",))[:] = points[:, axis]
        file.createVariable("time_whole", "f8", ("time_step",))[:] = [0.0, 1.0]
        connectivity = file.createVariable("connect2", "i4", ("num_el_in_blk2", "num_nod_per_el2"))
        connectivity.elem_type = "HEX8"
        connectivity[0] = np.arange(8) + 1
        texts(file, "name_nod_var", ("num_nod_var", "len_name"), ["u"])
        texts(file, "name_elem_var", ("num_elem_var", "len_name"), ["rank"])
        for step in range(2):
            for name, dims, values in [("vals_nod_var1", ("time_step", "num_nodes"), points @ [1, 2, -1] + step),
                                       ("vals_elem_var1eb2", ("time_step", "num_el_in_blk2"), part)]:
                target = file.variables.get(name) or file.createVariable(name, "f8", dims)
                target[step] = values
        # Each part has the outer side along x of one of the sets: side 4 is x = 0, side 2 is x = 2.
        texts(file, "ss_names", ("num_side_sets", "len_name"), ["inlet", "outlet"])
        file.createVariable(f"elem_ss{part + 1}", "i4", (f"num_side_ss{part + 1}",))[:] = 1
        file.createVariable(f"side_ss{part + 1}", "i4", (f"num_side_ss{part + 1}",))[:] = 4 if part == 0 else 2


folder = Path(sys.argv[1])
write(folder / "solid.e", "NETCDF3_CLASSIC", SOLID, 3, False)
write(folder / "solid_64bit.e", "NETCDF3_64BIT_OFFSET", SOLID, 3, True)
write(folder / "solid_data64.e", "NETCDF3_64BIT_DATA", SOLID, 3, False)
write(folder / "solid_netcdf4.exo", "NETCDF4", SOLID, 3, False)
write(folder / "flat.e", "NETCDF3_CLASSIC", FLAT, 2, False)
for part in range(2):
    write_part(folder / f"cubes.e.2.{part}", part)
