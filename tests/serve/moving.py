"""Moving pictures as a page receives them: of the canister's boundary, cut open, with a cut plane, while a hand turns it."""
import json
import os
import pathlib
import statistics
import threading
import time

from serving import Server
from test_serve import run

DATA = pathlib.Path(__file__).resolve().parents[1] / "data/elvis/bulletH1P2.dat"
SIZE = [480, 270]


def canister(folder):
    """A server of that scene."""
    run("convert", str(DATA), "-o", os.path.join(folder, "canister.h5"))
    path = os.path.join(folder, "scene.json")
    with open(path, "w") as file:
        json.dump({"version": 1, "volume": {"path": "canister.h5"},
                   "surfaces": [{"type": "boundary", "clip": [[0, -1, 0, 0]]}, {"type": "plane", "plane": [0, 1, 0, 0]}]}, file)
    return Server(path)


class Turn:
    """The camera turns for so long, and the page is told of it sixty times a second, as a hand does."""

    def __init__(self, page, seconds):
        self.page = page
        self.seconds = seconds
        self.frames = []
        self.late = []
        end = time.monotonic() + seconds
        page.confirms = False  # One thread speaks at a time.
        hand = threading.Thread(target=self.turn, args=(end,))
        hand.start()
        while time.monotonic() < end or not self.frames:
            self.receive()
        hand.join()
        page.confirms = True

    def turn(self, end):
        while time.monotonic() < end:
            self.page.tell(type="orbit", dx=3, dy=1, time=1000 * time.monotonic())
            time.sleep(1 / 60)

    def receive(self):
        message = self.page.receive()
        if message["type"] == "frame":
            self.page.socket.send({"type": "shown", "frame": message["frame"]})
            self.frames.append(message)
            self.late.append(1000 * time.monotonic() - (message["echo"] or 0))

    def __str__(self):
        across = [SIZE[0] // (frame["divisor"] * frame["shrink"]) for frame in self.frames]
        large = sum(width == SIZE[0] for width in across) / len(across)
        return (f"{len(self.frames) / self.seconds:.1f} pictures a second, {statistics.median(self.late):.0f} ms after the hand, {statistics.median(across):.0f} pixels across, "
                f"{100 * large:.0f} % of them {SIZE[0]}; load {os.getloadavg()[0]:.1f}")
