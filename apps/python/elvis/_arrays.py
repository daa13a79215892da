"""Volumes from numpy's arrays, without a file."""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from ._library import context
from ._progress import progress_for
from ._progress import Progress
from ._volume import Volume

Shape = Literal["hexahedron", "prism", "pyramid", "tetrahedron", "quadrilateral", "triangle"]
Basis = Literal["modified", "orthogonal", "gll_lagrange", "gauss_lagrange", "tensor"]

_SHAPES = ("hexahedron", "prism", "pyramid", "tetrahedron", "quadrilateral", "triangle")
_BASES = ("modified", "orthogonal", "gll_lagrange", "gauss_lagrange", "tensor")
_CONTINUITIES = ("unknown", "continuous", "discontinuous")


@dataclass(frozen=True)
class Space:
    """A polynomial space on a reference shape, and what numbers say about its functions.

    order: one for all directions, or three (two in two dimensions). Without nodes, numbers are coefficients of the basis, whose
    modes are ordered as in the page on native volumes; of gll_lagrange and gauss_lagrange these are values at the basis' points,
    the first direction fastest. nodes: (m, 3) reference coordinates in [-1, 1], as many as there are modes: numbers are values
    there.
    """

    order: int | Sequence[int]
    basis: Basis = "modified"
    nodes: ArrayLike | None = field(default=None, compare=False)

    def _to_dict(self, shape: str) -> dict[str, Any]:
        n_directions = 2 if shape in ("quadrilateral", "triangle") else 3
        order = [self.order] * n_directions if isinstance(self.order, int) else [int(one) for one in self.order]
        nodes = None if self.nodes is None else np.asarray(self.nodes, dtype=float)
        if nodes is not None and nodes.ndim == 2 and nodes.shape[1] == 2:
            nodes = np.column_stack([nodes, np.zeros(len(nodes))])
        return {"basis": _number(self.basis, _BASES, "basis"), "order": (order + [0])[:3], "nodes": nodes}


@dataclass
class Elements:
    """Elements of one shape and order.

    geometry: (n, m, 3), positions at the nodes of `space` or coefficients of its modes; m is the number of modes.
    corners: (n, corners of the shape), equal numbers are one corner; None: corners at one place are one.
    face_groups: (n, faces of the shape), index of the boundary group or -1; None: none has one.
    """

    shape: Shape
    space: Space
    geometry: ArrayLike
    corners: ArrayLike | None = None
    face_groups: ArrayLike | None = None


def from_arrays(elements: Elements | Sequence[Elements], fields: Mapping[str, Any], *, name: str = "arrays",
                times: Sequence[float] | None = None, boundary_groups: Sequence[str] = (), units: Mapping[str, str] | None = None,
                continuity: Mapping[str, str] | None = None, progress: Progress = True) -> Volume:
    """Makes a volume from arrays in the native spaces, which are copied.

    elements: of one kind, or of several. fields: by name (space, values); of several kinds of elements a list of such pairs.
    values: (n, m), of a vector (n, m, components); with `times`, one more axis in front, the time steps.
    continuity: by field "continuous" or "discontinuous", for the record. Volume.update_field replaces values later.
    """
    kinds = [elements] if isinstance(elements, Elements) else list(elements)
    steps = 1 if times is None else len(times)
    classes = [_class_of(kind) for kind in kinds]
    listed = []
    layouts: dict[str, list[tuple[int, int]]] = {}
    for field_name, given in fields.items():
        pairs = [given] if isinstance(given, tuple) else list(given)
        if len(pairs) != len(kinds):
            raise ValueError(f"field '{field_name}': {len(pairs)} pairs of space and values for {len(kinds)} kinds of elements")
        by_class = [_steps_of(values, times is not None, steps, cls["n_elements"], field_name)
                    for (_, values), cls in zip(pairs, classes)]
        components = {array.shape[-1] for array in by_class}
        if len(components) != 1:
            raise ValueError(f"field '{field_name}': kinds of elements differ in the number of components")
        for (space, _), kind, array in zip(pairs, kinds, by_class):
            _check_modes(kind.shape, space, array.shape[2], f"field '{field_name}'")
        layouts[field_name] = [array.shape[1:] for array in by_class]
        listed.append({
            "name": field_name, "unit": (units or {}).get(field_name, ""), "components": components.pop(),
            "continuity": _number((continuity or {}).get(field_name, "unknown"), _CONTINUITIES, "continuity"),
            "spaces": [space._to_dict(kind.shape) for (space, _), kind in zip(pairs, kinds)],
            "values": [np.ascontiguousarray(np.swapaxes(array[step], 1, 2))
                       for step, array in itertools.product(range(steps), by_class)]})
    dimension = 2 if kinds[0].shape in ("quadrilateral", "triangle") else 3
    with progress_for(progress) as report:
        handle = context().from_arrays(name, dimension, classes, listed, list(times) if times is not None else [0.0],
                                       list(boundary_groups), report)
    return Volume(handle, name, layouts)


def _class_of(kind: Elements) -> dict[str, Any]:
    geometry = np.asarray(kind.geometry, dtype=float)
    if geometry.ndim != 3 or geometry.shape[2] != 3:
        raise ValueError(f"geometry of {kind.shape} elements: the shape (n, m, 3) is wanted, not {geometry.shape}")
    _check_modes(kind.shape, kind.space, geometry.shape[1], f"geometry of {kind.shape} elements")
    n = len(geometry)
    for what in ("corners", "face_groups"):
        given = getattr(kind, what)
        if given is not None and np.ndim(given) != 2 or given is not None and len(given) != n:
            raise ValueError(f"{what} of {kind.shape} elements: one row for each of {n} elements is wanted")
    corners = _wide(kind.corners, {"hexahedron": 8, "prism": 6, "pyramid": 5, "tetrahedron": 4, "quadrilateral": 4, "triangle": 3},
                    kind.shape, "corners")
    groups = _wide(kind.face_groups,
                   {"hexahedron": 6, "prism": 5, "pyramid": 5, "tetrahedron": 4, "quadrilateral": 4, "triangle": 3}, kind.shape,
                   "face_groups")
    return {"shape": _number(kind.shape, _SHAPES, "shape"), "n_elements": n, **kind.space._to_dict(kind.shape),
            "geometry": np.ascontiguousarray(np.swapaxes(geometry, 1, 2)), "corners": corners, "face_groups": groups}


def _wide(given: ArrayLike | None, widths: dict[str, int], shape: str, what: str) -> np.ndarray | None:
    if given is None:
        return None
    array = np.asarray(given)
    if array.shape[1] != widths[shape]:
        raise ValueError(f"{what} of {shape} elements: {widths[shape]} columns are wanted, not {array.shape[1]}")
    return array


def _steps_of(values: ArrayLike, has_steps: bool, steps: int, n: int, field_name: str) -> np.ndarray:
    """As (steps, n, m, components)."""
    array = np.asarray(values, dtype=float)
    array = array if has_steps else array[np.newaxis]
    array = array[..., np.newaxis] if array.ndim == 3 else array
    if array.ndim != 4 or array.shape[:2] != (steps, n):
        wanted = f"({steps}, {n}, m)" if has_steps else f"({n}, m)"
        raise ValueError(f"field '{field_name}': values of the shape {wanted}, or with components behind, are wanted, not "
                         f"{np.shape(values)}")
    return array


def _check_modes(shape: str, space: Space, n_given: int, what: str) -> None:
    known = space._to_dict(shape)
    n_modes = context().count_modes(_number(shape, _SHAPES, "shape"), known["basis"], known["order"])
    if n_given != n_modes:
        raise ValueError(f"{what}: the space has {n_modes} modes, but there are {n_given} numbers an element")
    if known["nodes"] is not None and known["nodes"].shape != (n_modes, 3):
        raise ValueError(f"{what}: nodes of the shape ({n_modes}, 3) are wanted, not {known['nodes'].shape}")


def _number(word: str, words: Sequence[str], what: str) -> int:
    if word not in words:
        raise ValueError(f"{what} '{word}' is not known; there are {', '.join(words)}")
    return words.index(word)
