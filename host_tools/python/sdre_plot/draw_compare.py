# SPDX-License-Identifier: MIT
"""Draws the drives of a comparison over each other, one line each: `sdre-sil compare --plot`.

Usage: draw_compare.py TRACES.csv TITLE OUT.png|OUT.svg MARKS.json

TRACES has the columns run, time_s and those of a trace that are drawn. MARKS has an object for each
run: scenario, drive, and what draw_trace.py needs of a trace.
"""

import csv
import json
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "sdre"  # same traces, same bytes
import matplotlib.pyplot as plt  # noqa: E402
from draw_trace import window  # noqa: E402

PANELS = (
    ("omega_e_radps", "speed\n[rad/s el.]"),
    ("iq_A", "iq\n[A]"),
    ("vq_V", "vq\n[V]"),
)
ROOM = 0.06  # of a panel's height, above and below the lines


def read(path, marks):
    """The runs: their marks, and their columns under "trace"."""
    runs = [{**one, "trace": {}} for one in marks]
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            trace = runs[int(row.pop("run"))]["trace"]
            for name, value in row.items():
                trace.setdefault(name, []).append(float(value))
    return runs


def by_scenario(runs):
    """{scenario: its runs}, in order."""
    groups = {}
    for run in runs:
        groups.setdefault(run["scenario"], []).append(run)
    return groups


def unrest(values):
    """How far a line goes up and down in all: the restless ones are drawn first."""
    return sum(abs(b - a) for a, b in zip(values, values[1:]))


def also_rpm(axis, runs):
    """A second scale, when it is the same for all drives."""
    pairs = {run["pole_pairs"] for run in runs}
    if len(pairs) == 1:
        per_rpm = 2 * math.pi / 60 * pairs.pop()
        functions = (lambda w: w / per_rpm, lambda n: n * per_rpm)
        axis.secondary_yaxis("right", functions=functions).set_ylabel("[r/min]")


def panel(axis, runs, name, words):
    """One line for each run; the wanted speed is the one of the run that lasted longest."""
    if name == "omega_e_radps":
        longest = max((run["trace"] for run in runs), key=lambda t: len(t["time_s"]))
        axis.plot(longest["time_s"], longest["omega_ref_e_radps"], "k--", lw=1, label="wanted")
        also_rpm(axis, runs)
    order = sorted(range(len(runs)), key=lambda k: -unrest(runs[k]["trace"][name]))
    for k, run in enumerate(runs):
        label, place = run["drive"], 2 + order.index(k) / len(runs)
        axis.plot(
            run["trace"]["time_s"], run["trace"][name], f"C{k}", lw=1, zorder=place, label=label
        )
    axis.set_ylabel(words)
    axis.grid(alpha=0.3)


def closer(axes, runs):
    """The last measure, as long as the slowest of the drives that settle needs."""
    last = [run["measures"][-1] for run in runs if run["measures"]]
    if not last:
        for axis in axes:
            axis.set_axis_off()
        return
    windows = [window(m) for m in last if m.get("settling_time_s")] or [window(last[0])]
    lo, hi = min(begin for begin, _ in windows), max(end for _, end in windows)
    for axis, (name, words) in zip(axes, PANELS):
        panel(axis, runs, name, words)
        axis.set_xlim(lo, hi)
        seen = [
            y
            for line in axis.get_lines()
            for x, y in zip(line.get_xdata(), line.get_ydata())
            if lo <= x <= hi
        ]
        room = ROOM * (max(seen) - min(seen) or 1.0)
        axis.set_ylim(min(seen) - room, max(seen) + room)
    axes[0].set_title(f"{last[0]['name']}, closer", fontsize="medium")


def main(traces_path, title, out_path, marks_path):
    groups = by_scenario(read(traces_path, json.loads(Path(marks_path).read_text())))
    columns = 2 if any(run["measures"] for runs in groups.values() for run in runs) else 1
    rows = len(PANELS) * len(groups)
    figure, axes = plt.subplots(
        rows,
        columns,
        figsize=(6.5 * columns, 0.5 + 2.1 * rows),
        squeeze=False,
        constrained_layout=True,
    )
    figure.suptitle(title)
    for number, (scenario, runs) in enumerate(groups.items()):
        mine = axes[number * len(PANELS) : (number + 1) * len(PANELS)]
        for axis, (name, words) in zip(mine[:, 0], PANELS):
            panel(axis, runs, name, words)
        mine[0, 0].set_title(scenario, fontsize="medium")
        if columns == 2:
            closer(mine[:, 1], runs)
        mine[1, -1].legend(
            *mine[0, 0].get_legend_handles_labels(),
            loc="center left",
            bbox_to_anchor=(1.01, 0.5),
            fontsize="small",
        )
        for axis in mine[-1]:
            axis.set_xlabel("time [s]")
    metadata = {"Date": None} if out_path.endswith(".svg") else None
    figure.savefig(out_path, dpi=80, metadata=metadata)


if __name__ == "__main__":
    main(*sys.argv[1:])
