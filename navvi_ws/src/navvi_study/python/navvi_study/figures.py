"""Plots, as SVG."""
import io

import matplotlib
matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

from .measures import MEASURES  # noqa: E402
from .ways import MODALITIES, MOST_LINES  # noqa: E402

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
        # The panels share it. Nothing counted is a line at the bottom, not in the middle of an axis around it.
        least, most = min(0.0, values["value"].min()), max(1.0, values["value"].max())
        panels[0][0].set_ylim(least, least + 1.05 * (most - least))
        panels[0][0].set_ylabel(f"{measure.label}\n({measure.unit})")
        text = io.StringIO()
        drawing.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
        plt.close(drawing)
    return text.getvalue()


def time_lines(cues):
    """When something was said, played or felt, a line a trial. \\param cues  of ways.cues_by_condition()"""
    shown = {condition: trials[:MOST_LINES] for condition, (trials, _) in cues.items()}
    heights = [len(trials) for trials in shown.values()]
    with plt.rc_context({"svg.hashsalt": "navvi", "font.size": 12, "svg.fonttype": "path"}):
        drawing, panels = plt.subplots(len(shown), 1, figsize=(9.6, 1.2 * len(shown) + 0.22 * sum(heights)), squeeze=False, sharex=True, layout="constrained",
                                       gridspec_kw={"height_ratios": [3 + height for height in heights]})
        for (condition, trials), panel in zip(shown.items(), panels[:, 0]):
            for at, modality in enumerate(MODALITIES):
                onsets = [[onset for onset, one in trial if one == modality] for trial in trials]
                panel.eventplot(onsets, lineoffsets=[line + 0.25 * (at - 1) for line in range(len(trials))], linelengths=0.24, linewidths=1.4,
                                colors=COLOURS[at], label=modality)
            panel.set_title(condition, loc="left")
            panel.set_yticks([])
            panel.set_ylabel("a line\na trial")
        panels[-1][0].set_xlabel("s since the trial began")
        handles = [plt.Line2D([], [], color=COLOURS[at], linewidth=3) for at in range(len(MODALITIES))]
        drawing.legend(handles, ["lower: speech", "middle: sounds", "upper: felt patterns"], loc="upper right", ncol=3, frameon=False, fontsize=10)
        text = io.StringIO()
        drawing.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
        plt.close(drawing)
    return text.getvalue()


def _draw(panel, rows, values):
    means = values.pivot_table(index="participant", columns="condition", values="value", aggfunc="mean")
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
