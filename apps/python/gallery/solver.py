"""A solver in Python that shows its field at each step: no file, and only the field goes to the device again.

The heat equation on a bent cube of spectral elements, by explicit steps. It is a toy: derivatives are those of the elements, and
values at shared points are averaged, as in a continuous Galerkin method with a lumped mass matrix.
"""

import sys
from pathlib import Path

import numpy as np

import elvis

_, out = map(Path, sys.argv[1:])
N, P = 4, 4  # Elements in each direction, and their order.
points = np.concatenate([[-1], np.sort(np.polynomial.legendre.Legendre.basis(P).deriv().roots().real), [1]])
powers = np.vander(points, increasing=True)
derivative = np.vander(points, increasing=True)[:, :-1] * np.arange(1, P + 1) @ np.linalg.inv(powers)[1:]
weights = 2 / (P * (P + 1) * np.polynomial.legendre.legval(points, [0] * P + [1]) ** 2)

# Positions of all points, (element, z, y, x, 3); elements count x fastest, too.
cells = np.stack(np.meshgrid(*[np.arange(N)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)[:, ::-1]
local = np.stack(np.meshgrid(points, points, points, indexing="ij"), axis=-1)[..., ::-1]
places = (cells[:, None, None, None] + (1 + local) / 2) / N
places[..., 1] += 0.08 * np.sin(np.pi * places[..., 0]) * (1 - places[..., 1]) * places[..., 1] * 4


def gradient_in_reference(u):
    """(element, z, y, x) to (element, z, y, x, direction)."""
    return np.stack([np.einsum("ai,ezyi->ezya", derivative, u), np.einsum("ai,ezix->ezax", derivative, u),
                     np.einsum("ai,eiyx->eayx", derivative, u)], axis=-1)


jacobian = np.stack([gradient_in_reference(places[..., axis]) for axis in range(3)], axis=-2)
inverse, volume_factor = np.linalg.inv(jacobian), np.linalg.det(jacobian)
mass = volume_factor * np.einsum("z,y,x->zyx", weights, weights, weights)
# Points of different elements that are one.
_, shared = np.unique(np.round(places.reshape(-1, 3), 9), axis=0, return_inverse=True)


def assembled(values):
    return np.bincount(shared, values.ravel())[shared].reshape(values.shape)


def heat_flow(u):
    """Minus the stiffness matrix times u, over the mass: the weak Laplacian."""
    flux = np.einsum("...dr,...d->...r", inverse, np.einsum("...dr,...r->...d", np.swapaxes(inverse, -1, -2), gradient_in_reference(u)))
    flux = flux * mass[..., None]
    weak = (np.einsum("ai,ezya->ezyi", derivative, flux[..., 0]) + np.einsum("ai,ezax->ezix", derivative, flux[..., 1]) +
            np.einsum("ai,eayx->eiyx", derivative, flux[..., 2]))
    return -assembled(weak) / assembled(mass)


def start(x):
    return np.exp(-30 * np.sum((x - [0.35, 0.5, 0.5]) ** 2, axis=-1))


u = start(places)
flat = places.reshape(len(places), -1, 3)
kind = elvis.Elements("hexahedron", elvis.Space(P, "gll_lagrange"), flat)
shown = elvis.from_arrays(kind, {"T": (elvis.Space(P, "gll_lagrange"), u.reshape(len(u), -1))}, continuity={"T": "continuous"})
scene = shown.scene(cut_planes=[[0, 0, 1, -0.5]], isosurfaces={"T": [0.15]})
scene.color_map.range = [0, 0.5]
scene.camera.eye, scene.camera.look_at, scene.camera.up = [0.5, -1.2, 2.2], [0.5, 0.45, 0.45], [0, 0, 1]
step, total = 2e-5, np.sum(mass * u)
for number in range(5):
    picture = scene.render(320, 240)
    picture.save(out / f"solver_{number}.png")
    print(f"t = {100 * number * step:.3f}: T up to {shown.range('T').maximum:.4f}, heat {np.sum(mass * u) / total:.12f}, "
          f"picture in {picture.stats['milliseconds']['render']:.0f} ms")
    for _ in range(100):
        u = u + step * heat_flow(u)
    shown.update_field("T", u.reshape(len(u), -1))
