"""What all pictures of benchmarks share: colours, axes, names of machines, and how a problem is told."""
import sys
from math import ceil, log10

import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

INK, FAINT, SOFT = "#24292f", "#8b949e", "#57606a"


def fail(problem):
    print(f"plot_bench: {problem}", file=sys.stderr)
    sys.exit(2)


def short(renderer):
    """Returns the name alone of a renderer such as "NVIDIA H200/PCIe/SSE2" or "llvmpipe (LLVM 15.0.6, 256 bits)"."""
    return renderer.split("/")[0].split(" (")[0]


def plain_number(value, _=None):
    """Writes numbers like 1, 10, 1,000 and 0.01, and as a power of ten if that would be long."""
    if 1e-4 < value < 1e6:
        return f"{value:,.0f}" if value >= 1 else f"{value:g}"
    return f"$10^{{{len(f'{value:.0f}') - 1}}}$" if value >= 1 else f"{value:.0e}"


def leave_room(axes):
    """Leaves half a decade or more below, left and right of what is drawn, so that no marker lies on an axis.

    If the data cover less than 2.5 decades in x, each decade has ticks at 1, 2 and 5.
    """
    (left, low), (right, high) = axes.dataLim.min, axes.dataLim.max
    axes.set_xlim(left / 10 ** 0.5, right * 10 ** 0.5)
    axes.set_ylim(low / 10 ** 0.7, 10 ** ceil(log10(high) + 0.1))
    if log10(right / left) < 2.5:
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))


def set_style():
    plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 10, "text.color": INK, "axes.labelcolor": INK,
                         "axes.edgecolor": FAINT, "xtick.color": INK, "ytick.color": INK, "svg.fonttype": "path",
                         "svg.hashsalt": "pliant"})


def hardware_of(data):
    """Rows without a device were measured on the CPU."""
    machine, devices = data["machine"], {row.get("device", "cpu") for row in data["rows"]}
    names = {"gpu": short(machine["gpu"] or ""), "cpu": machine["cpu"].replace("(R)", "")}
    return f"{', '.join(names[device] for device in names if device in devices)} · {machine['date'][:10]}"


def trim_spines(axes):
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def make_axes(title, data, y_label):
    set_style()
    figure, axes = plt.subplots(figsize=(7.6, 4.8), dpi=160)
    dress_axes(axes, title, hardware_of(data), y_label)
    return figure, axes


def dress_axes(axes, title, subtitle, y_label):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("vertices")
    axes.set_ylabel(y_label)
    axes.grid(which="major", color="#d0d7de", linewidth=0.6)
    axes.grid(which="minor", visible=False)
    axes.set_axisbelow(True)
    trim_spines(axes)
    axes.tick_params(which="minor", length=2, color=FAINT)
    axes.xaxis.set_major_formatter(FuncFormatter(plain_number))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_title(title, loc="left", fontsize=13, fontweight="bold", pad=22)
    axes.text(0, 1.025, subtitle, transform=axes.transAxes, fontsize=8.5, color=SOFT)
