"""Values, information, conversion, and arguments that are wrong."""

import inspect
import random
import threading
import json
import unittest

import numpy as np

import elvis
from volumes import WithVolume


class Values(WithVolume):
    def test_values_and_gradients_are_those_of_the_field(self):
        points = np.random.default_rng(1).uniform(-0.8, 0.8, (200, 3))
        samples = self.volume.probe(points, ["p", "velocity", "norm(grad(p))"])
        x, y, z = points.T
        self.assertTrue(samples.is_inside.all())
        np.testing.assert_allclose(samples["p"], x * x * y + z, atol=1e-12)
        np.testing.assert_allclose(samples.gradient("p"), np.column_stack([2 * x * y, x * x, np.ones_like(x)]), atol=1e-9)
        np.testing.assert_allclose(samples["norm(grad(p))"], np.linalg.norm(samples.gradient("p"), axis=1), rtol=1e-10)
        self.assertEqual(samples["velocity"].shape, (200, 3))
        self.assertEqual(samples.gradient("velocity").shape, (200, 3, 3))
        self.assertFalse(samples.is_estimated("p").any())
        with self.assertRaises(KeyError):
            samples["pressure"]

    def test_points_outside_have_no_values(self):
        samples = self.volume.probe([[0, 0, 0], [9, 9, 9]], "p")
        self.assertEqual(samples.element[1], -1)
        self.assertTrue(np.isnan(samples["p"][1]) and np.isnan(samples.xi[1]).all())
        self.assertEqual(len(self.volume.probe(np.zeros((0, 3)))), 0)

    def test_what_is_in_the_volume(self):
        self.assertEqual(self.volume.n_elements, 27)
        self.assertEqual(self.volume.fields["velocity"].components, 3)
        self.assertEqual(self.volume.bounds.shape, (2, 3))
        self.assertIn("x-", self.volume.boundary_groups)
        found = self.volume.range("p")
        self.assertTrue(found.certified)
        self.assertLessEqual(found.lower_bound, found.minimum)
        self.assertAlmostEqual(self.volume.probe(0.999999 * np.array(found.minimum_position), "p")["p"][0], found.minimum, delta=1e-4)
        self.assertEqual(self.volume.info()["negative_jacobians"]["n_elements"], 0)
        self.assertEqual({field["name"]: field["exact"] for field in self.report["fields"]}["p"], True)
        self.assertGreater(len(elvis.devices()), 0)
        self.assertIn("org.elvis.native", [plugin["id"] for plugin in elvis.plugins()["plugins"]])

    def test_integrals_are_those_of_the_field(self):
        # By the divergence theorem: both sides are exact, in bent elements, too.
        whole = self.volume.integrate("p")
        self.assertTrue(whole.exact and whole.converged)
        flux = self.volume.integrate("(x^3*y/3 + z*x)*grad(x)", boundary=True, flux=True)
        self.assertAlmostEqual(float(whole), flux.value, delta=1e-12)
        self.assertAlmostEqual(whole.measure, self.volume.integrate("y*grad(y)", boundary=True, flux=True).value, delta=1e-12)
        sides = [self.volume.integrate("y*grad(y)", boundary=[side], flux=True).value for side in self.volume.boundary_groups]
        self.assertAlmostEqual(whole.measure, sum(sides), delta=1e-12)
        cut = self.volume.integrate("x^2", plane=[0, 0, 1, -0.2])
        self.assertTrue(cut.converged and not cut.exact and 3.5 < cut.measure < 4.5)
        sphere = self.volume.integrate(isosurface=0.5, isosurface_field="norm(x*grad(x) + y*grad(y) + z*grad(z))")
        self.assertAlmostEqual(sphere.measure, np.pi, delta=1e-8)
        for wrong in (lambda: self.volume.integrate("velocity", flux=True), lambda: self.volume.integrate("p", boundary=["wall"]),
                      lambda: self.volume.integrate("p", tolerance=2), lambda: self.volume.integrate(isosurface=1)):
            self.assertRaises(elvis.Error, wrong)
        self.assertRaises(ValueError, lambda: self.volume.integrate(plane=[1, 0, 0, 0], boundary=True))

    def test_a_line_tells_where_elements_begin_and_end(self):
        places = self.volume.walk_line([-2, 0.1, 0.2], [2, 0.1, 0.2], ["p", "velocity"])
        self.assertEqual(len(places), 4)
        self.assertIsNone(places[0].before)
        self.assertIsNone(places[-1].after)
        for here, there in zip(places, places[1:]):
            self.assertEqual(here.after.element, there.before.element)
        for place in places:
            x, y, z = place.position
            np.testing.assert_allclose(place.distance, x + 2, atol=1e-12)
            for side in (place.before, place.after):
                if side is not None:
                    self.assertAlmostEqual(side.values["p"], x * x * y + z, delta=1e-12)
                    self.assertEqual(side.values["velocity"].shape, (3,))

    def test_streamlines_are_tangent_to_the_field(self):
        lines = self.volume.streamlines("y*grad(x) - x*grad(y)", [[0.5, 0, 0.1], [0, 0.3, -0.2], [5, 0, 0]], ["p", "velocity"], direction="forward",
                                        length=1)
        self.assertEqual([line.end for line in lines], ["length", "length", "no element"])
        self.assertEqual(len(lines[2].positions), 0)
        for line, radius in zip(lines, (0.5, 0.3)):
            np.testing.assert_allclose(np.hypot(line.positions[:, 0], line.positions[:, 1]), radius, atol=1e-6)
            self.assertAlmostEqual(line.arc_lengths[-1], 1, delta=1e-9)
            x, y, z = line.positions.T
            np.testing.assert_allclose(line.values["p"], x * x * y + z, atol=1e-12)
            self.assertEqual(line.values["velocity"].shape, (len(x), 3))
        self.assertRaises(elvis.Error, lambda: self.volume.streamlines("p", [0, 0, 0]))
        evenly = self.volume.streamlines("grad(x)", elvis.Surface(type="plane", plane=[1, 0, 0, 0]), spacing=0.4, length=0.1)
        self.assertGreater(len(evenly), 3)
        for line in evenly:
            seed = line.positions[np.argmin(np.abs(line.arc_lengths))]
            self.assertLess(abs(seed[0]), 1e-12)

    def test_lines_of_a_scene_are_those_that_it_draws(self):
        scene = self.volume.scene(surfaces=[elvis.Surface(type="boundary"),
                                            elvis.Surface(type="streamlines", flow="grad(x)", seed_line=[[0, 0, 0], [0, 0.5, 0]], seed_count=3)])
        lines = self.volume.lines_of(scene, 1, "p")
        same = self.volume.streamlines("grad(x)", [[0, 0, 0], [0, 0.25, 0], [0, 0.5, 0]], "p")
        self.assertEqual(len(lines), 3)
        for line, other in zip(lines, same):
            np.testing.assert_array_equal(line.positions, other.positions)
            np.testing.assert_array_equal(line.values["p"], other.values["p"])
        self.assertRaises(elvis.Error, lambda: self.volume.lines_of(scene, 0))

    def test_pathlines_follow_a_rotation_that_gets_faster(self):
        with open(self.path("faster.json"), "w", encoding="utf-8") as file:
            json.dump({"generator": 1, "mesh": "box", "elements": 2, "field": "sphere", "time_steps": 3}, file)
        elvis.convert(self.path("faster.json"), self.path("faster.h5"))
        volume = elvis.open(self.path("faster.h5"))
        flow = "0.5 * (d(sphere, x) * grad(y) - d(sphere, y) * grad(x))"  # Angular velocity 1 + t.
        line, = volume.pathlines(flow, [[0.5, 0, 0.1]], "sphere", start_time=0.5, end_time=1.75, interpolation="linear", tolerance=1e-12)
        self.assertEqual((line.begin, line.end), ("length", "time"))
        self.assertEqual((line.times[0], line.times[-1]), (0.5, 1.75))
        angle = 1.25 + (1.75 ** 2 - 0.5 ** 2) / 2
        np.testing.assert_allclose(line.positions[-1], [0.5 * np.cos(angle), 0.5 * np.sin(angle), 0.1], atol=1e-10)
        # Values are those at the points' own times.
        np.testing.assert_allclose(line.values["sphere"], (1 + line.times) * (line.positions ** 2).sum(axis=1), atol=1e-12)
        back, = volume.pathlines(flow, line.positions[-1:], direction="backward", start_time=1.75, end_time=0.5, tolerance=1e-12)
        np.testing.assert_allclose(back.positions[0], [0.5, 0, 0.1], atol=1e-10)
        with self.assertRaisesRegex(elvis.Error, "not within the times"):
            volume.pathlines(flow, [0.5, 0, 0.1], start_time=2.5)
        with self.assertRaisesRegex(elvis.Error, "at least two"):
            self.volume.pathlines("velocity", [0.5, 0, 0.1])

    def test_a_mesh_lies_on_the_surface(self):
        mesh = self.volume.extract("p", isosurface=0.4, values=["p", "velocity"], tolerance=3e-3)
        x, y, z = mesh.positions.T
        np.testing.assert_allclose(x * x * y + z, 0.4, atol=1e-11)
        np.testing.assert_allclose(mesh.values["p"], 0.4, atol=1e-11)
        self.assertEqual(mesh.values["velocity"].shape, (len(x), 3))
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1)
        a, b, c = (mesh.positions[mesh.triangles[:, corner]] for corner in range(3))
        self.assertAlmostEqual(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2, mesh.measure, delta=1e-12)
        self.assertLess(max(mesh.mesh_to_surface, mesh.surface_to_mesh), mesh.tolerance)
        self.assertEqual((mesh.inner_edges, mesh.branching_edges, mesh.lines), (0, 0, []))
        lines = self.volume.extract("x", plane=[0, 0, 1, -0.1], contours=[0.5])
        self.assertEqual([lines.line_values[0], len(lines.triangles)], [0.5, 0])
        np.testing.assert_allclose(lines.positions[lines.lines[0]][:, [0, 2]], [[0.5, 0.1]] * len(lines.lines[0]), atol=1e-12)
        self.assertGreater(self.volume.extract(boundary=True, tolerance=1e-2).measure, 20)
        self.assertRaises(ValueError, lambda: self.volume.extract(isosurface=0.4))
        self.assertRaises(elvis.Error, lambda: self.volume.extract("nothing", isosurface=0.4))

    def test_a_warp_displaces_points_and_takes_values_along(self):
        point = np.array([0.3, -0.2, 0.4])
        before = self.volume.probe(point, ["velocity", "p"])
        warped = self.volume.warp("velocity", 0.1)
        after = warped.probe(point + 0.1 * before["velocity"][0], ["velocity", "p"])
        self.assertAlmostEqual(after["p"][0], before["p"][0], delta=1e-12)
        self.assertNotAlmostEqual(warped.integrate().value, self.volume.integrate().value, places=6)
        picture = warped.render(width=32, height=24)
        self.assertEqual(picture.color.shape[:2], (24, 32))
        self.assertRaises(elvis.Error, lambda: self.volume.warp("p"))

    def test_joined_volumes_have_the_fields_of_both(self):
        point = np.array([0.3, -0.2, 0.4])
        both = self.volume.join({"other": self.volume, "first": self.volume}, time_steps={"first": 0})
        values = both.probe(point, ["p - other.p", "p - first.p", "other.p", "p"])
        self.assertEqual((values["p - other.p"][0], values["p - first.p"][0]), (0, 0))
        self.assertEqual(values["other.p"][0], values["p"][0])
        self.assertRaises(elvis.Error, lambda: self.volume.join({"no name": self.volume}))
        self.assertRaises(ValueError, lambda: self.volume.join({}, time_steps={"b": 0}))

    def test_a_foreign_file_is_opened_as_it_is(self):
        for files in (self.path("input.json"), [self.path("input.json")]):
            self.assertEqual(elvis.open(files).n_elements, self.volume.n_elements)

    def test_errors_are_those_of_the_launcher(self):
        for wrong, text in [(lambda: elvis.open("nothing.h5"), "nothing.h5: there is no such file"),
                            (lambda: elvis.open(__file__), "no conversion plugin reads this file"),
                            (lambda: self.volume.probe([[0, 0, 0]], "q"), "q"),
                            (lambda: self.volume.range("p", 4), "time step"),
                            (lambda: elvis.convert(self.path("nothing"), self.path("x.h5")), "nothing")]:
            with self.assertRaises(elvis.Error) as raised:
                wrong()
            self.assertIn(text, str(raised.exception))

    def test_conversion_tells_how_far_it_is_and_is_stopped_by_an_exception(self):
        told = []
        elvis.convert(self.path("input.json"), self.path("again.h5"), progress=lambda *news: told.append(news))

        def stop(fraction, activity):
            raise RuntimeError("enough")

        points = np.zeros((400000, 3))
        with self.assertRaisesRegex(RuntimeError, "enough"):
            self.volume.probe(points, "p", progress=stop)

    def test_other_threads_run_meanwhile(self):
        n_turns = 0
        is_done = threading.Event()

        def turn():
            nonlocal n_turns
            while not is_done.wait(0.001):
                n_turns += 1

        thread = threading.Thread(target=turn)
        thread.start()
        self.volume.probe(np.random.default_rng(2).uniform(-0.8, 0.8, (40000, 3)), "p")
        is_done.set()
        thread.join()
        self.assertGreater(n_turns, 5)

    def test_random_arguments_give_errors_and_no_crash(self):
        rng = random.Random(5)
        things = [None, -1, 0, 10**12, 1.5, float("nan"), "", "p", "p+", "norm(", b"p", [], [[]], [["p"]], {}, object(), np.zeros(3),
                  np.zeros((2, 2)), np.zeros((1, 3)), np.full((2, 3), np.inf), np.zeros((2, 3), dtype=complex)]
        calls = [self.volume.probe, self.volume.range, self.volume.info, self.volume.scene, self.volume.render, elvis.open,
                 elvis.convert, elvis.Scene.read, elvis.Surface, elvis.from_arrays, elvis.Space, self.volume.update_field, self.volume.animate, self.volume.pick, self.volume.percentiles,
                 self.volume.complete, self.volume.integrate, self.volume.extract, self.volume.streamlines, self.volume.pathlines, self.volume.lines_of,
                 self.volume.warp, self.volume.walk_line]
        n_errors = 0
        for _ in range(300):
            call = rng.choice(calls)
            arguments = [rng.choice(things) for _ in range(rng.randint(0, 3))]
            named = [parameter.name for parameter in inspect.signature(call).parameters.values() if parameter.kind == parameter.KEYWORD_ONLY]
            keywords = {name: rng.choice(things) for name in named if rng.random() < 0.15}
            try:
                with np.errstate(all="ignore"):
                    call(*arguments, **keywords)
            except Exception:  # noqa: BLE001: any exception will do, a crash will not.
                n_errors += 1
        self.assertGreater(n_errors, 50)


if __name__ == "__main__":
    unittest.main()
