"""Pictures in memory."""

import json
import os
import tempfile
from html import escape
from typing import Any

import numpy as np

from . import _elvis


class Picture:
    """A picture. In a notebook it shows itself, and says in words what was undecided. Arrays have the top row first."""

    def __init__(self, handle: _elvis.Picture) -> None:
        self._handle = handle
        self._arrays: dict[str, np.ndarray] = {}
        self._stats: dict[str, Any] = {}

    def _array(self, channel: str) -> np.ndarray:
        if channel not in self._arrays:
            self._arrays[channel] = self._handle.read(channel)
            self._arrays[channel].flags.writeable = False
        return self._arrays[channel]

    @property
    def width(self) -> int:
        """Columns."""
        return self._handle.width

    @property
    def height(self) -> int:
        """Rows."""
        return self._handle.height

    @property
    def color(self) -> np.ndarray:
        """Red, green, blue, alpha: uint8, (height, width, 4)."""
        return self._array("color")

    @property
    def color_float(self) -> np.ndarray:
        """The same before rounding, 0 to 1: float64, (height, width, 4)."""
        return self._array("color_float")

    @property
    def value(self) -> np.ndarray:
        """Field value; NaN where nothing was met: float64, (height, width)."""
        return self._array("value")

    @property
    def depth(self) -> np.ndarray:
        """Distance from the ray's origin; NaN where nothing was met: float64, (height, width)."""
        return self._array("depth")

    @property
    def normal(self) -> np.ndarray:
        """Unit vector towards the viewer; NaN where nothing was met: float64, (height, width, 3)."""
        return self._array("normal")

    @property
    def element(self) -> np.ndarray:
        """Element; -1 where nothing was met: int64, (height, width)."""
        return self._array("element")

    @property
    def flags(self) -> np.ndarray:
        """Bits that say what is doubtful (elvis.Flag): uint32, (height, width)."""
        return self._array("flags")

    @property
    def stats(self) -> dict[str, Any]:
        """What `elvis render --stats` writes: device, milliseconds, counts, kernels."""
        if not self._stats:
            self._stats = json.loads(self._handle.stats())
        return self._stats

    @property
    def remarks(self) -> list[str]:
        """What is to be known of the picture, warnings first."""
        return [text for text, _ in sorted(self._handle.remarks(), key=lambda remark: not remark[1])]

    @property
    def warnings(self) -> list[str]:
        """What may be wrong with the picture or the data."""
        return [text for text, is_warning in self._handle.remarks() if is_warning]

    @property
    def color_bars(self) -> list[dict[str, Any]]:
        """What colours mean: for each map name, unit, points (value, red, green, blue), below, above, nan, logarithmic."""
        return json.loads(self._handle.color_bars())

    def plot(self, ax: Any = None, *, color_bar: bool = True) -> Any:
        """Puts the picture into axes of matplotlib, with a colour bar that has the picture's own colours. Returns the axes."""
        from ._plot import plot

        return plot(self, ax, color_bar)

    def save(self, path: str | os.PathLike, bits: int = 8) -> None:
        """Writes the file of `elvis render`: PNG, or by the name's ending SVG or PDF with annotation as shapes and text; bits a channel: 8 or 16."""
        name = os.fspath(path)
        writers = {".svg": self._handle.write_svg, ".pdf": self._handle.write_pdf}
        writers.get(os.path.splitext(name)[1].lower(), self._handle.write_png)(name, bits)

    def save_buffers(self, path: str | os.PathLike) -> None:
        """Writes the HDF5 file of `elvis render --buffers`."""
        self._handle.write_buffers(os.fspath(path))

    def png(self, bits: int = 8) -> bytes:
        """The bytes of the PNG file."""
        with tempfile.TemporaryDirectory(prefix="elvis-") as folder:
            path = os.path.join(folder, "picture.png")
            self.save(path, bits)
            with open(path, "rb") as file:
                return file.read()

    def _repr_mimebundle_(self, **_: Any) -> dict[str, Any]:
        import base64

        data = base64.b64encode(self.png()).decode()
        words = "".join(f"<br><small>{escape(text)}</small>" for text in self.remarks)
        return {"text/html": f'<img src="data:image/png;base64,{data}" width="{self.width}">{words}', "text/plain": repr(self)}

    def __repr__(self) -> str:
        return f"<Picture {self.width}x{self.height}{''.join(f'; {text}' for text in self.remarks)}>"
