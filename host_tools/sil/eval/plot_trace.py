# SPDX-License-Identifier: MIT
"""Draw one sdre-sil trace: speed, currents, voltages, estimated disturbances.

Usage: plot_trace.py TRACE.csv TITLE OUT.png|OUT.svg
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "sdre"  # same trace, same bytes
import matplotlib.pyplot as plt  # noqa: E402


def read(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {key: [float(row[key]) for row in rows] for key in rows[0]}


def main(trace_path, title, out_path):
    t = read(trace_path)
    time = t["time_s"]
    figure, axes = plt.subplots(4, 1, figsize=(8, 10), sharex=True, constrained_layout=True)
    figure.suptitle(title)

    axes[0].plot(time, t["omega_ref_e_radps"], "k--", lw=1, label="reference")
    axes[0].plot(time, t["omega_e_radps"], label="speed")
    axes[0].set_ylabel("electrical speed [rad/s]")

    for axis_name, colour in (("iq", "C0"), ("id", "C1")):
        axes[1].plot(time, t[axis_name + "_A"], colour, label=axis_name)
        axes[1].plot(time, t[axis_name + "_ref_A"], colour, ls="--", lw=1, label=axis_name + " reference")
    axes[1].set_ylabel("current [A]")

    axes[2].plot(time, t["vq_V"], label="vq")
    axes[2].plot(time, t["vd_V"], label="vd")
    length = [(q * q + d * d) ** 0.5 for q, d in zip(t["vq_V"], t["vd_V"])]
    axes[2].plot(time, length, "k:", lw=1, label="length")
    circle = [v / 3**0.5 for v in t["dc_link_V"]]
    axes[2].plot(time, circle, "r--", lw=1, label="dc link / sqrt 3")
    axes[2].set_ylabel("voltage [V]")

    axes[3].plot(time, t["d_omega_hat"], "C3", label="d_omega [rad/s²]")
    right = axes[3].twinx()
    right.plot(time, t["d_q_hat"], "C4", label="d_q [A/s]")
    right.plot(time, t["d_d_hat"], "C5", label="d_d [A/s]")
    axes[3].set_ylabel("d_omega [rad/s²]")
    right.set_ylabel("d_q, d_d [A/s]")
    right.legend(loc="lower right", fontsize="small")
    axes[3].set_xlabel("time [s]")

    for axis in axes:
        axis.grid(alpha=0.3)
        axis.legend(loc="upper left", fontsize="small")
    metadata = {"Date": None} if out_path.endswith(".svg") else None
    figure.savefig(out_path, dpi=110, metadata=metadata)


if __name__ == "__main__":
    main(*sys.argv[1:])
