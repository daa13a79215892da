"""Scenes: what is to be seen, with the keys of scene files."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ._library import context
from ._picture import Picture
from ._progress import progress_for
from .scene_objects import SceneKeys

if TYPE_CHECKING:
    from ._view import View
    from ._volume import Volume


class Scene(SceneKeys):
    """A scene: its attributes are the keys of a scene file.

    A scene that a volume made (Volume.scene) or that was read from a file knows what it shows; another one is drawn by
    Volume.render.
    """

    def __init__(self, **keys: Any) -> None:
        object.__setattr__(self, "_shown", None)
        object.__setattr__(self, "_folder", "")
        super().__init__(**keys)

    @classmethod
    def read(cls, path: str | os.PathLike) -> Scene:
        """Reads a scene file. Paths in it are seen from its folder."""
        scene = cls.from_dict(json.loads(context().read_scene(os.fspath(path))))
        object.__setattr__(scene, "_folder", os.path.dirname(os.fspath(path)))
        return scene

    def write(self, path: str | os.PathLike) -> None:
        """Writes a scene file, which appears whole or not at all. `elvis render` draws it to the same bytes.

        The scene of a volume from arrays names no volume, since there is no file of it.
        """
        whole = self.to_json()
        if self._shown is not None and self._shown.is_file:
            whole = json.dumps({**json.loads(whole), "volume": {**self._shown.named, **self.to_dict().get("volume", {})}})
        context().write_scene(whole, self._folder, os.fspath(path))

    def check(self) -> None:
        """Raises Error, which names the key, if a scene file could not say this."""
        context().check_scene(self.to_json(), self._folder)

    def to_json(self) -> str:
        """The scene as its file has it."""
        return json.dumps({"version": 1, **self.to_dict()})

    def render(self, width: int = 0, height: int = 0, *, progress: Any = True) -> Picture:
        """Draws the picture; width and height 0 are those of image.size. See Volume.render."""
        return self._volume().render(self, width, height, progress=progress)

    def view(self, *, width: str | int = "100%", height: str | int = 600, url: str = "http://127.0.0.1:{port}/",
             root: str | os.PathLike | None = None, origins: Sequence[str] = ()) -> View:
        """Shows the scene in a page that can be turned: in a notebook in a frame, else at the address that is printed.

        width, height: of the frame, in pixels or as CSS has them. url: where the browser finds the server's port, such as
        "/proxy/{port}/" behind jupyter-server-proxy. root: the folder of files that the page's scenes may name; by default the
        volume's. origins: where else pages may come from, such as "https://host" behind a proxy. The server opens the volume once
        more, and listens on 127.0.0.1.
        """
        from ._view import show

        return show(self._volume(), self, width=width, height=height, url=url, root=root, origins=origins)

    def _volume(self) -> Volume:
        if self._shown is None:
            from ._volume import Volume

            path = context().scene_volume(self.to_json(), self._folder)
            if not path:
                raise ValueError("the scene names no volume: set scene.volume.path, or draw it by Volume.render")
            with progress_for(True) as report:
                handle = context().open_scene_volume(self.to_json(), self._folder, report)
            object.__setattr__(self, "_shown", Volume(handle, path))
        return self._shown

    def _repr_png_(self) -> bytes:
        return self.render()._repr_png_()
