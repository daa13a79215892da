"""Views: a page's server, and Python beside the page. A second connection, or Chromium, stands for the person."""

import contextlib
import io
import logging
import os
import subprocess
import sys
import threading
import unittest

import elvis
from volumes import WithVolume

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "serve"))
import browser
from serving import Page
from web_socket import WebSocket


class Views(WithVolume):
    def setUp(self) -> None:
        scene = self.volume.scene(field="p", cut_planes=[[0, 0, 1, 0.1]])
        scene.image.size = [64, 48]
        scene.camera = elvis.Camera(eye=[1, -2, 3], look_at=[0, 0, 0])
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.view = scene.view()
        self.assertEqual(said.getvalue(), self.view.url + "\n")
        self.addCleanup(self.view.close)

    def page(self) -> Page:
        address = self.view.url.split("/", 3)
        page = Page(WebSocket(int(address[2].split(":")[1]), f"/session?{address[3].lstrip('?')}"), [64, 48])
        self.addCleanup(page.close)
        return page

    def heard(self, listen) -> "Heard":
        heard = Heard()
        listen(heard)
        return heard

    def test_what_the_page_shows_is_the_scene_here(self):
        page = self.page()
        page.ask(type="set", pointer="/surfaces/0/opacity", value=0.5)
        self.assertEqual(page.exact()["bytes"], self.view.scene.render().png())
        self.assertEqual(self.view.scene.surfaces[0].opacity, 0.5)
        self.view.scene = self.volume.scene(field="p", isosurfaces=[0.4])
        frame = page.exact()
        self.assertEqual(page.state["scene"]["surfaces"][0]["type"], "isosurface")
        self.assertEqual(frame["bytes"], self.view.scene.render().png())

    def test_the_camera_is_read_and_set(self):
        page = self.page()
        seen = self.heard(self.view.on_camera)
        self.assertEqual(self.view.camera.eye, [1, -2, 3])
        page.ask(type="orbit", dx=10, dy=0)
        self.assertNotEqual(seen.wait().eye, [1, -2, 3])
        self.view.camera = {"eye": [3, 2, 1]}
        self.assertEqual(self.view.camera.eye, [3, 2, 1])
        self.assertEqual(self.view.camera.look_at, [0, 0, 0])
        self.assertEqual(page.ask(type="save scene")["scene"]["camera"]["eye"], [3, 2, 1])
        self.view.camera = elvis.Camera(type="orthographic", height=3)
        self.assertEqual(page.ask(type="save scene")["scene"]["camera"]["height"], 3)
        for wrong in ({"eye": [0, 0, 0]}, {"eye": [0, 0, 5], "up": [0, 0, 1]}):
            with self.assertRaises(elvis.Error):
                self.view.camera = wrong
        self.assertEqual(self.view.camera.eye, [3, 2, 1])
        self.view.camera = {"eye": [2, 1, 2], "type": "perspective"}
        self.assertEqual(page.exact()["bytes"], self.view.scene.render().png())

    def test_what_is_picked_comes_here(self):
        page = self.page()
        seen = self.heard(self.view.on_pick)
        self.assertIsNone(self.view.picked)
        told = page.ask(type="pick", column=32.5, row=24.5)["picked"]
        self.assertEqual(seen.wait(), told)
        self.assertEqual(self.view.picked, told)
        self.assertTrue(told["hit"])
        self.assertEqual(told, self.volume.pick(self.view.scene, 32.5, 24.5))

    def test_a_function_that_fails_leaves_the_view_alone(self):
        page = self.page()

        @self.view.on_pick
        def fail(picked):
            raise KeyError("mine")

        seen = self.heard(self.view.on_pick)
        with self.assertLogs("elvis", logging.ERROR) as log:
            page.ask(type="pick", column=32.5, row=24.5)
            seen.wait()
        self.assertIn("mine", log.output[0])

    def test_a_closed_view_says_so(self):
        with contextlib.redirect_stdout(io.StringIO()), self.volume.view(height=300) as view:
            self.assertIn('height="300"', view._repr_html_())
            self.assertIn(view.url.replace("&", "&amp;"), view._repr_html_())
            scene = view.scene
        self.assertFalse(view.is_open)
        self.assertEqual(view.scene, scene)
        with self.assertRaisesRegex(elvis.Error, "closed"):
            view.camera = {"eye": [3, 2, 1]}
        view.close()

    def test_errors_of_the_server_are_told(self):
        with self.assertRaisesRegex(elvis.Error, "missing"):
            self.volume.scene().view(root=self.path("missing"))
        warped = self.volume.warp("velocity", 0.1)
        with self.assertRaisesRegex(ValueError, "warp"):
            warped.view()

    def test_the_server_ends_with_python(self):
        code = "import elvis, os, sys; v = elvis.open(sys.argv[1]).view(); print(v._server._process.pid, flush=True); os._exit(0)"
        done = subprocess.run([sys.executable, "-c", code, self.path("volume.h5")], capture_output=True, text=True, check=True)
        url, pid = done.stdout.split()
        self.assertTrue(url.startswith("http://127.0.0.1:"))
        for _ in range(100):
            if not os.path.exists(f"/proc/{pid}"):
                return
            threading.Event().wait(0.1)
        self.fail("it goes on")

    @unittest.skipUnless(browser.CHROMIUM and browser.DRIVER, "Chromium is not there")
    def test_a_frame_in_a_page_of_another_origin(self):
        with open(self.path("notebook.html"), "w", encoding="utf-8") as file:
            file.write(f"<!doctype html>{self.view._repr_html_()}")
        chromium = browser.Browser(self.folder)
        self.addCleanup(chromium.close)
        picked, moved = self.heard(self.view.on_pick), self.heard(self.view.on_camera)
        chromium.open(f"file://{self.path('notebook.html')}")
        chromium.frame("iframe")
        chromium.wait("window.elvis && elvis.frame().stage === 'exact'")
        chromium.click("#pick-middle")
        self.assertTrue(picked.wait()["hit"])
        chromium.click("#views button:nth-child(2)")
        self.assertEqual(moved.wait().eye, self.view.camera.eye)
        # What Python says is shown there, what is done there is known here, also after the frame is loaded anew.
        settled = "window.elvis && elvis.frame().stage === 'exact' && elvis.frame().revision >= elvis.state().revision"
        self.view.camera = {"eye": [0, 0, 5], "up": [0, 1, 0], "look_at": [0, 0, 0]}
        chromium.wait(f"{settled} && elvis.frame().camera.eye[2] === 5")
        chromium.click("#add")
        chromium.wait(f"{settled} && elvis.state().items.length === 2")
        self.assertEqual([surface.type for surface in self.view.scene.surfaces], ["plane", "boundary"])
        self.assertEqual(bytes(chromium.run("return [...elvis.picture.exact]")), self.view.scene.render().png())
        chromium.run("location.reload()")
        chromium.wait(f"{settled} && elvis.state().items.length === 2")
        self.view.scene = self.volume.scene(field="p", isosurfaces=[0.4])
        chromium.wait(f"{settled} && elvis.state().items[0].label.includes('sosurface')")
        self.assertEqual(chromium.complaints(), [])


class Heard:
    """A function that keeps what it is called with."""

    def __init__(self) -> None:
        self._last = None
        self._has_come = threading.Event()

    def __call__(self, what) -> None:
        self._last = what
        self._has_come.set()

    def wait(self):
        if not self._has_come.wait(60):
            raise AssertionError("nothing has come")
        return self._last


if __name__ == "__main__":
    unittest.main()
