"""What a page asks beside pictures: lines, histograms, palettes, handles; and programs beside the page."""
import json
import os
import tempfile
import unittest

from serving import Page, Server
from test_serve import run

SIZE = [160, 120]
CORNERS = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]


class ToolsTest(unittest.TestCase):
    """27 cubes with the field x, and one that is another number in each of them."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="elvis-tools-test-")
        source = os.path.join(cls.folder.name, "input.json")
        with open(source, "w") as file:
            json.dump({"generator": 1, "mesh": "box", "box": [[-1, -1, -1], [1, 1, 1]], "elements": [3, 3, 3],
                       "fields": [{"field": "polynomial", "name": "x coordinate", "coefficients": [[1, 0, 0, 1]]},
                                  {"field": "element", "name": "number"}]}, file)
        cls.volume = os.path.join(cls.folder.name, "cubes.h5")
        run("convert", source, "-o", cls.volume)
        cls.server = Server(cls.volume)

    @classmethod
    def tearDownClass(cls):
        status = cls.server.stop()
        cls.folder.cleanup()
        if status != 0:
            raise AssertionError(f"it ended with status {status}: {''.join(cls.server.errors)}")

    def page(self, **arguments):
        page = self.server.page(**{"size": SIZE, **arguments})
        self.addCleanup(page.close)
        return page

    def with_plane(self):
        page = self.page()
        page.ask(type="set", pointer="/surfaces", value=[{"type": "plane", "plane": [0, 0, 1, 0]}])
        page.ask(type="camera", camera={"eye": [2, 3, 4], "look_at": [0, 0, 0]})
        return page, page.ask(type="overlay", item={"kind": "surface", "index": 0})["handles"]

    # Lines.

    def test_a_line_has_the_numbers_of_elvis_sample(self):
        line = self.page().ask(type="line", **{"from": [-0.9, -0.8, 0.1], "to": [0.9, 0.7, 0.2]}, fields=["x coordinate", "number"], count=50)
        path = os.path.join(self.folder.name, "line.csv")
        run("sample", self.volume, "--line", "-0.9,-0.8,0.1", "0.9,0.7,0.2", "--count", "50", "--field", "x coordinate", "--field", "number",
            "-o", path)
        with open(path) as file:
            self.assertEqual(line["csv"], file.read())

    def test_jumps_on_a_line_are_gaps_where_elements_meet(self):
        line = self.page().ask(type="line", **{"from": [-2, 0, 0], "to": [2, 0, 0]}, fields=["x coordinate", "number"])
        places = [each["at"] for each in line["breaks"]]
        self.assertEqual(line["length"], 4)
        for place, expected in zip(places, (1, 5 / 3, 7 / 3, 3), strict=True):
            self.assertAlmostEqual(place, expected, delta=1e-10)  # Halving stops at some 1e-12 of an element.
        x, number = (one["points"] for one in line["series"])
        inside = [(at, value) for at, value in x if value is not None]
        print("\nlargest error along the line:", max(abs(value - (at - 2)) for at, value in inside))
        self.assertLess(max(abs(value - (at - 2)) for at, value in inside), 1e-10)
        self.assertAlmostEqual(inside[0][0], 1, delta=1e-10)
        self.assertAlmostEqual(inside[-1][0], 3, delta=1e-10)

        def gaps(points):
            return sum(1 for a, b in zip(points, points[1:]) if a[1] is not None and b[1] is None)
        self.assertEqual((gaps(x), gaps(number)), (1, 3))

    def test_lines_that_cannot_be_are_errors(self):
        page = self.page()
        ends = {"from": [0, 0, 0], "to": [1, 0, 0]}
        for wrong, word in (({"to": [0, 0, 0]}, "same point"), ({"to": [1, 0]}, "three numbers"), ({"fields": ["nothing"]}, "nothing"),
                            ({"fields": []}, "fields"), ({"fields": ["number"] * 17}, "fields"), ({"count": 1}, "count"),
                            ({"count": 1e9}, "count"), ({"to": "x"}, "")):
            answer = page.ask(type="line", **{**ends, **wrong})
            self.assertEqual(answer["type"], "error", wrong)
            self.assertIn(word, answer["text"])

    # Colours.

    def test_a_histogram_grows_until_it_is_that_of_the_volume(self):
        page = self.page()
        known = page.ask(type="histogram", field="x coordinate")
        while not known["is_complete"]:
            known = page.ask(type="histogram", field="x coordinate")
        self.assertLess(max(abs(known["lower"] + 1), abs(known["upper"] - 1)), 1e-12)
        self.assertEqual((len(known["bins"]), max(known["bins"])), (96, 1))
        self.assertGreater(min(known["bins"]), 0.5)  # Every value takes the same part; some 125 points a bin scatter.
        errors = [abs(found - (2 * part - 1)) for found, part in zip(known["quantiles"], (0.02, 0.1, 0.9, 0.98), strict=True)]
        print("\nlargest error of a quantile:", max(errors))
        self.assertLess(max(errors), 0.005)
        self.assertEqual(page.ask(type="histogram", field="nothing")["type"], "error")

    def test_a_palette_is_the_map(self):
        page = self.page()
        for own in ({"points": [[0, 1, 0, 0], [1, 0, 0, 1]]}, {"points": [[5, 1, 0, 0], [7, 0, 0, 1]], "range": [2, 3]}):
            points = page.ask(type="palette", color_map=own)["points"]
            self.assertEqual((points[0], points[-1]), ([0, 1, 0, 0], [1, 0, 0, 1]))
        self.assertGreater(len(page.ask(type="palette", color_map={"name": "viridis"})["points"]), 4)
        for wrong in ({"name": "none"}, {"file": "../x.json"}, 3):
            self.assertEqual(page.ask(type="palette", color_map=wrong)["type"], "error")

    # Handles.

    def test_a_plane_follows_the_hand_along_its_normal(self):
        page, handles = self.with_plane()
        self.assertEqual([handle["name"] for handle in handles], ["move", "turn"])
        at, way = handles[0]["at"], handles[0]["way"]
        for step in (3, 7, 12):
            page.tell(type="drag", handle=0, **{"from": at, "to": [at[0] + step * way[0], at[1] + step * way[1]]})
        page.ask(type="release")
        a, b, c, d = page.state["scene"]["surfaces"][0]["plane"]
        self.assertEqual((a, b, c), (0, 0, 1))
        self.assertLess(d, -0.05)
        moved = page.ask(type="overlay", item={"kind": "surface", "index": 0})["handles"][0]["at"]
        self.assertLess(max(abs(moved[i] - at[i] - 12 * way[i]) for i in (0, 1)), 1e-9)
        self.assertEqual(page.exact()["overlay"]["handles"][0]["at"], moved)
        page.ask(type="undo")  # All of it is one step.
        self.assertEqual(page.state["scene"]["surfaces"][0]["plane"], [0, 0, 1, 0])

    def test_a_plane_is_turned_about_its_middle(self):
        page, handles = self.with_plane()
        at = handles[1]["at"]
        page.ask(type="drag", handle=1, **{"from": at, "to": [at[0] + 10, at[1] + 5]})
        page.ask(type="release")
        a, b, c, d = page.state["scene"]["surfaces"][0]["plane"]
        self.assertAlmostEqual(a * a + b * b + c * c, 1, delta=1e-12)
        self.assertAlmostEqual(d, 0, delta=1e-12)
        self.assertLess(c, 0.999)
        page.ask(type="drag", handle=1, **{"from": at, "to": at})
        again = page.state["scene"]["surfaces"][0]["plane"]
        self.assertLess(max(abs(x - y) for x, y in zip(again, (a, b, c, d))), 1e-12)

    def test_what_cannot_be_dragged_is_refused(self):
        page, handles = self.with_plane()
        at = {"from": handles[0]["at"], "to": [10, 10]}
        for wrong in ({"handle": 2}, {"handle": -1}, {"to": [1e9, 0]}, {"to": [1]}, {"from": None}):
            self.assertEqual(page.ask(type="drag", **{"handle": 0, **at, **wrong})["type"], "error", wrong)
        page.ask(type="overlay", item=None)
        self.assertIn("selected", page.ask(type="drag", handle=0, **at)["text"])
        self.assertEqual(page.ask(type="overlay", item={"kind": "surface", "index": 9})["type"], "error")
        self.assertEqual(page.ask(type="overlay", points=CORNERS * 3)["type"], "error")
        self.assertEqual(page.ask(type="undo")["type"], "answer")

    # The first view.

    def test_all_is_seen_at_first_however_narrow_the_page_is(self):
        page = self.page(size=[200, 100])
        for size in ([200, 100], [60, 180], [300, 60]):
            page.ask(type="resize", width=size[0], height=size[1])
            places = page.ask(type="overlay", points=CORNERS)["points"]
            self.assertTrue(all(0 <= place[i] <= size[i] for place in places for i in (0, 1)), (size, places))
        page.ask(type="orbit", dx=5, dy=0)
        camera = page.ask(type="save scene")["scene"]["camera"]
        page.ask(type="resize", width=100, height=100)
        self.assertEqual(page.ask(type="save scene")["scene"]["camera"], camera)

    # Companions.

    def test_a_companion_hears_of_the_page_and_leaves_it_alone(self):
        page = self.page()
        page.exact()
        companion = Page(self.server.socket(session=page.session + "&companion=1"))
        self.addCleanup(companion.close)
        self.assertEqual(companion.session, page.session)
        page.ask(type="orbit", dx=4, dy=0)
        moved = companion.wait(lambda m: m["type"] == "camera")["camera"]
        self.assertEqual(moved, page.ask(type="save scene")["scene"]["camera"])
        companion.ask(type="add", name="Sphere")
        self.assertEqual(len(page.wait(lambda m: m["type"] == "state")["items"]), 2)
        picked = page.ask(type="pick", column=80.5, row=60.5)["picked"]
        self.assertEqual(companion.wait(lambda m: m["type"] == "picked")["picked"], picked)
        self.assertEqual(companion.ask(type="pick", column=80.5, row=60.5)["picked"], picked)
        page.exact()
        self.assertEqual(companion.frames, [])
        page.close()
        again = self.page(session=companion.session)
        self.assertEqual(len(again.state["items"]), 2)


if __name__ == "__main__":
    unittest.main()
