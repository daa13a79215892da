"""A view in a notebook as people have it: Jupyter runs the cells, Chromium shows them, and Python hears of what is done in the frame."""

import importlib.util
import json
import os
import subprocess
import sys
import time
import unittest
import urllib.request

from volumes import WithVolume

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "serve"))
import browser

TOKEN = "0" * 32
CELLS = [
    """import elvis, threading
view = elvis.open("volume.h5").scene(field="p", cut_planes=[[0, 0, 1, 0.1]]).view(height=300)
heard = threading.Event()
view.on_pick(lambda picked: heard.set())
view""",
    """heard.wait(60)
print("picked", view.picked["hit"], sorted(field["name"] for field in view.picked["fields"]))
view.camera = {"eye": [0, 0, 5], "up": [0, 1, 0], "look_at": [0, 0, 0]}""",
    """with open("seen.png", "wb") as file:
    file.write(view.scene.render().png())
print("surfaces", [surface.type for surface in view.scene.surfaces])
view.close()""",
]


def missing() -> str:
    modules = {"notebook": "jupyter-notebook", "ipykernel": "python3-ipykernel"}
    names = [package for module, package in modules.items() if importlib.util.find_spec(module) is None]
    return " and ".join(names + [name for name, path in (("chromium", browser.CHROMIUM), ("chromium-driver", browser.DRIVER)) if not path])


@unittest.skipIf(missing(), f"{missing()} not installed: views are not tested in a notebook")
class Notebook(WithVolume):
    def setUp(self) -> None:
        cells = [{"cell_type": "code", "source": text, "metadata": {}, "outputs": [], "execution_count": None} for text in CELLS]
        kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
        with open(self.path("look.ipynb"), "w", encoding="utf-8") as file:
            json.dump({"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 4}, file)
        own = {name: self.path(name.lower()) for name in ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")}
        self.port = browser.free_port()
        self.log = open(self.path("jupyter.log"), "w+", encoding="utf-8")  # noqa: SIM115
        self.addCleanup(self.log.close)
        jupyter = subprocess.Popen([sys.executable, "-m", "notebook", "--no-browser", "--allow-root", "--ip=127.0.0.1", f"--port={self.port}", "--port-retries=0",
                                    f"--NotebookApp.token={TOKEN}", f"--notebook-dir={self.folder}"],
                                   stdout=self.log, stderr=self.log, env={**os.environ, **own})
        self.addCleanup(jupyter.wait, 30)
        self.addCleanup(jupyter.terminate)
        self.wait_for(lambda: urllib.request.urlopen(f"http://127.0.0.1:{self.port}/api?token={TOKEN}", timeout=5))
        self.page = browser.Browser(self.folder)
        self.addCleanup(self.page.close)

    def wait_for(self, call) -> None:
        end = time.monotonic() + 60
        while True:
            try:
                return call()
            except OSError:
                if time.monotonic() > end:
                    self.log.seek(0)
                    raise AssertionError(self.log.read()) from None
                time.sleep(0.2)

    def run_cell(self, index: int, wanted: str) -> str:
        """Runs it, until its output, as HTML, has that."""
        output = f"Jupyter.notebook.get_cell({index}).output_area.element[0].innerHTML"
        self.page.run(f"Jupyter.notebook.execute_cells([{index}])")
        return self.page.wait(f"{output}.includes({json.dumps(wanted)}) && {output}")

    def test_a_view_in_a_notebook_is_turned_and_tells_what_is_picked(self):
        page = self.page
        page.open(f"http://127.0.0.1:{self.port}/notebooks/look.ipynb?token={TOKEN}")
        page.wait("window.Jupyter && Jupyter.notebook && Jupyter.notebook.kernel && Jupyter.notebook.kernel.is_connected()")
        self.run_cell(0, "<iframe")
        page.frame(".output iframe")
        page.wait("window.elvis && elvis.frame().stage === 'exact'")
        page.click("#pick-middle")
        page.wait("document.querySelector('#picked table')")
        page.frame(None)
        self.assertIn("True ['p', 'pressure', 'velocity']", self.run_cell(1, "picked"))
        page.frame(".output iframe")
        page.wait("elvis.connection.ask({type: 'save scene'}).then(({scene}) => scene.camera.eye[2] === 5)")
        page.click("#add")
        page.wait("elvis.state().items.length === 2 && elvis.frame().stage === 'exact' && elvis.frame().revision >= elvis.state().revision")
        seen = bytes(page.run("return Array.from(elvis.picture.exact)"))
        page.frame(None)
        self.assertIn("['plane', 'boundary']", self.run_cell(2, "surfaces"))
        with open(self.path("seen.png"), "rb") as file:
            self.assertEqual(file.read(), seen)


if __name__ == "__main__":
    unittest.main()
