"""Moving pictures: that they come, small ones, of the newest camera. How many a second depends on the machine: measure_moving.py."""
import tempfile
import unittest

from moving import SIZE, Turn, canister


class MovingTest(unittest.TestCase):
    def test_moving_pictures_come_then_all_pixels(self):
        with tempfile.TemporaryDirectory(prefix="elvis-moving-test-") as folder:
            server = canister(folder)
            self.addCleanup(lambda: self.assertEqual(server.stop(), 0))
            page = server.page(size=SIZE)
            page.exact()
            turn = Turn(page, 1)
            print(f"\n{turn}")
            moving = [frame for frame in turn.frames if frame["divisor"] > 1]
            for frame in turn.frames:
                self.assertEqual((frame["size"], frame["mime"]), (SIZE, "image/jpeg"))
                self.assertEqual(frame["stage"], "moving" if frame in moving else "full")
                self.assertEqual(frame["image"], [-(-side // frame["shrink"]) for side in SIZE])
            # None is older than one before.
            told = [frame["echo"] for frame in turn.frames if frame["echo"]]
            self.assertEqual(told, sorted(told))
            last = page.ask(type="save scene")["scene"]["camera"]
            exact = page.wait(lambda m: m["type"] == "frame" and m["stage"] == "exact")
            self.assertEqual([exact["camera"][key] for key in ("eye", "look_at", "up")], [last[key] for key in ("eye", "look_at", "up")])
            page.close()


if __name__ == "__main__":
    unittest.main()
