"""A browser without a window, driven over HTTP as the WebDriver standard says."""
import base64
import json
import shutil
import socket
import subprocess
import time
import urllib.error
import urllib.request

CHROMIUM = shutil.which("chromium")
DRIVER = shutil.which("chromedriver")
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Browser:
    def __init__(self, downloads, size=(1000, 700), dark=False, phone=None):
        """`phone`: width and height of a screen that is touched; windows are not that narrow."""
        self.port = free_port()
        self.driver = subprocess.Popen([DRIVER, f"--port={self.port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        arguments = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", f"--window-size={size[0]},{size[1]}",
                     *(["--blink-settings=preferredColorScheme=0"] if dark else [])]
        options = {"binary": CHROMIUM, "args": arguments,
                   "prefs": {"download.default_directory": downloads, "download.prompt_for_download": False}}
        if phone:
            options["mobileEmulation"] = {"deviceMetrics": {"width": phone[0], "height": phone[1], "pixelRatio": 2, "touch": True}}
        capabilities = {"browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
        # Until the driver listens, and a browser that does not start in the driver's time is started again.
        end = time.monotonic() + 90
        while True:
            try:
                made = self.call("POST", "", {"capabilities": {"alwaysMatch": capabilities}}, session="/session")
                break
            except (OSError, AssertionError):
                if time.monotonic() > end:
                    self.driver.kill()
                    raise
                time.sleep(0.2)
        self.session = "/session/" + made["sessionId"]

    def call(self, method, path, body=None, session=None):
        data = json.dumps(body or {}).encode() if method == "POST" else None
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}{session or self.session}{path}", data, method=method,
                                         headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise AssertionError(error.read().decode()[:500]) from None

    def close(self):
        try:
            self.call("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait(20)

    def open(self, url):
        self.call("POST", "/url", {"url": url})

    def run(self, script, *arguments):
        return self.call("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def wait(self, condition, seconds=120):
        """Until the expression is true; returns it."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            value = self.run(f"return {condition}")
            if value:
                return value
            time.sleep(0.05)
        raise AssertionError(f"never: {condition}; " + str(self.run("return document.body.innerText")))

    def find(self, selector):
        return self.call("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def frame(self, selector):
        """What follows is about the page in that frame; None: about the whole page."""
        self.call("POST", "/frame", {"id": {ELEMENT: self.find(selector)} if selector else None})

    def click(self, selector):
        self.call("POST", f"/element/{self.find(selector)}/click")

    def type(self, selector, keys):
        self.call("POST", f"/element/{self.find(selector)}/value", {"text": keys})

    def drag(self, start, way, steps=12, pointer="mouse"):
        """With the mouse or a finger ("touch"), from a place of the page."""
        button = 0
        moves = [{"type": "pointerMove", "duration": 0, "x": start[0], "y": start[1]}, {"type": "pointerDown", "button": button}]
        for i in range(1, steps + 1):
            moves.append({"type": "pointerMove", "duration": 30, "x": round(start[0] + way[0] * i / steps),
                          "y": round(start[1] + way[1] * i / steps)})
        moves.append({"type": "pointerUp", "button": button})
        self.call("POST", "/actions", {"actions": [{"type": "pointer", "id": pointer, "parameters": {"pointerType": pointer}, "actions": moves}]})

    def pinch(self, middle, before, after, steps=8):
        """Two fingers, level, whose distance changes."""
        fingers = []
        for side in (-1, 1):
            places = [round(middle[0] + side * (before + (after - before) * i / steps) / 2) for i in range(steps + 1)]
            moves = [{"type": "pointerMove", "duration": 20 if i else 0, "x": x, "y": middle[1]} for i, x in enumerate(places)]
            fingers.append({"type": "pointer", "id": f"finger{side}", "parameters": {"pointerType": "touch"},
                            "actions": [moves[0], {"type": "pointerDown", "button": 0}, *moves[1:], {"type": "pointerUp", "button": 0}]})
        self.call("POST", "/actions", {"actions": fingers})

    def press(self, *keys):
        actions = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
        self.call("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})

    def screenshot(self, path):
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.call("GET", "/screenshot")))

    def complaints(self):
        """What the browser's console has of errors."""
        return [entry["message"] for entry in self.call("POST", "/se/log", {"type": "browser"}) if entry["level"] == "SEVERE"]
