"""The library's context: one for the process, made when it is first needed."""

import json
import os
from collections.abc import Callable, Sequence
from typing import Any, Literal

from . import _elvis
from ._progress import progress_for

_context: _elvis.Context | None = None
_settings: dict[str, Any] = {"device": "", "plugin_path": None, "cache_folder": None}


def set_up(device: str | int = "", plugin_path: Sequence[str | os.PathLike] | None = None,
           cache_folder: str | os.PathLike | None = None) -> None:
    """Chooses what volumes that are opened from now on work with.

    device: index, or part of the name, of a Vulkan device; "" is $ELVIS_DEVICE, else the best.
    plugin_path: folders of plugins; None is $ELVIS_PLUGIN_PATH and those of the installation.
    cache_folder: where compiled kernels and converted volumes are kept; "" is nowhere, None $ELVIS_CACHE_PATH, else ~/.cache/elvis.
    """
    global _context
    _settings["device"] = str(device)
    _settings["plugin_path"] = None if plugin_path is None else ":".join(os.fspath(folder) for folder in plugin_path)
    _settings["cache_folder"] = None if cache_folder is None else os.fspath(cache_folder)
    _context = None


def context() -> _elvis.Context:
    """The context that everything works with; what it does is told in elvis.h."""
    global _context
    if _context is None:
        _context = _elvis.Context(**_settings)
    return _context


def settings() -> dict[str, Any]:
    """What set_up has chosen: device, plugin_path, cache_folder."""
    return dict(_settings)


def devices() -> list[dict[str, Any]]:
    """This machine's Vulkan devices: index, name, type, driver, memory_bytes, float64, unusable_because."""
    return json.loads(context().devices())


def plugins() -> dict[str, list[dict[str, Any]]]:
    """Plugins that were found, and those that were refused, with the reason."""
    return json.loads(context().plugins())


def convert(inputs: str | os.PathLike | Sequence[str | os.PathLike], output: str | os.PathLike, *, plugin: str = "",
            options: dict[str, Any] | None = None, fields: Sequence[str] = (), order: int | None = None,
            continuity: Literal["cg", "dg"] | None = None,
            progress: Callable[[float, str], None] | bool = True) -> dict[str, Any]:
    """Converts a foreign data set to a native volume and returns the report: how exact each field is.

    inputs: geometry first, then field files. output: the volume's file (.h5), which appears whole or not at all.
    order: of every field, 0 to 30; None is what contains the source. continuity: None is what the source says.
    progress: called with a fraction (negative if unknown) and an activity; True shows a bar, False nothing.
    """
    names = [inputs] if isinstance(inputs, (str, os.PathLike)) else list(inputs)
    with progress_for(progress) as report_progress:
        report = context().convert([os.fspath(name) for name in names], os.fspath(output), plugin,
                                   json.dumps(options) if options else "", list(fields), -1 if order is None else int(order),
                                   {None: 0, "cg": 1, "dg": 2}[continuity], report_progress)
    return json.loads(report)
