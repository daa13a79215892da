"""Two solutions of one problem, pixel by pixel: order 2 against order 6."""

import json
import sys
from pathlib import Path

import numpy as np

import elvis

_, out = map(Path, sys.argv[1:])
volumes = {}
for order in (2, 6):
    # The same mesh; the generator plugin interpolates the same function.
    text = {"generator": 1, "mesh": "ball", "elements": [3, 3, 3], "geometry_order": 2, "order": order, "field": "waves"}
    (out / f"waves{order}.json").write_text(json.dumps(text))
    elvis.convert(out / f"waves{order}.json", out / f"waves{order}.h5")
    volumes[order] = elvis.open(out / f"waves{order}.h5")

scene = elvis.Scene(surfaces=[elvis.Surface(type="plane", plane=[0, 0.2, 1, 0])], precision="float64")
scene.camera.type, scene.camera.eye, scene.camera.height = "orthographic", [0, 0, 4], 2.1
coarse, fine = (volumes[order].render(scene, 240, 240) for order in (2, 6))
difference = coarse.value - fine.value
print(f"largest difference {np.nanmax(np.abs(difference)):.3g}, root of the mean square {np.sqrt(np.nanmean(difference**2)):.3g}")
worst = np.unravel_index(np.nanargmax(np.abs(difference)), difference.shape)
print(f"it is largest in element {fine.element[worst]}")

try:
    import matplotlib
except ImportError:
    sys.exit()
matplotlib.use("Agg")
import matplotlib.pyplot as plt

figure, (left, middle, right) = plt.subplots(1, 3, figsize=(14, 4))
coarse.plot(left).set_title("order 2")
fine.plot(middle).set_title("order 6")
shown = right.imshow(difference, cmap="RdBu")
right.set_title("difference")
right.set_axis_off()
figure.colorbar(shown, ax=right)
figure.savefig(out / "compare.png", dpi=100)
