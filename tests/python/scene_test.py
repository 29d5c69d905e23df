"""Scenes from values, texts and files, and meshes from arrays."""
import pathlib
import pickle
import tempfile
import tomllib
import unittest

import numpy as np

import pliant
from pliant import _toml
from support import Case, meeting, run_program, source


class Scenes(Case):
    def test_values_become_the_toml_that_says_them(self):
        tables = {"title": "a \"quoted\" back\\slash, a tab\t, a line\n, ä and 😀", "simulation": {"duration": 0.1, "gravity": (0, -9.81, 0)},
                  "body": [{"name": "a b", "mesh": "cube:1", "damping": 1e-300}, {"mesh": "cube:1", "position": np.array([1, 5, 3])}],
                  "output": {"camera": {"eye": [1, 2, 3]}, "size": [64, 48]}, "ground": [{"height": np.float32(-3)}]}
        read = tomllib.loads(_toml.document(tables))
        tables["body"][1]["position"] = [1, 5, 3]
        tables["simulation"]["gravity"] = [0, -9.81, 0]
        self.assertEqual(read, tables)

    def test_a_scene_says_what_it_is(self):
        scene = pliant.Scene({**meeting, "title": "Meeting"})
        self.assertEqual((scene.title, scene.duration, scene.frame_rate, scene.bodies), ("Meeting", 0.1, 60, ["left", "right"]))
        self.assertEqual(repr(scene), "<pliant.Scene 'Meeting', 2 bodies, 0.1 s>")

    def test_files_texts_and_values_are_the_same_scene(self):
        file = source / "scenes" / "two_spheres.toml"
        loaded = pliant.Scene.load(file)
        states = []
        for scene in (loaded, pliant.Scene.parse(file.read_text(), folder=file.parent),
                      pliant.Scene(tomllib.loads(file.read_text()), folder=str(file.parent))):
            simulation = pliant.Simulation(scene, "cpu")
            simulation.advance(5)
            states.append(simulation.positions)
        self.assert_same_bits(states[0], states[1])
        self.assert_same_bits(states[0], states[2])

    def test_overrides_replace_values_and_earlier_overrides(self):
        scene = pliant.Scene(meeting, set={"simulation.duration": 3, "body.left.stiffness": 5})
        self.assertEqual(scene.duration, 3)
        changed = scene.override({"simulation.duration": 4, "body.right.position": np.array([2.0, 0, 0])})
        self.assertEqual((scene.duration, changed.duration), (3, 4))
        simulation = pliant.Simulation(changed, "cpu", set={"body.right.damping": 0})
        self.assertEqual(simulation.bodies["left"].stiffness, 5)
        self.assertEqual(simulation.bodies["right"].damping, 0)
        self.assertAlmostEqual(simulation.positions[42:, 0].mean(), 2)

    def test_errors_name_place_problem_and_remedy(self):
        expect = self.assert_error
        wrong = {"body": [{"name": "ball", "mesh": "cube:1", "stifness": 1}]}
        expect(pliant.InputError, ("Scene: body.ball.stifness", "unknown key", "\"stiffness\""), pliant.Scene, wrong)
        expect(pliant.InputError, ("Scene: body.ball.stiffness", "-1 is out of range", "0 to 1e30"), pliant.Scene,
               {"body": [{"name": "ball", "mesh": "cube:1", "stiffness": -1}]})
        expect(pliant.InputError, ("set: simulation.duration=-1", "out of range", ""), pliant.Scene, meeting,
               set={"simulation.duration": -1})
        expect(pliant.InputError, ("Scene", "has no body", "[[body]]"), pliant.Scene, {})
        expect(pliant.InputError, ("scene:3: simulation.duration", "", ""), pliant.Scene.parse,
               "\n[simulation]\nduration = -1\n[[body]]\nmesh = \"cube:1\"")
        expect(pliant.InputError, ("Scene: body[0].path", "object", "numbers"), pliant.Scene, {"body": [{"path": object()}]})
        expect(pliant.InputError, ("Scene: body", "one body alone", "list"), pliant.Scene, {"body": {"mesh": "cube:1"}})
        expect(pliant.InputError, ("nowhere.toml", "", ""), pliant.Scene.load, "nowhere.toml")
        expect(pliant.InputError, ("Scene: body.ball.mesh", "", ""), pliant.Simulation,
               pliant.Scene({"body": [{"name": "ball", "mesh": "nowhere.obj"}]}), "cpu")
        expect(pliant.InputError, ("device", "'tpu'", "gpu:N"), pliant.Simulation, pliant.Scene(meeting), "tpu")
        expect(pliant.DeviceError, ("", "", ""), pliant.Simulation, pliant.Scene(meeting), "gpu:99")

    def test_bodies_that_begin_in_each_other_are_an_error(self):
        together = {"body": [{"name": "a", "mesh": "icosphere:1"}, {"name": "b", "mesh": "icosphere:1", "position": [1, 0, 0]}]}
        self.assert_error(pliant.InputError, ("Scene", "\"a\"", ""), pliant.Simulation, pliant.Scene(together), "cpu")

    def test_scenes_and_errors_go_to_other_processes(self):
        mesh = pliant.mesh("icosphere:1")
        scene = pickle.loads(pickle.dumps(pliant.Scene({"body": [{"mesh": mesh}]}, set={"simulation.duration": 7})))
        self.assertEqual(scene.duration, 7)
        self.assertEqual(pliant.Simulation(scene, "cpu").vertex_count, 42)
        error = pickle.loads(pickle.dumps(pliant.DeviceError("here", "it broke", "mend it")))
        self.assertEqual((error.place, error.problem, error.remedy, str(error)), ("here", "it broke", "mend it", "here: it broke; mend it"))
        self.assertIsInstance(error, RuntimeError)

    def test_a_key_without_effect_is_warned_of(self):
        scene = pliant.Scene({**meeting, "collision": {"response": "none", "friction": 0.1}})
        with self.assertWarnsRegex(pliant.SceneWarning, "^(?!.*<values>).*collision.friction has no effect") as caught:
            pliant.Simulation(scene, "cpu")
        self.assertEqual(caught.filename, __file__)


class Meshes(Case):
    def test_arrays_are_the_mesh_that_they_were_read_from(self):
        mesh = pliant.mesh(source / "meshes" / "teapot.obj")
        with tempfile.TemporaryDirectory() as folder:
            mesh.write(pathlib.Path(folder) / "copy.obj")
            again = pliant.mesh(pathlib.Path(folder) / "copy.obj")
        self.assert_same_bits(again.positions, mesh.positions)
        self.assert_same_bits(again.triangles, mesh.triangles)

    def test_a_body_of_arrays_moves_as_one_of_the_generator(self):
        mesh = pliant.mesh("icosphere:1")
        arrays = {**meeting, "body": [{**body, "mesh": (mesh.positions.tolist(), mesh.triangles)} for body in meeting["body"]]}
        simulation = pliant.Simulation(pliant.Scene(arrays), "cpu")
        simulation.advance(50)
        rows, _ = run_program(pliant.Scene(meeting).text, "--device", "cpu")
        self.assert_same_bits(simulation.positions, rows[:, :3])

    def test_arrays_of_a_scene_are_its_own(self):
        mesh = pliant.mesh("icosphere:1")
        scene = pliant.Scene({"body": [{"mesh": mesh}]})
        mesh.positions[:] = 0
        self.assertAlmostEqual(np.linalg.norm(pliant.Simulation(scene, "cpu").positions, axis=1).max(), 1, delta=1e-6)

    def test_arrays_are_scaled_welded_and_subdivided_as_files_are(self):
        cube = pliant.mesh("cube:1")
        corners = cube.positions[cube.triangles.ravel()]
        loose = pliant.Mesh(corners, np.arange(len(corners)).reshape(-1, 3))  # each triangle has its own corners
        simulation = pliant.Simulation(pliant.Scene({"body": [{"mesh": loose, "weld": 1e-6, "subdivide": 1, "scale": 2}]}), "cpu")
        self.assertEqual((simulation.vertex_count, len(simulation.triangles)), (26, 48))
        self.assertAlmostEqual(np.abs(simulation.positions).max(), 2 * np.abs(cube.positions).max(), delta=1e-6)

    def test_meshes_that_are_wrong_name_what(self):
        p, t = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
        for mesh, parts in ((((p, [[0, 1, 3]])), ("", "triangle 0 names vertex 3, but the mesh has 3", "from 0")),
                            ((p, [[0, 1, 2], [0, 1, -1]]), ("triangles", "triangle 1 names vertex -1", "from 0")),
                            ((p, [[0, 1, 1]]), ("", "triangle 0 names a vertex twice", "")),
                            ((p, [[0.0, 1, 2]]), ("triangles", "float64", "whole")),
                            ((p * 2, [[0, 1, 2, 3]]), ("triangles", "(1, 4)", "(n, 3)")),
                            (([[0, 0, 0], [1, 0, np.inf]], t), ("", "vertex 1 has the coordinate inf", "finite")),
                            ((np.zeros((3, 2)), t), ("positions", "(3, 2)", "(n, 3)")),
                            (([], t), ("", "no vertices", ""))):
            positions = np.asarray(mesh[0], dtype=float).reshape(-1, 3) if len(mesh[0]) == 0 else mesh[0]
            self.assert_error(pliant.InputError, parts, pliant.Scene, {"body": [{"mesh": (positions, mesh[1])}]})

    def test_subdivision_and_report(self):
        mesh = pliant.mesh("cube:1")
        finer = mesh.subdivide(2)
        self.assertEqual(len(finer.triangles), 16 * len(mesh.triangles))
        self.assertTrue(finer.report()["closed"])
        self.assertAlmostEqual(finer.report()["volume"], mesh.report()["volume"])
        self.assertLess(mesh.subdivide(2, "loop").report()["volume"], mesh.report()["volume"])
        self.assert_error(pliant.InputError, ("scheme", "\"butterfly\"", "loop"), mesh.subdivide, 1, "butterfly")

    def test_flaws_of_files_are_warned_of(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "flawed.obj"
            file.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\n")
            with self.assertWarnsRegex(pliant.SceneWarning, "1 vertex") as caught:
                self.assertEqual(len(pliant.mesh(file).positions), 3)
            self.assertEqual(caught.filename, __file__)


class Package(Case):
    def test_info_is_that_of_the_program(self):
        self.assertEqual(pliant.info()["version"], pliant.__version__)
        self.assertIn("portable", pliant.info()["cpu"]["instruction_sets"])
        self.assertIn("dop853", [row["name"] for row in pliant.integrators()])

    def test_everything_public_is_there_and_documented(self):
        for name in pliant.__all__:
            self.assertTrue(hasattr(pliant, name), name)
            if name != "CONTACT":
                self.assertTrue(getattr(pliant, name).__doc__, name)
        for cls in (pliant.Simulation, pliant.Scene, pliant.Mesh, pliant.Picture, pliant.Animation):
            for name, member in vars(cls).items():
                if callable(member) and not name.startswith("_") and cls is not pliant.Mesh:
                    self.assertTrue(member.__doc__, f"{cls.__name__}.{name}")


if __name__ == "__main__":
    unittest.main()
