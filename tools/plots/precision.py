"""Pictures of the suite precision: what an error costs. Curves are the file's own (`curves`)."""
from math import ceil, log10

import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator

from plots.style import SOFT, fail, hardware_of, make_axes, plain_number, set_style, trim_spines

# Who takes part: library, device, precision, and whether on one thread. Everyone has the best of their methods.
CONTENDERS = (
    (("pliant", "cpu", 64, False), "pliant, {threads} threads, fp64", "#0072b2", "--"),
    (("pliant", "cpu", 64, True), "pliant, 1 thread, fp64", "#0072b2", "-"),
    (("pliant", "cpu", 32, True), "pliant, 1 thread, fp32", "#56b4e9", "-"),
    (("pliant", "gpu", 32, False), "pliant, GPU, fp32", "#1a7f5a", "-"),
    (("ARKODE", "cpu", 64, True), "SUNDIALS ARKODE", "#e69f00", "-."),
    (("CVODE", "cpu", 64, True), "SUNDIALS CVODE", "#cc79a7", (0, (4, 1, 1, 1, 1, 1))),
    (("odeint", "cpu", 64, True), "Boost.odeint", "#d55e00", ":"),
)
# Key of a curve, label of the axis, factor.
COSTS = {"time": ("seconds", "milliseconds", 1e3), "evaluations": ("evaluations", "force evaluations", 1)}
ROW_KEYS = {"time": "fastest_seconds", "evaluations": "evaluations"}
TITLES = {"time": "run time", "evaluations": "force evaluations"}
REMARKS_ALONE = ("collision, through contact",)  # no method converges there: no picture of methods


def key_of(row):
    return row["library"], row["device"], row["precision"], row["threads"] == 1


def is_drawn(curve, against):
    """Whether a curve is drawn. Force evaluations are drawn for one thread in fp64 alone."""
    return curve["errors"] and (against == "time" or (curve["precision"] == 64 and curve["threads"] == 1))


def power_of_ten(value, _=None):
    return f"$10^{{{round(log10(value))}}}$"


def plain_axes(axes):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.grid(which="major", color="#d0d7de", linewidth=0.6)
    axes.set_axisbelow(True)
    trim_spines(axes)
    axes.minorticks_off()
    axes.xaxis.set_major_formatter(FuncFormatter(power_of_ten))
    axes.yaxis.set_major_formatter(FuncFormatter(plain_number))


def limit_errors(axes, info, errors):
    """Makes the axis go from large errors to small ones, and marks where the reference's own error begins."""
    reference = info["reference_error"]
    least = max(min(errors), reference / 3) / 2
    axes.set_xlim(0.2, least)
    decades = ceil(-log10(least))
    axes.set_xticks([10.0 ** -decade for decade in range(1, decades, 1 if decades < 7 else 2 if decades < 13 else 4)])
    if reference > least:
        axes.axvspan(reference, least, color="#eaeef2", zorder=0, linewidth=0)


def mark_ticks(axes):
    low, high = axes.get_ylim()
    if high / low < 100:
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))


def draw_contenders(axes, info, curves, against):
    """Draws one panel, with a line for everyone who took part. Returns the legend's handles by label."""
    column, _, factor = COSTS[against]
    handles = {}
    for key, label, color, style in CONTENDERS:
        for curve in curves:
            if key_of(curve) != key:
                continue
            label = label.format(threads=curve["threads"])
            ours = curve["library"] == "pliant"
            handles[label], = axes.plot(curve["errors"], [factor * cost for cost in curve[column]], linestyle=style, color=color,
                                        zorder=2 if curve["precision"] == 32 else 3, linewidth=2.2 if ours else 1.8)
    plain_axes(axes)
    limit_errors(axes, info, [error for curve in curves for error in curve["errors"]])
    axes.set_title(info["name"], loc="left", fontsize=10.5, fontweight="bold", pad=16)
    bodies = f"{info['bodies']} spheres, " if info["bodies"] > 1 else ""
    alone = "" if any(curve["library"] != "pliant" for curve in curves) else "; pliant alone"
    axes.text(0, 1.03, f"{bodies}{info['vertices']:,} vertices, $\\omega T$ = {info['omega'] * info['duration']:.0f} rad{alone}",
              transform=axes.transAxes, fontsize=8.5, color=SOFT)
    return handles


def panels_of(data, against):
    """Returns every case in which pliant has a curve, with all its curves."""
    panels = []
    for info in data["cases"]:
        curves = [curve for curve in data["curves"] if curve["case"] == info["name"] and is_drawn(curve, against)]
        if info["name"] not in REMARKS_ALONE and any(curve["library"] == "pliant" for curve in curves):
            panels.append((info, curves))
    return panels


def draw_precision_overview(data, against):
    panels = panels_of(data, against)
    if not panels:
        fail("the file has no finished case of pliant's own")
    set_style()
    columns = 2 if len(panels) in (2, 4) else min(len(panels), 3)
    lines = -(-len(panels) // columns)
    height = 3.0 * lines + 1.3  # [inches], of which 0.7 for the heading and 0.6 for the legend
    figure, grid = plt.subplots(lines, columns, figsize=(max(4.1 * columns, 8.2), height), dpi=160, squeeze=False, sharey=True)
    handles = {}
    for index, axes in enumerate(grid.flat):
        axes.set_visible(index < len(panels))
        if index >= len(panels):
            continue
        handles.update(draw_contenders(axes, *panels[index], against))
        axes.set_xlabel("relative error at the end")
        axes.set_ylabel(COSTS[against][1] if index % columns == 0 else "")
    mark_ticks(grid[0][0])
    figure.tight_layout(rect=(0, 0.6 / height, 1, 1 - 0.7 / height), h_pad=1.6, w_pad=1.6)
    figure.suptitle(f"What an error costs: {TITLES[against]} of everyone's best method", x=0.01, y=1 - 0.1 / height, ha="left",
                    va="top", fontsize=14, fontweight="bold")
    figure.text(0.01, 1 - 0.42 / height, hardware_of(data) + " · other libraries: 1 thread, fp64 · grey: below the reference's own error",
                va="top", fontsize=8.5, color=SOFT)
    figure.legend(handles=list(handles.values()), labels=list(handles), loc="lower left", ncol=-(-len(handles) // 2), frameon=False,
                  fontsize=9, handlelength=2.8)
    return figure


METHOD_COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#5e4fa2", "#24292f",
                 "#a6761d", "#1a7f5a")
METHOD_MARKERS = "osD^vPX*<h"


def draw_precision_case(data, against, name):
    """Draws every method of pliant on one thread in fp64, dashed if a tolerance governs its steps. Also draws each library's best."""
    column, y_label, factor = COSTS[against]
    info = next((info for info in data["cases"] if info["name"] == name), None)
    rows = [row for row in data["rows"] if row["case"] == name and key_of(row) == ("pliant", "cpu", 64, True)]
    if info is None or not rows:
        fail(f"there is no case \"{name}\" with rows of pliant; there are {', '.join(info['name'] for info in data['cases'])}")
    figure, axes = make_axes(f"{name[0].upper()}{name[1:]}: {TITLES[against]} against error", data, y_label)
    axes.set_xlabel("relative error at the end")
    plain_axes(axes)
    others = [curve for curve in data["curves"] if curve["case"] == name and curve["library"] != "pliant" and curve["errors"]]
    for key, label, _, style in CONTENDERS:
        for curve in others:
            if key_of(curve) == key:
                axes.plot(curve["errors"], [factor * cost for cost in curve[column]], linestyle=style, color="#6e7781", linewidth=2.4,
                          label=f"best of {label}")
    known = list(dict.fromkeys(row["method"] for row in data["rows"] if row["library"] == "pliant"))  # the same colors in every case
    for method, adaptive in dict.fromkeys((row["method"], row["adaptive"]) for row in rows):
        line, index = [row for row in rows if (row["method"], row["adaptive"]) == (method, adaptive)], known.index(method)
        axes.plot([row["error"] for row in line], [factor * row[ROW_KEYS[against]] for row in line], METHOD_MARKERS[index % 10],
                  linestyle="--" if adaptive else "-", markerfacecolor="white" if adaptive else None, color=METHOD_COLORS[index % 10],
                  linewidth=1.6, markersize=4, label=f"{method} (adaptive)" if adaptive else method)
    limit_errors(axes, info, [row["error"] for row in rows] + [error for curve in others for error in curve["errors"]])
    mark_ticks(axes)
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False, fontsize=9, alignment="left", handlelength=2.8,
                title=f"one thread, fp64,\n{info['vertices']:,} vertices", title_fontsize=9)
    return figure


def draw_precision(data, against, name):
    if "curves" not in data:
        fail("the file has no curves, as an earlier version of pliant wrote it; measure again")
    return draw_precision_case(data, against, name) if name else draw_precision_overview(data, against)
