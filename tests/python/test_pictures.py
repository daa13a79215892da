"""Scenes as objects, pictures as arrays, bytes of the launcher."""

import base64
import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
import unittest
import zlib
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

import elvis
from volumes import WithVolume


def resident_mebibytes() -> float:
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


class Pictures(WithVolume):
    def scene(self) -> elvis.Scene:
        scene = self.volume.scene(field="p", cut_planes=[[0, 0, 1, 0.1]], isosurfaces=[0.4])
        scene.image.size = [64, 48]
        return scene

    def test_a_picture_has_the_bytes_of_the_launcher(self):
        scene = self.scene()
        scene.camera.eye = [3, 2, 2]
        scene.color_map.name = "viridis"
        scene.surfaces.append(elvis.Surface(type="sphere", center=[0, 0, 0], radius=0.5, opacity=0.5))
        scene.render().save(self.path("own.png"))
        scene.write(self.path("scene.json"))
        subprocess.run([os.environ["ELVIS_PROGRAM"], "render", self.path("scene.json"), "-o", self.path("launcher.png")], check=True)
        with open(self.path("own.png"), "rb") as own, open(self.path("launcher.png"), "rb") as launcher:
            self.assertEqual(own.read(), launcher.read())
        again = elvis.Scene.read(self.path("scene.json"))
        np.testing.assert_array_equal(again.render().color, scene.render().color)

    def test_a_picture_within_a_budget_of_memory_is_the_same(self):
        scene = self.scene()
        whole = scene.render()
        scene.memory = {"device": "1G"}
        within = scene.render()
        for channel in "color", "value", "depth", "element", "flags":
            np.testing.assert_array_equal(getattr(within, channel), getattr(whole, channel))
        scene.memory.device = "64K"
        with self.assertRaisesRegex(elvis.Error, "the budget is 64 KiB"):
            scene.render()

    def test_pdf_has_the_pixels_of_the_picture_without_annotation(self):
        scene = self.scene()
        scene.image.size = [200, 150]
        scene.camera.eye = [3, 2, 2]
        scene.camera.look_at = [0, 0, 0]
        scene.render().save(self.path("bare.png"), bits=16)
        scene.image.annotation = {"title": "p"}
        scene.render().save(self.path("annotated.PDF"), bits=16)
        with open(self.path("annotated.PDF"), "rb") as file:
            data = file.read()
        self.assertNotIn(b"/SMask", data)
        # The compressed rows of the PNG.
        image = re.search(rb"/ColorSpace /DeviceRGB [^>]*/Columns 200 >> /Length ([0-9]+) >>\nstream\n", data)
        with open(self.path("bare.png"), "rb") as file:
            rows = b"".join(re.findall(rb"IDAT(.*?)....(?=....(?:IDAT|IEND))", file.read(), re.S))
        self.assertEqual(data[image.end():image.end() + int(image[1])], rows)

    def test_pdf_is_as_transparent_as_the_picture(self):
        scene = self.scene()
        scene.image.size = [40, 30]
        scene.camera.eye = [3, 2, 2]
        scene.camera.look_at = [0, 0, 0]
        scene.image.background = [1, 1, 1, 0.25]
        picture = scene.render()
        picture.save(self.path("transparent.pdf"))
        with open(self.path("transparent.pdf"), "rb") as file:
            data = file.read()
        alpha = re.search(rb"/ColorSpace /DeviceGray [^>]*/Length ([0-9]+) >>\nstream\n", data)
        levels = np.frombuffer(zlib.decompress(data[alpha.end():alpha.end() + int(alpha[1])]), np.uint8).reshape(30, 40)
        np.testing.assert_array_equal(levels, picture.color[..., 3])
        self.assertEqual((levels.min(), levels.max()), (64, 255))

    def test_svg_has_the_pixels_of_the_picture_without_annotation(self):
        scene = self.scene()
        scene.image.size = [200, 150]
        scene.camera.eye = [3, 2, 2]
        scene.camera.look_at = [0, 0, 0]
        scene.render().save(self.path("bare.png"))
        scene.image.annotation = {"title": "p < 1 & more"}
        picture = scene.render()
        picture.save(self.path("annotated.svg"))
        root = ElementTree.parse(self.path("annotated.svg")).getroot()
        space = "{http://www.w3.org/2000/svg}"
        self.assertEqual((root.get("width"), root.get("viewBox")), ("200", "0 0 200 150"))
        kind, data = root.find(f"{space}image").get("{http://www.w3.org/1999/xlink}href").split(",")
        self.assertEqual(kind, "data:image/png;base64")
        with open(self.path("bare.png"), "rb") as file:
            self.assertEqual(base64.b64decode(data, validate=True), file.read())
        words = [text.text for text in root.iter(f"{space}text")]
        for word in ("p < 1 & more", "p", "x", "y", "z"):
            self.assertIn(word, words)
        self.assertGreater(len(list(root.iter(f"{space}polygon"))), 60)
        # The picture itself is as it was.
        picture.save(self.path("annotated.png"))
        scene.render().save(self.path("again.png"))
        with open(self.path("annotated.png"), "rb") as one, open(self.path("again.png"), "rb") as other:
            self.assertEqual(one.read(), other.read())

    def test_arrays_of_a_picture_fit_together(self):
        picture = self.scene().render(80, 60)
        self.assertEqual(picture.color.shape, (60, 80, 4))
        seen = picture.element >= 0
        self.assertGreater(seen.sum(), 500)
        np.testing.assert_array_equal(seen, np.isfinite(picture.value))
        np.testing.assert_array_equal(seen, np.isfinite(picture.depth))
        np.testing.assert_allclose(np.linalg.norm(picture.normal[seen], axis=1), 1, atol=1e-5)
        np.testing.assert_array_equal(np.rint(255 * picture.color_float.clip(0, 1)), picture.color)
        self.assertEqual(picture.stats["counts"]["hit_pixels"], seen.sum())
        with self.assertRaises(ValueError):
            picture.color[0] = 0
        colors = self.volume.render(self.scene(), 80, 60, color_only=True)
        np.testing.assert_array_equal(colors.color, picture.color)
        with self.assertRaisesRegex(elvis.Error, "COLOR_ONLY"):
            colors.depth

    def test_an_animation_is_a_sequence_of_pictures(self):
        scene = self.scene()
        scene.animation.turntable = elvis.Turntable(frames=3)
        animation = self.volume.animate(scene)
        self.assertEqual(len(animation), 3)
        pictures = [picture.color for picture in animation]
        np.testing.assert_array_equal(pictures[0], scene.render().color)
        np.testing.assert_array_equal(pictures[2], animation[-1].color)
        self.assertFalse(np.array_equal(pictures[0], pictures[1]))
        self.assertEqual(animation.remarks, [])
        with self.assertRaises(IndexError):
            animation[3]

    def test_points_are_picked_and_scenes_completed(self):
        scene = self.scene()
        picked = self.volume.pick(scene, 32, 24)
        x, y, z = picked["position"]
        self.assertAlmostEqual(picked["fields"][0]["values"][0], x * x * y + z, places=9)
        complete = self.volume.complete(scene)
        self.assertEqual(len(complete.camera.eye), 3)
        np.testing.assert_array_equal(complete.render().color, scene.render().color)
        low, high = self.volume.percentiles([0.1, 0.9], "p")
        self.assertLess(low, high)

    def test_the_first_picture_of_all_is_that_of_the_launcher(self):
        subprocess.run([os.environ["ELVIS_PROGRAM"], "render", self.path("volume.h5"), "--size", "64x48", "-o", self.path("l.png")],
                       check=True)
        with open(self.path("l.png"), "rb") as launcher:
            self.assertEqual(self.volume.render(None, 64, 48).png(), launcher.read())

    def test_a_notebook_shows_the_picture_and_its_warnings(self):
        scene = self.volume.scene(cut_planes=[[0, 0, 1, 50]])
        picture = scene.render(32, 24)
        self.assertTrue(any("hits no pixel" in text for text in picture.warnings))
        shown = picture._repr_mimebundle_()
        self.assertIn("data:image/png;base64,", shown["text/html"])
        self.assertIn("hits no pixel", shown["text/html"])

    def test_keys_that_a_scene_does_not_know_are_refused(self):
        scene = self.scene()
        with self.assertRaisesRegex(AttributeError, "did you mean 'camera'"):
            scene.camra = 1
        with self.assertRaisesRegex(AttributeError, "did you mean 'opacity'"):
            elvis.Surface(type="plane", opacty=1)
        scene.camera.eye = [1, 2]
        with self.assertRaisesRegex(elvis.Error, "camera.eye"):
            scene.render(8, 8)
        with self.assertRaisesRegex(ValueError, "Volume.render"):
            elvis.Scene().render(8, 8)
        self.assertIn("surfaces", dir(scene))

    def test_every_key_of_the_schema_is_an_attribute(self):
        def keys_of(node, schema):
            node = schema["$defs"][node["$ref"].rsplit("/", 1)[1]] if "$ref" in node else node
            for key, value in node.get("properties", {}).items():
                yield key
                yield from keys_of(value, schema)
            for inner in [node["items"]] if isinstance(node.get("items"), dict) else node.get("anyOf", []):
                yield from keys_of(inner, schema)

        from elvis import scene_objects

        schema = json.loads(elvis._elvis.scene_schema())
        known = {key for name in scene_objects.__all__ for key, _, _ in getattr(scene_objects, name)._keys.values()}
        self.assertEqual(set(keys_of(schema, schema)) - known, set())

    def test_scenes_go_to_json_and_back(self):
        scene = self.scene()
        scene.lighting.headlight = [0.7, 0.7, 0.7]
        scene.views.append(elvis.View(name="front", camera={"eye": [0, 0, 5]}))
        scene.surfaces.append(elvis.Surface(type="cylinder", from_=[0, 0, 0], to=[0, 0, 1], radius=0.2))
        again = elvis.Scene.from_dict(json.loads(scene.to_json()))
        self.assertEqual(json.loads(again.to_json()), json.loads(scene.to_json()))
        self.assertEqual(again.surfaces[-1].to_dict()["from"], [0, 0, 0])
        again.check()

    def test_flags_are_those_of_the_library(self):
        header = (Path(__file__).resolve().parents[2] / "core/api/include/elvis/editing.h").read_text()
        bits = {name: int(bit) for name, bit in re.findall(r"#define ELVIS_PIXEL_(\w+) (\d+)u", header)}
        self.assertEqual({flag.name: flag.value for flag in elvis.Flag}, bits)
        doubts = re.search(r"ELVIS_PIXEL_DOUBTS((?:.*\\\n)+.*\))", header)[1]
        self.assertEqual(sum(bits[name] for name in re.findall(r"ELVIS_PIXEL_(\w+)", doubts)), elvis.Flag.DOUBTS)

    def test_a_hundred_pictures_take_no_more_memory(self):
        scene = self.scene()
        for _ in range(20):
            scene.render(32, 24).color
        before = resident_mebibytes()
        for _ in range(100):
            scene.render(32, 24).color
        self.assertLess(resident_mebibytes() - before, 4)

    def test_interrupting_stops_within_a_fifth_of_a_second(self):
        scene = self.volume.scene(field="pressure", volume="default")
        scene.volume_rendering.tolerance = 1e-7
        scene.render(16, 12)  # Kernels are there.
        sent = []

        def interrupt():
            time.sleep(0.3)
            sent.append(time.process_time())
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            scene.render(1000, 700)
            time.sleep(60)
        # Processor time of each core: machines are busy with other things, too. To the end of the picture it takes seconds.
        self.assertLess((time.process_time() - sent[0]) / os.cpu_count(), 0.6)
        thread.join()

    def test_pictures_go_into_matplotlib(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("there is no matplotlib")
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        figure, axes = plt.subplots()
        picture = self.scene().render(64, 48)
        picture.plot(axes)
        self.assertEqual(len(figure.axes), 2)
        bar = picture.color_bars[0]
        shown = figure.axes[1]._colorbar.mappable
        for value, *color in bar["points"][1:-1]:
            np.testing.assert_allclose(shown.to_rgba(value)[:3], color, atol=0.01)
        plt.close(figure)


if __name__ == "__main__":
    sys.exit(unittest.main())
