"""What takes long: integrals, extrema, pictures to save and films, as the commands make them, one at a time."""
import json
import os
import tempfile
import unittest

from serving import Page, Server
from test_serve import make_volume, run

SIZE = [120, 90]
SCENE = {"version": 1, "volume": {"path": "waves.h5"}, "camera": {"eye": [1.2, -1.9, 2.6], "look_at": [0, 0, 0]},
         "image": {"size": SIZE, "annotation": "default"}, "surfaces": [{"type": "plane", "plane": [0, 0, 1, 0]}]}


class LongTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="elvis-long-test-")
        cls.volume = make_volume(cls.folder.name)
        cls.scene = cls.path("scene.json")
        with open(cls.scene, "w") as file:
            json.dump(SCENE, file)
        cls.server = Server(cls.scene)

    @classmethod
    def tearDownClass(cls):
        status = cls.server.stop()
        cls.folder.cleanup()
        if status != 0:
            raise AssertionError(f"it ended with status {status}: {''.join(cls.server.errors)}")

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder.name, name)

    def page(self, **arguments):
        page = self.server.page(**arguments)
        self.addCleanup(page.close)
        return page

    def saved(self, page):
        """The scene as a file that `elvis render` reads."""
        with open(self.path("saved.json"), "w") as file:
            json.dump(page.ask(type="save scene")["scene"], file)
        return self.path("saved.json")

    # Answers.

    def test_integrals_are_those_of_elvis_integrate(self):
        page = self.page()
        group = page.volume["groups"][0]
        for wishes, options in (
                ({"domain": "volume"}, []),
                ({"domain": "volume", "field": "p^2"}, ["--field", "p^2"]),
                ({"domain": "boundary", "field": "p"}, ["--boundary", "--field", "p"]),
                ({"domain": "boundary", "groups": [group], "field": "velocity", "flux": True}, ["--boundary", group, "--field", "velocity", "--flux"]),
                ({"domain": "plane", "plane": [0, 0.6, 0.8, 0.1], "field": "velocity", "flux": True}, ["--cut-plane", "0,0.6,0.8,0.1", "--field", "velocity", "--flux"]),
                ({"domain": "isosurface", "isovalue": 0.2, "level_field": "p", "tolerance": 1e-4}, ["--isosurface", "0.2", "--isosurface-field", "p", "--tolerance", "1e-4"])):
            self.assertEqual(page.ask(type="integrate", **wishes)["integral"], json.loads(run("integrate", self.volume, *options).stdout), wishes)
        # Of the time step and the displacement that the scene shows.
        page.ask(type="set", pointer="/volume/time_step", value=2)
        page.ask(type="set", pointer="/warp", value={"field": "velocity", "factor": 0.05})
        shown = ["--time-step", "2", "--warp", "velocity", "--warp-factor", "0.05"]
        self.assertEqual(page.ask(type="integrate", domain="volume", field="p")["integral"], json.loads(run("integrate", self.volume, "--field", "p", *shown).stdout))

    def test_extrema_are_those_of_elvis_extrema(self):
        page = self.page()
        for field in ("p", "velocity", "pressure"):
            found = page.ask(type="extrema", field=field)["extrema"]
            self.assertEqual(found, json.loads(run("extrema", self.volume, "--field", field).stdout))
        # Expressions are sampled in the precision of pictures, here float32.
        found, other = page.ask(type="extrema", field="p + x")["extrema"], json.loads(run("extrema", self.volume, "--field", "p + x").stdout)
        for end in ("minimum", "maximum"):
            self.assertAlmostEqual(found[end]["value"], other[end]["value"], delta=1e-6)
            self.assertEqual(found[end]["element"], other[end]["element"])
        self.assertIn("no extrema", page.ask(type="extrema", field="1 / (p - p)")["text"])

    def test_wrong_wishes_are_errors(self):
        page = self.page()
        plane = {"domain": "plane", "plane": [0, 0, 1, 0]}
        for wrong, word in (({"domain": "nothing"}, "nothing"), ({"domain": "plane"}, "plane"), ({**plane, "plane": [0, 0, 0, 1]}, "normal"), ({**plane, "plane": [1]}, "four"),
                            ({**plane, "field": "q"}, "q"), ({"domain": "volume", "field": "velocity", "flux": True}, "flux"), ({**plane, "flux": True}, "flux"),
                            ({"domain": "boundary", "groups": ["none"]}, "none"), ({"domain": "isosurface", "isovalue": 0}, "which field"),
                            ({"domain": "isosurface", "level_field": "p"}, "isovalue"), ({"domain": "volume", "tolerance": 1}, "tolerance")):
            answer = page.ask(type="integrate", **wrong)
            self.assertEqual(answer["type"], "error", wrong)
            self.assertIn(word, answer["text"])
        for wrong in ({"width": 9, "height": 9, "format": "exe"}, {"width": 9, "height": 9, "format": "../x.png"}, {"width": 8192, "height": 8193, "format": "pdf"}, {"width": 9}):
            self.assertEqual(page.ask(type="save picture", **wrong)["type"], "error", wrong)

    # Files.

    def test_saved_pictures_are_those_of_elvis_render_in_every_format(self):
        page = self.page()
        scene = self.saved(page)
        for ending, begin in (("png", b"\x89PNG"), ("svg", b"<"), ("pdf", b"%PDF")):
            saved = page.ask(type="save picture", width=100, height=80, format=ending)
            drawn = self.path(f"drawn.{ending}")
            run("render", scene, "--size", "100x80", "-o", drawn)
            with open(drawn, "rb") as file:
                self.assertEqual(saved["bytes"], file.read(), ending)
            self.assertTrue(saved["bytes"].startswith(begin))

    def test_a_film_has_the_pictures_of_elvis_render(self):
        page = self.page()
        self.assertIn("no animation", page.ask(type="film", width=40, height=30)["text"])
        page.ask(type="set", pointer="/animation", value={"time_steps": "all", "turntable": {"frames": 4}})
        scene = self.saved(page)
        run("render", scene, "--size", "40x30", "-o", self.path("film"))
        film = page.ask(type="film", width=40, height=30)
        names = sorted(os.listdir(self.path("film")))
        self.assertEqual(film["n_pictures"], len(names))
        self.assertEqual(film["frames_a_second"], 25)
        page.ask(type="orbit", dx=50, dy=0)  # It is of the scene as it was.
        for index, name in enumerate(names):
            drawn = page.ask(type="film picture", index=index)
            self.assertEqual(drawn["name"], name)
            with open(os.path.join(self.path("film"), name), "rb") as file:
                self.assertEqual(drawn["bytes"], file.read())
        self.assertEqual(page.ask(type="film picture", index=len(names))["type"], "error")
        self.assertIn("busy", page.ask(type="film", width=40, height=30)["text"])
        self.assertIn("busy", page.ask(type="extrema", field="p")["text"])
        page.ask(type="stop")
        self.assertIn("no film", page.ask(type="film picture", index=0)["text"])
        self.assertEqual(page.ask(type="extrema", field="p")["type"], "answer")
        page.ask(type="set", pointer="/animation", value={"turntable": {"frames": 1000000}})
        self.assertIn("at most", page.ask(type="film", width=40, height=30)["text"])
        self.assertEqual(page.ask(type="film", width=8192, height=8193)["type"], "error")

    # One at a time.

    def answers(self, page, *messages):
        """Sends them at once; what is answered to each."""
        first = page.number
        for message in messages:
            page.number += 1
            page.tell(id=page.number, **message)
        numbers = range(first + 1, page.number + 1)
        found = {}
        while len(found) < len(messages):
            answer = page.wait(lambda m: m.get("id") in numbers)
            found[answer["id"]] = answer
        return [found[number] for number in numbers]

    def test_a_second_one_is_told_that_the_first_is_busy_and_the_first_goes_on(self):
        page, other = self.page(), self.page()
        picture = {"type": "save picture", "width": 300, "height": 200}
        first, second, third = self.answers(page, picture, {"type": "integrate", "domain": "volume"}, {"type": "film", "width": 9, "height": 9})
        self.assertTrue(first["bytes"].startswith(b"\x89PNG"))
        self.assertIn("busy drawing a picture", second["text"])
        self.assertEqual(third["type"], "error")
        self.assertEqual(other.ask(type="integrate", domain="volume")["type"], "answer")  # Others are not concerned.

    def test_it_can_be_stopped_and_makes_way_for_movements(self):
        page = self.page()
        page.exact()
        picture = {"type": "save picture", "width": 2000, "height": 2000}
        stopped, _ = self.answers(page, picture, {"type": "stop"})
        self.assertEqual(stopped["text"], "stopped")
        page.frames.clear()
        saved, _ = self.answers(page, {**picture, "width": 400, "height": 300}, {"type": "orbit", "dx": 5, "dy": 0})
        self.assertTrue(saved["bytes"].startswith(b"\x89PNG"))
        self.assertNotEqual(page.frames, [])  # Those came first.

    def test_who_has_gone_keeps_nobody_waiting(self):
        page = self.page()
        page.tell(type="film", width=2000, height=2000)
        page.tell(type="save picture", width=2000, height=2000)
        page.close()
        again = Page(self.server.socket(session=page.session))
        self.addCleanup(again.close)
        answer = again.ask(type="extrema", field="p")
        while answer["type"] == "error":  # The server may not have seen yet that the first page has gone.
            self.assertIn("busy", answer["text"])
            answer = again.ask(type="extrema", field="p")


if __name__ == "__main__":
    unittest.main()
