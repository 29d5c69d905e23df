"""Finds the stiffness and the damping of a body from how it moves.

    python3 fit_stiffness.py --out fit_stiffness.png

A ball is stretched and let go. The script knows where its vertices are over time, and nothing else. It starts from a
wrong material, and least squares of scipy find the right one. It checks that both numbers come back to ten digits.
"""
from __future__ import annotations

import argparse
import sys

import numpy as np
import pliant
from matplotlib.figure import Figure
from scipy.optimize import least_squares

TIMES = np.arange(1, 91) * 0.02  # s, when positions are known
NAMES = ("stiffness", "damping")
UNITS = ("N/m", "kg/s")

SCENE = {
    "title": "A ball that was stretched",
    # With a step of fixed length the motion is a smooth function of the material. An automatic step would follow it.
    "simulation": {"integrator": "dop853", "time_step": 0.01, "damping_law": "internal"},
    "body": [{"name": "ball", "mesh": "icosphere:1", "vertex_mass": 0.1, "stretch": [1.5, 0.8, 0.9]}],
}


def move(material: np.ndarray) -> np.ndarray:
    """Returns where the vertices are at TIMES (times, vertices, 3) [m], for a stiffness [N/m] and a damping [kg/s]."""
    values = {f"body.ball.{name}": value for name, value in zip(NAMES, material)}
    # Differences of two runs are all that the fit goes by. In fp64 they are exact enough for very small changes.
    sim = pliant.Simulation(pliant.Scene(SCENE, set=values), device="cpu", precision=64, threads=1)
    positions = []
    for time in TIMES:
        sim.advance_to(time)
        positions.append(sim.positions)
    return np.array(positions)


def fit(target: np.ndarray, start: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns the material that moves most like the target, and of each run the material and how far it was off [m]."""
    materials, distances = [], []

    def differences(logarithms: np.ndarray) -> np.ndarray:
        materials.append(np.exp(logarithms))
        difference = move(materials[-1]) - target
        distances.append(np.sqrt((difference ** 2).sum(axis=2).mean()))
        return difference.ravel()

    # Logarithms keep both numbers positive, and make their sizes alike.
    found = least_squares(differences, np.log(start), xtol=1e-14, ftol=1e-14, gtol=1e-14)
    return np.exp(found.x), np.array(materials), np.array(distances)


def best_so_far(values: np.ndarray, distances: np.ndarray) -> np.ndarray:
    """Returns for each run the value of the best one until then. Runs that only probe a slope are left out so."""
    best = [int(np.argmin(distances[:count])) for count in range(1, len(distances) + 1)]
    return values[best]


def draw(target: np.ndarray, start: np.ndarray, found: np.ndarray, errors: np.ndarray, distances: np.ndarray,
         path: str) -> None:
    figure = Figure(figsize=(11, 4.2), layout="constrained")
    lengths, history = figure.subplots(1, 2, width_ratios=(1.4, 1))
    lengths.plot(TIMES, np.ptp(target[:, :, 0], axis=1), "o", color="black", markersize=3.5, label="known")
    lengths.plot(TIMES, np.ptp(move(start)[:, :, 0], axis=1), "--", color="#D55E00", label="with the first guess")
    lengths.plot(TIMES, np.ptp(move(found)[:, :, 0], axis=1), "-", color="#0072B2", label="with what was found")
    lengths.set(xlabel="time [s]", ylabel="length of the ball [m]", title="The motion", ylim=(0.7, None))
    lengths.legend(frameon=False, ncol=3, loc="lower center")
    runs = np.arange(1, len(distances) + 1)
    floor = 1e-16  # a logarithmic axis has no zero
    history.semilogy(runs, best_so_far(distances, distances) + floor, color="black", label="distance of vertices [m]")
    for name, error, style, color in zip(NAMES, errors.T, ("--", "-."), ("#0072B2", "#E69F00")):
        history.semilogy(runs, best_so_far(error, distances) + floor, style, color=color, label=f"error of {name}")
    history.set(xlabel="simulations", ylabel="relative error, or [m]", ylim=(floor / 3, 100))
    history.set_title("The best fit so far")
    history.legend(frameon=False, loc="lower left")
    figure.savefig(path, dpi=130)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--truth", type=float, nargs=2, default=(3.7, 0.06), metavar=("STIFFNESS", "DAMPING"),
                        help="both above 0 [N/m, kg/s] (default: 3.7 0.06)")
    parser.add_argument("--start", type=float, nargs=2, default=(2.0, 0.2), metavar=("STIFFNESS", "DAMPING"),
                        help="where the fit begins (default: 2 0.2)")
    parser.add_argument("--out", default="fit_stiffness.png", help="the figure to write (default: %(default)s)")
    arguments = parser.parse_args()
    truth, start = np.array(arguments.truth), np.array(arguments.start)
    target = move(truth)
    found, materials, distances = fit(target, start)
    draw(target, start, found, abs(materials / truth - 1), distances, arguments.out)

    errors = abs(found / truth - 1)
    for name, unit, *numbers in zip(NAMES, UNITS, truth, start, found, errors):
        print("{:9} [{}]: truth {:g}, start {:g}, found {:.15g}, relative error {:.0e}".format(name, unit, *numbers))
    print(f"{len(distances)} simulations. Wrote {arguments.out}.")
    if not errors.max() < 1e-10:
        print("FAILED: the fit has not found the material.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
