# SPDX-License-Identifier: MIT
"""Section of the campaigns."""

from __future__ import annotations

import math
from typing import Any, Dict, List, Sequence, Tuple

import numpy as np
from markupsafe import Markup

from .. import plots
from ..tables import Figure, Section, Table

TEXT = """<p>Motors that the controller does not know, each with its own noise, on the realistic
board; how a campaign is run and what its
margin is: docs/campaign.md. The margin is negative when the current was above what is allowed, or
the speed outside its band at some instant of a
steady part; a case has failed when it tripped, took too much current, or was outside at its
end.</p>
<p>Subset simulation finds what small margins lead to. A fault that comes without a small margin
before is met by chance alone, by the plain
campaign as by the first level: its bound is the plain one.</p>"""
EDGE = 0.05  # of a distribution, at either end: what is odd about a case


def percent(value: float) -> str:
    """Two digits."""
    return f"{100.0 * value:.2g} %"


def chance(value: float) -> str:
    """A probability."""
    return "0" if value == 0.0 else f"{value:.2g}"


def interval(ends: Sequence[float]) -> str:
    """As text."""
    return " .. ".join(chance(end) for end in ends)


def box(campaign: Dict[str, Any]) -> str:
    """The variables and their ranges."""
    return ", ".join(
        f"{one['name']} {one['low']:g} .. {one['high']:g}" for one in campaign["variables"]
    )


def odd(places: Dict[str, float]) -> str:
    """Which values of a case are at an end of their distributions."""
    ends = [
        f"{name}: lowest {percent(place)}"
        if place < 0.5
        else f"{name}: highest {percent(1.0 - place)}"
        for name, place in sorted(places.items(), key=lambda one: min(one[1], 1.0 - one[1]))
        if not EDGE < place < 1.0 - EDGE
    ]
    return "; ".join(ends) or "nothing: each value is a usual one"


def probabilities(campaigns: List[Dict[str, Any]]) -> Table:
    """A row for each campaign."""
    out = Table(
        "C-probability",
        "How probable a failure is",
        (
            "",
            "cases",
            "negative margin",
            "95 % interval",
            "failed",
            "95 % interval",
            "least margin",
        ),
        note="Plain campaigns: Clopper and Pearson. Subset simulation: "
        'docs/campaign.md, "Rare events".',
    )
    for campaign in campaigns:
        s = campaign["summary"]
        worst = min(one["margin"] for one in s["worst"])
        if campaign["method"] == "subset":
            found, failed = s["below_limit"], s["failed"]
            below = (
                (chance(found["probability"]), interval(found["interval_95"]))
                if s["reached"]
                else ("0", f"0 .. {chance(found['less_than'])}")
            )
            out.add(
                campaign["name"],
                s["cases"],
                *below,
                chance(failed["probability"]),
                interval(failed["interval_95"]),
                worst,
            )
        else:
            out.add(
                campaign["name"],
                s["cases"],
                chance(s["negative_margins"] / s["cases"]),
                interval(s["negative_margin_interval_95"]),
                chance(s["failure_probability"]),
                interval(s["interval_95"]),
                s["margin"]["least"],
            )
    return out


def histogram(campaign: Dict[str, Any], ident: str) -> Figure:
    """Histogram of the margin, with the share that each variable explains."""
    s = campaign["summary"]
    edges, counts = np.array(s["histograms"]["edges"]), np.array(s["histograms"]["least"])
    used = np.flatnonzero(counts)
    figure, axes = plots.grid(1, 2, 2.2)
    left, right = axes[0]
    shown = slice(max(0, used[0] - 1), used[-1] + 2)
    left.bar(
        edges[:-1][shown],
        counts[shown],
        np.diff(edges)[shown],
        align="edge",
        color="0.75",
        edgecolor="k",
        lw=0.5,
    )
    left.set_yscale("log")
    left.axvline(0.0, color="k", lw=0.9, ls=":")
    left.set_xlabel("margin")
    left.set_ylabel("cases")
    shares = sorted(s["first_order"].items(), key=lambda one: one[1])
    right.barh(
        [name for name, _ in shares],
        [100.0 * share for _, share in shares],
        color="0.75",
        edgecolor="k",
        lw=0.5,
    )
    right.set_xlabel("share of the margin's variance [%]")
    title = f"{campaign['name']}: margins of {s['cases']:,} cases, and what explains them"
    return Figure(
        ident,
        title,
        plots.finish(figure, axes, ident, title),
        f"{box(campaign)}. Right: Sobol's first-order index; the rest is interplay. Left: dotted "
        f"where the margin is zero.",
    )


def counted(summary: Dict[str, Any], margin: str) -> Tuple[np.ndarray, np.ndarray]:
    """Values of this margin in a plain campaign, and the share of the cases below each."""
    share = np.cumsum(summary["histograms"][margin]) / summary["cases"]
    keep = share > 0.0
    return np.array(summary["histograms"]["edges"])[1:][keep], share[keep]


def levels(campaign: Dict[str, Any], plain: List[Dict[str, Any]], ident: str) -> List[Any]:
    """How subset simulation came down, beside what plain campaigns of the same motors counted."""
    s = campaign["summary"]
    figure, axes = plots.grid(1, 1, 2.8)
    axis, curve = axes[0, 0], s["curve"]
    at, mean = np.array(curve["margin"]), np.array(curve["probability"])
    axis.fill_between(at, np.maximum(curve["least"], 1e-12), curve["most"], color="0.88", lw=0)
    plots.line(axis, at[mean > 0], mean[mean > 0], 0, "subset simulation")
    for style, one in enumerate(plain, 1):
        plots.line(
            axis,
            *counted(one["summary"], s["margin"]),
            style,
            one["name"],
            marker="o",
            ms=2.5,
            lw=0.6,
        )
    axis.axvline(s["limit"], color="k", lw=0.9, ls=":")
    axis.set_yscale("log")
    axis.set_ylim(0.5 * mean[mean > 0].min(), 1.5)
    axis.set_xlabel({"least": "margin"}.get(s["margin"], f"{s['margin']} margin"))
    axis.set_ylabel("probability of less")
    title = f"{campaign['name']}: how probable a margin is, level by level"
    out: List[Any] = [
        Figure(
            ident,
            title,
            plots.finish(figure, axes, ident, title),
            f"{len(s['runs'])} runs, {s['cases']:,} cases. Grey: from the least to the most of the "
            f"runs; points: cases that were counted.",
        )
    ]
    table = Table(
        f"{ident}-levels",
        f"{campaign['name']}: levels, means of the runs",
        (
            "",
            "runs",
            "margin below",
            "share",
            "gamma",
            "coefficient of variation",
            "candidates taken",
        ),
    )
    for k in range(max(len(run["levels"]) for run in s["runs"])):
        there = [run["levels"][k] for run in s["runs"] if k < len(run["levels"])]
        mean_of = [
            float(np.mean([math.inf if one[key] is None else one[key] for one in there]))
            for key in ("threshold", "share", "gamma", "coefficient_of_variation")
        ]
        table.add(
            f"level {k}",
            len(there),
            *mean_of,
            "drawn freely" if k == 0 else percent(float(np.mean([one["taken"] for one in there]))),
        )
    return [*out, table]


def worst(campaign: Dict[str, Any], ident: str) -> Table:
    """And what was odd about them."""
    names = [one["name"] for one in campaign["variables"]]
    out = Table(
        ident, f"{campaign['name']}: worst cases", ("", "margin", "ended", *names, "odd about it")
    )
    for one in campaign["summary"]["worst"]:
        ended = one["fault"] if one["fault"] != "none" else "failed" if one["failed"] else "good"
        out.add(
            f"case {one['case']}, seed {one['seed']}",
            one["margin"],
            ended,
            *(one["values"][name] for name in names),
            odd(one["places"]),
        )
    return out


def section(campaigns: List[Dict[str, Any]]) -> Section:
    """Text, tables and pictures."""
    plain = [one for one in campaigns if one["method"] != "subset"]
    out = Section(
        "campaigns",
        "Campaigns: how probable a failure is",
        Markup(TEXT),
        [probabilities(campaigns)],
    )
    for number, one in enumerate(plain, 1):
        out.parts += [histogram(one, f"C-margin{number}"), worst(one, f"C-worst{number}")]
    for number, one in enumerate((one for one in campaigns if one["method"] == "subset"), 1):
        same = [other for other in plain if other["variables"] == one["variables"]]
        out.parts += [*levels(one, same, f"C-subset{number}"), worst(one, f"C-rare{number}")]
    return out
