"""Pixels that are uncertain, and why: they are counted, flagged, and can be shown."""

import sys
from pathlib import Path

import numpy as np

import elvis

data, out = map(Path, sys.argv[1:])
elvis.convert(data / "elvis/raySincBox_F4_P4.dat", out / "sinc.h5")
sinc = elvis.open(out / "sinc.h5")
field = next(iter(sinc.fields))
# Near an extremum an isosurface may be there or not, by a rounding of the value.
scene = sinc.scene(isosurfaces=[sinc.range(field).maximum * (1 - 1e-7), 0.25 * sinc.range(field).maximum])
scene.surfaces[0].opacity = 0.5
picture = scene.render(240, 180)
print(*picture.warnings, sep="\n")

for flag in elvis.Flag:
    if n_pixels := np.count_nonzero(picture.flags & flag):
        print(f"{n_pixels} pixels: {flag.name.lower().replace('_', ' ')}")

# The same picture with doubtful pixels in red.
shown = picture.color.copy()
shown[(picture.flags & elvis.Flag.DOUBTS) != 0] = [255, 0, 0, 255]
picture.save(out / "doubt.png")
try:
    import matplotlib.image
except ImportError:
    sys.exit()
matplotlib.image.imsave(out / "doubt_shown.png", shown)
