"""The plugin for ParaView, as pvbatch loads it. Variables of the environment name program, plugin and folders."""

import json
import os
import shutil
import subprocess
import tempfile
import unittest

import matplotlib.image
import numpy

PROGRAM = os.environ["ELVIS_PROGRAM"]
PLUGIN = os.environ["ELVIS_PARAVIEW_PLUGIN"]
VIEWS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "views.py")
DATA = os.path.join(os.path.dirname(VIEWS), "..", "data")
BACKGROUND = numpy.array([0.2, 0.4, 0.6])


def tell(*command, env=None):
    return subprocess.run(command, capture_output=True, text=True, timeout=200, env=env)


@unittest.skipUnless(shutil.which("pvbatch") and shutil.which("xvfb-run"), "pvbatch or xvfb-run is not installed")
class ParaView(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.volume = os.path.join(cls.folder.name, "ball.h5")
        description = os.path.join(cls.folder.name, "ball.json")
        with open(description, "w") as file:
            json.dump({"generator": 1, "mesh": "ball", "shape": "hexahedron", "elements": [2, 2, 2], "geometry_order": 2,
                       "order": 3, "field": "waves"}, file)
        done = tell(PROGRAM, "convert", description, "-o", cls.volume)
        assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def draw(self, what, volume=None, ranks=1):
        """The output's path, and what pvbatch says."""
        output = os.path.join(self.folder.name, f"{what}_{ranks}.png")
        several = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        # A server of X that is reset when its first client leaves refuses the next one.
        done = tell("xvfb-run", "-a", "-s", "-screen 0 640x480x24 -noreset", *several, "pvbatch", "--force-offscreen-rendering",
                    VIEWS, PLUGIN, what, volume or self.volume, output, env={**os.environ, "LP_NUM_THREADS": "1"})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return output, done.stdout + done.stderr

    def scene(self, path):
        with open(path + ".json") as file:
            return json.load(file)

    def compare(self, path, tolerance=0.6 / 255):
        """Pixels that differ from what `elvis render` makes of the scene."""
        own = path + ".own.png"
        done = tell(PROGRAM, "render", path + ".json", "-o", own)
        self.assertEqual(done.returncode, 0, done.stderr)
        expected, shown = matplotlib.image.imread(own), matplotlib.image.imread(path)[..., :3]
        alpha = expected[..., 3:]
        expected = alpha * expected[..., :3] + (1 - alpha) * BACKGROUND
        self.assertGreater(numpy.count_nonzero(alpha), 5000)
        return numpy.count_nonzero(numpy.abs(shown - expected).max(axis=2) > tolerance)

    def test_pixels_are_those_of_elvis_on_one_and_on_three_ranks(self):
        pictures = []
        for ranks in (1, 3):
            path, said = self.draw("surfaces", ranks=ranks)
            with open(path, "rb") as file:
                pictures.append(file.read())
        self.assertEqual(self.compare(path), 0)
        self.assertEqual(pictures[0], pictures[1])
        scene = self.scene(path)
        self.assertEqual(len(scene["surfaces"]), 4)
        # The map and its range are ParaView's.
        values = [float(word) for word in next(line for line in said.splitlines() if line.startswith("range")).split()[1:]]
        numpy.testing.assert_allclose(scene["color_map"]["range"], values, rtol=1e-14)

    def test_orthographic_views_in_one_color_and_double_precision(self):
        path, _ = self.draw("one_color")
        self.assertEqual(self.compare(path), 0)

    def test_light_of_the_volume_is_in_front_of_its_own_and_other_surfaces(self):
        path, said = self.draw("light")
        # One step of eight bits, since the surface behind has been rounded to them.
        self.assertEqual(self.compare(path, 1.6 / 255), 0)
        self.assertIn("volume_rendering", self.scene(path))
        path, _ = self.draw("light_and_plane")
        own, other = (matplotlib.image.imread(name)[..., :3] for name in (path, path + ".plane.png"))
        # In the middle, where both planes are.
        middle = slice(65, 85), slice(90, 110)
        self.assertGreater(own[middle][..., 1].min(), 0.3)
        self.assertLess(numpy.abs(own[middle] - other[middle]).max(), 2.1 / 255)

    def test_several_ranks_say_that_they_leave_light_out(self):
        _, said = self.draw("light", ranks=2)
        self.assertIn("is left out on several ranks", said)

    def test_depths_are_those_of_other_things(self):
        """The green plane is in front of the red one where x is positive."""
        path, _ = self.draw("behind")
        shown = matplotlib.image.imread(path)[..., :3]
        red, green = shown[..., 0] > 0.9, shown[..., 1] > 0.9
        row = 75
        columns = numpy.arange(200)
        self.assertTrue(red[row][columns[(columns > 80) & (columns < 99)]].all())
        self.assertTrue(green[row][columns[(columns > 101) & (columns < 120)]].all())

    def test_time_steps_are_those_of_the_view(self):
        path, said = self.draw("steps", os.path.join(DATA, "vtkhdf", "lagrange_steps.vtkhdf"))
        self.assertIn("times 0.0 0.5 1.0", said)
        self.assertEqual(self.scene(path)["volume"]["time_step"], 2)

    def test_foreign_data_sets_of_several_files(self):
        folder = os.path.join(DATA, "mfem", "poisson-fichera-mixed-p2-p3")
        _, said = self.draw("several_files", os.path.join(folder, "mesh.mesh") + "," + os.path.join(folder, "sol.gf"))
        self.assertIn("fields sol", said)

    def test_errors_name_the_cause(self):
        self.assertIn("draws what the reader of ElVis gives", self.draw("other_data")[1])
        missing = os.path.join(self.folder.name, "missing.h5")
        done = tell("xvfb-run", "-a", "-s", "-screen 0 640x480x24 -noreset", "pvbatch", "--force-offscreen-rendering", VIEWS,
                    PLUGIN, "surfaces", missing, missing + ".png")
        self.assertIn("missing.h5: ", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
