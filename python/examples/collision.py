"""Two soft spheres collide head-on: how motion becomes deformation, and where the energy goes.

    python3 collision.py --out collision.png

The figure shows pictures of the collision that are coloured by strain, the energies, and the distance of the centres.
The script checks that momentum stays zero, that no energy appears from nowhere, and that the spheres part again.
"""
from __future__ import annotations

import argparse
import sys

import numpy as np
import pliant
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

MESH = "icosphere:3"
RADIUS = 1.0  # m
MASS = 1.0  # kg, of each sphere
SPEED = 3.0  # m/s, of each sphere
DAMPING_RATE = 4.0  # 1/s, of vibrations
CAMERA = {"eye": [2.3, 1.5, 5.2], "target": [0, -0.1, 0], "field_of_view": 30}


def make_scene() -> pliant.Scene:
    vertex_count = len(pliant.mesh(MESH).positions)
    sphere = {"mesh": MESH, "scale": RADIUS, "total_mass": MASS, "total_stiffness": 400.0,  # N/m
              "damping": DAMPING_RATE * MASS / vertex_count}
    return pliant.Scene({
        "title": "Head-on collision",
        # Internal damping takes vibrations alone, so the spheres lose no speed before they touch.
        "simulation": {"time_step": 0.0025, "damping_law": "internal"},
        "collision": {"elasticity": 0.0, "friction": 0.0},
        "body": [{"name": "left", "position": [-1.4, 0, 0], "velocity": [SPEED, 0, 0], **sphere},
                 {"name": "right", "position": [1.4, 0, 0], "velocity": [-SPEED, 0, 0], **sphere}],
    })


def measure(sim: pliant.Simulation) -> tuple[float, ...]:
    """Returns the time, the kinetic and elastic energy, what contacts took, the centres' distance and the momentum."""
    left, right = (sim.positions[sim.bodies[name].vertices].mean(axis=0) for name in ("left", "right"))
    measured, contacts = sim.measure(), sim.report()["contacts"]
    return (sim.time, measured.kinetic, measured.elastic, contacts["energy_taken"] - contacts["energy_given"],
            float(np.linalg.norm(right - left)), float(np.linalg.norm(measured.momentum)))


def simulate(times: np.ndarray) -> tuple[np.ndarray, list[tuple[float, np.ndarray]]]:
    """Returns a row of measure() for each time, and three pictures with their times."""
    sim = pliant.Simulation(make_scene(), device="cpu")
    rows, states = [], []
    for time in times:
        sim.advance_to(time)
        rows.append(measure(sim))
        states.append(sim.save())
    # Which moments are worth a picture shows only afterwards. Saved states lead back to them.
    closest = int(np.argmin([row[4] for row in rows]))
    pictures = []
    for frame in (round(0.3 * closest), closest, min(round(1.8 * closest), len(rows) - 1)):
        sim.restore(states[frame])
        pictures.append((sim.time, sim.render((720, 405), camera=CAMERA, coloring="deformation")))
    return np.array(rows), pictures


def draw(rows: np.ndarray, pictures: list[tuple[float, np.ndarray]], path: str) -> None:
    time, kinetic, elastic, by_contacts, distance, _ = rows.T
    figure = Figure(figsize=(11, 6), layout="constrained")
    shots, plots = figure.subfigures(2, 1, height_ratios=(1, 1.4))
    panels = shots.subplots(1, len(pictures))
    energies, distances = plots.subplots(1, 2, width_ratios=(1.4, 1))
    total = kinetic + elastic
    energies.stackplot(time, kinetic, elastic, by_contacts, total[0] - total - by_contacts,
                       labels=("kinetic", "elastic", "taken by contacts", "taken by damping"),
                       colors=("#56B4E9", "#E69F00", "#BBBBBB", "#E2E2E2"))
    energies.plot(time, total, color="black", label="total: kinetic + elastic")
    energies.set(xlabel="time [s]", ylabel="energy [J]", xlim=(0, time[-1]), ylim=(0, 1.25 * total[0]))
    energies.legend(frameon=False, ncol=3, loc="upper center", bbox_to_anchor=(0.5, 1.2), fontsize=9)
    distances.plot(time, distance, color="#0072B2")
    distances.axhline(2 * RADIUS, color="grey", linewidth=0.8)
    distances.annotate("two radii", (0.5, 2 * RADIUS), (0, 4), xycoords=("axes fraction", "data"),
                       textcoords="offset points", ha="center", color="dimgrey")
    distances.set(xlabel="time [s]", ylabel="distance of centres [m]", xlim=(0, time[-1]), ylim=(0, 1.25 * distance[0]))
    for letter, panel, (moment, pixels) in zip("abc", panels, pictures):
        panel.imshow(pixels)
        panel.set_axis_off()
        panel.set_title(f"{letter}:  {moment:.2f} s", fontsize=11)
        for axes in (energies, distances):
            axes.axvline(moment, color="black", linewidth=0.8, linestyle=":")
            axes.annotate(letter, (moment, 1), (4, -13), xycoords=("data", "axes fraction"), textcoords="offset points")
    strain = ScalarMappable(Normalize(0, 30), "viridis")  # the colours of render()
    shots.colorbar(strain, ax=list(panels), label="strain [%]", extend="max", shrink=0.9, pad=0.01)
    figure.savefig(path, dpi=130)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default="collision.png", help="the figure to write (default: %(default)s)")
    arguments = parser.parse_args()
    rows, pictures = simulate(times=np.linspace(0, 1.2, 121))
    draw(rows, pictures, arguments.out)

    _, kinetic, elastic, by_contacts, distance, momentum = rows.T
    by_damping = kinetic[0] - kinetic - elastic - by_contacts
    # Damping can only take. If the sum of the rest were wrong, this would show it.
    gain = -np.diff(by_damping).min() / kinetic[0]
    drift = momentum.max() / (MASS * SPEED)
    print(f"The centres came as near as {distance.min():.3f} m and were {distance[-1]:.3f} m apart in the end.\n"
          f"Of {kinetic[0]:.3f} J contacts took {by_contacts[-1]:.3f} J and damping {by_damping[-1]:.3f} J.\n"
          f"Momentum drifted by {drift:.0e} of that of a sphere.\nWrote {arguments.out}.")
    if drift > 1e-6 or gain > 1e-4 or distance.min() > 1.5 * RADIUS or distance[-1] < 2 * RADIUS:
        print("FAILED: this is not how spheres collide.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
