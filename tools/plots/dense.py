"""Picture of the suite dense: milliseconds of a sum of forces over vertices, by clusters and of all springs."""
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator

from plots.speed import by_place, color_of, label_of, marker_of
from plots.style import FAINT, fail, leave_room, make_axes, plain_number

LINES = ("-", ":", "-.")  # by tolerance, the largest first


def draw_dense(data):
    rows = [row for row in data["forces"] if row["precision"] == 32 and row["mesh"].startswith("icosphere")]
    if not rows:
        fail("no times of precision 32 in the file")
    figure, axes = make_axes("Forces of a dense body: time by number of vertices", {**data, "rows": rows}, "milliseconds")
    axes.set_xlabel("vertices of the sphere")
    tolerances = sorted({row["tolerance"] for row in rows}, reverse=True)
    handles = []
    for key, group in by_place(rows).items():
        style = {"color": color_of(key), "marker": marker_of(key), "markersize": 5}
        for tolerance, line in zip(tolerances, LINES):
            of_tolerance = [row for row in group if row["tolerance"] == tolerance]
            axes.plot([row["vertices"] for row in of_tolerance], [1e3 * row["seconds_per_sum"] for row in of_tolerance], line,
                      linewidth=2, **style)
        direct = [row for row in group if row["tolerance"] == tolerances[0] and row["direct_seconds_per_sum"]]
        axes.plot([row["vertices"] for row in direct], [1e3 * row["direct_seconds_per_sum"] for row in direct], "--", linewidth=1.2,
                  markerfacecolor="white", **style)
        handles.append(Line2D([], [], linewidth=2, label=label_of(key, data["machine"]), **style))
    for tolerance, line in zip(tolerances, LINES):
        handles.append(Line2D([], [], color=FAINT, linestyle=line, linewidth=2, label=f"by clusters, tolerance {plain_number(tolerance)}"))
    handles.append(Line2D([], [], color=FAINT, linestyle="--", linewidth=1.2, label="all springs"))
    axes.yaxis.set_major_formatter(FuncFormatter(plain_number))
    leave_room(axes)
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 3)))
    axes.set_xlim(right=1.5e6)
    axes.legend(handles=handles, loc="upper left", frameon=False, fontsize=8.5)
    return figure
