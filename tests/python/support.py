"""What tests of the package share. Environment: PLIANT_PROGRAM, PLIANT_SOURCE_DIR; PYTHONPATH leads to the built package."""
import csv
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

import numpy as np

import pliant

source = pathlib.Path(os.environ["PLIANT_SOURCE_DIR"])
program = os.environ["PLIANT_PROGRAM"]

signal.signal(signal.SIGINT, signal.default_int_handler)  # tests that run in the background were told to ignore it

# Two small spheres that meet after some 20 steps of 2 ms.
meeting = {
    "simulation": {"time_step": 0.002, "duration": 0.1},
    "body": [
        {"name": "left", "mesh": "icosphere:1", "position": [-1.1, 0.1, 0], "velocity": [4, 0, 0], "spin": [0, 1, 0]},
        {"name": "right", "mesh": "icosphere:1", "position": [1.1, 0, 0], "stretch": [0.9, 1, 1]},
    ],
}


def has_opengl():
    """Under CI, where all packages are installed, tests that need it fail instead of being left out."""
    return "CI" in os.environ or bool(pliant.info()["gpus"])


def run_program(scene_text, *options):
    """Returns the numbers of final_state.csv and the summary after `pliant run` of a scene's text."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "scene.toml"
        file.write_text(scene_text)
        subprocess.run([program, "run", file, "--out", folder, "--quiet", *options], check=True)
        with open(pathlib.Path(folder) / "final_state.csv", newline="") as table:
            rows = [[float(row[name]) for name in ("x", "y", "z", "vx", "vy", "vz")] for row in csv.DictReader(table)]
        return np.array(rows), json.loads((pathlib.Path(folder) / "summary.json").read_text())


class Case(unittest.TestCase):
    def assert_same_bits(self, a, b):
        self.assertEqual(a.shape, b.shape)
        self.assertTrue(np.array_equal(a, b), f"the largest difference is {np.abs(a - b).max()}")

    def assert_error(self, kind, parts, call, *arguments, **named):
        """Expects an error whose place, problem and remedy hold these texts."""
        with self.assertRaises(kind) as caught:
            call(*arguments, **named)
        told = (caught.exception.place, caught.exception.problem, caught.exception.remedy)
        for text, part in zip(told, parts):
            self.assertIn(part, text)
        return caught.exception
