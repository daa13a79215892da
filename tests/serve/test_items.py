"""The page's controls for what a scene can hold, made from its schema: lines, arrows, warp, threshold, planes that cut away, opacity."""
import json
import os
import re
import time
import unittest

from browser_case import SETTLED, BrowserCase
from test_serve import run

SCENE = "elvis.state().scene"
TAB, ESCAPE = "\ue004", "\ue00c"


def key_places(node, schema, place=""):
    """Of all keys that a scene may have, with `*` for numbers of entries."""
    node = {**schema["$defs"][node["$ref"].split("/")[-1]], **node} if "$ref" in node else node
    for one in [node, *node.get("anyOf", [])]:
        one = schema["$defs"][one["$ref"].split("/")[-1]] if "$ref" in one else one
        for key, value in one.get("properties", {}).items():
            yield f"{place}/{key}"
            yield from key_places(value, schema, f"{place}/{key}")
        if "items" in one:
            yield from key_places(one["items"], schema, f"{place}/*")


class ItemsTest(BrowserCase):
    SIZE = (760, 620)

    def setUp(self):
        super().setUp()
        self.page.open(self.server.url)
        self.page.wait(SETTLED)

    def control(self, label, action, *values):
        """Does something with the control of that label, which is `c`. Returns the state's number before."""
        return self.page.run(f"const c = document.querySelector(`[aria-label='${{arguments[0]}}']`); const v = arguments[1]; const before = elvis.state().revision; {action}; return before", label, *values)

    def put(self, label, value, condition):
        """Types or chooses a value; what the scene then holds."""
        before = self.control(label, "c.value = v; c.oninput?.(); c.onchange()", value)
        self.wait_for_state(before, condition)

    def click(self, label, condition):
        before = self.control(label, "c.click()")
        if condition:
            self.wait_for_state(before, condition)
        else:
            self.page.wait(SETTLED)

    def wait_for_state(self, before, condition):
        """A later one than that, as the server has it: the page changes its own scene at once."""
        self.page.wait(f"elvis.state().revision > {before} && {SCENE}.{condition}")

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

    def places(self, scene):
        """Of all controls, for every item, as `/surfaces/*/clip`."""
        self.page.run("return elvis.connection.ask({type: 'load', scene: arguments[0]})", {"version": 1, **scene})
        n = len(scene.get("surfaces", [])) + len(scene.get("lighting", {}).get("lights", [])) + ("volume_rendering" in scene)
        self.page.wait(f"document.querySelectorAll('#items li').length === {n}")
        found = self.page.run("""const all = new Set();
            for (let i = 0; i < Math.max(1, arguments[0]); ++i) {
              document.querySelectorAll('#items .label')[i]?.click();
              document.querySelectorAll('[data-place]').forEach((node) => all.add(node.dataset.place));
            }
            return [...all]""", n)
        self.assertEqual(self.without_names(), [])
        return {re.sub(r"/\d+(?=/|$)", "/*", place) for place in found}

    def test_every_key_of_a_scene_has_a_control(self):
        schema = json.loads(run("render", "--schema").stdout)
        lines = {"contours": {}, "mesh_lines": {}, "lic": {"field": "velocity"}}
        named = {"name": "plasma"}
        said = {"streamlines": {"flow": "velocity"}, "pathlines": {"flow": "velocity"}, "arrows": {"vectors": "velocity"},
                "isosurface": {"values": [0.5], "method": "bernstein"}, "boundary": {}, "elements": {}, "wireframe": {},
                "plane": {"plane": [0, 0, 1, 0], "color_map": named, **lines}, "sphere": {"center": [0, 0, 0], "radius": 1},
                "cylinder": {"from": [0, 0, 0], "to": [0, 0, 1], "radius": 1, "color_map": {"points": [[0, 1, 1, 1], [1, 0, 0, 0]]}},
                "cone": {"from": [0, 0, 0], "to": [0, 0, 1], "from_radius": 1, "to_radius": 0}, "quadric": {"coefficients": [1] * 10},
                "torus": {"center": [0, 0, 0], "axis": [0, 0, 1], "major_radius": 0.5, "minor_radius": 0.1},
                "implicit": {"expression": "x + y"}, "mesh": {"file": "triangles.obj"}, "bezier": {"file": "patches.bpt"}}
        with open(os.path.join(self.folder, "triangles.obj"), "w") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        with open(os.path.join(self.folder, "patches.bpt"), "w") as file:
            file.write("1\n3 3\n" + "".join(f"{i / 3} {j / 3} 0\n" for j in range(4) for i in range(4)))
        camera = {"eye": [3, 2, 1], "look_at": [0, 0, 0]}
        density = [[0, 0], [1, 1]]
        whole = {"color": [[0, 1, 1, 1], [1, 0, 0, 0]], "density": density}
        moves = {"turntable": {"frames": 3}}
        of_keys = {"key_frames": [{"frame": 0, **camera}, {"frame": 9, **camera, "eye": [1, 2, 3]}]}
        found = self.places({
            "warp": {"field": "velocity", "factor": 0.1}, "volumes": [{"offset": [3, 0, 0]}], "views": [{"name": "one", "camera": camera}],
            "color_map": named, **lines, "animation": moves,
            "image": {"annotation": {"texts": [{"text": "a", "position": [0, 0]}]}},
            "lighting": {"lights": [{"type": "directional", "direction": [0, 0, 1]}, {"type": "point", "position": [0, 0, 9]}]},
            "volume_rendering": {"visible": False, "color_map": named, "density": density, "peaks": [{"value": 0, "width": 1, "density": 1}]},
            "surfaces": [{"type": kind, "visible": False, **keys} for kind, keys in said.items()]})
        found |= self.places({"color_map": {"points": [[0, 1, 1, 1], [1, 0, 0, 0]]}, "animation": of_keys,
                              "volume_rendering": {"visible": False, "opacity": [[0, 0], [1, 0.5]], "integrator": "riemann",
                                                   "color_map": {"points": [[0, 1, 1, 1], [1, 0, 0, 0]]}}})
        found |= self.places({"volume_rendering": {"visible": False, "transfer": whole}})
        # A list, a button or the page's size says these; the volume is what is served; what the page shows has no budget of memory; a scene says
        # the rest in another way, too.
        others = re.compile(r"/(version|volume(/.*)?|memory(/.*)?|isosurfaces(/.*)?|image/size|camera/type|views/\*/camera(/.*)?|lighting/lights(/\*/type|/\*/visible)?"
                            r"|surfaces(/\*/(type|visible|point|normal))?|volumes/\*/(path|more_paths|plugin|options)|views|image|camera"
                            r"|volume_rendering(/visible|/peaks)?|.*color_map/name)")
        missing = [place for place in key_places(schema, schema) if place not in found and not others.fullmatch(place)]
        self.assertEqual(missing, [])
        print(f"\n{len(found)} places of a scene have controls")

    def test_what_scenes_say_of_colours_films_and_densities_is_set_in_the_page(self):
        page = self.page
        self.put("Colour map", "own points", "surfaces[0].color_map?.points?.length === 5")
        self.put("colour map points 2 value", 0.4, "surfaces[0].color_map.points[1][0] === 0.4")
        self.put("colour map points 2: red, green, blue", "1, 0, 0", "surfaces[0].color_map.points[1][1] === 1")
        self.click("Remove colour map points 3", "surfaces[0].color_map.points.length === 4")
        self.put("colour map space", "lab", "surfaces[0].color_map.space === 'lab'")
        with open(os.path.join(self.folder, "map.json"), "w") as file:
            json.dump([{"ColorSpace": "RGB", "RGBPoints": [0, 0, 0, 0, 1, 1, 1, 0]}], file)
        self.put("Colour map", "plasma", "surfaces[0].color_map.name === 'plasma'")
        self.put("colour map file", "map.json", "surfaces[0].color_map.name === undefined")
        page.wait(SETTLED)

        self.add("Wireframe")
        page.wait("document.querySelector(`[aria-label='own colour']`)")
        self.click("own colour", "surfaces[1].color !== undefined")
        self.put("colour: red, green, blue", "0.8, 0, 0", "surfaces[1].color?.[0] === 0.8")
        self.put("Colour map", "magma", "surfaces[1].color_map?.name === 'magma'")
        self.assertNotIn("color", self.scene()["surfaces"][1])

        self.add("Volume")
        self.click("Add to opacity", "volume_rendering.opacity?.length === 1")
        self.put("opacity 1 opacity", 0.25, "volume_rendering.opacity[0][1] === 0.25")
        with open(os.path.join(self.folder, "transfer.json"), "w") as file:
            json.dump({"color": [[-1, 0, 0, 1], [2, 1, 0, 0]], "density": [[-1, 0], [2, 3]]}, file)
        self.put("transfer file", "transfer.json", "volume_rendering.opacity === undefined")
        page.wait(SETTLED)
        self.shot("colours.png")
        # As numbers of its own it is the same picture.
        first = self.page.run("return [...elvis.picture.exact].join()")
        revision = self.page.run("return elvis.frame().revision")
        self.click("transfer", "volume_rendering.transfer?.density?.length === 2")
        page.wait(f"{SETTLED} && elvis.frame().revision > {revision}")
        self.assertEqual(self.page.run("return [...elvis.picture.exact].join()"), first)
        self.put("transfer density 1 density", 1, "volume_rendering.transfer.density[0][1] === 1")

        self.click("animation", "animation !== undefined")
        self.click("Add to animation key frames", "animation.key_frames?.length === 2")
        self.put("animation key frames 2 frame", 2, "animation.key_frames[1].frame === 2")
        self.put("animation key frames 2 eye x", 3, "animation.key_frames[1].eye[0] === 3")
        self.put("animation time steps", "0:2", "animation.time_steps === '0:2'")
        self.click("animation turntable", None)
        self.assertIn("key_frames", self.page.run("return document.getElementById('messages').innerText"))
        page.click("#save-scene")
        path = os.path.join(self.folder, "film.json")
        with open(path, "wb") as file:
            file.write(self.downloaded("waves.json"))
        run("render", path, "--size", "40x30", "-o", os.path.join(self.folder, "film"))
        self.assertEqual(len(os.listdir(os.path.join(self.folder, "film"))), 3)
        self.assertEqual(self.without_names(), [])
        self.assertEqual(page.complaints(), [])

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
        page.wait(f"{SCENE}.surfaces[3].clip[0][3] !== -0.5")
        self.put("threshold", "p > -1 && x < 0.9", "threshold === 'p > -1 && x < 0.9'")
        self.click("warp", "warp?.field === 'velocity'")
        self.put("warp factor", 0.2, "warp.factor === 0.2")
        self.assertEqual(page.run("return document.getElementById('messages').innerText"), "")

        last = self.scene()
        self.assertGreater(self.steps("undo"), 10)
        self.assertEqual(self.scene(), first)
        self.steps("redo")
        self.assertEqual(self.scene(), last)
        page.wait(SETTLED)
        self.shot("arrows.png")
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
        for label, value, word in (("radius", -1, "it must be above 0"), ("seed grid", 1.5, "an integer is expected"),
                                   ("clip 1: a, b, c, d of a x + b y + c z + d = 0", "1, 2, z", "are not four numbers")):
            control = f"document.querySelector(`[aria-label='{label}']`).value"
            shown = self.page.run(f"return {control}")
            self.control(label, "c.value = v; c.onchange()", value)
            self.page.wait(f"document.getElementById('messages').innerText.includes('{word}')")
            self.page.wait(f"{control} === '{shown}'")
            self.assertEqual(self.scene(), before)
        self.page.run("document.querySelector(`[aria-label='flow']`).focus()")
        self.assertIn("with which points move", self.page.run("return document.getElementById('help').textContent"))

    def wrong(self, label):
        """What is told at the control of that label."""
        return self.page.run("""const c = document.querySelector(`[aria-label='${arguments[0]}']`);
            const told = document.getElementById(c.getAttribute('aria-describedby'));
            return c.getAttribute('aria-invalid') === 'true' && !told.hidden && told.getBoundingClientRect().height > 0 ? told.textContent : ''""", label)

    def wait_for_wrong(self, label, word):
        end = time.monotonic() + 60
        while word not in self.wrong(label) or not (word or not self.wrong(label)):
            self.assertLess(time.monotonic(), end, f"{label} says {self.wrong(label)!r}")
            time.sleep(0.05)

    def test_wrong_texts_are_told_where_they_are_typed(self):
        page = self.page
        self.add("Streamlines")
        page.wait(SETTLED)
        before = self.scene()
        # While it is typed, and nothing has been drawn.
        for label, text, word in (("threshold", "p > ", "where a value is expected"), ("flow", " + grad(q)", "'q' is unknown"),
                                  ("colour map file", "nothing.json", "cannot be read"), ("Field along the line", "sqrt(p", "expected")):
            n_frames = page.run("return elvis.picture.times.length")
            page.run("document.querySelector(`[aria-label='${arguments[0]}']`).scrollIntoView({block: 'center'})", label)
            page.type(f"[aria-label='{label}']", text)
            self.wait_for_wrong(label, word)
            self.assertEqual(page.run("return elvis.picture.times.length"), n_frames)
        self.shot("wrong.png")
        self.assertEqual(self.scene(), before)
        # What is wrong is no part of the scene, and stays to be corrected when the panels are made anew.
        page.press(TAB)
        self.put("opacity", 0.5, "surfaces[1].opacity === 0.5")
        self.wait_for_wrong("threshold", "where a value is expected")
        self.assertEqual(page.run("return document.querySelector(`[aria-label='threshold']`).value"), "p > ")
        page.type("[aria-label='threshold']", "0.1")
        self.wait_for_wrong("threshold", "")
        page.press(TAB)
        page.wait(f"{SCENE}.threshold === 'p > 0.1'")
        page.run("document.querySelector(`[aria-label='flow']`).focus()")
        page.press(ESCAPE)
        self.wait_for_wrong("flow", "")
        self.assertEqual(page.run("return document.querySelector(`[aria-label='flow']`).value"), "velocity")
        self.assertEqual(page.run("return document.getElementById('messages').innerText"), "")
        self.assertEqual(page.complaints(), [])


if __name__ == "__main__":
    unittest.main()
