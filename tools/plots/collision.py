"""Picture of the suite collision, by triangles: refitting and querying two spheres of 5 % overlap, and steps in contact."""
import matplotlib.pyplot as plt

from plots.style import INK, dress_axes, hardware_of, leave_room, set_style

OVERLAP = "5 %"
COLORS = {"pliant": "#0072b2", "Embree": "#d55e00", "Bullet": "#009e73", "FCL": "#cc79a7", "brute": INK}
DASHES = {"one thread": "-", "more threads": (0, (4, 2)), "gpu": (0, (1, 1.5))}
GROUPS = {"expectation": "#56b4e9", "refit": "#0072b2", "search": "#009e73", "contacts": "#e69f00", "impulses": "#d55e00",
          "certificate": "#cc79a7", "step": INK}


def manner(row):
    if row["device"] == "gpu":
        return "gpu"
    return "one thread" if row["threads"] == 1 else "more threads"


def label_of(row):
    if row["device"] == "gpu":
        return f"{row['engine']}, GPU"
    return row["engine"] if row["threads"] == 1 else f"{row['engine']}, {row['threads']} threads"


def place_of(row):
    if row["device"] == "gpu":
        return "GPU"
    return "one thread" if row["threads"] == 1 else f"{row['threads']} threads"


def draw_line(axes, rows, key, **look):
    own = sorted(rows, key=lambda row: row["triangles"])
    axes.plot([row["triangles"] for row in own], [1e3 * row[key] for row in own], marker="o", markersize=4, linewidth=1.8, **look)


def finish(axes, rows, ticks=slice(None)):
    leave_room(axes)
    axes.set_xlabel("triangles of each sphere")
    axes.set_xticks(sorted({row["triangles"] for row in rows})[ticks])
    axes.minorticks_off()


def explain(axes):
    axes.legend(frameon=False, fontsize=9, loc="upper left", bbox_to_anchor=(1, 1), handlelength=3.2)


def draw_search(axes, data):
    """Draws pliant as it comes, without its other trees, and everything else."""
    dress_axes(axes, f"Two spheres, {OVERLAP} overlap: all pairs that touch", hardware_of(data), "milliseconds to refit and query")
    rows = [row for row in data["rows"]
            if row["overlap"] == OVERLAP and row["bodies"] == 2 and not row["engine"].startswith("pliant, ")]
    for label in dict.fromkeys(label_of(row) for row in rows):
        own = [row for row in rows if label_of(row) == label]
        draw_line(axes, own, "refit_and_query_seconds", label=label, color=COLORS[own[0]["engine"].split()[0]],
                  linestyle=DASHES[manner(own[0])])
    finish(axes, rows)
    explain(axes)


def draw_steps_in_contact(panels, rows):
    """Draws a panel for each place, all to one scale. They are narrow, so that they have every other tick."""
    for place, axes in panels.items():
        own = [row for row in rows if place_of(row) == place]
        is_first = axes is next(iter(panels.values()))
        dress_axes(axes, "A step in contact" if is_first else "", place, "milliseconds" if is_first else "")
        for group, color in GROUPS.items():
            draw_line(axes, own, f"{group}_seconds", label="all" if group == "step" else group, color=color)
        finish(axes, own, slice(None, None, 2))
        axes.tick_params(labelsize=9)
    limits = [axes.get_ylim() for axes in panels.values()]
    for axes in panels.values():
        axes.set_ylim(min(low for low, _ in limits), max(high for _, high in limits))
    explain(axes)


def draw_collision(data):
    """Files of earlier versions have no steps in contact."""
    steps = data.get("contact_steps", [])
    places = list(dict.fromkeys(place_of(row) for row in steps))
    set_style()
    rows = [["search"] * max(len(places), 1)] + ([places] if places else [])
    figure, panels = plt.subplot_mosaic(rows, figsize=(7.6, 4.8 * len(rows)), dpi=160)
    draw_search(panels.pop("search"), data)
    if steps:
        draw_steps_in_contact(panels, steps)
        figure.subplots_adjust(hspace=0.45, wspace=0.25)
    return figure
