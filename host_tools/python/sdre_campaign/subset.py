# SPDX-License-Identifier: MIT
"""Subset simulation (Au and Beck, 2001): a small probability as a product of larger ones.

The first level's samples are drawn freely. The tenth with the least margin starts Markov chains
that stay below the level's threshold, and so on. It ends when a tenth of a level's samples is below
the limit. This module uses margins alone: no simulation, no cluster.

Assumptions:

- The margin is a function of the sample alone.
- The rare samples are reached over small margins. A failure without a small margin is found by
chance only.
- A level's chains are independent of each other. This holds nearly:
tests/python/test_campaign_rare.py measures the interval.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Dict, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

STEPS = 10  # of a chain, its head counted: a level's share p0 is one in so many
_SHOWING = 5  # runs whose spread says something
_NORMAL_975 = 1.959964  # the standard normal's quantile: an interval of 95 %


@dataclass(frozen=True)
class Level:
    """Result of one level. The last threshold is the campaign's limit."""

    threshold: float
    share: float  # of its samples below the threshold
    gamma: float  # what the chains' correlation adds to the variance; 0: none
    samples: int
    is_last: bool

    @property
    def variation(self) -> float:
        """Coefficient of variation of the share (Au and Beck, equations 28 and 29)."""
        if self.share == 0.0:
            return math.inf
        return math.sqrt((1.0 - self.share) / (self.share * self.samples) * (1.0 + self.gamma))


def judge(margin: FloatArray, limit: float, chains: bool) -> Level:
    """A level from its margins, chain after chain."""
    heads = len(margin) // STEPS
    below = margin < limit
    if below.sum() >= heads:
        return Level(
            limit, float(below.mean()), correlation(below) if chains else 0.0, len(margin), True
        )
    ranked = np.sort(margin)
    threshold = float(0.5 * (ranked[heads - 1] + ranked[heads]))
    inside = margin <= threshold
    return Level(
        threshold, float(inside.mean()), correlation(inside) if chains else 0.0, len(margin), False
    )


def heads_of(margin: FloatArray) -> NDArray[np.int64]:
    """Samples that the next level's chains begin with: the least margins, by their place among
    equals."""
    return np.lexsort((np.arange(len(margin)), margin))[: len(margin) // STEPS]


def correlation(inside: BoolArray) -> float:
    """gamma of a level's chains (equations 25 to 27): twice the weighted sum of the indicator's
    correlation along them."""
    chains = inside.reshape(-1, STEPS).astype(np.float64)
    share = float(chains.mean())
    variance = share * (1.0 - share)
    if variance == 0.0:
        return 0.0
    lags = (
        (1.0 - k / STEPS) * (float((chains[:, k:] * chains[:, :-k]).mean()) - share**2)
        for k in range(1, STEPS)
    )
    return max(0.0, 2.0 * sum(lags) / variance)


@dataclass(frozen=True)
class Estimate:
    """A probability, and how sure it is."""

    probability: float
    variation: float  # coefficient of variation by the formula, as if levels were independent
    interval: Tuple[float, float]  # 95 %
    wide: float  # the coefficient of variation behind the interval

    def as_dict(self) -> Dict[str, Any]:
        """For summary.json."""
        return {
            "probability": self.probability,
            "coefficient_of_variation": self.variation,
            "interval_95": list(self.interval),
            "interval_variation": self.wide,
        }


def estimate(levels: Sequence[Level]) -> Estimate:
    """Estimate of one run: the product of its levels' shares.

    A level's heads are samples of the one before: the interval takes neighbours for wholly
    dependent. With independent levels it would be too narrow: it then holds the truth 83 to 90
    times of 100.
    """
    probability = math.prod(level.share for level in levels)
    if probability == 0.0:
        return Estimate(0.0, math.inf, (0.0, 1.0), math.inf)
    each = [level.variation for level in levels]
    square = sum(one**2 for one in each)
    wide = math.sqrt(square + 2.0 * sum(a * b for a, b in zip(each, each[1:])))
    return Estimate(probability, math.sqrt(square), _interval(probability, wide, _NORMAL_975), wide)


def combined(runs: Sequence[Estimate]) -> Estimate:
    """Estimate of independent runs: their mean. The interval is the wider one of the formula's and
    of the runs' spread (Student, from 5 runs on)."""
    from scipy.special import stdtrit

    count = len(runs)
    found = np.array([run.probability for run in runs])
    mean = float(found.mean())
    if count == 1 or mean == 0.0:
        return runs[0]
    seen = [run for run in runs if run.probability > 0.0]
    formula, wide = (
        math.sqrt(sum((run.probability * getattr(run, name)) ** 2 for run in seen)) / count / mean
        for name in ("variation", "wide")
    )
    shown = float(found.std(ddof=1)) / math.sqrt(count) / mean
    both = [(wide, _interval(mean, wide, _NORMAL_975))]
    if count >= _SHOWING:
        both.append((shown, _interval(mean, shown, float(stdtrit(count - 1, 0.975)))))
    behind, interval = max(both, key=lambda one: one[1][1])
    return Estimate(mean, formula, interval, behind)


def _interval(probability: float, variation: float, quantile: float) -> Tuple[float, float]:
    """Interval of an estimate whose logarithm is normally distributed: a product of estimates is
    never below zero."""
    factor = math.exp(quantile * math.sqrt(math.log1p(variation**2)))
    return probability / factor, min(1.0, probability * factor)


def next_spread(spread: float, accepted: float) -> float:
    """Spread of the next level's candidates: larger when most were accepted. 0.44: Papaioannou,
    Betz, Zwirglmaier and Straub, 2015."""
    return min(1.0, max(0.05, spread * math.exp(2.0 * (accepted - 0.44))))


def below(levels: Sequence[Level], margins: Sequence[FloatArray], at: FloatArray) -> FloatArray:
    """Probability of a margin at or below each value of `at`, by the deepest level that begins
    above it."""
    found = np.ones(len(at))
    reached = 1.0
    top: Optional[float] = None
    for level, margin in zip(levels, margins):
        here = at <= top if top is not None else np.full(len(at), True)
        found[here] = (
            reached * np.searchsorted(np.sort(margin), at[here], side="right") / len(margin)
        )
        reached *= level.share
        top = level.threshold
    return found
