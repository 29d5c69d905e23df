"""Picture of the suite collision: refitting and querying two spheres of 5 % overlap, by triangles."""
from plots.style import INK, make_axes, leave_room

OVERLAP = "5 %"
COLORS = {"pliant": "#0072b2", "Embree": "#d55e00", "Bullet": "#009e73", "FCL": "#cc79a7", "brute": INK}
DASHES = {"one thread": "-", "more threads": (0, (4, 2)), "gpu": (0, (1, 1.5))}


def manner(row):
    if row["device"] == "gpu":
        return "gpu"
    return "one thread" if row["threads"] == 1 else "more threads"


def label_of(row):
    if row["device"] == "gpu":
        return f"{row['engine']}, GPU"
    return row["engine"] if row["threads"] == 1 else f"{row['engine']}, {row['threads']} threads"


def draw_collision(data):
    """Draws pliant as it comes, without its other trees, and everything else."""
    figure, axes = make_axes(f"Two spheres, {OVERLAP} overlap: all pairs that touch", data, "milliseconds to refit and query")
    rows = [row for row in data["rows"] if row["overlap"] == OVERLAP and not row["engine"].startswith("pliant, ")]
    for label in dict.fromkeys(label_of(row) for row in rows):
        own = sorted((row for row in rows if label_of(row) == label), key=lambda row: row["triangles"])
        axes.plot([row["triangles"] for row in own], [1e3 * row["refit_and_query_seconds"] for row in own], label=label,
                  color=COLORS[own[0]["engine"].split()[0]], linestyle=DASHES[manner(own[0])], marker="o", markersize=4, linewidth=1.8)
    leave_room(axes)
    axes.set_xlabel("triangles of each sphere")
    axes.set_xticks(sorted({row["triangles"] for row in rows}))
    axes.minorticks_off()
    axes.legend(frameon=False, fontsize=9, loc="upper left", bbox_to_anchor=(1, 1), handlelength=3.2)
    return figure
