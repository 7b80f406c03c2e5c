# SPDX-License-Identifier: MIT
"""Draw tables of `sdre-gains orders --csv`: gain error over the range of the scheduling current.

Usage: plot_orders.py OUT.png TITLE=TABLE.csv ...
"""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def curves(path, loop):
    lines = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row["loop"] == loop:
                x, y = lines.setdefault(int(row["order"]), ([], []))
                x.append(float(row["within_A"]))
                y.append(100.0 * float(row["error"]))
    return lines


def main(out_path, *tables):
    loops = ("controller", "observer")
    figure, axes = plt.subplots(
        len(tables),
        2,
        figsize=(9, 3 * len(tables)),
        sharex=True,
        squeeze=False,
        constrained_layout=True,
    )
    for row, table in zip(axes, tables):
        title, path = table.split("=", 1)
        for axis, loop in zip(row, loops):
            for order, (x, y) in sorted(curves(path, loop).items()):
                axis.semilogy(x, y, label=f"order {order}")
            axis.axhline(10.0, color="k", ls=":", lw=1)
            axis.set_title(f"{title}, {loop}", fontsize="medium")
            axis.set_ylim(1e-4, 1e3)
            axis.grid(alpha=0.3)
        row[0].set_ylabel("largest gain error [%]")
        row[0].legend(fontsize="small")
    for axis, name in zip(axes[-1], ("current error within [A]", "estimated current within [A]")):
        axis.set_xlabel(name)
    figure.savefig(out_path, dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
