"""Many runs of a scene, side by side."""
from __future__ import annotations

import concurrent.futures
import contextlib
import csv
import fcntl
import functools
import hashlib
import inspect
import io
import itertools
import json
import math
import multiprocessing
import os
import pickle
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

from . import _core
from .errors import BreakdownError, Error, InputError, SceneWarning
from .scene import Overrides, Scene
from .simulation import Simulation

Row = dict[str, Any]
Run = Callable[[Simulation], Mapping[str, Any]]

_BATCH_SECONDS = 0.5  # of the runs that a worker gets at a time: handing over takes a few milliseconds, with Dask ten
_MOST_RUNS = 10**7
_MOST_TRIES = 3  # of a run whose worker has died
_LAST_COLUMNS = ["error", "warnings", "wall_seconds", "key"]


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
    - ``key``: tells the run from all others. Scene, meshes, values, the text of ``run``, precision, kind of device, and version
      and commit of pliant change it. What ``run`` calls does not.

    ``pandas.DataFrame(rows)`` and ``pandas.read_csv(out)`` make a table of them.

    Args:
        scene: a Scene, or the path of a scene's file.
        values: a list of values for each key, such as ``{"body.left.stiffness": [10, 20], "simulation.time_step": [1e-3, 2e-3]}``.
            There is a run for each combination. Or a list of dicts, one for each run.
        run: a function of a module that gets a Simulation at its start, and returns numbers and texts by names.
        out: the table's file (CSV). Runs that it has are not made again. Each new row is there as soon as its batch of runs is done.
        executor: runs the workers: any of the form of ``concurrent.futures``, such as those of Dask (``client.get_executor()``)
            and mpi4py (``MPIPoolExecutor()``). If it breaks, the sweep ends, and the table has the rows so far. If None, processes
            on this machine. One that dies costs its runs, which are repeated.
        workers: number of processes, or of the executor's workers. If None, one a processor, or ``runs_per_gpu`` for each GPU.
        device: ``cpu``, ``gpu``, or ``gpu:1`` for one of several GPUs. With ``gpu`` processes on this machine share out its GPUs.
            Workers of an executor take the one of their number under MPI or Slurm, else that of the environment's PLIANT_GPU.
        runs_per_gpu: how many runs share a GPU. Small ones leave most of it idle.
        precision: bits of the forces, as of a Simulation.
        threads: of each run on a CPU.
        progress: whether to show a bar. If None, where standard error is a terminal.

    Raises:
        InputError: the scene, a key or an argument is wrong, or ``out`` is of another kind of sweep, or in use by one.
    """
    for name, number in (("workers", 1 if workers is None else workers), ("runs_per_gpu", runs_per_gpu)):
        if number < 1:
            raise InputError(name, f"{number} is below 1", "name at least one")
    described = scene if isinstance(scene, Scene) else Scene.load(scene)
    place = _Place(device, precision, threads, runs_per_gpu)
    jobs = [_job(described, given, run, place) for given in _combinations(values)]
    _expect_sound(described, jobs, place)
    with _Table.of(out, jobs) as table:
        todo = list({job.key: job for job in jobs if not table.has(job)}.values())
        bar = _Bar(len(jobs), len(jobs) - len(todo), sys.stderr.isatty() if progress is None else progress)
        with contextlib.closing(_rows_of(todo, _Workers(described, run, place, executor, workers))) as batches:
            for rows in batches:
                table.add(rows)
                bar.add(len(rows))
        bar.end()
        table.put_in_order()
        return [table.rows[job.key] for job in jobs]


class _Place(NamedTuple):
    """Where runs are made."""

    device: str
    precision: int | None
    threads: int
    runs_per_gpu: int

    @property
    def shares_gpus(self) -> bool:
        return self.device == "gpu"


class _Job(NamedTuple):
    values: Row
    key: str


def _combinations(values: Mapping[str, Iterable[Any]] | Sequence[Overrides]) -> list[Row]:
    if isinstance(values, Mapping):
        lists = {key: [of] if isinstance(of, (str, Mapping)) or not isinstance(of, Iterable) else list(of) for key, of in values.items()}
        if (count := math.prod(len(of) for of in lists.values())) > _MOST_RUNS:
            raise InputError("values", f"make {count} runs", f"use at most {_MOST_RUNS} combinations")
        return [dict(zip(lists, chosen)) for chosen in itertools.product(*lists.values())]
    return [dict(given) for given in values]


def _plain(value: Any) -> Any:
    """Returns a value of JSON's types alone, so that it is the same in a key and a table wherever it came from."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, PathLike):
        return os.fspath(value)
    if isinstance(value, Mapping):
        return {str(key): _plain(of) for key, of in value.items()}
    return [_plain(of) for of in value] if isinstance(value, (list, tuple)) else value


def _job(scene: Scene, given: Row, run: Run, place: _Place) -> _Job:
    name = getattr(run, "__qualname__", None)
    if name is None:
        raise InputError("run", f"{run!r} has no name", "pass a function of a module")
    values = {key: _plain(value) for key, value in given.items()}
    kind = place.device.partition(":")[0]
    parts = (scene._text, scene._overrides, values, name, _source_of(run), kind, place.precision, _core.version, _core.commit)
    try:
        digest = hashlib.sha256(json.dumps(parts, sort_keys=True).encode())
    except TypeError as error:
        raise InputError("values", f"{values} can't be set: {error}", "use numbers, texts, lists and dicts") from error
    for name, mesh in scene._meshes.items():
        digest.update(name.encode() + mesh.positions.tobytes() + mesh.triangles.tobytes())
    return _Job(values, "run-" + digest.hexdigest()[:16])


@functools.cache
def _source_of(run: Run) -> str:
    """Returns the text of a function, or its module where there is no text, as in an interpreter."""
    try:
        return inspect.getsource(run)
    except (OSError, TypeError):
        return run.__module__


def _expect_sound(scene: Scene, jobs: Sequence[_Job], place: _Place) -> None:
    """Raises InputError for what would be wrong with all runs: a key that there is not, or a device."""
    Simulation.expect_choices(place.device, place.precision, place.threads)
    tried = set()
    for job in jobs:
        new = [key for key in job.values if key not in tried]
        tried.update(new)
        for key in new:
            try:
                scene.override({key: job.values[key]})
            except InputError as error:
                if "unknown key" in error.problem or "there is no body" in error.problem:
                    raise


# In a worker

_gpu: int | None = None  # which one this worker has, if workers share out the GPUs


def _end_with(process: int) -> None:
    """Ends this process when another one has gone. Else workers would wait for ever after a sweep that was killed."""
    while True:
        try:
            os.kill(process, 0)
        except OSError:
            os._exit(1)
        time.sleep(1)


def _begin_process(sweeper: int, numbers: Any) -> None:
    """Begins a worker process. It takes the next number if there are any, and leaves Ctrl-C to the process that sweeps."""
    global _gpu
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(sweeper,), daemon=True).start()
    if numbers is not None:
        _gpu = numbers.get()


def _device_of_worker(place: _Place) -> str:
    if not place.shares_gpus:
        return place.device
    names = ("PLIANT_GPU", "OMPI_COMM_WORLD_LOCAL_RANK", "MPI_LOCALRANKID", "SLURM_LOCALID")
    number = _gpu if _gpu is not None else int(next((os.environ[name] for name in names if os.environ.get(name)), 0))
    gpus = [gpu for gpu in json.loads(_core.info())["gpus"] if not gpu["software"]]
    return f"gpu:{number % len(gpus)}" if gpus else "gpu"


def _make_row(scene: Scene, job: _Job, run: Run, device: str, place: _Place) -> Row:
    begin = time.perf_counter()
    results: Row = {}
    error = told = None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SceneWarning)  # the row has them
            simulation = Simulation(scene.override(job.values), device, precision=place.precision,  # type: ignore[arg-type]
                                    threads=place.threads)
        told = "; ".join(simulation.warnings) or None
        # As they are read from a table again, so that rows are the same in either case.
        results = {name: _read_cell(_cell(_plain(value))) for name, value in run(simulation).items()}
        if taken := sorted({*job.values, *_LAST_COLUMNS} & set(results)):
            results = {}
            raise InputError("run", f"returns {', '.join(taken)}, which the row has already", "use other names")
    except Error as found:
        error = str(found)
    except (Exception, SystemExit) as found:  # of `run`: the other runs are not to blame
        error = f"{type(found).__name__}: {found}"
    seconds = time.perf_counter() - begin
    return {**job.values, **results, "error": error, "warnings": told, "wall_seconds": seconds, "key": job.key}


def _make_rows(scene: Scene, jobs: Sequence[_Job], run: Run, place: _Place) -> list[Row]:
    device = _device_of_worker(place)
    return [_make_row(scene, job, run, device, place) for job in jobs]


# In the process that sweeps


class _Workers:
    """An executor, and what makes another one if its processes have died."""

    def __init__(self, scene: Scene, run: Run, place: _Place, executor: concurrent.futures.Executor | None,
                 workers: int | None) -> None:
        self._scene, self._run, self._place = scene, run, place
        self.are_own = executor is None
        self.count = workers or _count_workers(executor, place)
        self._executor = executor
        if self.are_own:
            try:
                pickle.dumps(run)
            except Exception as error:
                raise InputError("run", f"can't go to other processes: {error}", "pass a function of a module") from error

    def submit(self, batch: Sequence[_Job]) -> concurrent.futures.Future[list[Row]]:
        if self._executor is None:
            self._executor = self._make_processes()
        return self._executor.submit(_make_rows, self._scene, batch, self._run, self._place)

    def _make_processes(self) -> concurrent.futures.Executor:
        # A fork of this process would inherit locks of its threads and contexts of its GPUs.
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload(["pliant"])
        numbers = context.Queue() if self._place.shares_gpus else None
        if numbers is not None:
            for worker in range(self.count):
                numbers.put(worker)
        return concurrent.futures.ProcessPoolExecutor(self.count, context, _begin_process, (os.getpid(), numbers))

    def end(self) -> None:
        """Ends own processes at once. After Ctrl-C they may have long runs in hand."""
        if not self.are_own or self._executor is None:
            return
        processes = list((getattr(self._executor, "_processes", None) or {}).values())
        self._executor.shutdown(wait=False, cancel_futures=True)
        for process in processes:
            process.terminate()
        for process in processes:
            process.join()
        self._executor = None


class _Batches:
    """Says how many runs a worker gets at a time: neither too few to pay, nor so many that workers end at different times."""

    def __init__(self, workers: int) -> None:
        self._workers = workers
        self._seconds_a_run = math.inf  # not known yet

    def size(self, left: int) -> int:
        wanted = _BATCH_SECONDS / self._seconds_a_run if self._seconds_a_run > 0 else math.inf
        return max(1, int(min(wanted, left / (4 * self._workers))))

    def learn(self, rows: Sequence[Row]) -> None:
        self._seconds_a_run = sum(row["wall_seconds"] for row in rows) / len(rows)


def _rows_of(jobs: Sequence[_Job], workers: _Workers) -> Generator[list[Row], None, None]:
    """Yields rows as they are made.

    A pool of processes breaks as a whole if one of them dies, and nobody knows whose run it was. So all that were running are
    suspects. They are made at the end, one at a time, and there each death has its culprit.
    """
    batches = _Batches(workers.count)
    waiting, suspects = list(reversed(jobs)), list[_Job]()
    running: dict[concurrent.futures.Future[list[Row]], list[_Job]] = {}
    try:
        while waiting or running:
            try:
                while waiting and len(running) < 2 * workers.count:
                    batch = waiting[: -batches.size(len(waiting)) - 1 : -1]
                    running[workers.submit(batch)] = batch
                    del waiting[-len(batch) :]
                done, _ = concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED)
                for future in done:
                    rows = future.result()
                    del running[future]
                    batches.learn(rows)
                    yield rows
            except concurrent.futures.BrokenExecutor:
                if not workers.are_own:
                    raise
                suspects += [job for batch in running.values() for job in batch]
                running.clear()
                workers.end()
        for job in suspects:
            yield [_try_alone(job, workers)]
    finally:
        for future in running:
            future.cancel()
        workers.end()


def _try_alone(job: _Job, workers: _Workers) -> Row:
    for _ in range(_MOST_TRIES):
        try:
            return workers.submit([job]).result()[0]
        except concurrent.futures.BrokenExecutor:
            workers.end()
    return {**job.values, "error": f"its process died {_MOST_TRIES} times", "warnings": None, "wall_seconds": None, "key": job.key}


def _count_workers(executor: concurrent.futures.Executor | None, place: _Place) -> int:
    if executor is not None:
        counts = (getattr(executor, name, None) for name in ("_max_workers", "num_workers"))  # of processes and threads, and of MPI
        dask = getattr(executor, "_client", None)
        return sum(dask.nthreads().values()) if dask is not None else next((int(c) for c in counts if c), os.cpu_count() or 1)
    if place.shares_gpus:
        gpus = sum(not gpu["software"] for gpu in json.loads(_core.info())["gpus"])
        return max(1, gpus) * place.runs_per_gpu
    if place.device.startswith("gpu"):
        return place.runs_per_gpu
    return max(1, len(os.sched_getaffinity(0)) // max(1, place.threads))


class _Table:
    """The rows by their keys, and their file."""

    def __init__(self, file: Path | None, jobs: Sequence[_Job]) -> None:
        self._file = file
        self._jobs = jobs
        self._columns: list[str] = []
        self._is_whole = False  # the file is there, and was not cut off
        self._row_count = 0  # of the file, which may have several of one run until the sweep ends
        self.rows: dict[str, Row] = {}
        if file is not None and file.exists():
            self._read(file)

    @staticmethod
    @contextlib.contextmanager
    def of(file: str | PathLike[str] | None, jobs: Sequence[_Job]) -> Iterator[_Table]:
        """Yields the table of a file, which no other sweep writes meanwhile. It is made if it is not there, so that a place where
        it can't be is noticed at once."""
        if file is None:
            yield _Table(None, jobs)
            return
        if Path(file).exists() and not Path(file).is_file():
            raise InputError(str(file), "is no plain file", "name another place")
        with _only_writer(Path(file)):
            table = _Table(Path(file), jobs)
            if jobs and not table._is_whole:
                table._write(list(table.rows.values()))
            yield table

    def _read(self, file: Path) -> None:
        """A row that was cut off is left out. The last one ends with the line's end if it was not."""
        text = file.read_bytes().decode("utf-8", "replace")
        whole = text[: text.rfind("\n") + 1]
        reader = csv.DictReader(io.StringIO(whole, newline=""))
        self._columns = list(reader.fieldnames or [])
        swept = list(self._jobs[0].values) if self._jobs else []
        self._is_whole = whole == text and whole != ""
        if whole and (self._columns[-len(_LAST_COLUMNS) :] != _LAST_COLUMNS or self._columns[: len(swept)] != swept):
            raise InputError(str(file), "is no table of this sweep: its columns are others", "name another file, or remove it")
        for row in reader:
            self._row_count += 1
            if None not in row.values() and None not in row:
                self.rows[row["key"]] = {name: _read_cell(cell) for name, cell in row.items()}

    def has(self, job: _Job) -> bool:
        row = self.rows.get(job.key)
        return row is not None and row["error"] is None

    def add(self, rows: Sequence[Row]) -> None:
        for row in rows:
            self.rows[row["key"]] = row
        if self._file is None:
            return
        if any(name not in self._columns for row in rows for name in row):  # the first rows, or the first without an error
            self._columns = []
            self._write(list(self.rows.values()))
            return
        with open(self._file, "a", newline="", encoding="utf-8") as text:
            self._append(text, rows)

    def put_in_order(self) -> None:
        """Lets the file have the sweep's rows in the order of its values, and behind them what else it had."""
        if self._file is None or not self.rows:
            return
        order = {job.key: place for place, job in enumerate(self._jobs)}
        rows = sorted(self.rows.values(), key=lambda row: order.get(row["key"], len(order)))
        if rows != list(self.rows.values()) or self._row_count != len(rows):
            self._write(rows)

    def _write(self, rows: Sequence[Row]) -> None:
        """Replaces the file as a whole."""
        assert self._file is not None
        self._columns = self._columns or _joined_columns(rows, self._jobs)
        self._row_count = 0
        unfinished = self._file.with_name(self._file.name + ".part")
        with open(unfinished, "w", newline="", encoding="utf-8") as text:
            csv.writer(text, lineterminator="\n").writerow(self._columns)
            self._append(text, rows)
        os.replace(unfinished, self._file)

    def _append(self, text: Any, rows: Sequence[Row]) -> None:
        writer = csv.writer(text, lineterminator="\n")
        self._row_count += len(rows)
        for row in rows:
            writer.writerow([_cell(row.get(name)) for name in self._columns])


@contextlib.contextmanager
def _only_writer(file: Path) -> Iterator[None]:
    """Raises InputError if another sweep writes the table."""
    lock = file.with_name(file.name + ".lock")
    with open(lock, "w") as held:
        try:
            fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise InputError(str(file), "is being written by another sweep", "wait for its end, or name another file") from None
        try:
            yield
        finally:
            lock.unlink(missing_ok=True)


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
