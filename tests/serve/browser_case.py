"""The page in Chromium: what its tests share."""
import os
import tempfile
import time
import unittest

import browser
from serving import Server
from test_serve import make_volume

SETTLED = "window.elvis && elvis.frame().stage === 'exact' && elvis.frame().revision >= elvis.state().revision"


def missing():
    return " and ".join(name for name, path in (("chromium", browser.CHROMIUM), ("chromium-driver", browser.DRIVER)) if not path)


@unittest.skipIf(missing(), f"{missing()} not installed: the page is not tested in a browser")
class BrowserCase(unittest.TestCase):
    SIZE = (1000, 700)

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="elvis-browser-test-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        cls.volume = make_volume(cls.folder)
        cls.server = Server(cls.volume)

    @classmethod
    def tearDownClass(cls):
        status = cls.server.stop()
        if status != 0:
            raise AssertionError(f"it ended with status {status}: {''.join(cls.server.errors)}")

    def setUp(self):
        self.page = browser.Browser(self.folder, self.SIZE)
        self.addCleanup(self.page.close)
        self.shots = os.environ.get("ELVIS_SCREENSHOTS", self.folder)

    def shot(self, name):
        self.page.screenshot(os.path.join(self.shots, name))

    def n_items(self):
        return self.page.run("return document.querySelectorAll('#items li').length")

    def add(self, name):
        """An item of that kind, as the last one."""
        n = self.n_items()
        self.page.run("document.getElementById('new-item').value = elvis.state().addable.find((item) => item.name.startsWith(arguments[0])).name", name)
        self.page.click("#add")
        self.page.wait(f"document.querySelectorAll('#items li').length === {n + 1}")

    def downloaded(self, name):
        path = os.path.join(self.folder, name)
        end = time.monotonic() + 60
        while not (os.path.exists(path) and os.path.getsize(path)) and time.monotonic() < end:
            time.sleep(0.1)
        with open(path, "rb") as file:
            content = file.read()
        os.remove(path)  # The next one of that name has another name otherwise.
        return content

    def by_label(self, words):
        self.page.run("[...document.querySelectorAll('label')].find((l) => l.textContent.trim() === arguments[0]).querySelector('input').click()", words)

    def without_names(self):
        """Controls that a screen reader has no name for."""
        return self.page.run("""return [...document.querySelectorAll('button, input, select, [tabindex]')].filter(
            (e) => !(e.getAttribute('aria-label') || e.textContent.trim() || e.closest('label'))).map((e) => e.outerHTML)""")
