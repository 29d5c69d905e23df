"""Simulations give the program's bits, and can be read, changed, saved and shared among threads."""
import _thread
import json
import signal
import threading
import time
import unittest
import warnings

import numpy as np

import pliant
from support import Case, has_opengl, meeting, run_program

falling = {
    "simulation": {"time_step": 0.002, "duration": 1, "gravity": [0, -9.81, 0], "damping_law": "none"},
    "body": [{"name": "ball", "mesh": "icosphere:1", "position": [0, 5, 0], "velocity": [1, 0, 0], "damping": 0}],
}


def simulate(scene=meeting, **how):
    return pliant.Simulation(pliant.Scene(scene), **{"device": "cpu", **how})


class TheProgramsBits(Case):
    def assert_as_program(self, scene, *options, **how):
        made = pliant.Scene(scene)
        rows, summary = run_program(made.text, *options)
        simulation = pliant.Simulation(made, **how)
        simulation.advance_to(simulation.duration)
        self.assertEqual(simulation.steps, summary["steps"])
        self.assert_same_bits(simulation.positions, rows[:, :3])
        self.assert_same_bits(simulation.velocities, rows[:, 3:])

    def test_steps_of_a_fixed_length(self):
        self.assert_as_program(meeting, "--device", "cpu", device="cpu")

    def test_fp64(self):
        self.assert_as_program(meeting, "--precision", "64", precision=64)

    def test_a_tolerance(self):
        scene = {**meeting, "simulation": {"integrator": "dop853", "tolerance": 1e-6, "duration": 0.1}}
        self.assert_as_program(scene, "--device", "cpu", device="cpu")

    @unittest.skipUnless(has_opengl(), "there is no OpenGL")
    def test_a_gpu(self):
        self.assert_as_program(meeting, "--device", "gpu", device="gpu")

    def test_one_step_at_a_time(self):
        at_once, one_by_one = simulate(), simulate()
        at_once.advance(50)
        for _ in range(50):
            one_by_one.advance()
        self.assert_same_bits(at_once.positions, one_by_one.positions)

    def test_steps_by_number_and_by_time_with_a_tolerance(self):
        scene = {**meeting, "simulation": {"integrator": "dop853", "tolerance": 1e-6}}
        by_time, by_number = simulate(scene), simulate(scene)
        by_time.advance_to(0.1)
        by_number.advance(by_time.steps)
        self.assertEqual(by_number.time, by_time.time)
        self.assert_same_bits(by_number.positions, by_time.positions)


class Arguments(Case):
    def test_arguments_that_are_wrong_are_named(self):
        for name, value in (("precision", 16), ("threads", -1), ("threads", 100000)):
            self.assert_error(pliant.InputError, (name, str(value), ""), simulate, **{name: value})
        self.assertRaises(TypeError, simulate, threads=1.0)
        error = self.assert_error(pliant.InputError, ("precision", "64", "cpu"), simulate, device="gpu", precision=64)
        self.assertNotIn("--", str(error))

    def test_a_report_becomes_json(self):
        simulation = simulate()
        simulation.advance(30)
        self.assertEqual(json.loads(json.dumps(simulation.report()))["steps"], 30)


class Steps(Case):
    def test_time_goes_to_the_nearest_step(self):
        simulation = simulate()
        simulation.advance_to(0.0149)
        self.assertEqual(simulation.steps, 7)
        self.assertAlmostEqual(simulation.time, 0.014, delta=1e-12)
        simulation.advance_to(simulation.time)
        self.assertEqual(simulation.steps, 7)

    def test_with_a_tolerance_a_step_ends_at_the_time(self):
        simulation = simulate({**meeting, "simulation": {"integrator": "dop853", "tolerance": 1e-6}})
        simulation.advance_to(0.0123)
        self.assertEqual(simulation.time, 0.0123)

    def test_with_a_tolerance_it_goes_on_after_a_change_to_times_that_are_no_sums(self):
        simulation = simulate({**meeting, "simulation": {"integrator": "dop853", "tolerance": 1e-6}})
        simulation.advance_to(0.003)
        simulation.set_state(velocities=0.5 * simulation.velocities)
        simulation.advance_to(0.013)  # 0.003 + (0.013 - 0.003) is less
        self.assertAlmostEqual(simulation.time, 0.013, delta=1e-15)
        simulation.advance_to(0.02)
        self.assertAlmostEqual(simulation.time, 0.02, delta=1e-15)

    def test_time_does_not_go_back(self):
        simulation = simulate()
        simulation.advance(10)
        self.assert_error(pliant.InputError, ("advance_to", "before now", "restore"), simulation.advance_to, 0.01)
        self.assert_error(pliant.InputError, ("advance_to", "", ""), simulation.advance_to, float("nan"))
        self.assertRaises(TypeError, simulation.advance, 1.5)
        self.assert_error(pliant.InputError, ("advance", "-1 steps", ""), simulation.advance, -1)
        self.assertEqual(simulation.steps, 10)

    def test_numbers_that_go_wrong_are_told(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", pliant.SceneWarning)
            simulation = simulate({"simulation": {"integrator": "rk4", "time_step": 10}, "body": meeting["body"][1:]})
        error = self.assert_error(pliant.BreakdownError, ("body \"", "is not finite in step", "time_step"), simulation.advance, 10000)
        found = simulation.report()["breakdown"]
        self.assertIn(f"step {found['step']}", error.problem)
        self.assertIn(f"vertex {found['vertex']} ", error.problem)
        self.assertFalse(found["is_finite"])
        self.assertRaises(pliant.BreakdownError, simulation.advance)
        self.assertTrue(np.isnan(simulation.positions).any() or np.isinf(simulation.positions).any())

    def test_a_step_beyond_the_bound_is_warned_of(self):
        with self.assertWarnsRegex(pliant.SceneWarning, "stability bound") as caught:
            simulate({**meeting, "simulation": {"integrator": "rk4", "time_step": 1}})
        self.assertEqual(caught.filename, __file__)


class Signals(Case):
    def test_ctrl_c_ends_steps_that_go_on_with_the_same_bits(self):
        simulation, undisturbed = simulate(), simulate()
        interrupt = threading.Timer(0.3, _thread.interrupt_main, (signal.SIGINT,))
        with self.assertRaises(KeyboardInterrupt):
            interrupt.start()
            simulation.advance(10**9)
        made = simulation.steps
        self.assertGreater(made, 0)
        self.assertLess(made, 10**9)
        undisturbed.advance(made)
        simulation.advance(10)
        undisturbed.advance(10)
        self.assert_same_bits(simulation.positions, undisturbed.positions)

    def test_other_threads_run_during_steps(self):
        simulation = simulate()
        reached = []

        def count():
            while not done.is_set():
                reached.append(time.perf_counter())

        done = threading.Event()
        thread = threading.Thread(target=count)
        thread.start()
        begin = time.perf_counter()
        simulation.advance(20000)
        end = time.perf_counter()
        done.set()
        thread.join()
        self.assertTrue(any(begin < at < end for at in reached))

    def test_threads_share_a_simulation(self):
        simulation, alone = simulate(), simulate()
        threads = [threading.Thread(target=lambda: [simulation.advance(1) for _ in range(50)]) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        alone.advance(200)
        self.assert_same_bits(simulation.positions, alone.positions)


class Reading(Case):
    def test_shapes_and_types(self):
        simulation = simulate()
        self.assertEqual(simulation.vertex_count, 84)
        for array, shape, kind in ((simulation.positions, (84, 3), np.float64), (simulation.velocities, (84, 3), np.float64),
                                   (simulation.drawn_positions, (84, 3), np.float32), (simulation.triangles, (160, 3), np.uint32)):
            self.assertEqual((array.shape, array.dtype), (shape, kind))
        self.assertEqual(list(simulation.bodies), ["left", "right"])
        self.assertEqual(simulation.bodies["right"].vertices, slice(42, 84, 1))
        self.assertTrue((simulation.triangles[simulation.bodies["right"].triangles] >= 42).all())

    def test_arrays_are_copies(self):
        simulation = simulate()
        before = simulation.positions
        before.setflags(write=True)
        taken = before.copy()
        before[:] = 0
        simulation.positions[:] = 0
        self.assert_same_bits(simulation.positions, taken)
        self.assert_same_bits(simulation.drawn_positions, taken.astype(np.float32))

    def test_positions_are_read_into_an_array_that_is_there(self):
        simulation = simulate()
        out = np.zeros((84, 3))
        self.assertIs(simulation.read_positions(out), out)
        self.assert_same_bits(out, simulation.positions)
        for wrong in (np.zeros((83, 3)), np.zeros((84, 3), np.float32), np.zeros((3, 84)).T, np.zeros((84, 6))[:, ::2]):
            self.assert_error(pliant.InputError, ("out", "", "(84, 3)"), simulation.read_positions, wrong)
        locked = np.zeros((84, 3))
        locked.setflags(write=False)
        self.assert_error(pliant.InputError, ("out", "", ""), simulation.read_positions, locked)

    def test_a_free_fall_has_its_closed_form(self):
        simulation = simulate(falling, precision=64)
        start = simulation.positions
        simulation.advance_to(0.5)
        way = np.array([0.5, -9.81 * 0.5**2 / 2, 0])
        np.testing.assert_allclose(simulation.positions, start + way, atol=1e-10)
        np.testing.assert_allclose(simulation.velocities, np.tile([1, -9.81 * 0.5, 0], (42, 1)), atol=1e-10)

    def test_energies_are_the_sums_over_vertices_and_springs(self):
        simulation = simulate()
        simulation.advance_to(0.05)
        measured, p, v = simulation.measure(), simulation.positions, simulation.velocities
        self.assertAlmostEqual(measured.kinetic, (v**2).sum() / 2, delta=1e-9 * measured.kinetic)
        np.testing.assert_allclose(measured.momentum, v.sum(axis=0), atol=1e-9)
        np.testing.assert_allclose(measured.angular_momentum, np.cross(p, v).sum(axis=0), atol=1e-9)
        rest = simulate({**meeting, "body": [{**b, "stretch": [1, 1, 1]} for b in meeting["body"]]}).positions
        elastic = 0
        for body in simulation.bodies.values():
            at, was = p[body.vertices], rest[body.vertices]
            longer = np.linalg.norm(at[:, None] - at, axis=2) - np.linalg.norm(was[:, None] - was, axis=2)
            elastic += body.stiffness * (longer**2).sum() / 4
        self.assertAlmostEqual(measured.elastic, elastic, delta=1e-5 * elastic)
        self.assertEqual(measured.energy, measured.kinetic + measured.elastic + measured.gravitational)

    def test_contacts_are_equal_and_opposite_and_push_bodies_apart(self):
        simulation = simulate()
        found = simulation.contacts()
        while len(found) == 0:
            simulation.advance()
            found = simulation.contacts()
        self.assertEqual(found.dtype, pliant.CONTACT)
        at = np.where(found["vertices"] < 42, 0, 1)
        for contact, bodies in zip(found, at):
            weights, there = contact["weights"], contact["vertices"] >= 0
            self.assertAlmostEqual(weights[there & (weights > 0)].sum(), 1)
            self.assertAlmostEqual(weights[there & (weights < 0)].sum(), -1)
            self.assertEqual(len({b for b, w in zip(bodies, weights) if w > 0}), 1)
            first_is_left = bodies[np.argmax(weights)] == 0
            self.assertLess(contact["impulse"][0] * (1 if first_is_left else -1), 0)  # the left body is pushed back
        self.assertGreater(simulation.report()["contact_steps"], 0)

    def test_bodies_that_touch_are_found(self):
        apart = simulate()
        self.assertEqual(apart.intersections(), pliant.Intersections(0, []))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", pliant.SceneWarning)
            through = simulate({**meeting, "collision": {"response": "none"}})
        through.advance_to(0.3)
        self.assertEqual(through.intersections().bodies, ["left", "right"])


class Changing(Case):
    def test_positions_and_velocities_are_set(self):
        simulation = simulate(precision=64)
        simulation.advance_to(0.03)
        positions, velocities, energy = simulation.positions, simulation.velocities, simulation.measure()
        turn = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]])
        simulation.set_state(positions=positions @ turn.T + [3, 4, 5], velocities=velocities @ turn.T)
        np.testing.assert_allclose(simulation.positions, positions @ turn.T + [3, 4, 5], atol=1e-12)
        np.testing.assert_allclose(simulation.velocities, velocities @ turn.T, atol=1e-12)
        self.assertEqual((simulation.steps, simulation.time), (15, 0.03))
        turned = simulation.measure()
        self.assertAlmostEqual(turned.kinetic, energy.kinetic, delta=1e-9 * energy.kinetic)
        self.assertAlmostEqual(turned.elastic, energy.elastic, delta=1e-9 * energy.elastic)

    def test_a_turned_state_moves_as_the_state_that_was_not_turned(self):
        here, there = simulate(precision=64), simulate(precision=64)
        turn = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]])
        there.set_state(positions=there.positions @ turn.T + [3, 4, 5], velocities=there.velocities @ turn.T)
        here.advance(60)
        there.advance(60)
        np.testing.assert_allclose(there.positions, here.positions @ turn.T + [3, 4, 5], atol=1e-6)

    def test_gravity_keeps_its_direction_for_a_body_that_was_turned(self):
        simulation = simulate(falling, precision=64)
        turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
        centre = simulation.positions.mean(axis=0)
        start = (simulation.positions - centre) @ turn.T + centre
        simulation.set_state(positions=start)
        simulation.advance_to(0.5)
        np.testing.assert_allclose(simulation.positions, start + [0.5, -9.81 * 0.5**2 / 2, 0], atol=1e-10)

    def test_a_state_that_is_wrong_changes_nothing(self):
        simulation = simulate()
        simulation.advance(5)
        before = simulation.positions
        broken = before.copy()
        broken[3, 1] = np.nan
        self.assert_error(pliant.InputError, ("positions", "row 3", "finite"), simulation.set_state, positions=broken)
        self.assert_error(pliant.InputError, ("velocities", "shape (83, 3)", "(84, 3)"), simulation.set_state, velocities=before[1:])
        inside = before.copy()
        inside[42:] = inside[:42] + 1e-3
        self.assert_error(pliant.InputError, ("the state", "", ""), simulation.set_state, positions=inside)
        self.assert_same_bits(simulation.positions, before)
        simulation.advance(5)

    def test_bodies_that_are_static_keep_their_place(self):
        scene = {"body": [{"name": "ball", "mesh": "icosphere:1"},
                          {"name": "wall", "mesh": "cube:2", "position": [0, -5, 0], "kind": "static"}]}
        simulation = simulate(scene)
        moved = simulation.positions
        moved[simulation.bodies["ball"].vertices] += [0, 1, 0]
        simulation.set_state(positions=moved)
        np.testing.assert_allclose(simulation.positions, moved, atol=1e-12)
        moved += 1
        self.assert_error(pliant.InputError, ("positions", "body \"wall\"", ""), simulation.set_state, positions=moved)

    def test_a_material_is_that_of_a_scene_that_has_it(self):
        changed, from_the_start = simulate(), simulate({**meeting, "body": [{**meeting["body"][0], "stiffness": 10, "damping": 0.1},
                                                                           meeting["body"][1]]})
        changed.set_material("left", stiffness=10, damping=0.1)
        self.assertEqual(changed.bodies["left"], from_the_start.bodies["left"])
        changed.advance(50)
        from_the_start.advance(50)
        self.assert_same_bits(changed.positions, from_the_start.positions)

    def test_an_automatic_step_follows_the_material(self):
        simulation = simulate({"body": meeting["body"]})
        before = simulation.time_step
        simulation.set_material("left", stiffness=4000)
        self.assertLess(simulation.time_step, before)
        simulation.advance_to(0.05)
        self.assertAlmostEqual(simulation.time, 0.05, delta=simulation.time_step)

    def test_a_material_that_makes_the_step_too_long_is_warned_of(self):
        simulation = simulate({**meeting, "simulation": {"time_step": 0.01}})
        with self.assertWarnsRegex(pliant.SceneWarning, "stability bound") as caught:
            simulation.set_material("left", stiffness=1e5)
        self.assertEqual(caught.filename, __file__)

    def test_materials_that_are_wrong_are_refused(self):
        simulation = simulate()
        self.assert_error(pliant.InputError, ("body", "'middle'", "left, right"), simulation.set_material, "middle", damping=1)
        self.assert_error(pliant.InputError, ("stiffness", "-1", ""), simulation.set_material, "left", stiffness=-1)
        self.assert_error(pliant.InputError, ("vertex_mass", "0", ""), simulation.set_material, "left", vertex_mass=0)
        self.assert_error(pliant.InputError, ("damping", "nan", ""), simulation.set_material, "left", damping=float("nan"))

    def test_a_pull_draws_the_body_there_and_keeps_others(self):
        simulation = simulate({**meeting, "body": [{**b, "velocity": [0, 0, 0], "spin": [0, 0, 0]} for b in meeting["body"]]})
        top = int(np.argmax(simulation.positions[:42, 1]))
        target = simulation.positions[top] + [0, 0.5, 0]
        right = simulation.positions[42:]
        for _ in range(100):
            simulation.advance()
            simulation.pull(top, target)
        self.assertLess(np.linalg.norm(simulation.positions[top] - target), 0.25)
        self.assertGreater(simulation.positions[:42, 1].mean(), 0.2)
        self.assertLess(np.abs(simulation.positions[42:].mean(axis=0) - right.mean(axis=0)).max(), 1e-6)
        self.assert_error(pliant.InputError, ("vertex", "84", ""), simulation.pull, 84, target)
        self.assert_error(pliant.InputError, ("target", "", "three"), simulation.pull, 0, [1, 2])

    def test_a_scripted_body_is_sent_elsewhere(self):
        hand = {"name": "hand", "mesh": "cube:2", "scale": 0.2, "position": [5, 0, 0], "kind": "scripted",
                "path": [{"time": 0}, {"time": 1}]}
        simulation = simulate({**meeting, "body": [*meeting["body"], hand]})
        rows = simulation.bodies["hand"].vertices
        simulation.advance(10)
        shape = simulation.positions[rows] - simulation.positions[rows].mean(axis=0)
        simulation.send("hand", [5, 2, 1], 0.1)
        simulation.advance(25)
        between = simulation.positions[rows].mean(axis=0)
        simulation.send("hand", [4, 0, 0], 0.2)
        simulation.advance(1)
        self.assertLess(np.linalg.norm(simulation.positions[rows].mean(axis=0) - between), 0.1)  # it goes on from where it was
        simulation.advance(100)
        np.testing.assert_allclose(simulation.positions[rows], shape + [4, 0, 0], atol=1e-9)
        self.assertEqual(np.abs(simulation.velocities[rows]).max(), 0)
        simulation.send("hand", [4, 1, 0], 0.2)
        simulation.advance(50)
        simulation.set_material("left", damping=0.5)
        simulation.set_state(velocities=simulation.velocities)
        simulation.advance(60)
        np.testing.assert_allclose(simulation.positions[rows], shape + [4, 1, 0], atol=1e-9)
        self.assert_error(pliant.InputError, ("body", "'hand' is scripted", "soft"), simulation.set_material, "hand", damping=1)
        self.assert_error(pliant.InputError, ("send", "\"left\"", "scripted"), simulation.send, "left", [0, 0, 0], 1)
        self.assert_error(pliant.InputError, ("seconds", "0", ""), simulation.send, "hand", [0, 0, 0], 0)


class Saving(Case):
    def test_a_restored_simulation_goes_on_bit_for_bit(self):
        simulation = simulate()
        simulation.advance(20)
        simulation.set_material("left", damping=0.5)
        simulation.advance(5)
        saved = simulation.save()
        simulation.advance(40)
        for other in (simulation, simulate()):
            expected = simulation.positions
            other.restore(saved)
            self.assertEqual((other.steps, other.bodies["left"].damping), (25, 0.5))
            other.advance(40)
            self.assert_same_bits(other.positions, expected)

    def test_bytes_that_do_not_fit_change_nothing(self):
        simulation = simulate()
        simulation.advance(20)
        saved, before = simulation.save(), simulation.positions
        damaged = saved[:100] + bytes([saved[100] ^ 1]) + saved[101:]
        for wrong in (b"", b"nonsense", damaged, saved[:-1], saved + b"x"):
            self.assert_error(pliant.InputError, ("restore", "", "save()"), simulation.restore, wrong)
        other = simulate(falling)
        self.assert_error(pliant.InputError, ("restore", "another scene", ""), other.restore, saved)
        self.assert_same_bits(simulation.positions, before)
        self.assertRaises(TypeError, simulation.restore, "text")


if __name__ == "__main__":
    unittest.main()
