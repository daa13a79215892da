"""Values of fields at points."""

from collections.abc import Sequence

import numpy as np


class Samples:
    """Values at n points: samples["p"] has the shape (n,), samples["u"] of a vector (n, components).

    Points in no element have NaN everywhere.
    """

    def __init__(self, points: np.ndarray, fields: Sequence[str], n_values: Sequence[int], probed: tuple) -> None:
        self.points = points
        """The points, (n, 3)."""
        self.fields = list(fields)
        """What was asked for."""
        self.element, self.xi, self._values, self._gradients, self._estimated = probed
        self._places = {}
        first = 0
        for field, n in zip(fields, n_values):
            self._places[field] = slice(first, first + n) if n > 1 else first
            first += n

    def __getitem__(self, field: str) -> np.ndarray:
        return self._values[:, self._place(field)]

    def gradient(self, field: str) -> np.ndarray:
        """World gradients: (n, 3), of a vector (n, components, 3)."""
        return self._gradients[:, self._place(field)]

    def is_estimated(self, field: str) -> np.ndarray:
        """Whether values or gradients rest on differences, since the plugin gives no derivatives: bool, (n,)."""
        found = self._estimated[:, self._place(field)] != 0
        return found if found.ndim == 1 else found.any(axis=1)

    @property
    def is_inside(self) -> np.ndarray:
        """Whether an element contains the point: bool, (n,). `element` is -2 where that is not known, -1 outside."""
        return self.element >= 0

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        return f"<{len(self)} samples of {', '.join(self.fields)}; {int(self.is_inside.sum())} in elements>"

    def _place(self, field: str) -> slice | int:
        if field not in self._places:
            raise KeyError(f"'{field}' was not asked for; there are {', '.join(self.fields)}")
        return self._places[field]
