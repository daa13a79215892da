"""The page of `elvis serve` in Chromium: load, orbit, add, pick, undo, reconnect, save."""
import json
import os
import tempfile
import time
import unittest

import browser
from serving import Server
from test_serve import make_volume, run

SETTLED = "window.elvis && elvis.frame().stage === 'exact' && elvis.frame().revision >= elvis.state().revision"


def missing():
    return " and ".join(name for name, path in (("chromium", browser.CHROMIUM), ("chromium-driver", browser.DRIVER)) if not path)


@unittest.skipIf(missing(), f"{missing()} not installed: the page is not tested in a browser")
class BrowserTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="elvis-browser-test-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.server = Server(make_volume(self.folder))
        self.addCleanup(lambda: self.assertEqual(self.server.stop(), 0))
        self.page = browser.Browser(self.folder)
        self.addCleanup(self.page.close)
        self.shots = os.environ.get("ELVIS_SCREENSHOTS", self.folder)

    def shot(self, name):
        self.page.screenshot(os.path.join(self.shots, name))

    def n_items(self):
        return self.page.run("return document.querySelectorAll('#items li').length")

    def downloaded(self, name):
        path = os.path.join(self.folder, name)
        end = time.monotonic() + 30
        while not os.path.exists(path) and time.monotonic() < end:
            time.sleep(0.1)
        with open(path, "rb") as file:
            return file.read()

    def test_a_visit(self):
        page = self.page
        page.open(self.server.url)
        page.wait(SETTLED)
        self.assertIn("pixel-exact", page.run("return document.getElementById('mark').textContent"))
        self.shot("loaded.png")

        camera = "(JSON.stringify(elvis.frame().revision))"
        before = page.run(f"return {camera}")
        n_frames = page.run("return elvis.picture.times.length")
        page.drag((300, 350), (150, 40))
        page.wait(SETTLED)
        self.assertNotEqual(page.run(f"return {camera}"), before)
        self.assertGreater(page.run("return elvis.picture.times.length"), n_frames + 1)

        n = self.n_items()
        page.run("document.getElementById('new-item').value = 'Cut plane'")
        page.click("#add")
        page.wait(f"document.querySelectorAll('#items li').length === {n + 1}")
        page.click("#items li:first-child input")
        page.wait(SETTLED)
        self.shot("plane.png")

        page.drag((350, 350), (0, 0), steps=1)
        page.wait("document.querySelector('#picked table')")
        self.assertIn("xi", page.run("return document.getElementById('picked').innerText"))
        self.shot("picked.png")

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
        page.press("\ue012", "\ue012", "+")  # Left, left, nearer.
        page.wait(f"{SETTLED} && elvis.frame().revision > {revision}")
        page.click("#undecided")
        page.wait("document.getElementById('counts').textContent.includes('undecided')")
        self.shot("keys.png")
        self.assertEqual(page.run("""return [...document.querySelectorAll('button, input, select')].filter(
            (e) => !(e.getAttribute('aria-label') || e.textContent.trim() || e.closest('label'))).map((e) => e.outerHTML)"""), [])
        self.assertEqual(page.complaints(), [])


if __name__ == "__main__":
    unittest.main()
