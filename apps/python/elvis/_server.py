"""`elvis serve` as a child of this process."""

import logging
import os
import re
import shutil
import subprocess
import threading
from collections.abc import Sequence

from . import _elvis
from ._library import settings

_log = logging.getLogger("elvis")


def program() -> str:
    """The launcher: $ELVIS_PROGRAM, or that of the installation that the package is part of, or the first on the path."""
    given = os.environ.get("ELVIS_PROGRAM")
    if given:
        return given
    folder = os.path.dirname(os.path.abspath(__file__))
    while folder != os.path.dirname(folder):
        folder = os.path.dirname(folder)
        near = os.path.join(folder, "bin", "elvis")
        if os.access(near, os.X_OK):
            return near
    found = shutil.which("elvis")
    if found is None:
        raise FileNotFoundError("the program elvis was not found: set $ELVIS_PROGRAM to its path")
    return found


class Server:
    """A server of pages on this machine. It ends with this process at the latest."""

    def __init__(self, scene: str, root: str, origins: Sequence[str]) -> None:
        """scene: its file. root: the folder of files that the page may name. origins: where else pages may come from."""
        chosen = settings()
        command = [program(), "serve", scene, "--root", root, "--port", "0", "--until-input-ends"]
        for origin in origins:
            command += ["--origin", origin]
        if chosen["device"]:
            command += ["--device", chosen["device"]]
        environment = dict(os.environ)
        for name, key in (("ELVIS_PLUGIN_PATH", "plugin_path"), ("ELVIS_CACHE_PATH", "cache_folder")):
            if chosen[key] is not None:
                environment[name] = chosen[key]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                         env=environment, text=True)
        self._said: list[str] = []
        self._reader = threading.Thread(target=self._listen, name="elvis serve", daemon=True)
        self._reader.start()
        try:
            url = self._process.stdout.readline().strip()
        except BaseException:  # Ctrl-C while a large volume is loaded, too.
            self.close()
            raise
        address = re.fullmatch(r"http://[^/:]+:(\d+)/\?token=([0-9a-f]+)", url)
        if address is None:
            self.close()
            raise _elvis.Error("".join(self._said).strip() or "elvis serve has ended without a word")
        self.port = int(address[1])
        """Of 127.0.0.1."""
        self.token = address[2]
        """What the page needs to be let in."""

    def _listen(self) -> None:
        for line in self._process.stderr:
            self._said = [*self._said[-20:], line]
            _log.info("elvis serve: %s", line.rstrip())

    def close(self) -> None:
        """Ends it, and waits until it has ended."""
        if self._process.stdin is not None and not self._process.stdin.closed:
            self._process.stdin.close()
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._reader.join(5)
        self._process.stdout.close()
        self._process.stderr.close()
