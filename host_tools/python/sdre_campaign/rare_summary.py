# SPDX-License-Identifier: MIT
"""Results of subset simulation: the probability of a margin below the limit, its interval, and the
rarest cases."""

from __future__ import annotations

import heapq
import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Dict, List, Sequence, Tuple

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from sdre import _native
from sdre_campaign.parts import Directory
from sdre_campaign.rare import Run
from sdre_campaign.spec import Spec
from sdre_campaign.subset import (
    STEPS,
    Estimate,
    FloatArray,
    Level,
    below,
    combined,
    correlation,
    estimate,
)
from sdre_campaign.summary import Worst, clopper_pearson, ranked_worst

POINTS = 61  # of the curve


@dataclass
class RareSummary:
    """Summary of all runs."""

    spec: Spec
    runs: List[Run]
    found: Estimate  # of a margin below the limit, or below the floor's threshold
    is_found: bool
    failed: Estimate
    failed_cases: int
    samples_below: int  # of the last levels
    cases: int  # simulated
    faults: Dict[str, int]
    at: FloatArray  # margins of the curve
    curves: FloatArray  # probability of a margin at or below them, a row for each run
    common: Dict[
        str, List[float]
    ]  # of the samples below the limit: 5 %, median, 95 % of every variable
    worst: List[Worst]

    def as_dict(self) -> Dict[str, Any]:
        """For summary.json."""
        return {
            "method": "subset",
            "margin": self.spec.margin,
            "cases": self.cases,
            "limit": self.spec.limit,
            "floor": self.spec.floor,
            "reached": self.is_found,
            "below_limit": self.found.as_dict()
            if self.is_found
            else {"less_than": self.found.interval[1]},
            "failed": {
                **self.failed.as_dict(),
                "cases": self.failed_cases,
                "of_samples_below": self.samples_below,
            },
            "faults": self.faults,
            "first_level_samples": self.spec.cases * len(self.runs),
            "without_warning_less_than": clopper_pearson(0, self.spec.cases * len(self.runs))[1],
            "runs": [
                {**estimate(run.levels).as_dict(), "end": run.end, "levels": _levels(run)}
                for run in self.runs
            ],
            "curve": {
                "margin": self.at.tolist(),
                "probability": self.curves.mean(axis=0).tolist(),
                "least": self.curves.min(axis=0).tolist(),
                "most": self.curves.max(axis=0).tolist(),
            },
            "common": self.common,
            "worst": [one.__dict__ for one in self.worst],
        }

    @property
    def failures(self) -> int:
        """Cases that failed, of the samples below the limit."""
        return self.failed_cases

    def text(self, spec: Spec, path: Path) -> str:
        """For the terminal."""
        lines = [
            f"{spec.name} on {spec.drive().name}: {len(self.runs)} runs of subset simulation, "
            f"{self.cases} cases"
        ]
        name = "margin" if spec.margin == "least" else f"{spec.margin} margin"
        low, high = self.found.interval
        if self.is_found:
            lines.append(
                f"{name} below {spec.limit:g}: probability {self.found.probability:.3g}, 95 % "
                f"interval {low:.3g} .. {high:.3g}, "
                f"coefficient of variation {self.found.variation:.2f}"
            )
        else:
            lines.append(
                f"{name} below {spec.limit:g}: probability below {high:.3g}; "
                f"{_why(self.runs, spec)}"
            )
        if self.is_found:
            low, high = self.failed.interval
            among = f"{self.failed_cases} of {self.samples_below} samples below it failed"
            lines.append(
                f"failed: probability {self.failed.probability:.3g}, 95 % interval {low:.3g} .. "
                f"{high:.3g} ({among})"
                if self.failed_cases
                else f"failed: probability below {high:.3g} ({among})"
            )
        lines += [f"{count} x {fault}" for fault, count in self.faults.items()]
        lines += [
            f"{name}: {low:.3g} .. {high:.3g} (5 .. 95 %), median {median:.3g} below it"
            for name, (low, median, high) in self.common.items()
        ]
        lines.append(
            "assumed: small margins lead to what is rare. What comes without one is met by chance "
            "alone: probability below "
            f"{clopper_pearson(0, spec.cases * len(self.runs))[1]:.2g} if the first levels met none"
        )
        return "\n".join([*lines, f"written: {path}/summary.json, parts/, worst/, levels.png"])


def _why(runs: Sequence[Run], spec: Spec) -> str:
    if any(run.end == "stuck" for run in runs):
        return (
            "no slope leads further down: candidates are hardly taken, the margin is the noise's "
            "alone or the same everywhere"
        )
    return f"less than {spec.floor:g} was not looked for"


def _levels(run: Run) -> List[Dict[str, float]]:
    taken = [math.nan, *run.taken]
    return [
        {
            "threshold": one.threshold,
            "share": one.share,
            "gamma": one.gamma,
            "coefficient_of_variation": one.variation,
            **({} if k == 0 else {"taken": taken[k]}),
        }
        for k, one in enumerate(run.levels)
    ]


def summarise_runs(spec: Spec, runs: List[Run], directory: Directory) -> RareSummary:
    """Reads the parts once more, a level of a run at a time."""
    worst: List[Tuple[Any, Worst]] = []
    faults: Dict[int, int] = {}
    lasts: List[pa.Table] = []
    cases = 0
    for run in runs:
        for level in range(len(run.levels)):
            table = run.table(directory, level)
            new = table.filter(table["new"])  # a sample that stays where it is counts once
            cases += spec.cases if level == 0 else spec.cases - spec.cases // STEPS
            for fault, count in zip(*np.unique(new["fault"].to_numpy(), return_counts=True)):
                if fault != 0:
                    faults[int(fault)] = faults.get(int(fault), 0) + int(count)
            worst = heapq.nsmallest(
                spec.worst, worst + ranked_worst(new, spec), key=lambda one: one[0]
            )
        lasts.append(table)
    reached = all(run.end == "limit" for run in runs)
    inside = [table["margin"].to_numpy() < spec.limit for table in lasts]
    failed = [table["failed"].to_numpy() & one for table, one in zip(lasts, inside)]
    found = combined([estimate(run.levels) for run in runs])
    at = np.linspace(
        min(float(run.margins[-1].min()) for run in runs),
        max(float(run.margins[0].max()) for run in runs),
        POINTS,
    )
    curves = np.array([below(run.levels, run.margins, at) for run in runs])
    named = {_native.fault_name(number): count for number, count in sorted(faults.items())}
    return RareSummary(
        spec,
        runs,
        found,
        reached,
        _failed(runs, inside, failed, found),
        int(sum(one.sum() for one in failed)),
        int(sum(one.sum() for one in inside)),
        cases,
        named,
        at,
        curves,
        _common(spec, lasts, inside),
        [one for _, one in worst],
    )


def _failed(
    runs: List[Run],
    inside: List[NDArray[np.bool_]],
    failed: List[NDArray[np.bool_]],
    found: Estimate,
) -> Estimate:
    """Probability of failing, from the share of the last levels' samples that failed.

    None at all: at most the probability's upper end times the share that so many samples leave, as
    many as are independent.
    """
    seen = [estimate([*run.levels[:-1], _level_of(run, one)]) for run, one in zip(runs, failed)]
    if any(one.probability > 0.0 for one in seen):
        return combined(seen)
    free = sum(int(one.sum() / (1.0 + run.levels[-1].gamma)) for run, one in zip(runs, inside))
    return Estimate(
        0.0,
        math.inf,
        (0.0, found.interval[1] * (clopper_pearson(0, free)[1] if free else 1.0)),
        math.inf,
    )


def _level_of(run: Run, failed: NDArray[np.bool_]) -> Level:
    gamma = correlation(failed) if len(run.levels) > 1 else 0.0
    return replace(run.levels[-1], share=float(failed.mean()), gamma=gamma)


def _common(
    spec: Spec, lasts: List[pa.Table], inside: List[NDArray[np.bool_]]
) -> Dict[str, List[float]]:
    """The range that the samples below the limit have of every variable."""
    if not any(one.any() for one in inside):
        return {}
    out = {}
    for one in spec.varied:
        name = one.variable.name
        values = np.concatenate(
            [table[f"value.{name}"].to_numpy()[rows] for table, rows in zip(lasts, inside)]
        )
        out[name] = [float(x) for x in np.quantile(values, (0.05, 0.5, 0.95))]
    return out
