"""Plots, as SVG."""
import io

import matplotlib
matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

from .analysis import by_participant  # noqa: E402
from .measures import MEASURES  # noqa: E402

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00")  # Okabe and Ito: told apart by all


def by_condition(analysis, name):
    """Means of the participants by condition, one panel a group. The same data give the same bytes."""
    measure, rows, values = MEASURES[name], analysis.by_condition(name), analysis.values(name)
    groups = list(dict.fromkeys(row["group"] for row in rows))
    with plt.rc_context({"svg.hashsalt": "navvi", "font.size": 12, "svg.fonttype": "path"}):
        drawing, panels = plt.subplots(1, len(groups), figsize=(4.8 * len(groups), 3.8), squeeze=False, sharey=True, layout="constrained")
        for group, panel in zip(groups, panels[0]):
            _draw(panel, [row for row in rows if row["group"] == group], values[values["group"] == group])
            panel.set_title(group)
        most = by_participant(values).max().max()
        panels[0][0].set_ylim(-0.04 * most, 1.05 * most)  # the panels share it, and marks at 0 are whole
        panels[0][0].set_ylabel(f"{measure.label}\n({analysis.unit(name)})")
        text = io.StringIO()
        drawing.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
        plt.close(drawing)
    return text.getvalue()


def _draw(panel, rows, values):
    means = by_participant(values)
    names = [row["condition"] for row in rows]
    for _, person in means[names].iterrows():
        panel.plot(range(len(names)), person.to_numpy(), color="#767676", linewidth=0.8, zorder=1)
    for at, row in enumerate(rows):
        colour = COLOURS[at % len(COLOURS)]
        dots = means[row["condition"]].dropna()
        panel.scatter([at] * len(dots), dots, s=18, color=colour, zorder=2)
        if row["low"] is not None:
            panel.plot([at + 0.15] * 2, [row["low"], row["high"]], color="black", linewidth=2, zorder=3)
        panel.scatter([at + 0.15], [row["mean"]], marker="s", s=48, color="black", zorder=4)
    panel.set_xticks(range(len(names)), names, rotation=20 if max(map(len, names)) * len(names) > 30 else 0)
    panel.set_xlim(-0.4, len(names) - 0.5)
    panel.grid(axis="y", color="#dddddd")
    panel.set_axisbelow(True)
