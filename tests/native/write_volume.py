"""Writes a native volume with h5py by format.md alone: a unit tetrahedron and a brick with the field x + 2y + 3z."""
import sys

import h5py
import numpy as np


def text(value):
    return np.bytes_(value.encode())


def dataset(group, name, values, chunk):
    group.create_dataset(name, data=values, chunks=chunk, shuffle=True, compression="gzip", fletcher32=True)


def write_class(file, index, shape, corners, numbers):
    """Order 1: the coefficients of a modified basis are the values at the corners, in the order of modes."""
    group = file.create_group(f"classes/{index}")
    group.attrs["shape"] = text(shape)
    group.attrs["geometry_basis"] = text("modified")
    group.attrs["geometry_order"] = np.array([1, 1, 1], dtype="<u4")
    group.attrs["n_elements"] = np.uint64(1)
    geometry = np.array(corners, dtype="<f8").T[None]
    dataset(group, "geometry", geometry, geometry.shape)
    dataset(group, "numbers", np.array(numbers, dtype="<i8"), (1,))
    part = file.create_group(f"fields/0/{index}")
    part.attrs["basis"] = text("modified")
    part.attrs["order"] = np.array([1, 1, 1], dtype="<u4")
    values = np.array([[[[x + 2 * y + 3 * z for x, y, z in corners]]]], dtype="<f8")
    dataset(part, "coefficients", values, values.shape)


with h5py.File(sys.argv[1], "w", libver="v110") as file:
    file.attrs["format"] = text("ElVis native volume")
    file.attrs["version"] = np.array([1, 0], dtype="<u4")
    file.attrs["dimension"] = np.uint32(3)
    file.attrs["n_elements"] = np.uint64(2)
    file.attrs["n_classes"] = np.uint32(2)
    file.attrs["n_fields"] = np.uint32(1)
    file.attrs["n_times"] = np.uint64(1)
    file.attrs["n_faces"] = np.uint64(1)
    file.attrs["n_boundary_groups"] = np.uint32(1)
    file.attrs["n_notes"] = np.uint32(1)
    dataset(file, "times", np.array([0.5], dtype="<f8"), (1,))
    dataset(file, "boundary_groups", np.array(["wall".encode()], dtype="S4"), (1,))
    dataset(file, "notes", np.array([["created with".encode(), "h5py".encode()]], dtype="S12"), (1, 2))
    # Element, neighbour, local face, the neighbour's local face, group.
    dataset(file, "faces", np.array([[1, -1, 0, -1, 0]], dtype="<i8"), (1, 5))
    # Modes of the tetrahedron are p, q, r with r fastest: (0,0,0) (0,0,1) (0,1,0) (1,0,0) are corners 0, 3, 2, 1.
    tetrahedron = [(0, 0, 0), (0, 0, 1), (0, 1, 0), (1, 0, 0)]
    # Those of the hexahedron are r, q, p with p fastest.
    brick = [(2 + p, q, 4 * r) for r in (0, 1) for q in (0, 1) for p in (0, 1)]
    write_class(file, 0, "tetrahedron", tetrahedron, [1])
    write_class(file, 1, "hexahedron", brick, [0])
    field = file["fields/0"]
    field.attrs["name"] = text("s")
    field.attrs["unit"] = text("m")
    field.attrs["n_components"] = np.uint32(1)
    field.attrs["continuity"] = text("continuous")
    field.attrs["transform"] = text("none")
    field.attrs["max_jump"] = np.float64("nan")
