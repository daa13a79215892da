#!/usr/bin/env python3
"""Files of `elvis extract`, read by readers of their formats that share nothing with the program: read_back_test.py ELVIS"""

import json
import math
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

RADIUS = 0.6
BOX = {"generator": 1, "mesh": "waves", "shape": "mixed", "elements": [4, 2, 2], "geometry_order": 2, "amplitude": 0.05,
       "fields": [{"field": "sphere", "order": 4}]}
SIZES = {"Float64": ("d", 8), "Int64": ("q", 8), "double": ("d", 8), "int": ("i", 4), "uchar": ("B", 1)}


def read_stl(path):
    """Triangles, each of three points."""
    data = path.read_bytes()
    (n,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * n, "size"
    numbers = [struct.unpack_from("<12fH", data, 84 + 50 * i) for i in range(n)]
    return [(one[3:6], one[6:9], one[9:12]) for one in numbers], [one[:3] for one in numbers]


def read_ply(path):
    """Lists of dictionaries, by the elements' names."""
    head, data = path.read_bytes().split(b"end_header\n", 1)
    elements, at, found = [], 0, {}
    for line in head.decode().splitlines():
        words = line.split()
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    for name, n, properties in elements:
        found[name] = []
        for _ in range(n):
            one = {}
            for *kind, word in properties:
                if kind[0] == "list":
                    letter, size = SIZES[kind[1]]
                    (count,) = struct.unpack_from("<" + letter, data, at)
                    at += size
                    letter, size = SIZES[kind[2]]
                    one[word] = struct.unpack_from(f"<{count}{letter}", data, at)
                    at += count * size
                else:
                    letter, size = SIZES[kind[0]]
                    (one[word],) = struct.unpack_from("<" + letter, data, at)
                    at += size
            found[name].append(one)
    assert at == len(data), "size"
    return found


def read_glb(path):
    """The document, and its accessors as lists of tuples."""
    data = path.read_bytes()
    magic, version, size, length, kind = struct.unpack_from("<4sIII4s", data)
    assert (magic, version, size, kind) == (b"glTF", 2, len(data), b"JSON") and length % 4 == 0
    document = json.loads(data[20:20 + length])
    n_bytes, kind = struct.unpack_from("<I4s", data, 20 + length)
    binary = data[28 + length:]
    assert kind == b"BIN\0" and len(binary) == n_bytes == document["buffers"][0]["byteLength"] and n_bytes % 4 == 0
    arrays = []
    for accessor in document["accessors"]:
        view = document["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        letter = {5126: "f", 5125: "I"}[accessor["componentType"]]
        assert view["byteOffset"] % 4 == 0 and view["byteLength"] == 4 * width * accessor["count"]
        numbers = struct.unpack_from(f"<{width * accessor['count']}{letter}", binary, view["byteOffset"])
        rows = [numbers[i:i + width] for i in range(0, len(numbers), width)]
        for key, choose in (("min", min), ("max", max)):
            if key in accessor:
                assert [choose(column) for column in zip(*rows)] == accessor[key], key
        arrays.append(rows)
    return document, arrays


def read_vtp(path):
    """Arrays by section and name."""
    data = path.read_bytes()
    text, rest = data.split(b'<AppendedData encoding="raw">\n_', 1)
    arrays, section = {}, ""
    for line in text.decode().splitlines():
        opened = re.match(r"<(PointData|CellData|Points|Polys|Lines)\b", line)
        section = opened.group(1) if opened else section
        array = re.match(r'<DataArray type="(\w+)" Name="([^"]*)" NumberOfComponents="(\d+)" format="appended" offset="(\d+)"/>', line)
        if array:
            at = int(array.group(4))
            n, _, _ = struct.unpack_from("<3Q", rest, at)
            sizes = struct.unpack_from(f"<{n}Q", rest, at + 24)
            at, plain = at + 24 + 8 * n, b""
            for size in sizes:
                plain += zlib.decompress(rest[at:at + size])
                at += size
            letter, width = SIZES[array.group(1)]
            arrays[section, array.group(2)] = struct.unpack(f"<{len(plain) // width}{letter}", plain)
    return arrays


def volume_inside(triangles):
    def triple(a, b, c):
        return (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return sum(triple(*t) for t in triangles)


class ReadBackTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.at = Path(cls.folder.name)
        (cls.at / "box.json").write_text(json.dumps(BOX))
        subprocess.run([ELVIS, "convert", "box.json", "-o", "box.h5"], cwd=cls.at, check=True, stdout=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def extract(self, *words, status=0):
        done = subprocess.run([ELVIS, "extract", "box.h5", *words], cwd=self.at, capture_output=True, text=True)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stderr if status else json.loads(done.stdout) if "--json" in words else done.stdout

    def sphere(self, file, *words):
        return self.extract("--isosurface", str(RADIUS**2), "--field", "sphere", "--tolerance", "3e-3", "--json", "-o", file, *words)

    def check_sphere(self, triangles, report):
        self.assertEqual(len(triangles), report["triangles"])
        self.assertAlmostEqual(volume_inside(triangles), report["volume"], delta=1e-6)
        self.assertAlmostEqual(report["volume"], 4 / 3 * math.pi * RADIUS**3, delta=0.05)
        for triangle in triangles:
            for point in triangle:
                self.assertAlmostEqual(math.hypot(*point), RADIUS, delta=1e-6)

    def test_stl(self):
        report = self.sphere("mesh.stl")
        triangles, normals = read_stl(self.at / "mesh.stl")
        self.check_sphere(triangles, report)
        for triangle, normal in zip(triangles, normals):
            self.assertGreater(sum(x * n for x, n in zip(triangle[0], normal)), 0 if any(normal) else -1)
        # Sides of triangles, by the very bytes of their points: each is there once in each direction.
        sides = {}
        for a, b, c in triangles:
            for side in ((a, b), (b, c), (c, a)):
                sides[side] = sides.get(side, 0) + 1
        self.assertTrue(all(side[::-1] in sides for side in sides))

    def test_ply(self):
        report = self.sphere("mesh.ply", "--values", "sphere", "--values", "grad(sphere)[0]")
        found = read_ply(self.at / "mesh.ply")
        vertices = found["vertex"]
        self.assertEqual(list(vertices[0]), ["x", "y", "z", "nx", "ny", "nz", "element", "sphere", "grad(sphere)[0]"])
        points = [(v["x"], v["y"], v["z"]) for v in vertices]
        self.check_sphere([tuple(points[i] for i in f["vertex_indices"]) for f in found["face"]], report)
        for v in vertices:
            self.assertAlmostEqual(v["sphere"], RADIUS**2, delta=1e-12)
            self.assertAlmostEqual(v["grad(sphere)[0]"], 2 * v["x"], delta=1e-9)
            self.assertAlmostEqual(v["nx"], v["x"] / RADIUS, delta=1e-9)

    def test_glb(self):
        report = self.sphere("mesh.glb", "--values", "sphere")
        document, arrays = read_glb(self.at / "mesh.glb")
        (primitive,) = document["meshes"][0]["primitives"]
        self.assertEqual(primitive["mode"], 4)
        points = arrays[primitive["attributes"]["POSITION"]]
        indices = [i for (i,) in arrays[primitive["indices"]]]
        self.check_sphere([tuple(points[i] for i in indices[k:k + 3]) for k in range(0, len(indices), 3)], report)
        for (value,) in arrays[primitive["attributes"]["_SPHERE"]]:
            self.assertAlmostEqual(value, RADIUS**2, delta=1e-6)
        for normal, point in zip(arrays[primitive["attributes"]["NORMAL"]], points):
            self.assertAlmostEqual(sum(n * x for n, x in zip(normal, point)), RADIUS, delta=1e-5)

    def test_vtp(self):
        report = self.sphere("mesh.vtp", "--values", "x")
        arrays = read_vtp(self.at / "mesh.vtp")
        points = list(zip(*[iter(arrays["Points", "Points"])] * 3))
        corners = arrays["Polys", "connectivity"]
        self.assertEqual(arrays["Polys", "offsets"], tuple(range(3, len(corners) + 1, 3)))
        self.check_sphere([tuple(points[i] for i in corners[k:k + 3]) for k in range(0, len(corners), 3)], report)
        for value, point in zip(arrays["PointData", "x"], points):
            self.assertAlmostEqual(value, point[0], delta=1e-12)
        self.assertEqual(len(arrays["CellData", "element"]), report["triangles"])

    def test_contours(self):
        words = ("--cut-plane", "0,0,1,0.1", "--field", "x^2+y^2", "--contours", "0.25,0.09", "--json", "-o")
        report = self.extract(*words, "lines.vtp")
        self.assertEqual((report["lines"], report["open_ends"]), (2, 0))
        self.assertAlmostEqual(report["length"], 2 * math.pi * 0.8, delta=0.05)
        arrays = read_vtp(self.at / "lines.vtp")
        points = list(zip(*[iter(arrays["Points", "Points"])] * 3))
        begin = 0
        for end, value in zip(arrays["Lines", "offsets"], arrays["CellData", "isovalue"]):
            line = arrays["Lines", "connectivity"][begin:end]
            self.assertEqual(line[0], line[-1])
            for vertex in line:
                self.assertAlmostEqual(math.hypot(*points[vertex][:2]), math.sqrt(value), delta=1e-10)
            begin = end
        self.extract(*words, "lines.ply")
        edges = read_ply(self.at / "lines.ply")["edge"]
        self.assertEqual(len(edges), len(arrays["Lines", "connectivity"]) - 2)
        self.extract(*words, "lines.glb")
        document, _ = read_glb(self.at / "lines.glb")
        self.assertEqual(document["meshes"][0]["primitives"][0]["mode"], 1)

    def test_what_is_wrong_is_refused_and_leaves_no_file(self):
        for words, said in ((("--isosurface", "0.3", "-o", "no.ply"), "--field"),
                            (("--field", "sphere", "--isosurface", "0.3", "--cut-plane", "1,0,0,0", "-o", "no.ply"), "one of"),
                            (("-o", "no.obj"), ".glb"),
                            (("--contours", "1", "--field", "sphere", "-o", "no.stl"), "triangles alone")):
            self.assertIn(said, self.extract(*words, status=2))
        self.assertIn("pressure", self.extract("--field", "pressure", "--isosurface", "1", "-o", "no.ply", status=1))
        self.assertEqual([path for path in self.at.iterdir() if path.name.startswith("no.")], [])


if __name__ == "__main__":
    ELVIS = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
