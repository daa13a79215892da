"""Progress bars: in a terminal on one line of stderr, in a notebook below the cell."""

import sys
import time
from collections.abc import Callable
from types import TracebackType

#: What a call is told of: a function of fraction and activity, True for a bar, False for nothing.
Progress = Callable[[float, str], None] | bool

#: Seconds after which a call is long enough to be shown.
_PATIENCE = 1.0
_WIDTH = 30


def _is_notebook() -> bool:
    shell = sys.modules.get("IPython")
    current = shell.get_ipython() if shell is not None else None
    return current is not None and hasattr(current, "kernel")


class _Bar:
    """Shows how far a call has come, once it takes long."""

    def __init__(self) -> None:
        self._start = time.monotonic()
        self._is_shown = False
        self._is_notebook = _is_notebook()
        self._display = None

    def __enter__(self) -> Callable[[float, str], None] | None:
        return self._show if self._is_notebook or sys.stderr.isatty() else None

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None) -> None:
        if self._display is not None:
            self._display.update({"text/plain": ""}, raw=True)
        elif self._is_shown:
            sys.stderr.write("\r\033[K")
            sys.stderr.flush()

    def _show(self, fraction: float, activity: str) -> None:
        if time.monotonic() - self._start < _PATIENCE:
            return
        done = round(_WIDTH * max(0.0, min(1.0, fraction)))
        bar = f"[{'#' * done}{'.' * (_WIDTH - done)}] {activity}" if fraction >= 0 else activity
        self._is_shown = True
        if self._is_notebook:
            from IPython.display import display

            if self._display is None:
                self._display = display({"text/plain": bar}, raw=True, display_id=True)
            else:
                self._display.update({"text/plain": bar}, raw=True)
        else:
            sys.stderr.write(f"\r\033[K{bar}")
            sys.stderr.flush()


class _Given:
    """The caller's own function, or none."""

    def __init__(self, function: Callable[[float, str], None] | None) -> None:
        self._function = function

    def __enter__(self) -> Callable[[float, str], None] | None:
        return self._function

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None) -> None:
        pass


def progress_for(wanted: Callable[[float, str], None] | bool | None) -> _Bar | _Given:
    """A context whose value is what a long call of the library is to report to, or None."""
    if wanted is True:
        return _Bar()
    return _Given(wanted if callable(wanted) else None)
