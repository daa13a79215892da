"""A window of ElVis on a display of its own, moved by true X events."""
import json
import os
import shutil
import subprocess
import time

PROGRAMS = {"Xvfb": "xvfb", "xdotool": "xdotool", "import": "imagemagick", "convert": "imagemagick"}


class Failure(Exception):
    pass


def require(condition, message):
    if not condition:
        raise Failure(message)


def check_programs():
    for program, package in PROGRAMS.items():
        require(shutil.which(program), f"{program} is missing: install the Debian package {package}")


class Display:
    """Xvfb on the first free display."""

    def __init__(self, width=1600, height=1000):
        read_end, write_end = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write_end), "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp"],
            pass_fds=[write_end], stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(read_end) as answer:
            number = answer.readline().strip()
        require(number, "Xvfb did not start")
        self.name = ":" + number

    def close(self):
        self.process.terminate()
        self.process.wait()


class Window:
    """`elvis view`. What is on the screen it tells in a file; what happens to it comes through X."""

    def __init__(self, elvis, display, folder, arguments):
        self.folder = folder
        self.description = os.path.join(folder, "screen.json")
        if os.path.exists(self.description):
            os.remove(self.description)
        self.environment = dict(os.environ, DISPLAY=display.name, XDG_CONFIG_HOME=os.path.join(folder, "config"))
        self.log = open(os.path.join(folder, "view.log"), "w")
        self.process = subprocess.Popen([elvis, "view", "--describe", self.description] + arguments, cwd=folder,
                                        env=self.environment, stdout=self.log, stderr=self.log)
        self.wait_for(lambda screen: True, "the window to open")

    def screen(self):
        require(self.process.poll() is None, f"the window has gone, with status {self.process.poll()}")
        try:
            with open(self.description) as file:
                return json.load(file)
        except FileNotFoundError:
            return None

    def wait_for(self, condition, what, seconds=120):
        end = time.time() + seconds
        while time.time() < end:
            screen = self.screen()
            if screen is not None and condition(screen):
                return screen
            time.sleep(0.05)
        raise Failure(f"waited {seconds} s for {what}; the screen says {self.summary()}")

    def summary(self):
        screen = self.screen() or {}
        return {key: value for key, value in screen.items() if key not in ("places", "scene")}

    def settle(self):
        """Until the picture is full and nothing is being done, for a while."""
        end = time.time() + 180
        calm_since = None
        while time.time() < end:
            screen = self.screen()
            if screen is None or not screen["settled"]:
                calm_since = None
            elif calm_since is None:
                calm_since = time.time()
            elif time.time() - calm_since > 0.4:
                return screen
            time.sleep(0.05)
        raise Failure(f"the picture was not finished in 180 s; the screen says {self.summary()}")

    def xdotool(self, *arguments):
        subprocess.run(["xdotool"] + [str(argument) for argument in arguments], env=self.environment, check=True)

    def place(self, name, across=0.5, down=0.5):
        screen = self.wait_for(lambda screen: name in screen["places"], f"'{name}' to be on the screen", 20)
        left, top, right, bottom = screen["places"][name]
        return int(left + across * (right - left)), int(top + down * (bottom - top))

    def click(self, name, across=0.5, down=0.5, button=1, twice=False):
        self.xdotool("mousemove", *self.place(name, across, down))
        time.sleep(0.2)  # ImGui takes a press for what was below the cursor in the frame before.
        for _ in range(2 if twice else 1):
            self.xdotool("mousedown", button)
            time.sleep(0.08)
            self.xdotool("mouseup", button)
            time.sleep(0.08)
        time.sleep(0.3)

    def drag(self, start, by, button=1, steps=12, pause=0.05, during=None):
        self.xdotool("mousemove", *start)
        time.sleep(0.2)
        self.xdotool("mousedown", button)
        time.sleep(0.1)
        for step in range(1, steps + 1):
            self.xdotool("mousemove", int(start[0] + by[0] * step / steps), int(start[1] + by[1] * step / steps))
            time.sleep(pause)
            if during:
                during(self.screen())
        self.xdotool("mouseup", button)
        time.sleep(0.2)

    def wheel(self, place, turns):
        self.xdotool("mousemove", *place)
        time.sleep(0.1)
        for _ in range(abs(turns)):
            self.xdotool("click", 4 if turns > 0 else 5)
            time.sleep(0.05)

    def key(self, keys):
        # Down for a while, as by hand: dialogs look at keys once a frame.
        self.xdotool("key", "--delay", 150, keys)
        time.sleep(0.3)

    def write(self, text):
        self.xdotool("key", "ctrl+a")
        time.sleep(0.2)
        self.xdotool("type", "--delay", 30, text)
        time.sleep(0.2)

    def picture(self, path):
        """What the screen shows, as a file."""
        time.sleep(0.3)
        screen = self.screen()
        subprocess.run(["import", "-window", "root", path], env=self.environment, check=True)
        return screen

    def close(self):
        """Returns the exit status."""
        if self.process.poll() is None:
            self.process.kill()
        status = self.process.wait()
        self.log.close()
        return status


def pixels(path, box=None):
    """Width, height and the bytes of an image, three a pixel; of the part `box` (x, y, width, height)."""
    crop = ["-crop", "{2}x{3}+{0}+{1}".format(*box), "+repage"] if box else []
    size = subprocess.run(["convert", path] + crop + ["-format", "%w %h", "info:"], capture_output=True, check=True, text=True)
    width, height = (int(number) for number in size.stdout.split())
    raw = subprocess.run(["convert", path] + crop + ["-depth", "8", "rgb:-"], capture_output=True, check=True)
    return width, height, raw.stdout
