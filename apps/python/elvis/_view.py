"""A volume in a page that can be turned, in a notebook or a browser, and that Python can speak with."""

from __future__ import annotations

import json
import logging
import os
import queue
import tempfile
import threading
import weakref
from collections.abc import Callable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

from . import _elvis
from ._progress import _is_notebook, progress_for
from ._scene import Scene
from ._server import Server
from ._web_socket import WebSocket
from .scene_objects import Camera

if TYPE_CHECKING:
    from ._volume import Volume

_log = logging.getLogger("elvis")

#: Seconds within which the server has to answer: it may be drawing, which it does not break off at once.
_PATIENCE = 60


class View:
    """What Scene.view() shows. In a notebook it shows itself in a frame; elsewhere open `url` in a browser.

    Python and the page have one scene: what is changed here is seen there, and the other way round. `close()`, or the end of the
    process, ends the server behind it; views can also be used in `with`.
    """

    def __init__(self, volume: Volume, scene: Scene, *, width: str | int = "100%", height: str | int = 600, url: str = "http://127.0.0.1:{port}/",
                 root: str | os.PathLike | None = None, origins: Sequence[str] = ()) -> None:
        """See Scene.view."""
        self._volume = volume
        self._size = width, height
        self._root = os.path.abspath(os.path.dirname(volume.path) if root is None else os.fspath(root))
        with tempfile.TemporaryDirectory(prefix="elvis-view-") as folder, progress_for(True):
            path = os.path.join(folder, "scene.json")
            _completed(volume, scene).write(path)
            self._server = Server(path, self._root, origins)
        try:
            self._link = _Link(self._server)
        except BaseException:
            self._server.close()
            raise
        self.url = f"{url.format(port=self._server.port)}?token={self._server.token}&session={self._link.session}"
        """Where the page is. Whoever knows it may look."""
        self._finalizer = weakref.finalize(self, _end, self._link, self._server)

    @property
    def scene(self) -> Scene:
        """The scene as it is now: a copy, whose picture is the page's, to the byte. Setting it shows another one."""
        shown = Scene.from_dict({key: value for key, value in self._link.scene().items() if key != "version"})
        object.__setattr__(shown, "_shown", self._volume)
        object.__setattr__(shown, "_folder", self._root)
        return shown

    @scene.setter
    def scene(self, scene: Scene) -> None:
        shown = {**scene.to_dict(), "version": 1}
        time_step = shown.pop("volume", {}).get("time_step", 0)
        if _names_files(shown) and os.path.abspath(scene._folder or ".") != self._root:
            raise ValueError(f"files that the scene names have to be named as seen from {self._root}")
        volume = {**self._link.scene()["volume"], "time_step": time_step}
        self._link.ask({"type": "load", "scene": {**shown, "volume": volume}})

    @property
    def camera(self) -> Camera:
        """The camera as it is now: a copy. Setting it moves the page's; keys that are not set stay as they are."""
        return Camera.from_dict(self._link.scene()["camera"])

    @camera.setter
    def camera(self, camera: Camera | dict[str, Any]) -> None:
        given = Camera.from_dict(camera) if isinstance(camera, dict) else camera
        self._link.ask({"type": "camera", "camera": given.to_dict()})

    @property
    def picked(self) -> dict[str, Any] | None:
        """What was picked last: see Volume.pick. None before the first."""
        return self._link.picked

    def on_pick(self, function: Callable[[dict[str, Any]], Any]) -> Callable[[dict[str, Any]], Any]:
        """Calls it with what is picked from now on. Can be used as a decorator; returns the function.

        Functions are called one after the other in a thread of the view. What they raise goes to the logger `elvis`.
        """
        self._link.on_pick.append(function)
        return function

    def on_camera(self, function: Callable[[Camera], Any]) -> Callable[[Camera], Any]:
        """Calls it with the camera after it has moved; if that takes long, with the newest of several. As on_pick."""
        self._link.on_camera.append(function)
        return function

    @property
    def is_open(self) -> bool:
        """Whether the server is there."""
        return self._link.is_open

    def close(self) -> None:
        """Ends the server. The page then shows its last picture."""
        self._finalizer()

    def __enter__(self) -> View:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _repr_html_(self) -> str:
        width, height = (escape(str(size)) for size in self._size)
        return (f'<iframe src="{escape(self.url)}" width="{width}" height="{height}" title="{escape(os.path.basename(self._volume.path))}" '
                'style="border: 0" allow="clipboard-write; fullscreen"></iframe>')

    def __repr__(self) -> str:
        return f"<View {self.url}{'' if self.is_open else '; closed'}>"


def show(volume: Volume, scene: Scene, **options: Any) -> View:
    """A view; outside of notebooks it says where its page is."""
    if not volume.is_file:
        raise ValueError(f"{volume.path}: pages show volumes of files, not of arrays or displaced by Volume.warp; scenes have 'warp'")
    view = View(volume, scene, **options)
    if not _is_notebook():
        print(view.url)
    return view


class _Link:
    """A companion of the page's session: what it knows of the scene, and who wants to hear of it."""

    def __init__(self, server: Server) -> None:
        self._socket = WebSocket(server.port, f"/session?token={server.token}&session=&companion=1")
        self._lock = threading.Lock()
        self._waiting: dict[int, queue.SimpleQueue] = {}
        self._number = 0
        self._events: queue.SimpleQueue = queue.SimpleQueue()
        self._camera_is_new = False
        self.picked: dict[str, Any] | None = None
        self.on_pick: list[Callable[[dict[str, Any]], Any]] = []
        self.on_camera: list[Callable[[Camera], Any]] = []
        self.is_open = True
        self.session = self._socket.receive()["session"]
        self._scene = self._socket.receive()["scene"]
        for work in (self._receive, self._dispatch):
            threading.Thread(target=work, name="elvis view", daemon=True).start()

    def scene(self) -> dict[str, Any]:
        """A copy of the scene as JSON has it."""
        with self._lock:
            return json.loads(json.dumps(self._scene))

    def ask(self, message: dict[str, Any]) -> dict[str, Any]:
        """Waits for the answer; raises Error if there is something wrong with the message, or the server is gone."""
        answer: queue.SimpleQueue = queue.SimpleQueue()
        with self._lock:
            self._number += 1
            number = self._number
            self._waiting[number] = answer
            is_open = self.is_open
        try:
            if not is_open:
                raise OSError("the view is closed")
            self._socket.send({**message, "id": number})
            told = answer.get(timeout=_PATIENCE)
        except (OSError, queue.Empty) as error:
            raise _elvis.Error(f"the server of the view does not answer: {error or 'it is busy'}") from None
        finally:
            with self._lock:
                self._waiting.pop(number, None)
        if told["type"] == "error":
            raise _elvis.Error(told["text"])
        return told

    def close(self) -> None:
        self._socket.close()

    def _receive(self) -> None:
        try:
            while True:
                self._take(self._socket.receive())
        except (EOFError, OSError, ValueError):
            pass
        with self._lock:
            self.is_open = False
            waiting = list(self._waiting.values())
        for answer in waiting:
            answer.put({"type": "error", "text": "the server of the view has ended"})
        self._events.put(None)

    def _take(self, message: dict[str, Any]) -> None:
        kind = message["type"]
        with self._lock:
            answer = self._waiting.get(message.get("id") or 0)
            if kind == "state" or kind == "camera":
                before = self._scene.get("camera")
                self._scene = message["scene"] if kind == "state" else {**self._scene, "camera": message["camera"]}
                if self._scene.get("camera") != before and not self._camera_is_new:
                    self._camera_is_new = True
                    self._events.put("camera")
            elif kind == "picked":
                self.picked = message["picked"]
                self._events.put(message["picked"])
        if answer is not None:
            answer.put(message)

    def _dispatch(self) -> None:
        while (event := self._events.get()) is not None:
            if event == "camera":
                with self._lock:
                    self._camera_is_new = False
                    what = dict(self._scene["camera"])
                _call(self.on_camera, lambda: Camera.from_dict(what))
            else:
                _call(self.on_pick, lambda: event)


def _call(functions: list[Callable[[Any], Any]], what: Callable[[], Any]) -> None:
    for function in list(functions):
        try:
            function(what())
        except Exception:  # noqa: BLE001: it is the caller's, and must not end the thread.
            _log.exception("a function of a view has failed")


def _end(link: _Link, server: Server) -> None:
    link.close()
    server.close()


def _completed(volume: Volume, scene: Scene) -> Scene:
    """With surfaces if it shows none. The page chooses the camera if the scene does not: it knows its own size."""
    complete = volume.complete(scene)
    if not scene.camera.to_dict():
        complete.camera = None
    return complete


def _names_files(part: Any) -> bool:
    if isinstance(part, dict):
        return any((key in ("path", "file", "transfer", "font") and isinstance(value, str)) or _names_files(value) for key, value in part.items())
    return isinstance(part, list) and any(_names_files(item) for item in part)
