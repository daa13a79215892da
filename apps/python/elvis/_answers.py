"""What is asked of a volume without a picture: integrals, and what a line meets."""

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
