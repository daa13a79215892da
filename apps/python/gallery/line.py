"""The gradient of a solution along a line: it jumps from element to element, and the plot shows that."""

import sys
from pathlib import Path

import numpy as np

import elvis

data, out = map(Path, sys.argv[1:])
mesh, solution = (data / "mfem/dg-fichera-q3-p4" / name for name in ("mesh.mesh", "sol.gf"))
report = elvis.convert([mesh, solution], out / "dg.h5")
dg = elvis.open(out / "dg.h5")
field = "norm(grad(sol))"
print(f"largest jump of 'sol' across faces: {report['fields'][0]['max_jump']:.3g}")

lower, upper = dg.bounds
start, end = lower + 0.02 * (upper - lower), upper - [0.02, 0.3, 0.6] * (upper - lower)
along = np.linspace(0, 1, 2001)
samples = dg.probe(start + along[:, None] * (end - start), field)
values, elements = samples[field], samples.element
borders = np.flatnonzero(np.diff(elements) != 0)
jumps = np.abs(values[borders + 1] - values[borders])
print(f"the line meets {len(set(elements[samples.is_inside]))} elements; the largest step between neighbours is {np.nanmax(jumps):.3g}")
np.savetxt(out / "line.txt", np.column_stack([along, elements, values]), header="part of the line, element, value")

try:
    import matplotlib
except ImportError:
    sys.exit()
matplotlib.use("Agg")
import matplotlib.pyplot as plt

# A gap where the element changes: a jump is drawn as one.
broken = values.copy()
broken[borders + 1] = np.nan
plt.plot(along, broken)
plt.xlabel("part of the line")
plt.ylabel(field)
plt.savefig(out / "line.png", dpi=100)
