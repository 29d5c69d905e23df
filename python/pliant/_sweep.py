"""Many runs of a scene, side by side."""
from __future__ import annotations

import concurrent.futures
import csv
import hashlib
import itertools
import json
import math
import multiprocessing
import os
import sys
import time
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

from . import _core
from .errors import BreakdownError, Error, InputError
from .scene import Overrides, Scene
from .simulation import Simulation

Row = dict[str, Any]
Run = Callable[[Simulation], Mapping[str, Any]]

_BATCH_SECONDS = 0.2  # of the runs that a worker gets at a time: handing over takes a few milliseconds
_MOST_TRIES = 3  # of a run whose worker has died


def run_to_end(simulation: Simulation) -> Row:
    """Goes on to the scene's duration. Returns what a sweep's table says of a run unless it is told otherwise: steps, contacts,
    and energies at the end [J] beside the one at the start."""
    begin = simulation.measure().energy
    breakdown = None
    try:
        simulation.advance_to(simulation.duration)
    except BreakdownError as error:
        breakdown = str(error)
    report, end = simulation.report(), simulation.measure()
    return {
        "time": report["time"],
        "steps": report["steps"],
        "time_step": simulation.time_step,
        "breakdown": breakdown,
        "initial_energy": begin,
        "kinetic_energy": end.kinetic,
        "elastic_energy": end.elastic,
        "gravitational_energy": end.gravitational,
        "contact_steps": report["contact_steps"],
        "contact_pairs_max": report["contact_pairs_max"],
        "contact_energy_given": report["contacts"]["energy_given"],
        "contact_energy_taken": report["contacts"]["energy_taken"],
        "friction_work": report["contacts"]["friction_work"],
        "held_parts": report["held_parts"],
        "force_evaluations": report["force_evaluations"],
    }


def sweep(scene: Scene | str | PathLike[str], values: Mapping[str, Iterable[Any]] | Sequence[Overrides], *, run: Run = run_to_end,
          out: str | PathLike[str] | None = None, executor: concurrent.futures.Executor | None = None,
          workers: int | None = None, device: str = "cpu", runs_per_gpu: int = 1, precision: int | None = None, threads: int = 1,
          progress: bool | None = None) -> list[Row]:
    """Runs a scene with many values, and returns a row for each run, in the order of the values.

    A row has the values by their keys, then what ``run`` returns, then

    - ``error``: why the run could not be made, else None. The other runs go on. The next sweep tries it again.
    - ``warnings``: those of its scene, one after the other.
    - ``wall_seconds``: how long it took, the only number that differs from one sweep to the next.
    - ``key``: tells the run from all others. Scene, meshes, values, ``run``'s name, precision, kind of device and the version of
      pliant change it.

    ``pandas.DataFrame(rows)`` and ``pandas.read_csv(out)`` make a table of them.

    Args:
        scene: a Scene, or the path of a scene's file.
        values: a list of values for each key, such as ``{"body.left.stiffness": [10, 20], "simulation.time_step": [1e-3, 2e-3]}``.
            There is a run for each combination. Or a list of dicts, one for each run.
        run: a function of a module that gets a Simulation at its start, and returns numbers and texts by names.
        out: the table's file (CSV). Runs that it has are not made again. Each new row is there as soon as its batch of runs is done.
        executor: runs the workers: any of the form of ``concurrent.futures``, such as those of Dask (``client.get_executor()``)
            and mpi4py (``MPIPoolExecutor()``). If None, processes on this machine. One that dies costs its runs, which are repeated.
        workers: number of processes, or of the executor's workers. If None, one a processor, or ``runs_per_gpu`` for each GPU.
        device: ``cpu``, ``gpu``, or ``gpu:1`` for one of several GPUs. With ``gpu`` workers share out all GPUs of a machine.
        runs_per_gpu: how many runs share a GPU. Small ones leave most of it idle.
        precision: bits of the forces, as of a Simulation.
        threads: of each run on a CPU.
        progress: whether to show a bar. If None, where standard error is a terminal.

    Raises:
        InputError: the scene or a key is wrong, or ``out`` is of another kind of sweep.
    """
    described = scene if isinstance(scene, Scene) else Scene.load(scene)
    place = _Place(device, precision, threads, runs_per_gpu)
    jobs = [_job(described, given, run, place) for given in _combinations(values)]
    table = _Table(out, jobs)
    todo = [job for job in jobs if not table.has(job)]
    bar = _Bar(len(jobs), len(jobs) - len(todo), sys.stderr.isatty() if progress is None else progress)
    if todo:
        for rows in _Sweep(described, run, place, executor, workers).rows_of(todo):
            table.add(rows)
            bar.add(len(rows))
    bar.end()
    table.put_in_order()
    return [table.rows[job.key] for job in jobs]


@dataclass(frozen=True)
class _Place:
    """Where runs are made."""

    device: str
    precision: int | None
    threads: int
    runs_per_gpu: int

    @property
    def shares_gpus(self) -> bool:
        return self.device == "gpu"


@dataclass(frozen=True)
class _Job:
    values: Row
    key: str = field(compare=False)


def _combinations(values: Mapping[str, Iterable[Any]] | Sequence[Overrides]) -> list[Row]:
    if isinstance(values, Mapping):
        lists = {key: list(of) if not isinstance(of, (str, Mapping)) else [of] for key, of in values.items()}
        return [dict(zip(lists, chosen)) for chosen in itertools.product(*lists.values())]
    return [dict(given) for given in values]


def _plain(value: Any) -> Any:
    """Returns a value without numpy's types, so that it looks the same in a key and a table wherever it came from."""
    return value.tolist() if hasattr(value, "tolist") else value


def _job(scene: Scene, given: Row, run: Run, place: _Place) -> _Job:
    values = {key: _plain(value) for key, value in given.items()}
    digest = hashlib.sha256()
    kind = place.device.partition(":")[0]
    parts = (scene._text, scene._overrides, values, f"{run.__module__}.{run.__qualname__}", kind, place.precision, _core.version)
    digest.update(json.dumps(parts, sort_keys=True, default=str).encode())
    for name, mesh in scene._meshes.items():
        digest.update(name.encode() + mesh.positions.tobytes() + mesh.triangles.tobytes())
    return _Job(values, "run-" + digest.hexdigest()[:16])


# In a worker

_gpu: int | None = None  # which one this worker has, if workers share out the GPUs


def _take_gpu(numbers: Any) -> None:
    """Begins a worker process: takes the next number."""
    global _gpu
    _gpu = numbers.get()


def _device_of_worker(place: _Place) -> str:
    """Returns the worker's GPU. Under MPI and Slurm it follows from the worker's number on its machine."""
    if not place.shares_gpus:
        return place.device
    ranks = (os.environ.get(name) for name in ("OMPI_COMM_WORLD_LOCAL_RANK", "MPI_LOCALRANKID", "SLURM_LOCALID"))
    number = _gpu if _gpu is not None else int(next((rank for rank in ranks if rank), 0))
    gpus = [gpu for gpu in json.loads(_core.info())["gpus"] if not gpu["software"]]
    return f"gpu:{number % len(gpus)}" if gpus else "gpu"


def _make_row(scene: Scene, job: _Job, run: Run, device: str, place: _Place) -> Row:
    begin = time.perf_counter()
    results: Row = {}
    error = None
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        try:
            simulation = Simulation(scene.override(job.values), device, precision=place.precision, threads=place.threads)  # type: ignore[arg-type]
            results = {name: _plain(value) for name, value in run(simulation).items()}
        except Error as found:
            error = str(found)
        except Exception as found:  # of `run`: the other runs are not to blame
            error = f"{type(found).__name__}: {found}"
    seconds = time.perf_counter() - begin
    texts = "; ".join(str(warning.message) for warning in told) or None
    return {**job.values, **results, "error": error, "warnings": texts, "wall_seconds": seconds, "key": job.key}


def _make_rows(scene: Scene, jobs: Sequence[_Job], run: Run, place: _Place) -> list[Row]:
    device = _device_of_worker(place)
    return [_make_row(scene, job, run, device, place) for job in jobs]


# In the process that sweeps


class _Sweep:
    """Hands jobs to workers, in batches that are neither too small to pay nor so large that workers end at different times."""

    def __init__(self, scene: Scene, run: Run, place: _Place, executor: concurrent.futures.Executor | None,
                 workers: int | None) -> None:
        self._scene, self._run, self._place = scene, run, place
        self._owns_executor = executor is None
        self._workers = workers or _count_workers(executor, place)
        self._executor = executor or self._make_processes()
        self._seconds_a_run = math.inf  # not known yet
        self._tries: dict[str, int] = {}

    def rows_of(self, jobs: list[_Job]) -> Iterable[list[Row]]:
        """Yields rows as they are made."""
        waiting = list(reversed(jobs))
        running: dict[concurrent.futures.Future[list[Row]], list[_Job]] = {}
        try:
            while waiting or running:
                while waiting and len(running) < 2 * self._workers:
                    batch = [waiting.pop() for _ in range(min(self._batch(len(waiting)), len(waiting)))]
                    running[self._submit(batch)] = batch
                done, _ = concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED)
                for future in done:
                    batch = running.pop(future)
                    rows = self._result(future, batch, waiting)
                    if rows:
                        yield rows
        finally:
            for future in running:
                future.cancel()
            if self._owns_executor:
                self._end_processes()

    def _batch(self, left: int) -> int:
        wanted = _BATCH_SECONDS / self._seconds_a_run if self._seconds_a_run > 0 else math.inf
        return max(1, int(min(wanted, left / (4 * self._workers))))

    def _submit(self, batch: list[_Job]) -> concurrent.futures.Future[list[Row]]:
        try:
            return self._executor.submit(_make_rows, self._scene, batch, self._run, self._place)
        except BrokenProcessPool:
            self._mend()
            return self._executor.submit(_make_rows, self._scene, batch, self._run, self._place)

    def _result(self, future: concurrent.futures.Future[list[Row]], batch: list[_Job], waiting: list[_Job]) -> list[Row]:
        """Returns the rows of a batch. If its worker has died, there are none, and the batch waits again."""
        try:
            rows = future.result()
        except concurrent.futures.BrokenExecutor:
            if not self._owns_executor:
                raise
            return self._repeat(batch, waiting)
        self._seconds_a_run = sum(row["wall_seconds"] for row in rows) / len(rows)
        return rows

    def _repeat(self, batch: list[_Job], waiting: list[_Job]) -> list[Row]:
        """A pool of processes breaks as a whole if one dies, so nobody knows which run it was. Runs that have been lost before
        come alone the next time."""
        self._mend()
        self._seconds_a_run = math.inf
        lost = []
        for job in reversed(batch):
            self._tries[job.key] = self._tries.get(job.key, 0) + 1
            if len(batch) == 1 and self._tries[job.key] >= _MOST_TRIES:
                lost.append({**job.values, "error": f"its process died {_MOST_TRIES} times", "warnings": None, "wall_seconds": None,
                             "key": job.key})
            else:
                waiting.append(job)
        return lost

    def _make_processes(self) -> concurrent.futures.Executor:
        # A fork of this process would inherit locks of its threads and contexts of its GPUs.
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload(["pliant"])
        if not self._place.shares_gpus:
            return concurrent.futures.ProcessPoolExecutor(self._workers, context)
        numbers = context.Queue()
        for worker in range(2 * self._workers):  # some for processes that come after one that died
            numbers.put(worker)
        return concurrent.futures.ProcessPoolExecutor(self._workers, context, _take_gpu, (numbers,))

    def _mend(self) -> None:
        self._executor.shutdown(wait=False, cancel_futures=True)
        self._executor = self._make_processes()

    def _end_processes(self) -> None:
        """Ends processes at once. After Ctrl-C they may have long runs in hand."""
        processes = list((getattr(self._executor, "_processes", None) or {}).values())
        self._executor.shutdown(wait=False, cancel_futures=True)
        for process in processes:
            process.terminate()
        for process in processes:
            process.join()


def _count_workers(executor: concurrent.futures.Executor | None, place: _Place) -> int:
    if executor is not None:
        return int(getattr(executor, "_max_workers", None) or getattr(executor, "num_workers", None) or os.cpu_count() or 1)
    if place.shares_gpus:
        gpus = sum(not gpu["software"] for gpu in json.loads(_core.info())["gpus"])
        return max(1, gpus) * place.runs_per_gpu
    if place.device.startswith("gpu"):
        return place.runs_per_gpu
    return max(1, len(os.sched_getaffinity(0)) // max(1, place.threads))


class _Table:
    """The rows by their keys, and their file."""

    def __init__(self, file: str | PathLike[str] | None, jobs: Sequence[_Job]) -> None:
        self._file = None if file is None else Path(file)
        self._jobs = jobs
        self._columns: list[str] = []
        self.rows: dict[str, Row] = {}
        if self._file is not None and self._file.exists():
            self._read(self._file)

    def _read(self, file: Path) -> None:
        with open(file, newline="", encoding="utf-8") as text:
            reader = csv.DictReader(text)
            self._columns = list(reader.fieldnames or [])
            swept = list(self._jobs[0].values) if self._jobs else []
            if self._columns and (self._columns[-1] != "key" or self._columns[: len(swept)] != swept):
                raise InputError(str(file), "is no table of this sweep: its columns are others", "name another file, or remove it")
            for row in reader:
                if None not in row.values() and None not in row:  # else it was cut off
                    self.rows[row["key"]] = {name: _read_cell(cell) for name, cell in row.items()}

    def has(self, job: _Job) -> bool:
        row = self.rows.get(job.key)
        return row is not None and row["error"] is None

    def add(self, rows: Sequence[Row]) -> None:
        for row in rows:
            self.rows[row["key"]] = row
        if self._file is None:
            return
        is_wider = any(name not in self._columns for row in rows for name in row)
        if is_wider:  # the first rows, or the first without an error
            self._columns = _joined_columns(self.rows.values(), self._jobs)
            self._write(list(self.rows.values()))
            return
        with open(self._file, "a", newline="", encoding="utf-8") as text:
            self._append(text, rows)

    def put_in_order(self) -> None:
        """Lets the file have the sweep's rows in the order of its values, and behind them what else it had."""
        if self._file is None or not self.rows:
            return
        order = {job.key: place for place, job in enumerate(self._jobs)}
        self._write(sorted(self.rows.values(), key=lambda row: order.get(row["key"], len(order))))

    def _write(self, rows: Sequence[Row]) -> None:
        """Replaces the file as a whole."""
        assert self._file is not None
        self._columns = self._columns or _joined_columns(rows, self._jobs)
        unfinished = self._file.with_name(self._file.name + ".part")
        with open(unfinished, "w", newline="", encoding="utf-8") as text:
            csv.writer(text).writerow(self._columns)
            self._append(text, rows)
        os.replace(unfinished, self._file)

    def _append(self, text: Any, rows: Sequence[Row]) -> None:
        writer = csv.writer(text)
        for row in rows:
            writer.writerow([_cell(row.get(name)) for name in self._columns])


_LAST_COLUMNS = ["error", "warnings", "wall_seconds", "key"]


def _joined_columns(rows: Iterable[Row], jobs: Sequence[_Job]) -> list[str]:
    names = dict.fromkeys(name for job in jobs for name in job.values)
    names.update(dict.fromkeys(name for row in rows for name in row))
    return [name for name in names if name not in _LAST_COLUMNS] + _LAST_COLUMNS


def _cell(value: Any) -> str:
    """Numbers keep every bit. Lists are JSON, and so are texts that would be read as something else."""
    if value is None:
        return ""
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, str) and _read_cell(value) == value:
        return value
    return json.dumps(value)


def _read_cell(cell: str) -> Any:
    if cell == "":
        return None
    if cell in ("nan", "inf", "-inf"):
        return float(cell)
    try:
        return json.loads(cell)
    except ValueError:
        return cell


class _Bar:
    """A line on standard error that says how far the sweep is."""

    def __init__(self, count: int, done: int, is_shown: bool) -> None:
        self._count, self._done, self._is_shown = count, done, is_shown
        self._before, self._begin = done, time.monotonic()
        self._show()

    def add(self, count: int) -> None:
        self._done += count
        self._show()

    def end(self) -> None:
        if self._is_shown:
            print(file=sys.stderr)

    def _show(self) -> None:
        if not self._is_shown:
            return
        part = self._done / max(1, self._count)
        made = self._done - self._before
        left = (time.monotonic() - self._begin) / made * (self._count - self._done) if made else 0
        bar = ("#" * round(30 * part)).ljust(30)
        told = f", {left:.0f} s left" if left >= 1 else ""
        print(f"\r[{bar}] {self._done} of {self._count} runs{told}\x1b[K", end="", file=sys.stderr, flush=True)
