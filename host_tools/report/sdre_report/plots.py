# SPDX-License-Identifier: MIT
"""Vector plots that read in grey: every line has its own dashes and lightness. Same data, same
bytes."""

from __future__ import annotations

import io
import re
from typing import Any, Sequence, Tuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

# Chosen so that neighbours differ in dashes and in lightness: black, blue, orange, light green.
STYLES: Tuple[dict, ...] = (
    {"color": "#000000", "ls": "-", "lw": 1.3},
    {"color": "#0060a8", "ls": (0, (5, 1.5)), "lw": 1.3},
    {"color": "#d06000", "ls": (0, (1, 1)), "lw": 1.5},
    {"color": "#70a840", "ls": (0, (6, 1.5, 1, 1.5)), "lw": 1.3},
)
REFERENCE = {"color": "#888888", "ls": "-", "lw": 0.7}
WIDTH_IN = 7.6


def grid(
    rows: int, columns: int = 1, height_in: float = 1.55, **more: Any
) -> Tuple[Any, np.ndarray]:
    """Axes on a fixed width."""
    figure, axes = plt.subplots(
        rows,
        columns,
        figsize=(WIDTH_IN, height_in * rows + 0.35),
        constrained_layout=True,
        squeeze=False,
        **more,
    )
    return figure, axes


def line(axis: Any, x: np.ndarray, y: np.ndarray, style: int, label: str = "", **more: Any) -> None:
    """One line in the style of its number."""
    axis.plot(x, y, label=label or None, **{**STYLES[style % len(STYLES)], **more})


def finish(figure: Any, axes: np.ndarray, ident: str, title: str) -> str:
    """The figure as SVG text to stand in HTML: ids of its own, no date, a title for who does not
    see it."""
    for axis in axes.flat:
        axis.grid(alpha=0.3, lw=0.5)
        axis.tick_params(labelsize=7)
        axis.xaxis.label.set_size(8)
        axis.yaxis.label.set_size(8)
        axis.title.set_size(9)
        if axis.get_legend_handles_labels()[0]:
            axis.legend(fontsize=7, loc="best", handlelength=3, framealpha=0.8)
    with matplotlib.rc_context(
        {"svg.hashsalt": ident, "svg.fonttype": "none", "path.simplify_threshold": 0.3}
    ):
        text = io.StringIO()
        figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)
    svg = text.getvalue()
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r'\b(id="|url\(#|href="#)', rf"\g<1>{ident}-", svg)
    return re.sub(
        r"<svg [^>]*?viewBox=(\"[^\"]+\")[^>]*>",
        rf'<svg viewBox=\1 role="img" aria-label="{title}">',
        svg,
        count=1,
    )


def window(trace: dict, from_s: float, to_s: float) -> dict:
    """The rows of a time, their time in ms from its beginning on."""
    keep = (trace["time_s"] >= from_s - 1e-9) & (trace["time_s"] <= to_s + 1e-9)
    out = {name: column[keep] for name, column in trace.items()}
    out["ms"] = 1e3 * out["time_s"]
    return out


def names(labels: Sequence[str]) -> str:
    """For a note: which line is which."""
    words = ("black, full", "blue, dashed", "orange, dotted", "green, dash-dotted")
    return "; ".join(f"{w}: {t}" for w, t in zip(words, labels))
