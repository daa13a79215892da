"""Small volumes for tests."""

import json
import os
import tempfile
import unittest

import elvis


class WithVolume(unittest.TestCase):
    """27 bent hexahedra with p = x^2 y + z and the Taylor-Green vortex, in a folder of its own."""

    @classmethod
    def setUpClass(cls) -> None:
        cls._folder = tempfile.TemporaryDirectory(prefix="elvis-test-")
        cls.folder = cls._folder.name
        with open(cls.path("input.json"), "w", encoding="utf-8") as file:
            json.dump({"generator": 1, "mesh": "waves", "elements": [3, 3, 3], "geometry_order": 2,
                       "fields": [{"field": "polynomial", "name": "p", "coefficients": [[2, 1, 0, 1], [0, 0, 1, 1]]},
                                  "taylor-green"]}, file)
        cls.report = elvis.convert(cls.path("input.json"), cls.path("volume.h5"))
        cls.volume = elvis.open(cls.path("volume.h5"))

    @classmethod
    def tearDownClass(cls) -> None:
        cls._folder.cleanup()

    @classmethod
    def path(cls, name: str) -> str:
        return os.path.join(cls.folder, name)
