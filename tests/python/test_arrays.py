"""Volumes from numpy's arrays."""

import unittest

import numpy as np

import elvis


def gauss_lobatto(order: int) -> np.ndarray:
    """Points of Gauss-Lobatto-Legendre quadrature."""
    inner = np.polynomial.legendre.Legendre.basis(order).deriv().roots()
    return np.concatenate([[-1], np.sort(inner.real), [1]])


def grid(n: int, order: int) -> np.ndarray:
    """Positions of n^3 hexahedra in [-1, 1]^3 at Gauss-Lobatto points, x fastest: (n^3, (order+1)^3, 3), bent."""
    points = gauss_lobatto(order)
    elements = []
    for k, j, i in np.ndindex(n, n, n):
        z, y, x = np.meshgrid(points, points, points, indexing="ij")
        x, y, z = (((1 + x) / 2 + i) * 2 / n - 1, ((1 + y) / 2 + j) * 2 / n - 1, ((1 + z) / 2 + k) * 2 / n - 1)
        elements.append(np.stack([x, y + 0.1 * x * x, z], axis=-1).reshape(-1, 3))
    return np.array(elements)


class Arrays(unittest.TestCase):
    def volume(self, function):
        geometry = grid(3, 2)
        kind = elvis.Elements("hexahedron", elvis.Space(2, "gll_lagrange"), geometry)
        fields = grid(3, 4)  # The places of the fields' own points, on the same mapping.
        self.places = fields
        return elvis.from_arrays(kind, {"p": (elvis.Space(4, "gll_lagrange"), function(*np.moveaxis(fields, -1, 0)))},
                                 continuity={"p": "continuous"}, units={"p": "Pa"})

    def test_values_are_those_of_the_function(self):
        volume = self.volume(lambda x, y, z: x * y + z)
        points = np.random.default_rng(3).uniform(-0.7, 0.7, (50, 3))
        x, y, z = points.T
        np.testing.assert_allclose(volume.probe(points)["p"], x * y + z, atol=1e-12)
        self.assertEqual(volume.fields["p"].unit, "Pa")
        self.assertEqual(volume.info()["n_faces"], 27 * 3 + 27)

    def test_values_are_replaced_and_drawn(self):
        volume = self.volume(lambda x, y, z: x)
        scene = volume.scene(cut_planes=[[0, 0, 1, 0.2]])
        scene.render(48, 36)
        x, y, z = np.moveaxis(self.places, -1, 0)
        volume.update_field("p", y * y - z)
        fresh = self.volume(lambda x, y, z: y * y - z)
        np.testing.assert_array_equal(scene.render(48, 36).color, fresh.render(scene, 48, 36).color)
        self.assertAlmostEqual(volume.range("p").minimum, fresh.range("p").minimum)
        with self.assertRaisesRegex(ValueError, "of the shape"):
            volume.update_field("p", np.zeros((27, 3)))
        with self.assertRaisesRegex(KeyError, "q"):
            volume.update_field("q", x)

    def test_vectors_time_steps_groups_and_several_kinds(self):
        # A prism and a hexahedron that share a face, by values at their corners.
        hexahedron = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], dtype=float)
        prism = np.array([[1, 0, 0], [2, 0, 0], [2, 1, 0], [1, 1, 0], [1, 0, 1], [1, 1, 1]], dtype=float)
        cube = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
        wedge = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [-1, 1, 1]])
        kinds = [elvis.Elements("hexahedron", elvis.Space(1, nodes=cube), hexahedron[np.newaxis], face_groups=[[0, -1, -1, -1, -1, -1]]),
                 elvis.Elements("prism", elvis.Space(1, nodes=wedge), prism[np.newaxis])]
        times = [0.0, 2.5]
        values = [np.array([points * (1 + time) for time in times])[:, np.newaxis] for points in (hexahedron, prism)]
        spaces = [elvis.Space(1, nodes=cube), elvis.Space(1, nodes=wedge)]
        volume = elvis.from_arrays(kinds, {"u": list(zip(spaces, values))}, times=times, boundary_groups=["floor"])
        np.testing.assert_allclose(volume.time_steps, times)
        self.assertEqual(volume.boundary_groups, ["floor"])
        self.assertEqual(volume.info()["n_faces"], 6 + 5 - 1)
        points = [[0.3, 0.6, 0.2], [1.2, 0.5, 0.4]]
        samples = volume.probe(points, "u", time_step=1)
        np.testing.assert_array_equal(samples.element, [0, 1])
        np.testing.assert_allclose(samples["u"], 3.5 * np.array(points), atol=1e-12)
        picture = volume.scene(boundary=["floor"], field="u").render(32, 24)
        self.assertGreater((picture.element == 0).sum(), 50)
        self.assertEqual((picture.element == 1).sum(), 0)

    def test_arrays_that_do_not_fit_are_refused(self):
        geometry = np.zeros((1, 8, 3))
        space = elvis.Space(1, "gll_lagrange")
        for wrong, text in [
                (lambda: elvis.from_arrays(elvis.Elements("hexahedron", space, np.zeros((1, 8))), {}), "geometry of hexahedron"),
                (lambda: elvis.from_arrays(elvis.Elements("hexahedron", space, np.zeros((1, 7, 3))), {}), "8 modes"),
                (lambda: elvis.from_arrays(elvis.Elements("cube", space, geometry), {}), "'cube' is not known"),
                (lambda: elvis.from_arrays(elvis.Elements("hexahedron", space, geometry), {"p": (space, np.zeros((2, 8)))}), "values"),
                (lambda: elvis.from_arrays(elvis.Elements("hexahedron", space, geometry, corners=[[1, 2]]), {}), "8 columns")]:
            with self.assertRaisesRegex(ValueError, text):
                wrong()
        with self.assertRaises(elvis.Error):
            elvis.from_arrays(elvis.Elements("hexahedron", space, geometry), {})


if __name__ == "__main__":
    unittest.main()
