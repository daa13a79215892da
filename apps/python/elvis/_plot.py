"""Pictures in matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable

    from ._picture import Picture


def _mappable(bar: dict[str, Any]) -> ScalarMappable | None:
    """The bar's colours on its values; nothing for a map of one value."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LinearSegmentedColormap, LogNorm, Normalize

    points = np.array(bar["points"])
    values, colors = points[:, 0], points[:, 1:]
    if len(values) < 2 or values[0] == values[-1]:
        return None
    norm = (LogNorm if bar["logarithmic"] else Normalize)(values[0], values[-1])
    places = np.clip(np.asarray(norm(values)), 0, 1)
    places[0], places[-1] = 0, 1
    # Enough steps that colours are those of the picture, whose pieces are linear.
    colormap = LinearSegmentedColormap.from_list(bar["name"] or "elvis", list(zip(places, colors)), N=4096)
    colormap.set_extremes(under=bar["below"], over=bar["above"], bad=bar["nan"])
    return ScalarMappable(norm, colormap)


def plot(picture: Picture, ax: Axes | None, color_bar: bool) -> Axes:
    """See Picture.plot."""
    import matplotlib.pyplot as plt

    axes = plt.gca() if ax is None else ax
    axes.imshow(picture.color, interpolation="nearest")
    axes.set_axis_off()
    for bar in picture.color_bars if color_bar else []:
        mappable = _mappable(bar)
        if mappable is not None:
            label = f"{bar['name']} [{bar['unit']}]" if bar["unit"] else bar["name"]
            axes.figure.colorbar(mappable, ax=axes, label=label)
    return axes
