"""Pictures of the suites forces and steps: pairs or milliseconds over vertices."""
import collections
from math import exp, log

from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter

from plots.style import FAINT, INK, fail, leave_room, make_axes, plain_number, short

LINES = ("-", ":", "-.")  # by family
COLORS = {"gpu": "#1a7f5a", "cpu": "#1f5fbf", "cpu1": "#9a6ae0"}  # cpu1: one thread


def color_of(key):
    device, threads = key
    return COLORS["gpu"] if device == "gpu" else COLORS["cpu1" if threads == 1 else "cpu"]


def label_of(key, machine):
    device, threads = key
    if device == "gpu":
        return short(machine["gpu"] or "GPU")
    return f"CPU, {threads} thread{'s' if threads > 1 else ''}"


def marker_of(key):
    device, threads = key
    return "o" if device == "gpu" else "^" if threads == 1 else "s"


def by_place(rows):
    """Returns rows by (device, threads), each sorted by size. The GPU comes first and has 0 threads."""
    groups = collections.defaultdict(list)
    for row in sorted(rows, key=lambda row: row["vertices"]):
        groups[row["device"], 0 if row["device"] == "gpu" else row["threads"]].append(row)
    return dict(sorted(groups.items(), key=lambda item: (item[0][0] != "gpu", -item[0][1])))


def fastest_isa(rows):
    """Returns the rows of the instruction set that is the fastest at the largest size. On the GPU each size has its best variant."""
    largest = max(row["vertices"] for row in rows)
    best = max((row for row in rows if row["vertices"] == largest), key=lambda row: row["pairs_per_second"])
    if best["device"] != "gpu":
        return [row for row in rows if row["isa"] == best["isa"] and row["variant"] == best["variant"]]
    fastest = {}  # the GPU has a best variant for each size
    for row in rows:
        if row["vertices"] not in fastest or row["pairs_per_second"] > fastest[row["vertices"]]["pairs_per_second"]:
            fastest[row["vertices"]] = row
    return list(fastest.values())


def draw_forces(data, precision):
    figure, axes = make_axes("Spring forces: pairs per second by size of a body", data, "pairs of vertices per second")
    rows = [row for row in data["rows"] if row["precision"] == precision]
    if not rows:
        fail(f"no forces of precision {precision} in the file")
    handles = []
    for key, group in by_place(rows).items():
        line = fastest_isa(group)
        x = [row["vertices"] for row in line]
        isa = "" if key[0] == "gpu" else f", {line[0]['isa']}"
        handles += axes.plot(x, [row["pairs_per_second"] for row in line], marker_of(key) + "-", color=color_of(key), linewidth=2,
                             markersize=5, label=label_of(key, data["machine"]) + isa)
        axes.plot(x, [row["bound_pairs_per_second"] for row in line], "--", color=color_of(key), linewidth=1, alpha=0.8)
    handles.append(Line2D([], [], color=FAINT, linestyle="--", linewidth=1, label="bound: multiply-adds / instructions a pair"))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"$10^{{{len(f'{value:.0f}') - 1}}}$"))
    leave_room(axes)
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(0, -0.13), ncol=2, frameon=False, fontsize=8.5)
    return figure


def crossing_height(crossing, rows):
    """Returns the time of a step where the lines cross, read off the GPU's line."""
    line = sorted((row["vertices"], row["milliseconds_per_step"]) for row in rows)
    (x0, y0), (x1, y1) = next(pair for pair in zip(line, line[1:]) if crossing <= pair[1][0])
    return exp(log(y0) + log(crossing / x0) / log(x1 / x0) * log(y1 / y0))


def draw_steps(data):
    machine = data["machine"]
    figure, axes = make_axes("Time of a step by number of vertices", data, "milliseconds per step")
    axes.set_xlabel("vertices of all bodies")
    families = [f for f in dict.fromkeys(row["family"] for row in data["rows"]) if f]
    handles = []
    for key, group in by_place(data["rows"]).items():
        style = {"color": color_of(key), "marker": marker_of(key)}
        for index, family in enumerate(families):
            line = [row for row in group if row["family"] == family]
            axes.plot([row["vertices"] for row in line], [row["milliseconds_per_step"] for row in line], LINES[index % len(LINES)],
                      linewidth=1.4 if index else 2, markersize=4.5 if index else 5.5, **style)
        scenes = [row for row in group if not row["family"]]
        axes.plot([row["vertices"] for row in scenes], [row["milliseconds_per_step"] for row in scenes], linestyle="",
                  markersize=5, markerfacecolor="white", **style)
        handles.append(Line2D([], [], linewidth=2, markersize=5.5, label=label_of(key, machine), **style))
    for index, family in enumerate(families):
        handles.append(Line2D([], [], color=FAINT, linestyle=LINES[index % len(LINES)], label=family))
    if any(not row["family"] for row in data["rows"]):
        handles.append(Line2D([], [], color=FAINT, marker="o", markerfacecolor="white", markersize=5, linestyle="",
                              label="shipped scenes"))
    axes.yaxis.set_major_formatter(FuncFormatter(plain_number))
    leave_room(axes)
    mark_crossings(axes, data, families)
    axes.legend(handles=handles, loc="upper left", frameon=False, fontsize=8.5)
    return figure


def mark_crossings(axes, data, families):
    """Circles where the first family's lines cross, and below each says what that means."""
    gpu = [row for row in data["rows"] if families and row["device"] == "gpu" and row["family"] == families[0]]
    told = 0
    for crossing in sorted(data.get("crossovers", []), key=lambda crossing: crossing["vertices"] or 0):
        vertices, threads = crossing["vertices"], crossing["threads"]
        if not gpu or crossing["family"] != families[0] or vertices is None:
            continue
        height = crossing_height(vertices, gpu)
        axes.plot([vertices], [height], "o", markersize=15, markerfacecolor="none", markeredgecolor=INK, markeredgewidth=1.2)
        opponent = f"{threads} threads" if threads > 1 else "one thread"
        told += 1
        axes.annotate(f"the GPU overtakes {opponent} at {vertices:,.0f} vertices", (vertices, height), xytext=(9, -6 - 13 * told),
                      ha="left", va="center", textcoords="offset points", fontsize=8.5)
