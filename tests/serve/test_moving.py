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
            # A hand that the machine holds up for a while rests: then there are exact ones, too.
            self.assertIn(turn.frames[0]["stage"], ("moving", "full"))
            for frame in turn.frames:
                is_exact = frame["stage"] == "exact"
                self.assertEqual((frame["size"], frame["mime"]), (SIZE, "image/png" if is_exact else "image/jpeg"))
                self.assertEqual(frame["stage"] == "moving", frame["divisor"] > 1)
                self.assertEqual(frame["image"], SIZE if is_exact else [-(-side // frame["shrink"]) for side in SIZE])
            # None is older than one before.
            told = [frame["echo"] for frame in turn.frames if frame["echo"]]
            self.assertEqual(told, sorted(told))
            eye = page.ask(type="save scene")["scene"]["camera"]["eye"]
            while page.frames[-1]["stage"] != "exact" or page.frames[-1]["camera"]["eye"] != eye:
                page.receive()
            page.close()


if __name__ == "__main__":
    unittest.main()
