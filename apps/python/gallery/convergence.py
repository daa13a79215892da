"""How the area of an isosurface converges with the order of the field.

The surface is the sphere of radius 0.5 of the field "distance", seen from far: each pixel of a parallel projection sees a piece
of the area (pixel's area) / |cosine between normal and view|. Near the silhouette that is inaccurate, so that only pixels with a
cosine above 0.5 count: the cap up to 60 degrees, whose area is pi r^2.
"""

import json
import sys
from pathlib import Path

import numpy as np

import elvis

_, out = map(Path, sys.argv[1:])
radius, height, n = 0.5, 1.2, 300
exact = np.pi * radius**2
orders, errors = [1, 2, 4, 6], []
for order in orders:
    text = {"generator": 1, "mesh": "shell", "elements": [3, 3, 3], "inner_radius": 0.3, "geometry_order": 3, "order": order,
            "field": "distance"}
    (out / "shell.json").write_text(json.dumps(text))
    elvis.convert(out / "shell.json", out / "shell.h5")
    volume = elvis.open(out / "shell.h5")
    scene = volume.scene(isosurfaces=[radius])
    scene.camera.type = "orthographic"
    scene.camera.eye, scene.camera.look_at, scene.camera.up, scene.camera.height = [0, 0, 5], [0, 0, 0], [0, 1, 0], height
    picture = scene.render(n, n)
    cosine = picture.normal[..., 2]
    counted = cosine > 0.5
    area = (height / n) ** 2 * np.sum(1 / cosine[counted])
    errors.append(abs(area / exact - 1))
    print(f"order {order}: area {area:.6f}, relative error {errors[-1]:.2e}")
print(f"exact: {exact:.6f}; a pixel's worth is {(height / n) ** 2 / exact:.1e}")
