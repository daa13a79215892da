"""The page's controls for what a scene can hold, made from its schema: lines, arrows, warp, threshold, planes that cut away, opacity."""
import json
import os
import unittest

from browser_case import SETTLED, BrowserCase
from test_serve import run

SCENE = "elvis.state().scene"


class ItemsTest(BrowserCase):
    SIZE = (760, 620)

    def setUp(self):
        super().setUp()
        self.page.open(self.server.url)
        self.page.wait(SETTLED)

    def control(self, label, action, *values):
        """Does something with the control of that label, which is `c`."""
        self.page.run(f"const c = document.querySelector(`[aria-label='${{arguments[0]}}']`); const v = arguments[1]; {action}", label, *values)

    def put(self, label, value, condition):
        """Types or chooses a value; what the scene then holds."""
        self.control(label, "c.value = v; c.oninput?.(); c.onchange()", value)
        self.page.wait(f"{SCENE}.{condition}")

    def click(self, label, condition):
        self.control(label, "c.click()")
        self.page.wait(f"{SCENE}.{condition}" if condition else SETTLED)

    def labels(self, panel="item-editor"):
        return self.page.run("""return [...document.querySelectorAll(`#${arguments[0]} :is(input, select, button)`)].map((c) => c.getAttribute('aria-label'))""", panel)

    def scene(self):
        return self.page.run(f"return {SCENE}")

    def steps(self, button):
        """As often as it goes."""
        n = 0
        while not self.page.run(f"return document.getElementById('{button}').disabled"):
            before = self.page.run("return elvis.state().revision")
            self.page.click(f"#{button}")
            self.page.wait(f"elvis.state().revision > {before}")
            n += 1
        return n

    def test_every_key_has_a_control(self):
        properties = json.loads(run("render", "--schema").stdout)["properties"]["surfaces"]["items"]["properties"]
        said = {"streamlines": {"flow": "velocity"}, "pathlines": {"flow": "velocity"}, "arrows": {"vectors": "velocity"},
                "isosurface": {"values": [0.5]}, "elements": {}, "torus": {"center": [0, 0, 0], "axis": [0, 0, 1], "major_radius": 0.5, "minor_radius": 0.1}}
        for kind, keys in said.items():
            self.page.run("return elvis.connection.ask({type: 'set', pointer: '/surfaces', value: [arguments[0]]})", {"type": kind, "visible": False, **keys})
            self.page.wait(f"{SCENE}.surfaces[0].type === '{kind}' && document.getElementById('item-title').textContent.toLowerCase().startsWith('{kind}')")
            captions = self.page.run("""return [...document.querySelectorAll('#item-editor > .row')].map(
                (r) => r.querySelector('.caption')?.textContent || r.textContent.trim())""")
            wanted = [key.replace("_", " ").replace("color", "colour") for key, node in properties.items()
                      if key not in ("type", "visible", "degree") and kind in node.get("with", {"type": [kind]})["type"]]
            missing = [key for key in wanted if key not in captions and key != "colour map"]
            self.assertEqual(missing, [], kind)
            n_told = self.page.run("return [...document.querySelectorAll('#item-editor > .row')].filter((r) => r.title.length > 5).length")
            self.assertGreater(n_told, 8)
        self.assertEqual(self.without_names(), [])

    def test_lines_arrows_and_what_cuts_them(self):
        page = self.page
        first = self.scene()
        self.put("opacity", 0.25, "surfaces[0].opacity === 0.25")
        self.add("Streamlines")
        self.put("seed grid", 3, "surfaces[1].seed_grid === 3")
        self.put("radius", 0.02, "surfaces[1].radius === 0.02")
        self.put("direction", "forward", "surfaces[1].direction === 'forward'")
        # Keys that mean nothing beside others go.
        self.click("Add to seeds", "surfaces[1].seeds?.length === 1")
        self.assertNotIn("seed_grid", self.scene()["surfaces"][1])
        self.put("seeds 1 y", 0.4, "surfaces[1].seeds[0][1] === 0.4")
        self.click("Add to seeds", "surfaces[1].seeds.length === 2")
        self.click("Remove seeds 1", "surfaces[1].seeds.length === 1")
        self.put("Colour map", "magma", "surfaces[1].color_map?.name === 'magma'")
        self.click("own colour", "surfaces[1].color?.length === 3")
        self.assertNotIn("color_map", self.scene()["surfaces"][1])
        page.wait(SETTLED)
        self.shot("streamlines.png")
        page.click("#copy")
        page.wait(f"{SCENE}.surfaces.length === 3")
        page.click("[aria-label='Show Streamlines velocity']")
        page.wait(f"{SCENE}.surfaces[1].visible === false")
        self.add("Arrows")
        self.put("spacing", 0.4, "surfaces[3].spacing === 0.4")
        self.click("Add to clip", "surfaces[3].clip?.length === 1")
        self.put("Position of clip 1", 0.5, "surfaces[3].clip[0][3] === -0.5")
        page.wait("document.querySelectorAll('.grip').length === 2")
        page.wait(SETTLED)
        at = page.run("const box = document.querySelector('.grip').getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2]")
        page.drag([round(x) for x in at], (-20, 8))
        page.wait(f"{SETTLED} && {SCENE}.surfaces[3].clip[0][3] !== -0.5")
        self.put("threshold", "p > -1 && x < 0.9", "threshold === 'p > -1 && x < 0.9'")
        self.click("warp", "warp?.field === 'velocity'")
        self.put("warp factor", 0.2, "warp.factor === 0.2")
        page.wait(SETTLED)
        self.shot("arrows.png")
        self.assertEqual(page.run("return document.getElementById('messages').innerText"), "")

        last = self.scene()
        self.assertGreater(self.steps("undo"), 10)
        self.assertEqual(self.scene(), first)
        self.steps("redo")
        self.assertEqual(self.scene(), last)
        page.wait(SETTLED)
        page.click("#save-picture")
        picture = self.downloaded("waves.png")
        page.click("#save-scene")
        saved = json.loads(self.downloaded("waves.json"))
        path = os.path.join(self.folder, "saved.json")
        with open(path, "w") as file:
            json.dump(saved, file)
        run("render", path, "-o", os.path.join(self.folder, "drawn.png"))
        with open(os.path.join(self.folder, "drawn.png"), "rb") as file:
            self.assertEqual(file.read(), picture)
        page.click("#items li:last-child [title=Remove]")
        page.wait(f"{SCENE}.surfaces.length === 3")
        page.run("return elvis.connection.ask({type: 'load', scene: arguments[0]})", saved)
        page.wait(f"{SCENE}.surfaces.length === 4")
        self.assertEqual(self.scene()["surfaces"], saved["surfaces"])
        self.assertEqual(self.without_names(), [])
        self.assertEqual(page.complaints(), [])

    def test_what_cannot_be_is_told_and_goes(self):
        self.add("Pathlines")
        self.put("flow", "grad(p)", "surfaces[1].flow === 'grad(p)'")
        self.click("Add to clip", "surfaces[1].clip?.length === 1")
        before = self.scene()
        for label, value, word in (("radius", -1, "it must be above 0"), ("flow", "", "is missing"), ("seed grid", 1.5, "an integer is expected"),
                                   ("clip 1: a, b, c, d of a x + b y + c z + d = 0", "1, 2, z", "are not four numbers")):
            control = f"document.querySelector(`[aria-label='{label}']`).value"
            shown = self.page.run(f"return {control}")
            self.control(label, "c.value = v; c.onchange()", value)
            self.page.wait(f"document.getElementById('messages').innerText.includes('{word}')")
            self.page.wait(f"{control} === '{shown}'")
            self.assertEqual(self.scene(), before)
        # What the picture alone can tell: the message comes, and undo helps.
        self.control("threshold", "c.value = v; c.onchange()", "p > ")
        self.page.wait("document.getElementById('messages').innerText.includes('where a value is expected')")
        self.page.click("#undo")
        self.page.wait(SETTLED)
        self.page.run("document.querySelector(`[aria-label='flow']`).focus()")
        self.assertIn("with which points move", self.page.run("return document.getElementById('help').textContent"))


if __name__ == "__main__":
    unittest.main()
