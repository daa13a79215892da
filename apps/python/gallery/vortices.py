"""Expressions: vorticity and the Q criterion of the Taylor-Green vortex, in values and as surfaces."""

import json
import sys
from pathlib import Path

import numpy as np

import elvis

_, out = map(Path, sys.argv[1:])
text = {"generator": 1, "mesh": "box", "box": [[0, 0, 0], [3.2, 3.2, 3.2]], "elements": [3, 3, 3], "order": 7, "field": "taylor-green"}
(out / "vortices.json").write_text(json.dumps(text))
elvis.convert(out / "vortices.json", out / "vortices.h5")
flow = elvis.open(out / "vortices.h5")

points = np.random.default_rng(1).uniform(0.1, 3.1, (500, 3))
samples = flow.probe(points, ["velocity", "norm(curl(velocity))", "q_criterion(velocity)"])
x, y, z = points.T
curl = np.array([-np.cos(x) * np.sin(y) * np.sin(z), -np.sin(x) * np.cos(y) * np.sin(z), 2 * np.sin(x) * np.sin(y) * np.cos(z)])
error = np.abs(samples["norm(curl(velocity))"] - np.linalg.norm(curl, axis=0))
print(f"vorticity: largest error {error.max():.1e} against the exact field, whose order is not finite")

scene = flow.scene(isosurfaces={"q_criterion(velocity)": [0.3]})
scene.surfaces[0].color_field = "norm(curl(velocity))"
scene.lighting = "default"
picture = scene.render(320, 240)
picture.save(out / "vortices.png")
print(*picture.remarks, sep="\n")
