"""`elvis serve` as a program talks to it: who may come, what sessions do, and what it withstands."""
import json
import os
import random
import re
import subprocess
import tempfile
import threading
import time
import unittest

from serving import PROGRAM, Server
from web_socket import Closed, Refused, WebSocket, connect

SIZE = [160, 120]
SCENE = {
    "version": 1,
    "volume": {"path": "waves.h5"},
    "camera": {"eye": [1.2, -1.9, 2.6], "look_at": [0, 0, 0]},
    "image": {"size": SIZE, "annotation": "default"},
    "surfaces": [{"type": "plane", "plane": [0, 0, 1, 0], "contours": {"count": 5}}, {"type": "boundary", "opacity": 0.3}],
}


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, text=True)


def make_volume(folder):
    """27 bent hexahedra with p = x^2 y + z and the Taylor-Green vortex."""
    source = os.path.join(folder, "input.json")
    with open(source, "w") as file:
        json.dump({"generator": 1, "mesh": "waves", "elements": [3, 3, 3], "geometry_order": 2, "time_steps": 3,
                   "fields": [{"field": "polynomial", "name": "p", "coefficients": [[2, 1, 0, 1], [0, 0, 1, 1]]},
                              "taylor-green"]}, file)
    volume = os.path.join(folder, "waves.h5")
    run("convert", source, "-o", volume)
    return volume


class ServeTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="elvis-serve-test-")
        cls.inside = os.path.join(cls.folder.name, "inside")
        os.mkdir(cls.inside)
        cls.volume = make_volume(cls.inside)
        cls.scene = os.path.join(cls.inside, "scene.json")
        with open(cls.scene, "w") as file:
            json.dump(SCENE, file)
        cls.server = Server(cls.scene)

    @classmethod
    def tearDownClass(cls):
        status = cls.server.stop()
        cls.folder.cleanup()
        if status != 0:
            raise AssertionError(f"it ended with status {status}: {''.join(cls.server.errors)}")

    def page(self, **arguments):
        page = self.server.page(**arguments)
        self.addCleanup(page.close)
        return page

    def drawn_by_render(self, scene, size=None):
        path = os.path.join(self.inside, "drawn.json")
        with open(path, "w") as file:
            json.dump(scene, file)
        picture = os.path.join(self.inside, "drawn.png")
        run("render", path, "-o", picture, *(["--size", f"{size[0]}x{size[1]}"] if size else []))
        with open(picture, "rb") as file:
            return file.read()

    # Who may come.

    def test_page_needs_the_token_and_its_files_do_not(self):
        self.assertEqual(self.server.get("/")[0], 403)
        self.assertEqual(self.server.get("/?token=" + "0" * 48)[0], 403)
        for prefix in ("", "/user/me/proxy"):
            status, headers, body = self.server.get(f"{prefix}/?token={self.server.token}")
            self.assertEqual(status, 200)
            self.assertIn(b"<!doctype html>", body)
            self.assertNotIn(self.server.token.encode(), body)
            self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
            status, headers, body = self.server.get(f"{prefix}/main.js")
            self.assertEqual((status, headers["Content-Type"]), (200, "text/javascript; charset=utf-8"))

    def test_page_names_no_other_place(self):
        body = self.server.get(f"/?token={self.server.token}")[2].decode()
        for file in ("main.js", "style.css"):
            self.assertIn(f'"{file}"', body)
        self.assertNotIn("//", body.replace("<!doctype", ""))

    def test_files_of_the_machine_are_not_served(self):
        for path in ("/../../../../etc/passwd", "/scene.json", "/waves.h5", "/%2e%2e/etc/passwd", "/main.js/../scene.json"):
            self.assertEqual(self.server.get(path)[0], 404, path)

    def test_session_needs_the_token(self):
        for token in ("0" * 48, "x", self.server.token[:-1], self.server.token + "0"):
            with self.assertRaises(Refused) as refused:
                self.server.socket(token=token)
            self.assertEqual(refused.exception.status, 403)

    def test_pages_of_other_origins_are_refused(self):
        for origin in ("http://evil.example", "null", f"http://127.0.0.1:{self.server.port}.evil.example", "http://127.0.0.1:1"):
            with self.assertRaises(Refused) as refused:
                self.server.socket(headers=[f"Origin: {origin}"])
            self.assertEqual(refused.exception.status, 403)
        self.server.socket(headers=[f"Origin: http://127.0.0.1:{self.server.port}"]).close()

    # Sessions.

    def test_still_frame_is_what_render_draws(self):
        page = self.page()
        frame = page.exact()
        with open(self.scene) as file:
            self.assertEqual(frame["bytes"], self.drawn_by_render(json.load(file)))
        self.assertEqual(frame["mime"], "image/png")
        self.assertIn("undecided_pixels", frame["counts"])
        stages = [f["stage"] for f in page.frames]
        self.assertEqual(stages[0], "moving")
        self.assertTrue(page.frames[0]["bytes"].startswith(b"\xff\xd8"))

    def test_saved_scene_and_picture_are_what_render_draws(self):
        page = self.page(size=[200, 100])
        page.tell(type="orbit", dx=30, dy=-10)
        page.ask(type="add", name="Sphere")
        frame = page.exact()
        saved = page.ask(type="save scene")
        self.assertEqual(frame["bytes"], self.drawn_by_render(saved["scene"]))
        self.assertEqual(json.loads(saved["text"]), saved["scene"])
        picture = page.ask(type="save picture", width=120, height=90)
        self.assertEqual(picture["bytes"], self.drawn_by_render(saved["scene"], [120, 90]))

    def test_edits_are_judged_and_undone(self):
        page = self.page()
        before = page.state["scene"]
        answer = page.ask(type="set", pointer="/surfaces/1/opacity", value=0.5, name="opacity")
        self.assertEqual(answer["type"], "answer")
        self.assertEqual(page.state["scene"]["surfaces"][1]["opacity"], 0.5)
        self.assertEqual(page.state["undo"], "opacity")
        for pointer, value, word in (("/surfaces/1/opacity", 3, "opacity"), ("/surfaces/7/opacity", 1, "place '7'"),
                                     ("/nonsense", 1, "nonsense"), ("surfaces", 1, "'/'"), ("/surfaces/0", "x", "surfaces")):
            wrong = page.ask(type="set", pointer=pointer, value=value)
            self.assertEqual(wrong["type"], "error", pointer)
            self.assertIn(word, wrong["text"])
        page.ask(type="undo")
        self.assertEqual(page.state["scene"], before)
        page.ask(type="redo")
        self.assertEqual(page.state["scene"]["surfaces"][1]["opacity"], 0.5)
        page.ask(type="merge", patch={"color_map": {"name": "plasma"}})
        self.assertEqual(page.state["scene"]["color_map"]["name"], "plasma")

    def test_items_are_added_hidden_copied_removed(self):
        page = self.page()
        n = len(page.state["items"])
        item = page.ask(type="add", name="Cut plane")
        self.assertEqual((item["kind"], item["index"]), ("surface", n))
        copied = page.ask(type="copy", kind="surface", index=n)
        self.assertEqual(copied["index"], n + 1)
        page.ask(type="show", kind="surface", index=n, shown=False)
        self.assertFalse(page.state["scene"]["surfaces"][n]["visible"])
        page.ask(type="remove", kind="surface", index=n + 1)
        page.ask(type="remove", kind="surface", index=n)
        self.assertEqual(len(page.state["items"]), n)
        self.assertEqual(page.ask(type="remove", kind="surface", index=99)["type"], "error")

    def test_pick_is_what_probe_says(self):
        page = self.page()
        picked = page.ask(type="pick", column=80.5, row=60.5)["picked"]
        self.assertTrue(picked["hit"])
        point = ",".join(repr(x) for x in picked["position"])
        probed, = json.loads(run("probe", self.volume, "--point", point, "--json").stdout)["points"]
        self.assertEqual(picked["element"], probed["element"])
        self.assertEqual(picked["xi"], probed["xi"])
        self.assertEqual({f["name"]: f["values"] for f in picked["fields"]}, probed["fields"])
        self.assertEqual({f["name"]: f["gradients"] for f in picked["fields"]},
                         {name: sum(gradients, []) for name, gradients in probed["gradients"].items()})

    def test_steps_of_long_scenes_are_few(self):
        page = self.page()
        clip = [[0, 0, 1, 5]] * 60000
        for i in range(9):
            page.ask(type="set", pointer="/surfaces", value=[{"type": "plane", "plane": [0, 0, 1, i / 100], "clip": clip}], name=f"plane {i}")
        n = 0
        while page.state["undo"] is not None:
            page.ask(type="undo")
            n += 1
        text = len(json.dumps(clip))
        print(f"\n{n} steps of scenes of {text >> 10} KiB")
        self.assertLess(n, 9)
        self.assertLess(n * text, 8 << 20)

    def test_time_steps(self):
        page = self.page()
        self.assertEqual(page.volume["times"], [0, 1, 2])
        page.ask(type="set", pointer="/field", value="pressure")
        page.ask(type="set", pointer="/volume/time_step", value=2)
        frame = page.exact()
        self.assertEqual(frame["bytes"], self.drawn_by_render(page.ask(type="save scene")["scene"]))
        self.assertIn("3 time steps", page.ask(type="set", pointer="/volume/time_step", value=3)["text"])

    def test_scene_is_loaded_and_camera_placed(self):
        page = self.page()
        loaded = {"version": 1, "surfaces": [{"type": "sphere", "center": [0, 0, 0], "radius": 0.5}]}
        self.assertEqual(page.ask(type="load", scene=loaded)["type"], "answer")
        self.assertEqual(page.state["scene"]["surfaces"][0]["radius"], 0.5)
        self.assertEqual(page.state["scene"]["image"]["size"], SIZE)
        page.ask(type="camera", camera={"eye": [3, 2, 1], "look_at": [0, 0, 0], "up": [0, 0, 1]})
        self.assertEqual(page.ask(type="save scene")["scene"]["camera"]["eye"], [3, 2, 1])
        for eye in ([0, 0, 0], [0, 0, 5], [1, 2], [1e300, 0, 0]):
            self.assertEqual(page.ask(type="camera", camera={"eye": eye, "look_at": [0, 0, 0], "up": [0, 0, 1]})["type"], "error")
        page.ask(type="undo")
        self.assertEqual(len(page.state["scene"]["surfaces"]), 2)

    def test_views_zoom_and_undecided(self):
        page = self.page()
        for view in page.volume["views"] + ["all"]:
            page.tell(type="view", name=view)
        page.tell(type="zoom", x=10, y=10, factor=0.5)
        page.tell(type="pan", dx=3, dy=4)
        page.ask(type="projection", orthographic=True)
        mask = page.ask(type="undecided")
        self.assertEqual(len(mask["bytes"]), SIZE[0] * SIZE[1] // 8)
        self.assertEqual(sum(byte.bit_count() for byte in mask["bytes"]), mask["n_undecided"])

    def test_every_doubt_is_marked(self):
        page = self.page()
        lines = {"type": "plane", "plane": [0, 0, 1, 0], "contours": {"count": 20}, "mesh_lines": {}}
        self.assertEqual(page.ask(type="merge", patch={"surfaces": [lines], "subdivisions": 0})["type"], "answer")
        counts = page.exact()["counts"]
        doubtful = [counts[name] for name in ("undecided_pixels", "undecided_contour_pixels", "undecided_mesh_line_pixels")]
        self.assertGreater(counts["undecided_contour_pixels"], counts["undecided_pixels"])
        n_marked = page.ask(type="undecided")["n_undecided"]
        self.assertLessEqual(max(doubtful), n_marked)
        self.assertLessEqual(n_marked, sum(doubtful))

    def test_lost_connection_keeps_the_state(self):
        page = self.page()
        page.ask(type="set", pointer="/color_map", value={"name": "magma"})
        page.close()
        again = self.page(session=page.session)
        self.assertEqual(again.session, page.session)
        self.assertEqual(again.state["scene"]["color_map"]["name"], "magma")
        again.ask(type="undo")
        other = self.page(session=again.session)
        self.assertEqual(other.session, page.session)
        self.assertEqual(again.wait(lambda m: m["type"] == "taken")["type"], "taken")

    def test_several_volumes_are_shown_as_they_are_drawn(self):
        page = self.page(size=SIZE)
        page.ask(type="set", pointer="/surfaces/1/opacity", value=1)
        page.ask(type="set", pointer="/volumes", value=[{"offset": [2.5, 0, 0], "time_step": 1}])
        page.ask(type="view", name="+z")
        self.assertEqual(page.exact()["bytes"], self.drawn_by_render(page.ask(type="save scene")["scene"]))
        self.assertIn("another volume", page.ask(type="set", pointer="/volumes/0/path", value="other.h5")["text"])
        page.frames.clear()
        page.ask(type="orbit", dx=5, dy=3)
        page.exact()
        self.assertEqual(page.frames[0]["size"], SIZE)
        self.assertEqual(page.frames[0]["mime"], "image/jpeg")

    def test_no_more_than_two_frames_are_unconfirmed(self):
        page = self.page(size=[400, 300])
        page.confirms = False
        for i in range(60):
            page.tell(type="orbit", dx=2, dy=0, time=i)
            time.sleep(0.01)
        time.sleep(1)
        page.ask(type="save scene")
        self.assertLessEqual(len(page.frames), 2)
        page.confirms = True
        page.tell(type="shown", frame=page.frames[-1]["frame"])
        late = page.wait(lambda m: m["type"] == "frame")
        self.assertEqual(late["echo"], 59)  # Of the newest camera, not of those in between.

    def test_slow_page_gets_fewer_pixels(self):
        page = self.page(size=[400, 300])
        page.confirms = False
        for _ in range(8):
            page.tell(type="orbit", dx=5, dy=0)
            frame = page.wait(lambda m: m["type"] == "frame")
            time.sleep(0.4)
            page.tell(type="shown", frame=frame["frame"])
        self.assertGreater(max(f["shrink"] for f in page.frames), 1)

    # What it withstands.

    def test_files_outside_of_the_folder_are_refused(self):
        outside = os.path.join(self.folder.name, "secret.json")
        with open(outside, "w") as file:
            file.write('{"secret": 1}')
        os.symlink(outside, os.path.join(self.inside, "link.json"))
        page = self.page()
        for path in (outside, "../secret.json", "link.json", "/etc/passwd", "inside/../../secret.json"):
            for pointer, value in (("/color_map", {"file": path}), ("/volume_rendering", {"transfer": path}),
                                   ("/surfaces/-", {"type": "mesh", "file": path})):
                wrong = page.ask(type="set", pointer=pointer, value=value)
                self.assertEqual(wrong["type"], "error")
                self.assertIn("outside", wrong["text"])
        for volume in ({"path": outside}, {"path": "waves.h5", "plugin": "x"}, "waves.h5"):
            self.assertEqual(page.ask(type="set", pointer="/volume", value=volume)["type"], "error")

    def test_large_messages_end_the_connection_alone(self):
        page = self.page()
        with self.assertRaises((Closed, ConnectionError)):
            page.socket.send_frame(1, b" " * (2 << 20))
            page.ask(type="undo")
        deep = self.page()
        deep.socket.send_frame(1, b"[" * 500000)
        self.assertIn("deep", deep.wait(lambda m: m["type"] == "error")["text"])

    def test_pictures_that_are_too_large_are_refused(self):
        page = self.page()
        self.assertEqual(page.ask(type="resize", width=9000, height=10)["type"], "error")
        self.assertEqual(page.ask(type="save picture", width=8192, height=8193)["type"], "error")
        self.assertEqual(page.ask(type="merge", patch={"image": {"size": [8000, 8000], "samples": 8}})["type"], "error")
        self.assertEqual(page.ask(type="merge", patch={"image": {"size": [20000, 10]}})["type"], "error")

    def test_a_port_that_is_taken_is_named(self):
        done = subprocess.run([PROGRAM, "serve", self.volume, "--port", str(self.server.port)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("--port", done.stderr)

    def test_long_headers_and_wrong_methods_are_refused(self):
        line = connect(self.server.port)
        line.sendall(b"GET / HTTP/1.1\r\nHost: x\r\nX: " + b"a" * 20000 + b"\r\n\r\n")
        try:
            self.assertNotIn(b"200 OK", line.recv(1000))
        except ConnectionError:
            pass
        line.close()
        line = connect(self.server.port)
        line.sendall(b"DELETE / HTTP/1.1\r\nHost: x\r\n\r\n")
        self.assertIn(b"405", line.recv(1000))
        line.close()

    def test_fuzzed_messages(self):
        seed = int(os.environ.get("ELVIS_FUZZ_SEED", "1"))
        n = int(os.environ.get("ELVIS_FUZZ_MESSAGES", "2000"))
        chance = random.Random(seed)
        types = ["check", "transfer", "resize", "orbit", "pan", "zoom", "roll", "view", "projection", "camera", "release", "set", "merge", "load", "undo",
                 "redo", "add", "remove", "show", "copy", "pick", "range", "overlay", "drag", "line", "histogram", "palette", "save scene", "save picture", "integrate", "extrema", "film",
                 "film picture", "stop", "shown", "nonsense"]
        keys = ["dx", "dy", "x", "y", "factor", "name", "pointer", "value", "patch", "scene", "camera", "color_map", "from", "to", "handle", "item", "points", "count", "fields", "kind", "index", "shown", "column", "row",
                "width", "height", "frame", "eye", "look_at", "up", "degrees", "orthographic", "field", "middle", "domain", "groups", "plane",
                "isovalue", "level_field", "flux", "tolerance", "format", "id", "time"]
        values = [0, 1, -1, 1e308, -1e-308, 2 ** 63, 1.5, "", "all", "+x", "Sphere", "Isosurface", "surface", "/surfaces/0/opacity",
                  "/camera/eye", "/surfaces/-", "/volume/time_step", "/image/size", None, True, [], {}, [1, 2, 3], [[]], {"name": "gray"},
                  {"surfaces": None}, {"type": "plane", "plane": [0, 1, 0, 0]}, "\u0000", "é" * 50, SCENE, "p", "velocity", "volume", "boundary", "plane",
                  "isosurface", "svg", [0, 0, 1, 0.1], 48, {"animation": {"turntable": {"frames": 2}}}]
        page = self.page(size=[48, 36])
        memory = self.server.memory()
        for i in range(n):
            message = {"type": chance.choice(types)}
            for key in chance.sample(keys, chance.randrange(8)):
                message[key] = chance.choice(values)
            data = bytearray(json.dumps(message).encode())
            if chance.random() < 0.3:
                for _ in range(chance.randrange(1, 4)):
                    data[chance.randrange(len(data))] = chance.randrange(32, 127)
            page.socket.send_frame(1, bytes(data))
            if i % 50 == 49:
                page.ask(type="save scene")
        self.assertEqual(page.ask(type="save scene")["type"], "answer")
        print(f"\n{n} messages with seed {seed}; memory grew by {self.server.memory() - memory:.1f} MiB")

    def test_fuzzed_frames_of_the_protocol(self):
        chance = random.Random(7)
        for _ in range(60):
            socket = self.server.socket()
            try:
                socket.socket.sendall(bytes(chance.randrange(256) for _ in range(chance.randrange(1, 300))))
            except ConnectionError:
                pass
            socket.close()
            time.sleep(0.01)
        self.page().exact()

    def test_many_slow_connections_do_not_keep_others_out(self):
        lines = [connect(self.server.port) for _ in range(200)]
        for line in lines:
            line.sendall(b"GET / HTTP/1.1\r\nHost:")
        page = self.page()
        page.exact()
        self.assertEqual(page.ask(type="save scene")["type"], "answer")
        lines[0].settimeout(60)
        try:
            self.assertEqual(lines[0].recv(100), b"")  # Half a request is not waited for.
        except ConnectionError:
            pass
        for line in lines:
            line.close()


class MostMemory:
    """The most that a server holds, looked at all the time."""

    def __init__(self, server):
        self.value = 0
        self.is_done = threading.Event()
        self.thread = threading.Thread(target=self.look, args=(server,))
        self.thread.start()

    def look(self, server):
        while not self.is_done.wait(0.003):
            self.value = max(self.value, server.memory())

    def stop(self):
        self.is_done.set()
        self.thread.join()
        return self.value


class LimitsTest(unittest.TestCase):
    def test_sessions_have_a_limit_and_share_the_volume(self):
        with tempfile.TemporaryDirectory(prefix="elvis-serve-test-") as folder:
            volume = make_volume(folder)
            server = Server(volume, "--sessions", "3")
            try:
                pages = []
                memory = []
                for _ in range(3):
                    pages.append(server.page(size=[160, 120]))
                    pages[-1].exact()
                    memory.append(server.memory())
                print("\nmemory with 1, 2, 3 sessions:", *(f"{m:.1f}" for m in memory), "MiB")
                with self.assertRaises(Refused) as refused:
                    server.socket()
                self.assertEqual(refused.exception.status, 503)
                pages[0].close()
                self.page_that_comes(server).close()  # In place of the one whose page has gone.
                for page in pages[1:]:
                    page.close()
            finally:
                self.assertEqual(server.stop(), 0)

    def page_that_comes(self, server):
        """Once the server has seen that another one has gone."""
        end = time.monotonic() + 60
        while True:
            try:
                return server.page()
            except Refused:
                self.assertLess(time.monotonic(), end)
                time.sleep(0.1)

    def test_memory_has_a_limit(self):
        """It is kept: what would go beyond is refused, or stopped while it is drawn, and the server goes on."""
        with tempfile.TemporaryDirectory(prefix="elvis-serve-test-") as folder:
            volume = make_volume(folder)
            done = subprocess.run([PROGRAM, "serve", volume, "--port", "0", "--memory", "20"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn("of the 20 MiB that it may (--memory)", done.stderr)
            margin = int(re.search(r"the last (\d+) are kept free", done.stderr)[1])
            server = Server(volume)
            opened = server.memory()
            page = server.page(size=[160, 120])
            page.exact()
            limit = int(server.memory()) + 160
            page.close()
            self.assertEqual(server.stop(), 0)

            server = Server(volume, "--memory", str(limit))
            most = MostMemory(server)
            try:
                page = server.page(size=[160, 120])
                page.exact()
                for refused in (page.ask(type="resize", width=4000, height=4000), page.ask(type="save picture", width=4000, height=4000),
                                page.ask(type="set", pointer="/image/size", value=[4000, 4000])):
                    self.assertEqual(refused["type"], "error")
                    self.assertIn("--memory", refused["text"])
                # Each takes kernels of its own; those before go when it has to be. Others are more than there may be.
                texts = [self.drawn(page, type="set", pointer="/field", value=f"p * {i}.5 + x") for i in range(1, 6)]
                self.assertIn("", texts)
                items = []
                for name in ("Cut plane", "Isosurface", "Volume", "Streamlines", "Torus"):
                    items.append(self.drawn(page, type="add", name=name, middle=0.5))
                print(f"\nof {limit} MiB it held {most.stop():.0f} at most; of {len(items)} items {items.count('')} were drawn")
                self.assertNotEqual(items[-1], "")
                for text in [*texts, *items]:
                    self.assertTrue(text == "" or "--memory" in text, text)
                self.assertLessEqual(most.value, limit)
                page.ask(type="load", scene={"version": 1})
                self.assertEqual(self.drawn(page, type="set", pointer="/color_map", value={"name": "gray"}), "")  # What there is room for goes on.
                page.close()
                time.sleep(0.3)
                again = server.page(session=page.session)
                again.exact()
                again.close()
            finally:
                most.stop()
                self.assertEqual(server.stop(), 0)

            server = Server(volume, "--memory", str(int(opened) + margin + 5))
            try:
                with self.assertRaises(Refused) as refused:
                    server.socket()
                self.assertEqual(refused.exception.status, 503)
                self.assertIn("--memory", str(refused.exception))
            finally:
                self.assertEqual(server.stop(), 0)

    def drawn(self, page, **change):
        """What is wrong with the change, or with its picture."""
        answer = page.ask(**change)
        if answer["type"] == "error":
            return answer["text"]
        told = page.wait(lambda m: m.get("revision", 0) >= page.state["revision"] and (m["type"] == "error" or m.get("stage") == "exact"))
        return told.get("text", "")

    def test_wrong_arguments_are_errors(self):
        for arguments in (["missing.h5"], ["missing.json", "--port", "70000"], [__file__], ["missing.h5", "--sessions", "0"], ["missing.h5", "--memory", "0"]):
            done = subprocess.run([PROGRAM, "serve", *arguments], capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertNotEqual(done.stderr, "")


if __name__ == "__main__":
    unittest.main()
