"""Catches soft balls with a cup, by a control loop that sees nothing but where the ball is.

    python3 catch_ball.py --throws 3 --seed 0 --out catch_ball.png --film film.png

In each frame the controller foresees where the ball will come down, and sends the cup there. Shortly before, the cup
begins to go along with the ball, so that they meet gently. The script fails if a ball does not stay in the cup.
"""
from __future__ import annotations

import argparse
import sys

import numpy as np
import pliant
from matplotlib.figure import Figure

GRAVITY = np.array([0, -9.81, 0])  # m/s^2
FRAME = 1 / 60  # s
BALL, CUP = 0.16, 0.4  # radii [m]
MEETING_HEIGHT = 1.0  # of the cup's bottom when the ball touches it [m]
EASING, PART = 0.9, 0.85  # how far the cup goes along with the ball [m], and with what part of its velocity they meet
CAMERA = {"eye": [-0.8, 4.2, 5.6], "target": [-0.8, 1.3, 0], "field_of_view": 36}
COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")


def plan(last: np.ndarray, ball: np.ndarray) -> tuple[float, np.ndarray, float]:
    """Returns how soon ball and cup meet [s], where the cup's bottom has to go, and how long that should take [s]."""
    velocity = (ball - last) / FRAME + GRAVITY * FRAME / 2  # the quotient is the velocity half a frame ago
    above = max(ball[1] - BALL - MEETING_HEIGHT, 0)
    left = (velocity[1] + np.sqrt(velocity[1] ** 2 - 2 * GRAVITY[1] * above)) / -GRAVITY[1]  # s until they meet
    meeting = ball + velocity * left + GRAVITY * left ** 2 / 2 - [0, BALL, 0]
    speed = np.linalg.norm(velocity + GRAVITY * left)
    # The cup eases along the ball's way. Half-way it is fastest, 1.5 times its mean speed, and there they meet.
    way = EASING * (velocity + GRAVITY * left) / speed
    duration = 1.5 * EASING / (PART * speed)
    if left - duration / 2 > FRAME:
        return left, meeting - way / 2, left - duration / 2
    return left, meeting + way / 2, left + duration / 2


def make_scene(random: np.random.Generator) -> pliant.Scene:
    vertex_count = len(pliant.mesh("icosphere:2").positions)
    ball = {"name": "ball", "mesh": "icosphere:2", "scale": BALL, "color": [0.8, 0.25, 0.05],
            "position": random.uniform((-2.4, 1.0, -0.5), (-2.2, 1.4, 0.5)),
            "velocity": random.uniform((1.2, 5.0, -0.4), (2.2, 6.0, 0.4)),
            "total_mass": 0.5, "total_stiffness": 4000.0, "damping": 15.0 / vertex_count}
    # The cup never goes along its path, because send() replaces it. But send() only takes a body that has one.
    cup = {"name": "cup", "mesh": "bowl:5", "scale": CUP, "position": [0, MEETING_HEIGHT + CUP, 0],
           "color": [0.1, 0.35, 0.6], "kind": "scripted", "path": [{"time": 0}, {"time": 1}]}
    return pliant.Scene({"simulation": {"gravity": GRAVITY, "time_step": FRAME / 4},
                         "collision": {"elasticity": 0.2, "friction": 0.5},
                         "output": {"ground_height": 0}, "body": [ball, cup]})


def throw(random: np.random.Generator, film: list[np.ndarray], film_every: int) -> tuple[np.ndarray, ...]:
    """Throws a ball and catches it. Returns, frame by frame, the ball, the cup's bottom and their relative speed."""
    sim = pliant.Simulation(make_scene(random), device="cpu")
    ball, cup = (sim.bodies[name].vertices for name in ("ball", "cup"))
    heights = sim.positions[cup, 1]
    bottom_to_centre = np.array([0, heights.mean() - heights.min(), 0])
    balls, bottoms, is_flying = [], [], True
    for frame in range(210):
        positions = sim.positions
        balls.append(positions[ball].mean(axis=0))
        bottoms.append(positions[cup].mean(axis=0) - bottom_to_centre)
        if frame > 0 and is_flying:
            left, bottom, seconds = plan(*balls[-2:])
            sim.send("cup", bottom + bottom_to_centre, seconds)
            is_flying = left > 2 * FRAME  # from then on the last plan holds
        if film_every and frame % film_every == 0:
            film.append(sim.render((720, 540), camera=CAMERA))
        sim.advance_to((frame + 1) * FRAME)
    apart = np.subtract(balls, bottoms)
    return np.array(balls), np.array(bottoms), np.linalg.norm(np.gradient(apart, FRAME, axis=0), axis=1)


def judge(balls: np.ndarray, bottoms: np.ndarray, speeds: np.ndarray) -> tuple[bool, float]:
    """Returns whether the ball is caught, and at what speed they met: not too fast, and it has to stay in the cup."""
    meeting_speed = speeds[np.argmax(np.linalg.norm(balls - bottoms, axis=1) < 1.1 * BALL)]
    x, y, z = (balls - bottoms)[-60:].T
    is_inside = np.all((y > 0) & (y < CUP) & (np.hypot(x, z) < CUP - BALL / 2))
    return bool(is_inside and speeds[-1] < 0.2 and meeting_speed < 2), meeting_speed


def expose(frames: list[np.ndarray]) -> np.ndarray:
    """Returns one picture of all frames: the shadows of each, and above them what has a colour."""
    picture = np.min(frames, axis=0)
    for frame in frames:
        has_color = np.ptp(frame.astype(int), axis=2) > 45
        picture[has_color] = frame[has_color]
    return picture


def draw(throws: list[tuple[np.ndarray, ...]], picture: np.ndarray, path: str) -> None:
    figure = Figure(figsize=(11, 5), layout="constrained")
    shot, plots = figure.subfigures(1, 2, width_ratios=(1.5, 1))
    panel, (ways, approach) = shot.subplots(), plots.subplots(2, 1)
    panel.imshow(picture)
    panel.set_axis_off()
    panel.set_title("The first throw, ten times a second")
    for number, (balls, bottoms, speeds) in enumerate(throws):
        color = COLORS[number % len(COLORS)]
        ways.plot(balls[:, 0], balls[:, 1], color=color, label=None if number else "ball")
        ways.plot(bottoms[:, 0], bottoms[:, 1], color=color, linestyle="--", label=None if number else "cup")
        approach.plot(np.arange(len(speeds)) * FRAME, speeds, color=color)
    ways.set(xlabel="x [m]", ylabel="height [m]", title=f"All {len(throws)} throws")
    ways.legend(frameon=False)
    approach.set(xlabel="time [s]", ylabel="speed, ball to cup [m/s]", ylim=(0, None))
    figure.savefig(path, dpi=130)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--throws", type=int, default=3, help="how many balls (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=0, help="of the throws (default: %(default)s)")
    parser.add_argument("--out", default="catch_ball.png", help="the figure to write (default: %(default)s)")
    parser.add_argument("--film", help="an animated PNG to write of the first throw")
    arguments = parser.parse_args()
    random, film_every = np.random.default_rng(arguments.seed), 3 if arguments.film else 6
    film: list[np.ndarray] = []
    throws = [throw(random, film, 0 if number else film_every) for number in range(arguments.throws)]
    draw(throws, expose(film[:96 // film_every:6 // film_every]), arguments.out)
    if arguments.film:
        pliant.Animation(film, 1 / (film_every * FRAME)).save(arguments.film)

    verdicts = [judge(*one) for one in throws]
    met = ", ".join(f"{speed:.2f}" for _, speed in verdicts)
    print(f"With seed {arguments.seed} balls met the cup at {met} m/s. Wrote {arguments.out}.")
    lost = [number for number, (is_caught, _) in enumerate(verdicts, 1) if not is_caught]
    if lost:
        print(f"FAILED: these balls are not caught gently: {lost}", file=sys.stderr)
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
