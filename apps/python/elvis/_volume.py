"""Volumes that are open."""

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _elvis
from ._answers import Break, Integral, Mesh, Streamline, breaks_of, mesh_of, streamlines_of
from ._frames import Frames
from ._library import context
from ._picture import Picture
from ._probe import Samples
from ._progress import Progress, progress_for
from ._scene import Scene
from ._view import View
from .scene_objects import Surface


def _seeds_of(seeds: ArrayLike | Surface) -> tuple[NDArray[np.float64], str]:
    """Points, and the surface on which there are others, as JSON."""
    if isinstance(seeds, Surface):
        return np.empty((0, 3)), json.dumps(seeds.to_dict())
    return np.atleast_2d(np.asarray(seeds, dtype=float)), ""


@dataclass(frozen=True)
class Field:
    """A field of a volume."""

    name: str
    components: int
    unit: str
    continuity: str
    """continuous, discontinuous or unknown."""


@dataclass(frozen=True)
class Range:
    """Smallest and largest value of a field or expression over a volume."""

    minimum: float
    maximum: float
    lower_bound: float
    """No value lies below, if `certified`. Infinite where an expression grows without limit, as far as its samples tell."""
    upper_bound: float
    certified: bool
    """Proven, not from samples."""
    minimum_element: int
    maximum_element: int
    minimum_position: Sequence[float]
    """In the world; NaN if the plugin does not evaluate on the CPU."""
    maximum_position: Sequence[float]


class Volume:
    """A volume that is open: see elvis.open."""

    def __init__(self, handle: _elvis.Volume, path: str, layouts: dict[str, list[tuple[int, ...]]] | None = None,
                 named: dict[str, Any] | None = None) -> None:
        self._handle = handle
        self._layouts = layouts
        self.named = {"path": os.path.abspath(path), **(named or {})}
        """As scenes name it: path, more_paths, plugin, options."""
        self.path = path
        """Its file."""
        self._facts = json.loads(handle.describe(0, True))

    @property
    def is_file(self) -> bool:
        """Not from arrays."""
        return self._layouts is None

    @property
    def fields(self) -> dict[str, Field]:
        """The fields by their names."""
        return {field["name"]: Field(field["name"], field["components"], field["unit"], field["continuity"])
                for field in self._facts["fields"]}

    @property
    def n_elements(self) -> int:
        """Number of elements."""
        return self._facts["n_elements"]

    @property
    def bounds(self) -> np.ndarray:
        """Lower and upper corner of the bounds, (2, 3), in world units."""
        return np.array(self._facts["bounds"])

    @property
    def time_steps(self) -> np.ndarray:
        """Times of the steps."""
        return np.array(self._facts["times"], dtype=float)

    @property
    def boundary_groups(self) -> list[str]:
        """Names of the groups of boundary faces."""
        return list(self._facts["boundary_groups"])

    def info(self, time_step: int = 0) -> dict[str, Any]:
        """What `elvis info --json` prints: classes, orders, ranges, Jacobians. Takes a while for large volumes."""
        return json.loads(self._handle.describe(time_step, False))

    def range(self, field: str, time_step: int = 0) -> Range:
        """Extrema of a field's component or of an expression; of a vector, of its magnitude."""
        return Range(**self._handle.range(field, time_step))

    def probe(self, points: ArrayLike, fields: str | Sequence[str] | None = None, *, time_step: int = 0,
              progress: Progress = True) -> Samples:
        """Values at points, in double precision, straight from the basis.

        points: (n, 3), world units; or one point, (3,). fields: names or expressions; None is all fields. A field's name gives
        all its components.
        """
        places = np.atleast_2d(np.asarray(points, dtype=float))
        names = list(self.fields) if fields is None else [fields] if isinstance(fields, str) else list(fields)
        n_values = [self._handle.count_values(name) for name in names]
        with progress_for(progress) as report:
            probed = self._handle.probe(places, names, time_step, report)
        return Samples(places, names, n_values, probed)

    def integrate(self, field: str | None = None, *, boundary: bool | Sequence[str] = False, plane: Sequence[float] | None = None,
                  isosurface: float | None = None, isosurface_field: str | None = None, flux: bool = False, time_step: int = 0,
                  tolerance: float = 1e-9, progress: Progress = True) -> Integral:
        """The integral of a field or expression over the volume, or over one of boundary, plane and isosurface.

        field: None is the number 1. boundary: True, or names of groups. plane: a, b, c, d of ax+by+cz+d=0. isosurface: its value,
        of `isosurface_field`, or of `field`. flux: the field is a vector, of which the component along the normal is integrated: out of
        the volume, along (a, b, c), or to larger values. tolerance: of the error, relative to the integral of the magnitude.
        """
        if (boundary is not False) + (plane is not None) + (isosurface is not None) > 1:
            raise ValueError("one of boundary, plane and isosurface")
        domain = 1 if boundary is not False else 2 if plane is not None else 3 if isosurface is not None else 0
        groups = [] if isinstance(boundary, bool) else list(boundary)
        level_field = isosurface_field if isosurface_field is not None else None if flux else field
        with progress_for(progress) as report:
            return Integral(**self._handle.integrate(domain, field, groups, [0.0] * 4 if plane is None else list(plane), level_field,
                                                     0.0 if isosurface is None else isosurface, flux, time_step, tolerance, report))

    def extract(self, field: str | None = None, *, isosurface: float | None = None, isosurface_field: str | None = None,
                plane: Sequence[float] | None = None, boundary: bool | Sequence[str] = False, contours: Sequence[float] = (),
                values: str | Sequence[str] = (), tolerance: float = 1e-3, time_step: int = 0, progress: Progress = True) -> Mesh:
        """A mesh of one of isosurface, plane and boundary, or of the contours on it.

        field: of the isosurface and of contours, a name or an expression. isosurface: its value, of `isosurface_field` if that is given.
        plane: a, b, c, d of ax+by+cz+d=0. boundary: True, or names of groups; it is what is taken where nothing else is given. contours:
        values of `field`, whose lines on the surface are wanted in place of it. values: fields and expressions whose values at the
        vertices are wanted. tolerance: how far mesh and surface may be from each other, as a share of the diagonal of the bounds.
        """
        if (boundary is not False) + (plane is not None) + (isosurface is not None) > 1:
            raise ValueError("one of isosurface, plane and boundary")
        level_field = isosurface_field if isosurface_field is not None else field
        if isosurface is not None and level_field is None:
            raise ValueError("isosurface: of which field?")
        if len(contours) > 0 and field is None:
            raise ValueError("contours: of which field?")
        domain = 2 if plane is not None else 3 if isosurface is not None else 1
        groups = [] if isinstance(boundary, bool) else list(boundary)
        names = [values] if isinstance(values, str) else list(values)
        n_values = [self._handle.count_values(name) for name in names]
        with progress_for(progress) as report:
            found = self._handle.extract(domain, groups, [0.0] * 4 if plane is None else list(plane), level_field,
                                         0.0 if isosurface is None else isosurface, field, list(contours), names, tolerance, time_step, report)
        return mesh_of(found, names, n_values)

    def streamlines(self, field: str, seeds: ArrayLike | Surface, fields: str | Sequence[str] = (), *, spacing: float = 0.0, direction: str = "both",
                    tolerance: float = 1e-9, length: float = 0.0, time_step: int = 0, progress: Progress = True) -> list[Streamline]:
        """Curves that are everywhere tangent to a vector field, one through each seed.

        field: a vector by name or expression. seeds: (n, 3), or a surface, such as a plane or a group of the boundary, on which they are
        evenly spaced: spacing, 0 is 0.05 of the diagonal. fields: names or expressions whose values at the points are wanted.
        direction: both, forward or backward. tolerance: of a step's error, as a share of the diagonal of the bounds. length: of a line
        in each direction; 0 is ten times the diagonal.
        """
        names = [fields] if isinstance(fields, str) else list(fields)
        n_values = [self._handle.count_values(name) for name in names]
        with progress_for(progress) as report:
            points, surface = _seeds_of(seeds)
            found = self._handle.trace(field, points, ("both", "forward", "backward").index(direction), names, tolerance, length, time_step,
                                       False, False, None, None, surface, spacing, report)
        return streamlines_of(found, names, n_values)

    def pathlines(self, field: str, seeds: ArrayLike | Surface, fields: str | Sequence[str] = (), *, spacing: float = 0.0, direction: str = "forward",
                  start_time: float | None = None, end_time: float | None = None, interpolation: str = "cubic", tolerance: float = 1e-9,
                  length: float = 0.0, progress: Progress = True) -> list[Streamline]:
        """The ways of points that move with a vector field through the time steps, one from each seed.

        field: a vector by name or expression, interpolated between time steps (cubic or linear). seeds, spacing: as of streamlines. fields: names or
        expressions whose values along the ways, at the points' times, are wanted. direction: forward in time, backward or both.
        start_time: when points are at their seeds; the first time step, backward the last one. end_time: till when, backward since
        when, they are followed. tolerance and length: as of streamlines, but without a limit of length.
        """
        names = [fields] if isinstance(fields, str) else list(fields)
        n_values = [self._handle.count_values(name) for name in names]
        with progress_for(progress) as report:
            points, surface = _seeds_of(seeds)
            found = self._handle.trace(field, points, ("both", "forward", "backward").index(direction), names, tolerance, length, 0, True,
                                       ("cubic", "linear").index(interpolation) == 1, start_time, end_time, surface, spacing, report)
        return streamlines_of(found, names, n_values)

    def lines_of(self, scene: Scene, surface: int, fields: str | Sequence[str] = (), *, progress: Progress = True) -> list[Streamline]:
        """The streamlines or pathlines of a scene's surface, as its picture shows them.

        surface: index in scene.surfaces. fields: names or expressions whose values at the points are wanted. If the scene has a warp,
        lines are those of the displaced volume.
        """
        names = [fields] if isinstance(fields, str) else list(fields)
        n_values = [self._handle.count_values(name) for name in names]
        with progress_for(progress) as report:
            found = self._handle.trace_scene(scene.to_json(), scene._folder, surface, names, report)
        return streamlines_of(found, names, n_values)

    def warp(self, field: str, factor: float = 1.0, *, imaginary: str | None = None, phase: float = 0.0, time_step: int = 0,
             progress: Progress = True) -> "Volume":
        """The volume displaced by factor times a field, exactly; fields go along with the points.

        field: a vector; in two dimensions also a number, which is a height. imaginary: of a complex displacement the imaginary part;
        what is shown is the real part of (field + i imaginary) e^(i phase). phase: degrees. Derivatives in expressions are those in
        the displaced coordinates.
        """
        with progress_for(progress) as report:
            return Volume(self._handle.warp(field, factor, imaginary, phase, time_step, report), self.path, {})

    def join(self, others: Mapping[str, "Volume"], *, time_steps: Mapping[str, int] | None = None, progress: Progress = True) -> "Volume":
        """The volume with the fields of others beside its own, as NAME.FIELD: `v.join({"b": w})` has p and b.p.

        others: by name. With the same elements p - b.p is exact; with others b.p is found by place, and NaN where b is not. One may be this volume itself, at another time step. time_steps: by name, the
        step that is shown at each time; without, the same one, or the only one there is.
        """
        steps = dict(time_steps or {})
        unknown = sorted(set(steps) - set(others))
        if unknown:
            raise ValueError(f"time_steps: {unknown[0]!r} is not among those joined")
        wanted = [(name, other._handle, steps.get(name)) for name, other in others.items()]
        with progress_for(progress) as report:
            return Volume(self._handle.join(wanted, report), self.path, {})

    def walk_line(self, start: Sequence[float], end: Sequence[float], fields: str | Sequence[str] | None = None, *, time_step: int = 0,
                  progress: Progress = True) -> list[Break]:
        """Where the straight line from start to end enters and leaves elements, in order, with the fields as seen from either side.

        fields: names or expressions; None is all fields. For values between these places see `probe`.
        """
        names = list(self.fields) if fields is None else [fields] if isinstance(fields, str) else list(fields)
        n_values = [self._handle.count_values(name) for name in names]
        with progress_for(progress) as report:
            places = self._handle.walk_line(list(start), list(end), names, time_step, report)
        return breaks_of(json.loads(places), names, n_values)

    def scene(self, *, field: str | None = None, cut_planes: Sequence[Sequence[float]] = (), boundary: bool | Sequence[str] = False,
              isosurfaces: Sequence[float] | Mapping[str, Sequence[float]] = (), volume: str | None = None,
              time_step: int = 0, **keys: Any) -> Scene:
        """A scene of this volume. Without any surface it shows what `elvis render FILE` does.

        field: what surfaces show; the first of the volume if None. cut_planes: a, b, c, d of planes ax+by+cz+d=0.
        boundary: True, or names of groups. isosurfaces: values of `field`, or a dict of values by field.
        volume: "default" draws the volume itself. keys: other keys of the scene file, such as camera or color_map.
        """
        scene = Scene(**keys)
        object.__setattr__(scene, "_shown", self)
        if field is not None:
            scene.field = field
        if time_step:
            scene.volume.path = os.path.abspath(self.path) if self.is_file else self.path
            scene.volume.time_step = time_step
        for plane in cut_planes:
            scene.surfaces.append(Surface(type="plane", plane=plane))
        if boundary:
            scene.surfaces.append(Surface(type="boundary"))
            if boundary is not True:
                scene.surfaces[-1].groups = list(boundary)
        of_fields = isosurfaces if isinstance(isosurfaces, Mapping) else {None: isosurfaces} if len(isosurfaces) else {}
        for name, values in of_fields.items():
            scene.surfaces.append(Surface(type="isosurface", values=values, field=name))
        if volume == "default":
            scene.volume_rendering.visible = True
        elif volume is not None:
            raise ValueError(f"volume: '{volume}' is not known; 'default' is, and scene.volume_rendering has all else")
        return scene

    def render(self, scene: Scene | None = None, width: int = 0, height: int = 0, *, color_only: bool = False,
               progress: Progress = True) -> Picture:
        """Draws a picture of a scene; None shows what `elvis render FILE` does.

        width, height: 0 are those of scene.image.size. color_only: without values, depths and flags, which is faster.
        Kernels and buffers are kept: the next picture of the kind costs the device's work alone.
        """
        scene = Scene() if scene is None else scene
        with progress_for(progress) as report:
            drawn = self._handle.render(scene.to_json(), scene._folder, int(width), int(height), color_only, report)
        return Picture(drawn)

    def animate(self, scene: Scene, *, color_only: bool = True, progress: Progress = True) -> Frames:
        """The pictures of a scene's animation, over time steps or along a path of the camera: a sequence.

        Colours mean the same in all pictures: where the scene gives no range, they span that of all time steps.
        """
        with progress_for(progress) as report:
            return Frames(self._handle.animate(scene.to_json(), scene._folder, report), color_only, progress)

    def percentiles(self, parts: Sequence[float], field: str | None = None, *, time_step: int = 0,
                    progress: Progress = True) -> np.ndarray:
        """Values of a field or expression below which these parts of the volume lie, from samples; of the first field if None.

        parts: numbers in [0, 1]. Not of surfaces in space.
        """
        scene = self.scene(field=field, time_step=time_step)
        with progress_for(progress) as report:
            return np.array(self._handle.percentiles(scene.to_json(), scene._folder, [float(part) for part in parts], report))

    def pick(self, scene: Scene, column: float, row: float, *, progress: Progress = False) -> dict[str, Any]:
        """What is known of the point that a place of the scene's picture shows: position, element, reference coordinates, fields.

        column, row: pixels from the upper left corner; middles of pixels end in a half. `hit` is False where nothing is seen.
        """
        with progress_for(progress) as report:
            return json.loads(self._handle.pick(scene.to_json(), scene._folder, float(column), float(row), report))

    def view(self, **options: Any) -> View:
        """Shows the volume in a page that can be turned: see Scene.view, and View."""
        return self.scene(image={"annotation": "default"}).view(**options)

    def complete(self, scene: Scene | None = None) -> Scene:
        """The scene with what it leaves open: the camera, and surfaces if it shows nothing, as its picture has them."""
        scene = self.scene() if scene is None else scene
        complete = Scene.from_dict(json.loads(self._handle.complete(scene.to_json(), scene._folder)))
        object.__setattr__(complete, "_folder", scene._folder)
        object.__setattr__(complete, "_shown", self)
        return complete

    def update_field(self, field: str, values: ArrayLike, *, time_step: int = 0, kind: int = 0) -> None:
        """Replaces a field's values, laid out as for elvis.from_arrays: (n, m), of a vector (n, m, components).

        kind: which of the kinds of elements. The next picture shows them; the mesh and kernels are kept. Only of volumes from
        arrays.
        """
        if self._layouts is None:
            raise ValueError(f"{self.path} is a file: its values cannot be replaced")
        if field not in self._layouts:
            raise KeyError(f"there is no field '{field}'; there are {', '.join(self._layouts)}")
        if not 0 <= kind < len(self._layouts[field]):
            raise IndexError(f"there are {len(self._layouts[field])} kinds of elements")
        layout = self._layouts[field][kind]
        array = np.asarray(values, dtype=float)
        array = array[..., np.newaxis] if array.ndim == 2 else array
        if array.shape != tuple(layout):
            raise ValueError(f"field '{field}': values of the shape {tuple(layout)} are wanted, not {np.shape(values)}")
        self._handle.update_field(list(self._layouts).index(field), time_step, kind, np.ascontiguousarray(np.swapaxes(array, 1, 2)))

    def __repr__(self) -> str:
        return f"<Volume {self.path}: {self.n_elements} elements, fields {', '.join(self.fields)}>"


def open(path: str | os.PathLike | list[str | os.PathLike], *, plugin: str = "", options: dict[str, Any] | None = None,
         progress: Progress = True) -> Volume:
    """Opens a volume.

    path: its file; a list are the files of one foreign data set, geometry first. A foreign file is converted, and the conversion
    kept in the cache. plugin: id of the plugin; "" is the one surest of the file. options: of the plugin.
    """
    paths = [os.fspath(file) for file in (path if isinstance(path, list) else [path])]
    with progress_for(progress) as report:
        handle = context().open(paths, plugin, json.dumps(options) if options else "", report)
    more = [os.path.abspath(file) for file in paths[1:]]
    named = {"more_paths": more, "plugin": plugin, "options": options}
    return Volume(handle, paths[0], named={key: value for key, value in named.items() if value})
