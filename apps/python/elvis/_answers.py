"""What is asked of a volume without a picture: integrals, what a line meets, streamlines, and meshes of surfaces."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Integral:
    """An integral, and how sure it is. `float(integral)` is its value."""

    value: float
    error: float
    """The value is off by about this much: the difference of two rules, or rounding if `exact`."""
    measure: float
    """Volume, area or length of what was integrated over."""
    measure_error: float
    converged: bool
    """Both errors are within the tolerance."""
    exact: bool
    """Integrand and geometry are polynomials, which are integrated exactly."""
    parts: int
    """Elements or faces that take part."""
    evaluations: int
    inverted: int
    """Elements whose Jacobian determinant is negative somewhere; they count as positive."""
    unresolved: int
    """Places on planes and isosurfaces that stay undecided; what they may add is in the errors."""

    def __float__(self) -> float:
        return self.value


ENDS = ("left volume", "stagnation", "length", "steps", "jump", "no element", "time")
"""Why lines begin and end: the numbers of the library, in words."""


@dataclass(frozen=True)
class Streamline:
    """A curve that is everywhere tangent to a vector field, or the way of a point that moves with it; points in the order of time."""

    begin: str
    """Why it begins there: left volume, stagnation, length (or the seed), steps, jump, no element; of pathlines also time."""
    end: str
    positions: np.ndarray
    """(n, 3)"""
    times: np.ndarray
    """(n,): from the seed on, negative upstream; of pathlines as time steps have it."""
    arc_lengths: np.ndarray
    elements: np.ndarray
    xi: np.ndarray
    """(n, 3): reference coordinates."""
    values: dict[str, np.ndarray]
    """Of each field asked for: (n,), or (n, components)."""


def streamlines_of(found: dict, fields: Sequence[str], n_values: Sequence[int]) -> list[Streamline]:
    """From what the library gives."""
    lines = []
    for line, (first, last) in enumerate(zip(found["first"], found["first"][1:])):
        of_line = slice(int(first), int(last))
        values, column = {}, 0
        for name, n in zip(fields, n_values):
            part = found["values"][of_line, column:column + n]
            values[name] = part[:, 0] if n == 1 else part
            column += n
        lines.append(Streamline(ENDS[found["begins"][line]], ENDS[found["ends"][line]], found["positions"][of_line],
                                found["times"][of_line], found["arc_lengths"][of_line], found["elements"][of_line], found["xi"][of_line],
                                values))
    return lines


@dataclass(frozen=True)
class Side:
    """A place on a line, seen from one of the elements that meet there."""

    element: int
    xi: np.ndarray
    """Reference coordinates, (3,)."""
    values: dict[str, float | np.ndarray]
    """By what was asked for: a number, or the components of a vector."""


@dataclass(frozen=True)
class Break:
    """Where a line goes from one element to the next, or enters or leaves the volume."""

    distance: float
    """From the line's first point."""
    position: np.ndarray
    before: Side | None
    """None outside of the volume."""
    after: Side | None


def breaks_of(places: list[dict], fields: Sequence[str], n_values: Sequence[int]) -> list[Break]:
    """From the library's JSON."""
    def side(one: dict | None) -> Side | None:
        if one is None:
            return None
        values, first = {}, 0
        numbers = np.array(one["values"], dtype=float)
        for field, n in zip(fields, n_values):
            values[field] = numbers[first:first + n] if n > 1 else float(numbers[first])
            first += n
        return Side(one["element"], np.array(one["xi"]), values)
    return [Break(place["distance"], np.array(place["position"]), side(place["before"]), side(place["after"])) for place in places]


@dataclass(frozen=True)
class Mesh:
    """A surface as triangles, or contours as lines, and how near to the true ones they are."""

    positions: np.ndarray
    """(n, 3): vertices, which lie on the true surface."""
    normals: np.ndarray
    """(n, 3), of length 1: to where the isosurface's field is larger, along the plane's (a, b, c), or out of the volume."""
    elements: np.ndarray
    """(n,): an element that each vertex lies in."""
    xi: np.ndarray
    """(n, 3): reference coordinates there."""
    values: dict[str, np.ndarray]
    """Of each field asked for: (n,), or (n, components)."""
    triangles: np.ndarray
    """(m, 3): vertices, anticlockwise from where normals point."""
    triangle_elements: np.ndarray
    """(m,)"""
    lines: list[np.ndarray]
    """Of each contour its vertices; a closed one has its first again as its last."""
    line_values: np.ndarray
    """Which of the contours' values each line is of."""
    measure: float
    """Area, or length of lines."""
    volume: float
    """What a mesh without open edges encloses."""
    mesh_to_surface: float
    """The largest distance seen from the mesh to the surface, in world units; the other way: `surface_to_mesh`."""
    surface_to_mesh: float
    tolerance: float
    """What was asked for, in world units."""
    euler_number: int
    rim_edges: int
    """Edges where the surface ends in the outer boundary."""
    inner_edges: int
    """Open edges inside of the volume, where the field jumps or elements do not meet face to face."""
    branching_edges: int
    """Edges of more than two triangles."""
    open_ends: int
    """Ends of lines that are not where the surface ends."""
    certified: bool
    """Bounds prove that no part of the surface is missing that reaches farther than the tolerance from where it is extreme."""
    sampled_elements: int
    """Elements for which samples had to stand for bounds."""
    undecided: int
    """Places as small as the tolerance that stay undecided."""


def mesh_of(found: dict, fields: Sequence[str], n_values: Sequence[int]) -> Mesh:
    """From what the library gives."""
    numbers, values, column = found.pop("values"), {}, 0
    for name, n in zip(fields, n_values):
        values[name] = numbers[:, column] if n == 1 else numbers[:, column:column + n]
        column += n
    first, vertices = found.pop("line_first"), found.pop("line_vertices")
    lines = [vertices[int(begin):int(end)] for begin, end in zip(first, first[1:])]
    return Mesh(values=values, lines=lines, **found)
