"""Picture of the suite stability: how motions end, by damping and step."""
from math import exp, log

import matplotlib.pyplot as plt
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from plots.style import INK, SOFT, fail, hardware_of, set_style, trim_spines

# How cells of the map of stability end: colour, and what the legend says.
OUTCOMES = {"stable": ("#a9cdf0", "stable: rings on"), "damped": ("#3f8f6b", "comes to rest in its shape"),
            "creeping": ("#a5cf8f", "still, but creeping back to its shape"), "blown up": ("#d9604c", "blows up")}
MAP_COLUMNS = ("verlet", "rk4", "cv8", "dop853")  # the others look alike


def edges(values):
    """Returns edges midway between ever larger numbers, by logarithms, and as far beyond the first and the last."""
    logs = [log(value) for value in values]
    middles = [(a + b) / 2 for a, b in zip(logs, logs[1:])]
    return [exp(middle) for middle in (2 * logs[0] - middles[0], *middles, 2 * logs[-1] - middles[-1])]


def draw_map(axes, rows):
    """Draws one panel: damping over step, each cell by how it ended, and the bound that pliant predicts."""
    nothing = 0.015  # where c = 0 lies on the logarithmic axis: below a gap
    for damped in (False, True):
        own = [row for row in rows if (row["damping"] > 0) == damped]
        dampings = sorted({row["damping"] for row in own})
        across = edges(sorted({row["time_step"] / row["undamped_bound"] for row in own}))
        up = edges(dampings) if damped else [nothing / 1.7, nothing * 1.7]
        lines = [sorted((row for row in own if row["damping"] == damping), key=lambda row: row["time_step"]) for damping in dampings]
        outcomes = [[list(OUTCOMES).index(row["outcome"]) for row in line] for line in lines]
        axes.pcolormesh(across, up, outcomes, cmap=ListedColormap([color for color, _ in OUTCOMES.values()]), vmin=0,
                        vmax=len(OUTCOMES) - 1, edgecolors="white", linewidth=0.25)
        bounds = [min(max(line[0]["predicted_bound"] / line[0]["undamped_bound"], across[0]), across[-1]) for line in lines]
        axes.stairs(bounds, up, orientation="horizontal", baseline=None, color=INK, linewidth=1.8)
        axes.set_xlim(across[0], across[-1])
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(nothing / 1.7, up[-1])
    axes.set_yticks([nothing, 1, 1e2, 1e4, 1e6], ["0", "1", "100", "$10^4$", "$10^6$"])
    axes.set_xticks([0.1, 0.3, 1, 3], ["0.1", "0.3", "1", "3"])
    axes.minorticks_off()
    axes.tick_params(length=2.5)
    trim_spines(axes)


def map_columns(rows):
    there = {row["integrator"] for row in rows}
    return [name for name in MAP_COLUMNS if name in there] or sorted(there)


def draw_stability(data):
    rows = [row for row in data["rows"] if row["kind"] == "map" and row["vertices"] == 42 and row["law"] != "none"]
    if not rows:
        fail("the file has no map of stability")
    set_style()
    columns, laws = map_columns(rows), [law for law in ("constant", "adaptive") if any(row["law"] == law for row in rows)]
    figure, grid = plt.subplots(len(laws), len(columns), figsize=(1.6 + 2.05 * len(columns), 1.2 + 2.25 * len(laws)), dpi=160,
                                sharex=True, sharey=True, squeeze=False)
    for line, law in zip(grid, laws):
        for axes, name in zip(line, columns):
            own = [row for row in rows if row["law"] == law and row["integrator"] == name]
            draw_map(axes, own)
            axes.set_title(name if law == laws[0] else "", fontsize=11, fontweight="bold", loc="left", pad=6)
        line[0].set_ylabel(f"{law} damping\nc in kg/s", fontsize=9.5)
    top = 1 - 0.85 / figure.get_figheight()
    figure.subplots_adjust(left=0.1, right=0.99, top=top, bottom=1.0 / figure.get_figheight(), wspace=0.1, hspace=0.14)
    figure.text(0.1, 1 - 0.08 / figure.get_figheight(), "At which steps methods blow up, under ever more damping", fontsize=13,
                fontweight="bold", va="top")
    body = f"a sphere of {rows[0]['vertices']} vertices, squashed by 20 %, after {rows[0]['steps']} steps"
    figure.text(0.1, 1 - 0.34 / figure.get_figheight(), f"{body} · {hardware_of(data)}", fontsize=8.5, color=SOFT, va="top")
    figure.text(0.545, 0.52 / figure.get_figheight(), "length of a step, over the method's bound without damping", ha="center",
                fontsize=9.5)
    handles = [Patch(color=color, label=label) for color, label in OUTCOMES.values()]
    handles.append(Line2D([], [], color=INK, linewidth=1.8, label="the bound that pliant predicts"))
    figure.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.545, 0), ncol=3, frameon=False, fontsize=9)
    return figure
