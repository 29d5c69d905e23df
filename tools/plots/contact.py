"""Picture of the suite contact: what an impact gives, by the length of the step."""
from math import ceil, floor, log10

import matplotlib.pyplot as plt

from plots.precision import plain_axes
from plots.style import FAINT, SOFT, fail, hardware_of, set_style

RESPONSES = {"impulse": "#0072b2", "reflect": "#d55e00"}
METHODS = {"cv8": "-", "verlet": (0, (3, 2))}
ERRORS = (("position_error", "where a body is\n(over its radius)"), ("momentum_error", "momentum\n(over the start's)"),
          ("spin_error", "spin\n(over M r v)"))


def draw_panel(axes, rows, error):
    """Draws a line for each response and method, and one of first order."""
    values = [row[error] for row in rows]
    for response, color in RESPONSES.items():
        for method, dashes in METHODS.items():
            own = sorted((row for row in rows if (row["response"], row["integrator"]) == (response, method)),
                         key=lambda row: row["omega_step"])
            axes.plot([row["omega_step"] for row in own], [row[error] for row in own], color=color, linestyle=dashes, marker="o",
                      markersize=3.5, linewidth=1.6, label=f"{response}, {method}")
    plain_axes(axes)
    axes.set_ylim(10.0 ** floor(log10(min(values))), 10.0 ** ceil(log10(max(values))))
    steps = sorted({row["omega_step"] for row in rows})
    first = max(row[error] for row in rows if row["response"] == "impulse" and row["omega_step"] == steps[-1])
    axes.plot([steps[0], steps[-1]], [first * steps[0] / steps[-1], first], color=FAINT, linewidth=1, linestyle=":",
              label="first order", zorder=0)


def draw_contact(data):
    rows = [row for row in data["rows"] if row["kind"] == "impact" and row["position_error"]]
    if not rows:
        fail("the file has no impacts with several lengths of step")
    set_style()
    figure, panels = plt.subplots(1, len(ERRORS), figsize=(10.4, 4.1), dpi=160)
    for axes, (error, label) in zip(panels, ERRORS):
        draw_panel(axes, rows, error)
        axes.set_title(label, fontsize=9.5, loc="left")
        axes.set_xlabel("step times omega", fontsize=9.5)
    panels[0].set_ylabel("difference from the shortest step")
    figure.subplots_adjust(left=0.075, right=0.99, top=0.76, bottom=0.24, wspace=0.24)
    figure.text(0.075, 0.985, "What an impact gives, as steps get shorter", fontsize=13, fontweight="bold", va="top")
    figure.text(0.075, 0.915, f"two spheres of 162 vertices, off their centres · {hardware_of(data)}", fontsize=8.5, color=SOFT,
                va="top")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=len(labels), frameon=False, fontsize=9)
    return figure
