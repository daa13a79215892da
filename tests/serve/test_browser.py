"""The page of `elvis serve` in Chromium: load, orbit, add, pick, undo, reconnect, save."""
import io
import json
import os
import unittest
import zipfile

import browser
from browser_case import SETTLED, BrowserCase
from test_serve import run

LEFT, UP, RIGHT, DELETE = "\ue012", "\ue013", "\ue014", "\ue017"


class BrowserTest(BrowserCase):
    def test_a_visit(self):
        page = self.page
        page.open(self.server.url)
        page.wait(SETTLED)
        self.assertIn("pixel-exact", page.run("return document.getElementById('mark').textContent"))
        self.shot("loaded.png")
        # What the line below says, however long, leaves the picture as large as it is.
        heights = page.run("""const told = document.getElementById('activity'), before = elvis.picture.view.clientHeight;
            told.textContent = 'drawing '.repeat(200); const long = elvis.picture.view.clientHeight; told.textContent = ''; return [before, long];""")
        self.assertEqual(heights[1], heights[0])

        camera = "(JSON.stringify(elvis.frame().revision))"
        before = page.run(f"return {camera}")
        n_frames = page.run("return elvis.picture.times.length")
        page.drag((300, 350), (150, 40))
        page.wait(SETTLED)
        self.assertNotEqual(page.run(f"return {camera}"), before)
        self.assertGreater(page.run("return elvis.picture.times.length"), n_frames + 1)

        revision = page.run("return elvis.frame().revision")
        page.drag((300, 350), (-40, 40), pointer="touch")
        page.wait(f"{SETTLED} && elvis.frame().revision > {revision}")

        n = self.n_items()
        self.add("Cut plane")
        page.click("#items li:first-child input")
        page.wait(SETTLED)
        self.shot("plane.png")

        middle = page.run("""const box = document.getElementById('view').getBoundingClientRect();
                             return [Math.round(box.left + box.width / 2), Math.round(box.top + box.height / 2)]""")
        page.drag(middle, (0, 0), steps=1)
        page.wait("document.querySelector('#picked table')")
        self.assertIn("xi", page.run("return document.getElementById('picked').innerText"))
        self.assertEqual(page.run("return [document.body.scrollTop, document.documentElement.scrollTop, document.body.scrollHeight <= innerHeight]"), [0, 0, True])
        self.shot("picked.png")
        page.click("#panel-toggle")
        page.wait(f"{SETTLED} && elvis.frame().size[0] === innerWidth && elvis.frame().size[1] === innerHeight")
        self.shot("full.png")
        page.click("#panel-toggle")
        page.wait(f"{SETTLED} && elvis.frame().size[0] < innerWidth")

        page.click("#undo")
        page.click("#undo")
        page.wait(f"document.querySelectorAll('#items li').length === {n}")
        page.click("#redo")
        page.wait(f"document.querySelectorAll('#items li').length === {n + 1}")

        page.run("elvis.connection.socket.close()")
        page.wait("elvis.connection.socket && elvis.connection.socket.readyState === 1")
        page.wait(SETTLED)
        self.assertEqual(self.n_items(), n + 1)
        page.open(self.server.url)
        page.wait(SETTLED)
        self.assertEqual(self.n_items(), n + 1)

        page.click("#save-scene")
        scene = json.loads(self.downloaded("waves.json"))
        page.click("#save-picture")
        picture = self.downloaded("waves.png")
        path = os.path.join(self.folder, "saved.json")
        with open(path, "w") as file:
            json.dump(scene, file)
        run("render", path, "-o", os.path.join(self.folder, "drawn.png"))
        with open(os.path.join(self.folder, "drawn.png"), "rb") as file:
            self.assertEqual(file.read(), picture)

        page.run("document.getElementById('view').focus()")
        revision = page.run("return elvis.frame().revision")
        page.press(LEFT, LEFT, "+")  # Left, left, nearer.
        page.wait(f"{SETTLED} && elvis.frame().revision > {revision}")
        page.click("#undecided")
        page.wait("document.getElementById('counts').textContent.includes('undecided')")
        self.shot("keys.png")
        self.assertEqual(self.without_names(), [])
        self.assertEqual(page.complaints(), [])

    def test_dark_on_a_phone(self):
        """All of the volume is seen at first, panels do not lie over each other, and two fingers zoom and move."""
        phone = browser.Browser(self.folder, dark=True, phone=(400, 800))
        self.addCleanup(phone.close)
        phone.open(self.server.url)
        phone.wait(SETTLED)
        phone.screenshot(os.path.join(self.shots, "phone.png"))
        self.assertTrue(phone.run("return matchMedia('(prefers-color-scheme: dark)').matches"))
        boxes = phone.run("""return ['bar', 'view', 'panel', 'status'].map((id) => {
            const box = document.getElementById(id).getBoundingClientRect(); return [box.top, box.bottom, box.left, box.right]})""")
        for above, below in zip(boxes, boxes[1:]):
            self.assertLessEqual(above[1], below[0])
        self.assertTrue(all(0 <= left and right <= 400 and bottom <= 800 for _, bottom, left, right in boxes), boxes)
        self.assertGreater(boxes[1][1] - boxes[1][0], 200)
        corners = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        self.assertTrue(phone.run("""const corners = arguments[0];
            return elvis.connection.ask({type: 'overlay', points: corners}).then(({points}) =>
                points.every(([x, y]) => x >= 0 && y >= 0 && x <= elvis.picture.size[0] && y <= elvis.picture.size[1]))""", corners))

        middle = [200, round((boxes[1][0] + boxes[1][1]) / 2)]
        distance = """return elvis.connection.ask({type: 'save scene'}).then(({scene: {camera}}) =>
            Math.hypot(...camera.eye.map((x, i) => x - camera.look_at[i])))"""
        before, revision = phone.run(distance), phone.run("return elvis.frame().revision")
        phone.pinch(middle, 60, 120)
        phone.wait(f"{SETTLED} && elvis.frame().revision > {revision}")
        self.assertAlmostEqual(phone.run(distance), before / 2, delta=0.05 * before)
        self.assertEqual(phone.complaints(), [])

    def test_tools_by_hand_and_by_keys(self):
        page = self.page
        page.open(self.server.url)
        page.wait(SETTLED)
        scene = "elvis.state().scene"
        self.add("Cut plane")
        page.click("#items li:first-child input")
        page.wait("document.querySelectorAll('.grip').length === 2")
        page.wait(SETTLED)

        # Handles: dragged, then moved by keys, each of it one step.
        plane = f"{scene}.surfaces[1].plane"
        at = page.run("const box = document.querySelector('.grip').getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2]")
        page.drag([round(x) for x in at], (-18, 11))
        page.wait(f"{SETTLED} && {plane}[3] !== 0 && Math.abs({plane}[3]) > 0.05")
        moved = page.run(f"return {plane}")
        self.assertEqual(moved[:3], [0, 0, 1])
        page.run("document.querySelector('.grip[data-name=turn]').focus()")
        page.press(RIGHT)
        page.wait(f"{SETTLED} && {plane}[2] < 1")
        self.shot("handles.png")
        page.click("#undo")
        page.wait(f"{plane}[2] === 1")

        # A line by two clicks, its cursor by keys, its values as text.
        page.click("#items li:first-child .label")
        page.wait("document.querySelectorAll('.grip').length === 0")
        page.run("[...document.querySelectorAll('#line button')][0].click()")
        middle = page.run("""const box = document.getElementById('view').getBoundingClientRect();
                             return [Math.round(box.left + box.width / 2), Math.round(box.top + box.height / 2)]""")
        page.drag([middle[0] - 40, middle[1]], (0, 0), steps=1)
        page.wait("document.querySelectorAll('#line input')[0].value !== ''")
        page.drag([middle[0] + 30, middle[1] + 20], (0, 0), steps=1)
        page.wait("document.querySelector('#line-plot path.curve')")
        self.assertIsNone(page.run("return document.querySelector('#picked table')"))
        page.run("document.querySelector('.plot').focus()")
        page.press(RIGHT, RIGHT)
        page.wait("document.querySelector('.told').textContent.includes('p = ')")
        page.wait("document.querySelectorAll('#marks .mark').length === 3")
        self.shot("line.png")
        page.run("[...document.querySelectorAll('#line button')].find((b) => b.textContent === 'Save values').click()")
        self.assertTrue(self.downloaded("line.csv").startswith(b"arc_length,x,y,z,element,p\n"))

        # The range by keys.
        page.run("document.querySelector('[aria-label=\"Upper end of the colours\"]').focus()")
        page.press(LEFT, LEFT, LEFT)
        page.wait(f"{scene}.color_map && {scene}.color_map.range && {scene}.color_map.range[1] < 2")
        self.assertEqual(page.run("return document.activeElement.getAttribute('aria-label')"), "Upper end of the colours")

        # The transfer function: points are made, moved and removed.
        self.add("Volume")
        page.wait("document.querySelector('.transfer')")
        density = f"{scene}.volume_rendering.density"
        self.by_label("own density")
        page.wait(f"{density} && {density}.length === 3")
        page.run("[...document.querySelectorAll('#item-editor button')].find((b) => b.textContent === 'Add point').click()")
        page.wait(f"{density}.length === 4")
        page.run("document.querySelector('[aria-label=\"Point 2 of the density\"]').focus()")
        page.press(UP, UP, RIGHT)
        page.wait(f"{density}[1][1] > 0")
        page.press(DELETE)
        page.wait(f"{density}.length === 3")
        page.run("[...document.querySelectorAll('#item-editor button')].find((b) => b.textContent === 'Add peak').click()")
        page.wait(f"{scene}.volume_rendering.peaks")
        page.wait(SETTLED)
        self.shot("transfer.png")

        # Light and annotation.
        self.add("Point light")
        page.wait(f"{scene}.lighting.lights")
        page.run("const x = document.querySelector('[aria-label=\"position x\"]'); x.value = 3; x.onchange()")
        page.wait(f"{scene}.lighting.lights[0].position[0] === 3")
        page.run("document.querySelector('[aria-label=\"own annotation title\"]').click()")
        page.wait(f"{scene}.image.annotation.title === ''")
        page.run("const t = document.querySelector('[aria-label=\"annotation title\"]'); t.value = 'Mine'; t.onchange()")
        page.wait(f"{scene}.image.annotation.title === 'Mine'")
        page.wait(SETTLED)
        self.shot("lights.png")

        # Play.
        page.click("#play")
        page.wait(f"{scene}.volume.time_step === 1")
        page.wait(f"{scene}.volume.time_step === 2")
        page.click("#play")
        page.wait("document.getElementById('play').textContent === 'Play'")
        page.wait(SETTLED)
        step = page.run(f"return {scene}.volume.time_step")
        self.assertEqual(page.run(f"return {scene}.volume.time_step"), step)
        self.assertEqual(self.without_names(), [])
        self.assertEqual(page.run("return document.getElementById('messages').innerText"), "")
        self.assertEqual(page.complaints(), [])

    def test_integrals_films_and_pictures_of_other_formats(self):
        page = self.page
        page.open(self.server.url)
        page.wait(SETTLED)
        answer = "document.getElementById('integral').innerText"

        def choose(label, value):
            page.run("const c = document.querySelector(`[aria-label='${arguments[0]}']`); c.value = arguments[1]; c.onchange()", label, value)

        def press(words):
            page.run("[...document.querySelectorAll('#integrals button')].find((b) => b.textContent === arguments[0]).click()", words)

        def shown(name):
            return page.run("return [...document.querySelectorAll('#integral tr')].find((r) => r.firstChild.textContent === arguments[0]).lastChild.innerText", name)

        # The plane is that of the selected item.
        self.add("Cut plane")
        page.wait(SETTLED)
        choose("What is integrated over", "plane")
        choose("Field of the integral", "p")
        press("Integrate")
        page.wait(f"{answer}.includes('evaluations')")
        self.shot("integral.png")
        expected = json.loads(run("integrate", self.volume, "--cut-plane", "0,0,1,0", "--field", "p").stdout)
        self.assertEqual(float(shown("integral")), expected["value"])
        self.assertEqual(float(shown("measure")), expected["measure"])
        press("Extrema")
        page.wait(f"{answer}.includes('maximum')")
        self.assertEqual(float(shown("maximum")), json.loads(run("extrema", self.volume, "--field", "p").stdout)["maximum"]["value"])
        choose("What is integrated over", "isosurface")
        press("Integrate")
        page.wait("document.getElementById('messages').innerText.includes('has a value')")

        page.click("#save-scene")
        path = os.path.join(self.folder, "saved.json")
        with open(path, "wb") as file:
            file.write(self.downloaded("waves.json"))
        page.run("document.getElementById('save-format').value = 'svg'")
        page.click("#save-picture")
        picture = self.downloaded("waves.svg")
        run("render", path, "-o", os.path.join(self.folder, "drawn.svg"))
        with open(os.path.join(self.folder, "drawn.svg"), "rb") as file:
            self.assertEqual(file.read(), picture)

        # A film is stopped, and made.
        self.assertTrue(page.run("return document.getElementById('save-film').disabled"))
        animate = "return elvis.connection.ask({type: 'set', pointer: '/animation', value: {turntable: {frames: arguments[0]}}, name: 'animation'})"
        page.run(animate, 500)
        page.wait(f"{SETTLED} && !document.getElementById('save-film').disabled")
        page.click("#save-film")
        page.wait("!document.getElementById('work').hidden")
        self.shot("film.png")
        page.wait("document.getElementById('work-progress').value > 0")
        page.click("#work-stop")
        page.wait("document.getElementById('work').hidden")
        page.run(animate, 3)
        for id, value in (("save-width", 40), ("save-height", 30)):
            page.run("document.getElementById(arguments[0]).value = arguments[1]", id, value)
        page.click("#save-film")
        film = zipfile.ZipFile(io.BytesIO(self.downloaded("waves-film.zip")))
        self.assertIsNone(film.testzip())
        page.click("#save-scene")
        with open(path, "wb") as file:
            file.write(self.downloaded("waves.json"))
        run("render", path, "--size", "40x30", "-o", os.path.join(self.folder, "film"))
        names = sorted(os.listdir(os.path.join(self.folder, "film")))
        self.assertEqual(film.namelist(), names)
        for name in names:
            with open(os.path.join(self.folder, "film", name), "rb") as file:
                self.assertEqual(film.read(name), file.read())
        self.assertEqual(self.without_names(), [])
        self.assertEqual(page.complaints(), [])

    def test_colours_are_dragged_on_their_scale(self):
        page = self.page
        page.open(self.server.url)
        page.wait(SETTLED)
        points = "elvis.state().scene.color_map?.points"
        value = {"points": [[0, 0, 0, 1], [4, 1, 1, 1], [10, 1, 0, 0]]}
        page.run("""return elvis.connection.ask({type: 'set', pointer: '/color_map', name: 'colours', value: arguments[0]})
            .then(() => elvis.connection.ask({type: 'release'}))""", value)
        scale = "document.querySelector('#color-editor .scale')"
        page.wait(f"{points}?.length === 3 && {scale}.querySelector('.color-point')?.hasAttribute('cx')")
        page.run(f"{scale}.scrollIntoView({{block: 'center'}})")
        box = page.run(f"const b = {scale}.querySelector('.outside').getBoundingClientRect(); return [b.left, b.top + b.height / 2, b.width]")

        def place(position):
            return [round(box[0] + box[2] * position / 10), round(box[1])]

        page.drag(place(4), (round(0.3 * box[2]), 0))
        page.wait(f"{points}[1][0] > 6.8")
        moved = page.run(f"return {points}")
        self.assertAlmostEqual(moved[1][0], 7, delta=0.15)
        self.assertEqual([moved[0], moved[1][1:], moved[2]], [[0, 0, 0, 1], [1, 1, 1], [10, 1, 0, 0]])
        page.wait(SETTLED)
        self.shot("colour-points.png")
        page.click("#undo")  # All of it is one step.
        page.wait(f"{points}[1][0] === 4")
        page.run(f"{scale}.querySelector('.color-point').focus()")
        page.press(RIGHT)
        page.wait(f"{points}[1][0] === 4.1")
        page.run(f"{scale}.dispatchEvent(new MouseEvent('dblclick', {{clientX: arguments[0], clientY: arguments[1]}}))", *place(7))
        page.wait(f"{points}.length === 4")
        added = page.run(f"return {points}[2]")
        self.assertAlmostEqual(added[0], 7, delta=0.1)
        share = (7 - 4.1) / (10 - 4.1)
        self.assertLess(max(abs(found - wanted) for found, wanted in zip(added[1:], (1, 1 - share, 1 - share))), 0.02)
        page.run(f"{scale}.querySelectorAll('.color-point')[0].focus()")
        page.press(DELETE)
        page.wait(f"{points}.length === 3")
        self.assertEqual(self.without_names(), [])
        self.assertEqual(page.complaints(), [])


if __name__ == "__main__":
    unittest.main()
