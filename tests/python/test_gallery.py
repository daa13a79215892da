"""The gallery's programs run, and say what is true."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2]


class Gallery(unittest.TestCase):
    def run_program(self, name: str, *pictures: str) -> str:
        with tempfile.TemporaryDirectory(prefix="elvis-gallery-") as folder:
            done = subprocess.run([sys.executable, SOURCES / f"apps/python/gallery/{name}.py", SOURCES / "tests/data", folder],
                                  capture_output=True, text=True, timeout=280, env={**os.environ, "MPLCONFIGDIR": folder})
            self.assertEqual(done.returncode, 0, done.stderr)
            for picture in pictures:
                self.assertGreater((Path(folder) / picture).stat().st_size, 1000, picture)
        return done.stdout

    def test_first_picture(self):
        self.assertIn("density lies in [-1.248, 1.436], which is proven", self.run_program("first_picture", "first_picture.png"))

    def test_compare(self):
        said = self.run_program("compare")
        self.assertAlmostEqual(float(re.search(r"largest difference ([\d.e-]+)", said)[1]), 0.065, delta=0.002)

    def test_convergence(self):
        errors = [float(error) for error in re.findall(r"relative error ([\d.e+-]+)", self.run_program("convergence"))]
        self.assertEqual(len(errors), 4)
        self.assertLess(max(errors[2:]), 2e-4)  # What the pixels allow.
        self.assertGreater(min(errors[:2]), 5e-4)

    def test_film(self):
        self.assertIn("time 5", self.run_program("film", *(f"film/frame_{step:04}.png" for step in range(6))))

    def test_solver(self):
        said = self.run_program("solver", *(f"solver_{step}.png" for step in range(5)))
        self.assertEqual({round(float(heat), 9) for heat in re.findall(r"heat ([\d.]+)", said)}, {1.0})
        tops = [float(top) for top in re.findall(r"T up to ([\d.]+)", said)]
        self.assertEqual(tops, sorted(tops, reverse=True))

    def test_line(self):
        self.assertRegex(self.run_program("line"), r"the line meets [2-9] elements")

    def test_vortices(self):
        error = float(re.search(r"largest error ([\d.e+-]+)", self.run_program("vortices", "vortices.png"))[1])
        self.assertLess(error, 1e-6)

    def test_doubt(self):
        self.assertRegex(self.run_program("doubt", "doubt.png"), r"[1-9]\d* pixels: isosurface undecided\n")


if __name__ == "__main__":
    unittest.main()
