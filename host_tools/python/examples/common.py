# SPDX-License-Identifier: MIT
"""Common part of the examples: paths, and one way to draw."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Mapping, Sequence, Tuple

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

ROOT = Path(__file__).resolve().parents[3]
DRIVES = ROOT / "firmware/config/drives"
SCENARIOS = ROOT / "host_tools/sil/scenarios"

#: A curve: label, times in s, values.
Curve = Tuple[str, NDArray, NDArray]


def draw(title: str, panels: Mapping[str, Sequence[Curve]]) -> None:
    """One panel under the other, by its label with the unit, to the file named on the command
    line."""
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(sys.argv[0]).with_suffix(".png").name
    figure, axes = plt.subplots(
        len(panels), 1, figsize=(8.0, 2.6 * len(panels) + 0.6), sharex=True, squeeze=False
    )
    for axis, (label, curves) in zip(axes[:, 0], panels.items()):
        for (name, time_s, values), style in zip(curves, ("-", "--", ":", "-.")):
            axis.plot(1e3 * time_s, values, style, linewidth=1.1, label=name)
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8, loc="upper right")
    axes[-1, 0].set_xlabel("time [ms]")
    figure.suptitle(title, fontsize=10)
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    print(f"written: {path}")
