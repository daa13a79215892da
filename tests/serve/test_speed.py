"""How many moving pictures a page receives: the canister's boundary, cut open, with a cut plane."""
import json
import os
import pathlib
import tempfile
import threading
import time
import unittest

from serving import Server
from test_serve import run

DATA = pathlib.Path(__file__).resolve().parents[1] / "data/elvis/bulletH1P2.dat"
SIZE = [480, 270]
SECONDS = 2
WANTED = 15


class SpeedTest(unittest.TestCase):
    def test_fifteen_moving_pictures_a_second_arrive(self):
        """The best of some tries: other programs may want the processors, too."""
        with tempfile.TemporaryDirectory(prefix="elvis-speed-test-") as folder:
            run("convert", str(DATA), "-o", os.path.join(folder, "canister.h5"))
            path = os.path.join(folder, "scene.json")
            with open(path, "w") as file:
                json.dump({"version": 1, "volume": {"path": "canister.h5"},
                           "surfaces": [{"type": "boundary", "clip": [[0, -1, 0, 0]]}, {"type": "plane", "plane": [0, 1, 0, 0]}]}, file)
            server = Server(path)
            try:
                page = server.page(size=SIZE)
                page.exact()
                best = 0
                for _ in range(4):
                    best = max(best, self.rate(page))
                    if best >= WANTED:
                        break
                page.close()
            finally:
                self.assertEqual(server.stop(), 0)
        self.assertGreaterEqual(best, WANTED)

    def rate(self, page):
        """Pictures a second while the camera turns, told of sixty times a second as a hand does."""
        end = time.monotonic() + SECONDS

        def turn():
            while time.monotonic() < end:
                page.tell(type="orbit", dx=3, dy=1, time=1000 * time.monotonic())
                time.sleep(1 / 60)

        page.confirms = False  # One thread speaks at a time.
        page.frames.clear()
        late = []
        hand = threading.Thread(target=turn)
        hand.start()
        while time.monotonic() < end:
            message = page.receive()
            if message["type"] == "frame":
                page.socket.send({"type": "shown", "frame": message["frame"]})
                late.append(1000 * time.monotonic() - (message["echo"] or 0))
        hand.join()
        moving = [frame for frame in page.frames if frame["divisor"] < 24]
        sizes = sorted(SIZE[0] // frame["divisor"] for frame in moving)
        print(f"\n{len(moving) / SECONDS:.0f} pictures a second, {sorted(late)[len(late) // 2]:.0f} ms after the hand, of {sizes[len(sizes) // 2]} pixels across; "
              f"load {os.getloadavg()[0]:.1f}")
        return len(moving) / SECONDS


if __name__ == "__main__":
    unittest.main()
