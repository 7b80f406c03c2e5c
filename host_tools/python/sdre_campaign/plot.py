# SPDX-License-Identifier: MIT
"""The sensitivity plot: how the margin goes with every variable."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from sdre_campaign.rare_summary import RareSummary
from sdre_campaign.summary import Summary

_LINES = ((0.5, "median", "-"), (0.01, "1 %", "--"), (0.0, "least", ":"))


def draw_sensitivity(summary: Summary, title: str, path: Path) -> None:
    """One panel for each variable, those that explain most of the variance first."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    variance, mean = summary.margin_deviation**2, summary.margin_mean
    ranked = sorted(summary.sensitivities, key=lambda one: -one.first_order(variance, mean))
    columns = min(2, len(ranked))
    rows = -(-len(ranked) // columns)
    figure, axes = plt.subplots(
        rows, columns, figsize=(5.0 * columns, 2.9 * rows + 0.6), squeeze=False, sharey=True
    )
    for axis, one in zip(axes.flat, ranked):
        centre = 0.5 * (one.edges[1:] + one.edges[:-1])
        used = one.counts.sum(axis=1) > 0
        for share, label, style in _LINES:
            values = one.least if share == 0.0 else one.quantile(share)
            axis.plot(
                centre[used],
                np.maximum(values[used], -1.0),
                style,
                color="black",
                linewidth=1.2,
                label=label,
            )
        axis.axhline(0.0, color="grey", linewidth=0.8)
        axis.set_xlabel(one.name)
        axis.set_title(
            f"explains {100.0 * one.first_order(variance, mean):.1f} % of the variance", fontsize=9
        )
        axis.grid(alpha=0.3)
        axis.locator_params(axis="x", nbins=5)
        axis.ticklabel_format(axis="x", scilimits=(-2, 4))
    for axis in axes.flat[len(ranked) :]:
        axis.set_axis_off()
    for axis in axes[:, 0]:
        axis.set_ylabel("margin")
    axes[0, 0].legend(fontsize=8)
    figure.suptitle(title, fontsize=10)
    figure.tight_layout()
    figure.savefig(path, dpi=120, metadata={"Software": None} if path.suffix == ".png" else None)
    plt.close(figure)


def draw_levels(summary: RareSummary, title: str, path: Path) -> None:
    """Probability of a margin at or below each value, every run with its levels' thresholds."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, axis = plt.subplots(figsize=(7.0, 4.2))
    for run, curve in zip(summary.runs, summary.curves):
        axis.semilogy(summary.at, np.where(curve > 0.0, curve, np.nan), color="0.7", linewidth=0.8)
        reached = np.cumprod([level.share for level in run.levels])
        axis.plot(
            [level.threshold for level in run.levels], reached, ".", color="black", markersize=3
        )
    mean = summary.curves.mean(axis=0)
    axis.semilogy(
        summary.at,
        np.where(mean > 0.0, mean, np.nan),
        color="black",
        linewidth=1.4,
        label="mean of the runs",
    )
    axis.axvline(summary.spec.limit, color="black", linewidth=0.8, linestyle=":", label="limit")
    axis.set_xlabel("margin")
    axis.set_ylabel("probability of less")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    axis.set_title(title, fontsize=10)
    figure.tight_layout()
    figure.savefig(path, dpi=120, metadata={"Software": None} if path.suffix == ".png" else None)
    plt.close(figure)
