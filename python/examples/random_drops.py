"""Drops a thousand random bodies on a floor, as a data set.

    python3 random_drops.py --count 1000 --workers 2 --out random_drops.png

Each drop has a seed of its own, so its numbers depend neither on the order nor on the count of workers. They go to a
CSV and an .npz file beside the figure. The script makes one drop again, and fails if it gives other bits.
"""
from __future__ import annotations

import argparse
import csv
import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np
import pliant
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

SHAPES = {"ball": ("icosphere:1", "#0072B2", "o"), "cube": ("cube:2", "#E69F00", "s"),
          "plank": ("box:2.4,0.8,1.6,4", "#009E73", "^"), "ring": ("ring:0.4,10", "#CC79A7", "x")}
SCALE = 0.5  # m per mesh unit
MASS = 1.0  # kg
GRAVITY = 9.81  # m/s^2
INPUTS = {"fall": "height of fall [m]", "stiffness": "total stiffness [N/m]", "tilt": "tilt [degrees]"}
RESULTS = {"peak_strain": "peak of the mean strain", "contact_time": "time on the floor [s]",
           "rebound": "rebound / way down"}


def draw_lots(seed: int, number: int) -> dict:
    random = np.random.default_rng([seed, number])
    return {"number": number, "shape": str(random.choice(list(SHAPES))), "fall": random.uniform(0.2, 2.0),
            "stiffness": 10 ** random.uniform(3.3, 4.7), "tilt": random.uniform(0, 90),
            "turn": random.uniform(0, 360), "speed": random.uniform(0, 1.5)}


def make_scene(lots: dict) -> pliant.Scene:
    """Returns the scene of a drop. `fall` [m] is how far the body's lowest vertex is above the floor."""
    mesh, tilt = pliant.mesh(SHAPES[lots["shape"]][0]), np.radians(lots["tilt"])
    lowest = SCALE * (mesh.positions[:, 1] * np.cos(tilt) - mesh.positions[:, 2] * np.sin(tilt)).min()
    body = {"mesh": mesh, "scale": SCALE, "position": [0, lots["fall"] - lowest, 0],
            "rotation": [lots["tilt"], lots["turn"], 0], "velocity": [lots["speed"], 0, 0], "total_mass": MASS,
            "total_stiffness": lots["stiffness"], "damping": 2.0 * MASS / len(mesh.positions)}
    return pliant.Scene({"simulation": {"gravity": [0, -GRAVITY, 0], "time_step": 0.004}, "ground": [{"height": 0}],
                         "body": [body]})


def edge_lengths(positions: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    return np.linalg.norm(positions[triangles] - positions[np.roll(triangles, 1, axis=1)], axis=2)


def drop(seed: int, number: int) -> dict:
    """Makes a drop until a second after the first touch. Returns its random numbers and what came of them."""
    lots = draw_lots(seed, number)
    sim = pliant.Simulation(make_scene(lots), device="cpu", threads=1)  # the workers share the cores
    triangles, rest, energy = sim.triangles, edge_lengths(sim.positions, sim.triangles), sim.measure().energy
    rows = []
    while sim.time < np.sqrt(2 * lots["fall"] / GRAVITY) + 1:
        strain = np.abs(edge_lengths(sim.positions, triangles) / rest - 1).mean()
        rows.append((sim.time, sim.positions[:, 1].mean(), strain, len(sim.contacts()) > 0))
        sim.advance()
    times, heights, strains, touches = np.array(rows).T
    low = int(np.argmin(heights))
    high = low + int(np.argmax(heights[low:]))
    touching = np.flatnonzero(touches[:high + 1])  # a second bounce comes later, and does not count
    return {**lots, "peak_strain": strains.max(), "contact_time": times[touching[-1]] - times[touching[0]],
            "rebound": (heights[high] - heights[low]) / (heights[0] - heights[low]),
            "energy_lost": 1 - sim.measure().energy / energy,
            "final_speed": np.linalg.norm(sim.velocities.mean(axis=0))}


def write(drops: list[dict], path: Path) -> None:
    """Writes a row for each drop in a CSV file, and a column for each key in an .npz file."""
    with open(path.with_suffix(".csv"), "w", newline="") as file:
        table = csv.DictWriter(file, drops[0])
        table.writeheader()
        table.writerows(drops)
    np.savez_compressed(path.with_suffix(".npz"), **{key: [one[key] for one in drops] for key in drops[0]})


def draw(drops: list[dict], path: Path) -> None:
    figure = Figure(figsize=(11, 8))
    figure.set_layout_engine("constrained", rect=(0, 0, 1, 0.95))  # the legend stands above
    grid = figure.subplots(len(RESULTS), len(INPUTS), sharex="col", sharey="row")
    for row, result in zip(grid, RESULTS):
        row[0].set_ylabel(RESULTS[result])
        for axes, given in zip(row, INPUTS):
            for shape, (_, color, marker) in SHAPES.items():
                of_shape = [one for one in drops if one["shape"] == shape]
                axes.scatter([one[given] for one in of_shape], [one[result] for one in of_shape], s=9, alpha=0.7,
                             linewidths=0.8, label=shape, color=color, marker=marker)
    for axes, given in zip(grid[-1], INPUTS):
        axes.set_xlabel(INPUTS[given])
    grid[0, 1].set_xscale("log")
    grid[1, 0].set_yscale("log")
    for axis in (grid[0, 1].xaxis, grid[1, 0].yaxis):
        axis.set(major_locator=LogLocator(subs=(1, 2, 5)), major_formatter="{x:g}", minor_formatter=NullFormatter())
    figure.legend(handles=grid[0, 0].collections, loc="upper center", ncol=len(SHAPES), frameon=False, markerscale=2)
    figure.savefig(path, dpi=130)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=1000, help="how many drops (default: %(default)s)")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="processes (default: one a processor)")
    parser.add_argument("--seed", type=int, default=0, help="of all drops together (default: %(default)s)")
    parser.add_argument("--out", type=Path, default="random_drops.png", help="the figure (default: %(default)s)")
    arguments = parser.parse_args()
    begin = time.perf_counter()
    with ProcessPoolExecutor(arguments.workers) as pool:
        drops = list(pool.map(partial(drop, arguments.seed), range(arguments.count), chunksize=5))
    print(f"{len(drops)} drops with seed {arguments.seed} took {time.perf_counter() - begin:.1f} s.")
    write(drops, arguments.out)
    draw(drops, arguments.out)
    print(f"Wrote {arguments.out}, and {arguments.out.stem}.csv and .npz beside it.")

    odd = [one["number"] for one in drops if not (0 <= one["rebound"] < 1 and 0 < one["energy_lost"] < 1)]
    is_same = drop(arguments.seed, len(drops) - 1) == drops[-1]
    if odd or not is_same:
        print(f"FAILED: drops that gained height or energy: {odd}. Same bits again: {is_same}.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
