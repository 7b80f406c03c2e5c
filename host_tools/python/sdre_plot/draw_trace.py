# SPDX-License-Identifier: MIT
"""Draws one trace, whole on the left and around its last measure on the right: `sdre-sil run
--plot`, `sdre.Run.plot()`.

Usage: draw_trace.py TRACE.csv TITLE OUT.png|OUT.svg MARKS.json

MARKS: pole_pairs, and measures with name, time_s, end_s and, where there is one, settling_time_s
and dip_e_radps.
"""

import csv
import json
import math
import sys
from pathlib import Path

import matplotlib

if __name__ == "__main__":
    matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

ZOOM_SETTLINGS = 4.0  # chosen: what came before fits beside it
ZOOM_LEAST_S = 0.02
BEFORE = 0.15  # of the zoomed window


def columns_of(text):
    """{name: values} of a trace as CSV."""
    rows = list(csv.DictReader(text.splitlines()))
    return {key: [float(row[key]) for row in rows] for key in rows[0]}


def speed(axis, t, marks):
    axis.plot(t["time_s"], t["omega_ref_e_radps"], "k--", lw=1, label="wanted")
    axis.plot(t["time_s"], t["omega_e_radps"], label="speed")
    axis.set_ylabel("speed\n[rad/s el.]")
    per_rpm = 2 * math.pi / 60 * marks["pole_pairs"]
    right = axis.secondary_yaxis("right", functions=(lambda w: w / per_rpm, lambda n: n * per_rpm))
    right.set_ylabel("[r/min]")


def position(axis, t, marks):
    turn = 2 * math.pi * marks["pole_pairs"]
    axis.plot(
        t["time_s"], [x / turn for x in t["position_ref_e_rad"]], "k--", lw=1, label="reference"
    )
    axis.plot(t["time_s"], [x / turn for x in t["position_e_rad"]], label="shaft")
    axis.set_ylabel("position\n[turns]")


def currents(axis, t, _):
    for name, colour in (("iq", "C0"), ("id", "C1")):
        axis.plot(t["time_s"], t[name + "_A"], colour, label=name)
        axis.plot(t["time_s"], t[name + "_ref_A"], colour, ls="--", lw=1, label=name + " reference")
    axis.set_ylabel("current\n[A]")


def phases(axis, t, _):
    for k, name in enumerate(("ia", "ib", "ic")):
        axis.plot(t["time_s"], t[name + "_A"], f"C{k}", lw=1, label=name)
    axis.set_ylabel("phase current\n[A]")


def torque(axis, t, _):
    axis.plot(t["time_s"], t["torque_Nm"], label="motor")
    axis.plot(t["time_s"], t["load_torque_Nm"], "k--", lw=1, label="load")
    axis.set_ylabel("torque\n[N m]")


def voltages(axis, t, _):
    axis.plot(t["time_s"], t["vq_V"], label="vq")
    axis.plot(t["time_s"], t["vd_V"], label="vd")
    length = [math.hypot(q, d) for q, d in zip(t["vq_V"], t["vd_V"])]
    axis.plot(t["time_s"], length, "k:", lw=1, label="length")
    axis.plot(t["time_s"], [v / 3**0.5 for v in t["dc_link_V"]], "r--", lw=1, label="dc link / √3")
    axis.set_ylabel("voltage\n[V]")


def disturbances(axis, t, _):
    axis.plot(t["time_s"], [x / 1e3 for x in t["d_omega_hat"]], "C3", label="d_ω [10³ rad/s²]")
    axis.plot(t["time_s"], [x / 1e2 for x in t["d_q_hat"]], "C4", lw=1, label="d_q [10² A/s]")
    axis.plot(t["time_s"], [x / 1e2 for x in t["d_d_hat"]], "C5", lw=1, label="d_d [10² A/s]")
    axis.set_ylabel("estimated\ndisturbance")


def panels(t):
    """The position in a run to a position; otherwise the reference is the shaft's own."""
    goes = any(abs(a - b) > 1e-9 for a, b in zip(t["position_ref_e_rad"], t["position_e_rad"]))
    return [speed, *([position] if goes else []), currents, torque, phases, voltages, disturbances]


def window(measure):
    """Window of a measure for a closer look: some settling times, or all of a short measure."""
    whole = measure["end_s"] - measure["time_s"]
    settled = measure.get("settling_time_s")
    length = min(whole, max(ZOOM_SETTLINGS * settled, ZOOM_LEAST_S)) if settled else whole
    return measure["time_s"] - BEFORE * length, measure["time_s"] + length


def mark(axis, measure):
    """When it is settled, and how deep it dipped."""
    begin = measure["time_s"]
    words = []
    if measure.get("settling_time_s"):
        axis.axvspan(begin, begin + measure["settling_time_s"], color="0.9", zorder=0)
        words.append(f"settled in {1e3 * measure['settling_time_s']:.1f} ms")
    if measure.get("dip_e_radps"):
        words.append(f"dip {measure['dip_e_radps']:.2f} rad/s")
    axis.set_title(
        f"{measure['name']}: " + ", ".join(words) if words else measure["name"], fontsize="medium"
    )


def zoom_y(axis, t, lo, hi):
    """The data of the window alone set the scale."""
    axis.set_xlim(lo, hi)
    seen = [
        y
        for line in axis.get_lines()
        if len(line.get_xdata()) == len(t["time_s"])
        for x, y in zip(line.get_xdata(), line.get_ydata())
        if lo <= x <= hi
    ]
    if seen:
        room = 0.06 * (max(seen) - min(seen) or 1.0)
        axis.set_ylim(min(seen) - room, max(seen) + room)


def draw(trace, title, out_path, marks):
    """A trace as CSV with its marks as JSON, to a .png or .svg; same input, same bytes."""
    t, marks = columns_of(trace), json.loads(marks)
    measures = marks["measures"]
    drawn = panels(t)
    columns = 2 if measures else 1
    figure, axes = plt.subplots(
        len(drawn),
        columns,
        figsize=(6.5 * columns, 1.75 * len(drawn)),
        sharex="col",
        squeeze=False,
        constrained_layout=True,
    )
    figure.suptitle(title)
    for row, panel in zip(axes, drawn):
        for axis in row:
            panel(axis, t, marks)
            axis.grid(alpha=0.3)
            axis.label_outer() if axis is not row[0] else None
        row[-1].legend(
            loc="center left",
            bbox_to_anchor=(1.13 if panel is speed else 1.01, 0.5),
            fontsize="small",
        )
        for m in measures:
            row[0].axvline(m["time_s"], color="0.6", lw=0.8, ls=":")
    if measures:
        lo, hi = window(measures[-1])
        for row in axes:
            zoom_y(row[1], t, lo, hi)
            row[1].tick_params(labelleft=True)
        mark(axes[0][1], measures[-1])
    for axis in axes[-1]:
        axis.set_xlabel("time [s]")
    metadata = {"Date": None} if out_path.endswith(".svg") else None
    with matplotlib.rc_context({"svg.hashsalt": "sdre"}):
        figure.savefig(out_path, dpi=80, metadata=metadata)
    plt.close(figure)


if __name__ == "__main__":
    trace_path, wanted_title, picture, marks_path = sys.argv[1:]
    draw(
        Path(trace_path).read_text(encoding="utf-8"),
        wanted_title,
        picture,
        Path(marks_path).read_text(encoding="utf-8"),
    )
