"""Draws an atlas of stability: how a squashed sphere that drifts ends, by time step, damping and integrator.

    python3 stability_atlas.py --out stability_atlas.png --table stability_atlas.csv

A sweep makes 7,200 runs on all processors. With a table a second one only tries those again that pliant refuses. The
script checks step_bound for constant damping: steps up to 0.95 of it are stable, and those from 1.3 of it on are not.
"""
from __future__ import annotations

import argparse
import contextlib
import math
import sys

import numpy as np
import pliant
from matplotlib.colors import LinearSegmentedColormap, LogNorm
from matplotlib.figure import Figure

INTEGRATORS = ("verlet", "rk4", "dop853", "dprkn8")
RUNGE_KUTTA = ("rk4", "dop853")  # with damping the others bear steps that are far longer than their bounds
LAWS = ("constant", "adaptive")
STEPS, SQUASH = 400, 0.01  # so little that motion is nearly linear, as bounds expect
GROWTH = 2.0  # of energy, from which on motion is unstable. Steps at the bound may amplify by 1 + 1e-4: to 1.08 in all
SAFE, UNSAFE = 0.95, 1.3  # parts of step_bound up to which all is stable, and from which on nothing is
VERTICES, STIFFNESS, MASS = 42, 4000.0, 1.0  # of the sphere, of a spring [N/m], of a vertex [kg]
OMEGA = math.sqrt(VERTICES * STIFFNESS / MASS)  # of the stiffest mode, in which the sphere breathes [1/s]
CRITICAL = 2 * MASS * OMEGA  # damping of that mode [kg/s]
SCENE = pliant.Scene({
    "collision": {"response": "none"},  # dprkn8 takes constant damping only where no impulses keep bodies apart
    # It drifts as fast as its surface vibrates. Drag may bound drifting more than springs bound vibrations.
    "body": [{"name": "ball", "mesh": "icosphere:1", "stiffness": STIFFNESS, "vertex_mass": MASS,
              "damping": 0, "stretch": [1 - SQUASH, 1, 1], "velocity": [SQUASH * OMEGA, 0, 0]}]})
COLORS = [(0, "#0b3c7d"), (0.25, "#4a97c9"), (0.51, "#e3eff5"), (0.51, "#fbd28b"), (1, "#e5791a")]  # jumps at GROWTH
NOT_FINITE, REFUSED = "#8a2d1b", "#d9d9d9"


def judge(simulation: pliant.Simulation) -> dict:
    """Goes on to the scene's duration. Says how it ends, and by what factor the energy has changed."""
    before, after = simulation.measure().energy, math.inf
    with contextlib.suppress(pliant.BreakdownError):
        simulation.advance_to(simulation.duration)
        after = simulation.measure().energy
    ratio = after / before if math.isfinite(after) else math.inf
    outcome = "stable" if ratio < GROWTH else "growing" if ratio < math.inf else "not finite"
    return {"outcome": outcome, "energy_ratio": ratio, "step_bound": simulation.step_bound}


def list_runs(dampings: np.ndarray, steps: np.ndarray) -> list[dict]:
    """Returns a run for each integrator, law, damping [critical damping] and step [undamped bounds], in that order."""
    runs = []
    for name in INTEGRATORS:
        bound = pliant.Simulation(SCENE, device="cpu", set={"simulation.integrator": name}).step_bound
        runs += [{"simulation.integrator": name, "simulation.damping_law": law, "body.ball.damping": damping * CRITICAL,
                  "simulation.time_step": step * bound, "simulation.duration": STEPS * step * bound}
                 for law in LAWS for damping in dampings for step in steps]
    return runs


def draw(ratios: np.ndarray, bounds: np.ndarray, up: np.ndarray, across: np.ndarray, path: str) -> None:
    """Draws a cell for each ratio (integrators, laws, dampings, steps), and bounds (integrators, laws, dampings)."""
    figure = Figure(figsize=(11, 6.2), layout="constrained")
    grid = figure.subplots(len(LAWS), len(INTEGRATORS), sharex=True, sharey=True)
    colors = LinearSegmentedColormap.from_list("ends", COLORS).with_extremes(over=NOT_FINITE, bad=REFUSED)
    below = up[0] * np.array([0.3, 0.65])  # where damping 0 lies, which a logarithmic axis does not have
    for column, row in np.ndindex(ratios.shape[:2]):
        axes = grid[row, column]
        for part, edges in ((slice(0, 1), below), (slice(1, None), up)):
            ends = np.minimum(ratios[column, row, part], sys.float_info.max)  # matplotlib takes infinity for no number
            cells = axes.pcolormesh(across, edges, ends, norm=LogNorm(1e-15, 1e15), cmap=colors)
            axes.stairs(bounds[column, row, part], edges, orientation="horizontal", baseline=None, color="black", lw=2)
        axes.set(title="" if row else INTEGRATORS[column], ylabel="" if column else f"{LAWS[row]} damping")
    axes.set(xscale="log", yscale="log", xlim=across[[0, -1]], ylim=(below[0], up[-1]))
    axes.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2], ["0.05", "0.1", "0.2", "0.5", "1", "2"])
    axes.set_yticks([np.sqrt(below.prod()), 0.01, 0.1, 1, 10, 100], ["0", "0.01", "0.1", "1", "10", "100"])
    axes.minorticks_off()
    for mark, color, label in ("-", "black", "step_bound"), ("s", NOT_FINITE, "not finite"), ("s", REFUSED, "refused"):
        axes.plot([], [], mark, color=color, lw=2, markersize=10, label=label)
    axes.legend(loc="center", framealpha=1)  # on a panel that is refused as a whole
    figure.suptitle(f"How a squashed sphere that drifts ends after {STEPS} steps", fontsize=14)
    figure.supxlabel("time step / step_bound without damping", fontsize=10)
    figure.supylabel("damping c / critical damping of the stiffest mode", fontsize=10)
    figure.colorbar(cells, ax=grid, extend="both", ticks=10.0 ** np.arange(-15, 16, 5),
                    label=f"energy at the end / energy at the start (growing from {GROWTH:g} on)")
    figure.savefig(path, dpi=130)


def check(ratios: np.ndarray, parts: np.ndarray) -> list[str]:
    """Prints how sharp bounds are, by arrays (integrators, dampings, steps). Returns what is wrong."""
    wrong = []
    for name, ratio, part in zip(INTEGRATORS, ratios, parts):
        counted = slice(None if name in RUNGE_KUTTA else 1)
        shortest = part[ratio >= GROWTH].min(initial=math.inf)
        longest = part[counted][ratio[counted] < GROWTH].max(initial=0)
        print(f"{name}: the shortest unstable step has {shortest:.2f} of step_bound, the longest stable {longest:.2f}")
        if shortest <= SAFE or longest >= UNSAFE:
            wrong.append(f"the bound of {name} does not hold")
    return wrong


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default="stability_atlas.png", help="the figure to write (default: %(default)s)")
    parser.add_argument("--table", help="a table of all runs (CSV), to read and to write")
    parser.add_argument("--workers", type=int, help="processes (default: one a processor)")
    parser.add_argument("--quick", action="store_true", help="a coarse grid of 480 runs")
    arguments = parser.parse_args()
    across = np.geomspace(10 ** -1.5, 10 ** 0.5, 13 if arguments.quick else 37)  # edges of cells [undamped bounds]
    up = np.geomspace(0.01, 100, 5 if arguments.quick else 25)  # [critical damping]
    steps, dampings = np.sqrt(across[1:] * across[:-1]), np.array([0, *np.sqrt(up[1:] * up[:-1])])
    rows = pliant.sweep(SCENE, list_runs(dampings, steps), run=judge, out=arguments.table, precision=64,
                        workers=arguments.workers)
    columns = [[row.get(name) for row in rows] for name in ("energy_ratio", "step_bound", "simulation.time_step")]
    ratios, bounds, lengths = np.array(columns, float).reshape(3, len(INTEGRATORS), len(LAWS), len(dampings), -1)
    draw(ratios, np.fmax.reduce(bounds / lengths * steps, axis=3), up, across, arguments.out)
    print(f"{len(rows)} runs, {np.isnan(ratios).sum()} of them refused. Wrote {arguments.out}.")
    wrong = check(ratios[:, 0], (lengths / bounds)[:, 0])
    wrong += sorted({row["error"] for row in rows if row["error"] and row["simulation.integrator"] != "dprkn8"})
    if wrong:
        print(f"FAILED: {'; '.join(wrong)}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
