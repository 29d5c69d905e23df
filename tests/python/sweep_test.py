"""Sweeps: their rows, their tables, and what happens to runs that fail and workers that die."""
import concurrent.futures
import csv
import functools
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

import pliant
import sweep_runs
from support import Case, meeting, program

try:
    import distributed
except ImportError:
    distributed = None

small = {**meeting, "simulation": {"time_step": 0.002, "duration": 0.02}}
values = {"body.left.stiffness": [10, 20.5, 1e-3], "body.right.damping": [0, 1]}


def without_times(rows):
    return [{name: value for name, value in row.items() if name != "wall_seconds"} for row in rows]


class InFolder(Case):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.table = self.folder / "table.csv"
        self.scene = pliant.Scene({**small, "title": folder.name})

    def sweep(self, values=values, **how):
        return pliant.sweep(self.scene, values, **{"workers": 2, "progress": False, **how})

    def calls(self):
        return len(list(self.folder.glob("call-*")))


class Rows(InFolder):
    def test_there_is_a_row_for_each_combination_with_the_bits_of_its_simulation(self):
        rows = self.sweep()
        chosen = [(row["body.left.stiffness"], row["body.right.damping"]) for row in rows]
        self.assertEqual(chosen, [(10, 0), (10, 1), (20.5, 0), (20.5, 1), (1e-3, 0), (1e-3, 1)])
        for row in rows:
            simulation = pliant.Simulation(self.scene, "cpu", threads=1,
                                           set={key: row[key] for key in values})
            expected = pliant.run_to_end(simulation)
            self.assertEqual({name: row[name] for name in expected}, expected)
            self.assertEqual(row["steps"], 10)
            self.assertIsNone(row["error"])
        self.assertEqual(len({row["key"] for row in rows}), 6)

    def test_rows_do_not_depend_on_workers_executors_and_order(self):
        rows = without_times(self.sweep())
        self.assertEqual(without_times(self.sweep(workers=1)), rows)
        with concurrent.futures.ThreadPoolExecutor(2) as executor:
            self.assertEqual(without_times(self.sweep(executor=executor)), rows)
        listed = [{key: row[key] for key in values} for row in rows]
        self.assertEqual(without_times(self.sweep(listed[::-1])), rows[::-1])

    @unittest.skipIf(distributed is None, "there is no Dask")
    def test_dask_gives_the_same_rows(self):
        with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
            with distributed.Client(cluster) as client:
                self.assertEqual(without_times(self.sweep(executor=client.get_executor(pure=False))), without_times(self.sweep()))

    def test_a_run_that_fails_has_its_error_and_others_go_on(self):
        rows = self.sweep({"body.right.position": [[1.1, 0, 0], [0, 0, 0]], "simulation.integrator": ["dop853", "nonsense"]})
        self.assertIsNone(rows[0]["error"])
        self.assertIn("nonsense", rows[1]["error"])
        self.assertIn("\"left\"", rows[2]["error"])
        self.assertNotIn("steps", rows[3])

    def test_a_run_that_breaks_down_says_where(self):
        rows = self.sweep([{"simulation.time_step": step, "simulation.duration": 100 * step, "simulation.integrator": "rk4",
                            "collision.response": "none"} for step in (0.002, 10.0)])
        self.assertIsNone(rows[0]["breakdown"])
        self.assertIn("is not finite in step", rows[1]["breakdown"])
        self.assertIn("stability bound", rows[1]["warnings"])

    def test_what_is_wrong_with_all_runs_is_an_error_at_once(self):
        self.assert_error(pliant.InputError, ("nowhere.toml", "", ""), pliant.sweep, "nowhere.toml", values)
        expect = self.assert_error
        expect(pliant.InputError, ("set: body.left.stifness", "unknown key", "stiffness"), self.sweep, {"body.left.stifness": [1, 2]})
        expect(pliant.InputError, ("set: body.middle.damping", "no body", ""), self.sweep, {"body.middle.damping": [1]})
        expect(pliant.InputError, ("device", "'tpu'", "gpu:N"), self.sweep, device="tpu")
        expect(pliant.InputError, ("workers", "-1", ""), self.sweep, workers=-1)
        expect(pliant.InputError, ("runs_per_gpu", "0", ""), self.sweep, runs_per_gpu=0)
        expect(pliant.InputError, ("run", "partial", "function"), self.sweep, run=functools.partial(print))
        expect(pliant.InputError, ("run", "other processes", "module"), self.sweep, run=lambda simulation: {})
        self.assertRaises(FileNotFoundError, self.sweep, out=self.folder / "nowhere" / "table.csv")
        self.assertEqual(self.sweep([]), [])

    def test_equal_values_are_one_run(self):
        rows = self.sweep({"body.left.stiffness": [10, 10, 10]}, run=sweep_runs.count)
        self.assertEqual(rows, 3 * rows[:1])
        self.assertEqual(self.calls(), 1)

    def test_warnings_are_those_of_each_scene_on_threads_too(self):
        swept = {"simulation.time_step": [0.002, 10.0] * 4, "simulation.integrator": ["rk4"]}
        with concurrent.futures.ThreadPoolExecutor(4) as executor:
            rows = self.sweep(swept, executor=executor, workers=4, run=sweep_runs.count)
        self.assertEqual([row["warnings"] is not None for row in rows], 4 * [False, True])

    def test_the_command_module_is_called_like_the_function(self):
        import pliant.sweep as module

        self.assertEqual(len(module(self.scene, {"body.left.stiffness": [10]}, workers=1, progress=False)), 1)


class Tables(InFolder):
    def test_the_table_has_the_rows_and_runs_that_it_has_are_not_made_again(self):
        rows = self.sweep(out=self.table, run=sweep_runs.count)
        self.assertEqual(self.calls(), 6)
        with open(self.table, newline="") as text:
            self.assertEqual([float(row["x"]) for row in csv.DictReader(text)], [row["x"] for row in rows])
        before = self.table.read_text()
        self.assertEqual(self.sweep(out=self.table, run=sweep_runs.count), rows)  # types and bits, from the file
        self.assertEqual(self.calls(), 6)
        self.assertEqual(self.table.read_text(), before)

    def test_more_values_make_only_the_runs_that_are_missing(self):
        first = self.sweep({**values, "body.left.stiffness": [10, 20.5]}, out=self.table, run=sweep_runs.count)
        more = self.sweep(out=self.table, run=sweep_runs.count)
        self.assertEqual(self.calls(), 6)
        self.assertEqual(more[:4], first)
        self.sweep({**values, "body.left.stiffness": [20.5]}, out=self.table, run=sweep_runs.count)
        with open(self.table, newline="") as text:
            stiffnesses = [float(row["body.left.stiffness"]) for row in csv.DictReader(text)]
        self.assertEqual(sorted(stiffnesses), [1e-3, 1e-3, 10, 10, 20.5, 20.5])  # other rows stay
        self.assertEqual(self.calls(), 6)

    def test_another_scene_makes_other_runs(self):
        self.sweep(out=self.table, run=sweep_runs.count)
        self.scene = self.scene.override({"simulation.duration": 0.03})
        self.sweep(out=self.table, run=sweep_runs.count)
        self.assertEqual(self.calls(), 12)

    def test_a_table_that_was_cut_off_anywhere_loses_no_other_row(self):
        """A crash cuts the file, and another one the rows that come behind."""
        rows = self.sweep(out=self.table, run=sweep_runs.return_numpys_values)
        text = self.table.read_text()
        first = text.index("\n") + 1
        for length in range(first, len(text)):
            self.table.write_text(text[:length])
            whole = text[:length].count("\n") - 1
            jobs = [pliant._sweep._job(self.scene, {key: row[key] for key in values}, sweep_runs.return_numpys_values,
                                       pliant._sweep._Place("cpu", None, 1, 1)) for row in rows]
            with pliant._sweep._Table.of(self.table, jobs) as table:
                self.assertEqual([table.has(job) for job in jobs], 6 * [False] if whole < 0 else whole * [True] + (6 - whole) * [False])
                table.add(rows[-1:])
            with pliant._sweep._Table.of(self.table, jobs) as table:
                self.assertEqual(table.rows[rows[-1]["key"]], rows[-1])
                self.assertEqual(len(table.rows), whole + (whole < 6))

    def test_values_are_the_same_from_memory_and_from_the_table(self):
        rows = self.sweep(out=self.table, run=sweep_runs.return_numpys_values)
        self.assertEqual({name: rows[0][name] for name in ("number", "numbers", "text", "nothing", "empty")},
                         {"number": 0.1, "numbers": [1, 2], "text": "true", "nothing": None, "empty": ""})
        self.assertEqual(self.sweep(out=self.table, run=sweep_runs.return_numpys_values), rows)

    def test_a_value_that_no_table_can_hold_is_an_error_of_its_run(self):
        for row in self.sweep(out=self.table, run=sweep_runs.return_odd_values):
            self.assertIn("TypeError", row["error"])

    def test_values_of_any_type_are_the_same_from_memory_and_from_the_table(self):
        swept = [{"body.left.position": (-1.5, np.int64(0), 0), "body.right.position": np.array([1.5, 0, 0]),
                  "body.left.mesh": pathlib.PurePath("icosphere:1"), "simulation.sleep": False}]
        rows = self.sweep(swept, out=self.table)
        self.assertEqual((rows[0]["body.left.position"], rows[0]["body.left.mesh"], rows[0]["error"]), ([-1.5, 0, 0], "icosphere:1", None))
        self.assertEqual(self.sweep(swept, out=self.table), rows)

    def test_a_single_value_is_a_list_of_one(self):
        self.assertEqual(len(self.sweep({"body.left.stiffness": 10, "simulation.integrator": "rk4"})), 1)

    def test_results_do_not_replace_values(self):
        row = self.sweep({"body.left.stiffness": 10}, run=sweep_runs.return_what_is_taken)[0]
        self.assertEqual(row["body.left.stiffness"], 10)
        self.assertIn("body.left.stiffness, key", row["error"])
        self.assertNotIn("steps", row)

    def test_one_sweep_at_a_time_writes_a_table(self):
        with pliant._sweep._only_writer(self.table):
            self.assert_error(pliant.InputError, ("table.csv", "another sweep", ""), self.sweep, out=self.table)
        self.sweep(out=self.table)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["table.csv"])

    def test_a_run_with_an_error_is_tried_again(self):
        swept = {"body.left.stiffness": [10, 20]}
        rows = self.sweep(swept, out=self.table, run=sweep_runs.fail_at_first)
        self.assertEqual([row["error"] for row in rows], [None, "ValueError: not yet"])
        rows = self.sweep(swept, out=self.table, run=sweep_runs.fail_at_first)
        self.assertEqual([(row["error"], row["steps"]) for row in rows], [(None, 0), (None, 0)])
        self.assertEqual(len(self.table.read_text().splitlines()), 3)

    def test_a_table_of_another_sweep_is_left_alone(self):
        self.table.write_text("a,b\n1,2\n")
        self.assert_error(pliant.InputError, ("table.csv", "columns", "another file"), self.sweep, out=self.table)
        self.assertEqual(self.table.read_text(), "a,b\n1,2\n")
        self.assert_error(pliant.InputError, ("/dev/null", "no plain file", ""), self.sweep, out="/dev/null")

    def test_a_sweep_that_is_killed_leaves_no_processes(self):
        file = self.folder / "endless.py"
        file.write_text("import time, pliant, sweep_runs\n"
                        f"if __name__ == '__main__':\n    scene = pliant.Scene({{**{small!r}, 'title': {self.folder.name!r}}})\n"
                        "    pliant.sweep(scene, {'body.left.stiffness': [1, 2]}, workers=2, run=sweep_runs.tell_and_wait)\n")
        sweeper = subprocess.Popen([sys.executable, file], cwd=self.folder.parent)
        while len(told := list(self.folder.glob("pid-*"))) < 2:
            time.sleep(0.05)
        sweeper.kill()
        sweeper.wait()
        for path in told:
            while pathlib.Path(f"/proc/{path.name.removeprefix('pid-')}").exists():
                time.sleep(0.05)  # the test's limit of time ends it


class Deaths(InFolder):
    def test_a_worker_that_dies_costs_its_run_which_is_repeated(self):
        swept = {"body.left.stiffness": [10, 20, 30], "body.right.damping": [0, 0.5, 1, 1.5]}
        rows = self.sweep(swept, out=self.table, run=sweep_runs.die_once)
        self.assertTrue((self.folder / "died").exists())
        self.assertEqual(len({row["key"] for row in rows}), 12)
        undisturbed = self.sweep(swept, run=sweep_runs.die_once)
        self.assertEqual(without_times(rows), without_times(undisturbed))
        with open(self.table, newline="") as text:
            self.assertEqual([row["key"] for row in csv.DictReader(text)], [row["key"] for row in rows])

    def test_a_run_that_ends_every_worker_says_so_and_others_are_made(self):
        os.mkfifo(self.folder / "pipe")
        for run in (sweep_runs.die_always, sweep_runs.die_while_others_run):
            rows = self.sweep({"body.left.stiffness": [10, 20, 30, 40, 50]}, run=run)
            self.assertEqual([row["error"] for row in rows], [None, "its process died 3 times", None, None, None])


class Command(InFolder):
    def setUp(self):
        super().setUp()
        (self.folder / "scene.toml").write_text(self.scene.text)
        self.file = self.folder / "sweep.toml"
        self.write("")

    def write(self, more):
        self.file.write_text("scene = \"scene.toml\"\n[values]\n\"body.left.stiffness\" = { from = 1, to = 100, count = 3, "
                             "spacing = \"logarithmic\" }\nbody.right.damping = { from = 0, to = 1, count = 2 }\n" + more)

    def command(self, *options):
        return subprocess.run([program, "sweep", self.file, *options], capture_output=True, text=True)

    def test_it_makes_the_runs_of_the_file(self):
        done = self.command("--workers", "2")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("sweep.csv (6 runs)", done.stdout)
        with open(self.folder / "sweep.csv", newline="") as text:
            made = [(float(row["body.left.stiffness"]), float(row["body.right.damping"])) for row in csv.DictReader(text)]
        for (stiffness, damping), (wanted, other) in zip(made, [(1, 0), (1, 1), (10, 0), (10, 1), (100, 0), (100, 1)], strict=True):
            self.assertAlmostEqual(stiffness, wanted)
            self.assertEqual(damping, other)

    def test_what_is_wrong_has_its_exit_code(self):
        for options, code, text in ((("--workers", "0"), 2, "--workers"), (("--executor", "carrier:pigeon"), 2, "processes, dask"),
                                    (("--nonsense",), 2, "--nonsense")):
            done = self.command(*options)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(text, done.stderr)
        for more, text in (("simulation.time_step = { from = 1 }", "values.simulation.time_step"), ("[nonsense]", "unknown key"),
                           ("x = ", "TOML")):
            self.write(more)
            done = self.command()
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(text, done.stderr)

    def test_without_the_package_the_remedy_is_named(self):
        for python in ("/nonexistent", "/bin/false"):
            done = subprocess.run([program, "sweep", self.file], capture_output=True, text=True, env={**os.environ, "PLIANT_PYTHON": python})
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn("python3-pliant", done.stderr)

    def test_after_ctrl_c_the_same_command_goes_on(self):
        self.write("simulation.duration = { from = 0.5, to = 1, count = 10 }")
        begun = subprocess.Popen([program, "sweep", self.file, "--workers", "2"], stderr=subprocess.PIPE, text=True,
                                 start_new_session=True)
        table = self.folder / "sweep.csv"
        while begun.poll() is None and (not table.exists() or table.read_text().count("\n") < 2):
            time.sleep(0.01)
        os.killpg(begun.pid, signal.SIGINT)
        _, told = begun.communicate()
        self.assertEqual(begun.returncode, 130, told)
        self.assertEqual(told.count("Traceback"), 0, told)
        with open(table, newline="") as text:
            made = list(csv.DictReader(text))
        self.assertGreater(len(made), 0)
        self.assertLess(len(made), 60)
        self.assertEqual(self.command("--quiet").returncode, 0)
        with open(table, newline="") as text:
            rows = {row["key"]: row for row in csv.DictReader(text)}
        self.assertEqual(len(rows), 60)
        for row in made:
            self.assertEqual(rows[row["key"]], row)

    def test_runs_with_errors_have_an_exit_code(self):
        self.write("body.right.position = [[1.1, 0, 0], [0, 0, 0]]")
        done = self.command("--quiet")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("(12 runs, 6 with an error)", done.stdout)


if __name__ == "__main__":
    unittest.main()
