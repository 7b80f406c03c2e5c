# SPDX-License-Identifier: MIT
"""Summary of a campaign's parts. It depends on the parts alone, not on their writer or order.

One part is in memory at a time, and counts: memory does not grow with the number of cases.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Dict, Iterable, List, Tuple

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from sdre import _native
from sdre_campaign.draw import place_of
from sdre_campaign.spec import Spec

BINS = 40  # of a variable's range
HISTOGRAM_EDGES = np.round(np.linspace(-1.0, 1.0, 101), 2)  # the first has all that is below too
_MARGIN_EDGES = np.linspace(-1.0, 1.0, 401)  # 0.005 each; what is below is counted in the first


def clopper_pearson(failures: int, cases: int, confidence: float = 0.95) -> Tuple[float, float]:
    """Interval of a probability from failures in independent cases: never too narrow (Clopper and
    Pearson, 1934)."""
    from scipy.special import betaincinv

    rest = 0.5 * (1.0 - confidence)
    low = 0.0 if failures == 0 else float(betaincinv(failures, cases - failures + 1, rest))
    high = (
        1.0 if failures == cases else float(betaincinv(failures + 1, cases - failures, 1.0 - rest))
    )
    return low, high


@dataclass
class Sensitivity:
    """How the margin goes with one variable."""

    name: str
    edges: NDArray[np.float64]
    counts: NDArray[np.int64] = field(init=False)  # bins of the variable x bins of the margin
    failures: NDArray[np.int64] = field(init=False)
    sums: NDArray[np.float64] = field(init=False)
    least: NDArray[np.float64] = field(init=False)

    def __post_init__(self) -> None:
        self.counts = np.zeros((BINS, len(_MARGIN_EDGES) - 1), dtype=np.int64)
        self.failures = np.zeros(BINS, dtype=np.int64)
        self.sums = np.zeros(BINS)
        self.least = np.full(BINS, np.inf)

    def add(
        self, values: NDArray[np.float64], margin: NDArray[np.float64], failed: NDArray[np.bool_]
    ) -> None:
        """Cases of one part."""
        at = np.clip(np.searchsorted(self.edges, values, side="right") - 1, 0, BINS - 1)
        high = np.clip(
            np.searchsorted(_MARGIN_EDGES, margin, side="right") - 1, 0, len(_MARGIN_EDGES) - 2
        )
        np.add.at(self.counts, (at, high), 1)
        np.add.at(self.failures, at, failed)
        np.add.at(self.sums, at, margin)
        np.minimum.at(self.least, at, margin)

    def quantile(self, share: float) -> NDArray[np.float64]:
        """Margin that this share of the cases of each bin is below, to 0.005; NaN without cases."""
        below = np.cumsum(self.counts, axis=1)
        total = below[:, -1]
        index = np.argmax(below >= np.ceil(share * total)[:, None], axis=1)
        return np.where(total > 0, _MARGIN_EDGES[index + 1], np.nan)

    def first_order(self, variance: float, mean: float) -> float:
        """Share of the margin's variance that this variable alone explains (Sobol's first-order
        index, by bins).

        Without what chance explains: the means of so many bins differ of themselves.
        """
        n = self.counts.sum(axis=1)
        used = n > 0
        between = float(np.sum(n[used] * (self.sums[used] / n[used] - mean) ** 2) / n.sum())
        free = int(n.sum() - used.sum())
        chance = (used.sum() - 1) * max(variance - between, 0.0) / free if free > 0 else 0.0
        return max(between - float(chance), 0.0) / variance if variance > 0.0 else 0.0


@dataclass
class Worst:
    """One case."""

    case: int
    seed: int
    failed: bool
    margin: float
    fault: str
    values: Dict[str, float]
    places: Dict[str, float]  # of the values: the share of their distributions that is below them
    results: Dict[str, float]


@dataclass
class Summary:
    """Summary of all parts."""

    cases: int
    failures: int
    interval: Tuple[float, float]
    negative: int  # margins below zero, of failed cases or not
    faults: Dict[str, int]
    margin_mean: float
    margin_deviation: float
    margin_least: float
    # Counts in the bins of HISTOGRAM_EDGES: the margin and its two parts.
    histograms: Dict[str, NDArray[np.int64]]
    sensitivities: List[Sensitivity]
    worst: List[Worst]

    def as_dict(self) -> Dict[str, Any]:
        """For summary.json."""
        return {
            "cases": self.cases,
            "failures": self.failures,
            "failure_probability": self.failures / self.cases,
            "interval_95": list(self.interval),
            "negative_margins": self.negative,
            "negative_margin_interval_95": list(clopper_pearson(self.negative, self.cases)),
            "faults": self.faults,
            "margin": {
                "mean": self.margin_mean,
                "deviation": self.margin_deviation,
                "least": self.margin_least,
            },
            "histograms": {
                "edges": HISTOGRAM_EDGES.tolist(),
                **{name: one.tolist() for name, one in self.histograms.items()},
            },
            "first_order": {
                one.name: one.first_order(self.margin_deviation**2, self.margin_mean)
                for one in self.sensitivities
            },
            "worst": [one.__dict__ for one in self.worst],
        }

    def text(self, spec: Spec, path: Path) -> str:
        """For the terminal."""
        low, high = self.interval
        lines = [
            f"{spec.name} on {spec.drive().name}: {self.failures} of {self.cases} cases failed",
            f"failure probability {self.failures / self.cases:.3g}, 95 % interval "
            f"{low:.3g} .. {high:.3g} (Clopper-Pearson)",
            f"margin: mean {self.margin_mean:.3f}, least {self.margin_least:.3f}, below zero in "
            f"{self.negative} cases",
        ]
        lines += [f"{count} x {fault}" for fault, count in self.faults.items()]
        variance = self.margin_deviation**2
        lines += [
            f"{one.name}: explains {100.0 * one.first_order(variance, self.margin_mean):.1f} % of "
            f"the margin's variance"
            for one in self.sensitivities
        ]
        picture = ", sensitivity.png" if self.sensitivities else ""
        return "\n".join([*lines, f"written: {path}/summary.json, parts/, worst/{picture}"])


def summarise(spec: Spec, tables: Iterable[pa.Table]) -> Summary:
    """Reads the parts once. A case's margin is the smaller one of its two."""
    cases = failures = negative = 0
    faults: Dict[int, int] = {}
    total = square = 0.0
    least = np.inf
    histograms: Dict[str, NDArray[np.int64]] = {
        name: np.zeros(len(HISTOGRAM_EDGES) - 1, dtype=np.int64)
        for name in ("least", "speed", "current")
    }
    sensitivities = [
        Sensitivity(one.variable.name, _edges(one.low, one.high)) for one in spec.varied
    ]
    worst: List[Tuple[Tuple[bool, float, int], Worst]] = []
    for table in tables:
        columns = columns_in(table)
        failed = columns["failed"]
        margin = np.minimum(columns["current_margin"], columns["speed_margin"])
        cases += len(margin)
        failures += int(failed.sum())
        negative += int((margin < 0.0).sum())
        total += float(margin.sum())
        square += float((margin**2).sum())
        least = min(least, float(margin.min()))
        for name, one in (
            ("least", margin),
            ("speed", columns["speed_margin"]),
            ("current", columns["current_margin"]),
        ):
            histograms[name] += np.histogram(one.clip(-1.0, 1.0), HISTOGRAM_EDGES)[0]
        for fault, count in zip(*np.unique(columns["fault"], return_counts=True)):
            if fault != 0:
                faults[int(fault)] = faults.get(int(fault), 0) + int(count)
        for one in sensitivities:
            one.add(columns[f"value.{one.name}"], margin, failed)
        worst += ranked_worst(table, spec)
        worst = heapq.nsmallest(spec.worst, worst, key=lambda one: one[0])
    mean = total / cases
    return Summary(
        cases,
        failures,
        clopper_pearson(failures, cases),
        negative,
        {_native.fault_name(number): count for number, count in sorted(faults.items())},
        mean,
        max(square / cases - mean * mean, 0.0) ** 0.5,
        least,
        histograms,
        sensitivities,
        [one for _, one in worst],
    )


def _edges(low: float, high: float) -> NDArray[np.float64]:
    return np.linspace(low, high if high > low else low + 1.0, BINS + 1)


def columns_in(table: pa.Table) -> Dict[str, Any]:
    """As arrays."""
    return {name: table[name].to_numpy() for name in table.column_names}


def ranked_worst(table: pa.Table, spec: Spec) -> List[Tuple[Tuple[bool, float, int], Worst]]:
    """The worst cases of a table with what ranks them: failed cases first, then the least margin,
    then the number."""
    columns = columns_in(table)
    margin = columns.get("margin", np.minimum(columns["current_margin"], columns["speed_margin"]))
    lowest = np.lexsort((np.arange(len(margin)), margin, ~columns["failed"]))[: spec.worst]
    return [_ranked(spec, columns, int(row), float(margin[row])) for row in lowest]


def _ranked(
    spec: Spec, columns: Dict[str, Any], row: int, margin: float
) -> Tuple[Tuple[bool, float, int], Worst]:
    case, failed = int(columns["case"][row]), bool(columns["failed"][row])
    values = {
        one.variable.name: float(columns[f"value.{one.variable.name}"][row]) for one in spec.varied
    }
    places = {one.variable.name: place_of(one, values[one.variable.name]) for one in spec.varied}
    results = {
        name: float(array[row])
        for name, array in columns.items()
        if "." in name and not name.startswith(("value.", "normal."))
    }
    fault = _native.fault_name(int(columns["fault"][row]))
    return (not failed, margin, case), Worst(
        case, int(columns["seed"][row]), failed, margin, fault, values, places, results
    )
