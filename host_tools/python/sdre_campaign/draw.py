# SPDX-License-Identifier: MIT
"""The values of a case: a function of the campaign's seed and the case's number alone.

Random numbers are counter-based (Philox 4x64). Number `case` has its own blocks of the sequence.
Any worker can draw any batch without the previous ones.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

import sdre
from sdre.cases import draw_motors
from sdre_campaign.spec import Spec, Varied, points_of

FloatArray = NDArray[np.float64]

_PER_BLOCK = 4  # numbers that one count of Philox gives


def seeds_of(spec: Spec, first: int, count: int) -> NDArray[np.uint64]:
    """Noise seeds of the cases first .. first + count - 1."""
    if spec.fixed_seed is not None:
        return np.full(count, spec.fixed_seed, dtype=np.uint64)
    return np.arange(first + 1, first + count + 1, dtype=np.uint64)


def values_of(spec: Spec, first: int, count: int) -> FloatArray:
    """One row for each case, one column for each variable."""
    if spec.method == "motors":
        return draw_motors(sdre.Scenario(spec.scenario, spec.drive()), first, count, spec.seed)
    if spec.method == "random":
        shares = even_numbers(spec.seed, first, count, len(spec.varied))
        columns = [_drawn(one, shares[:, k]) for k, one in enumerate(spec.varied)]
    else:
        columns = _grid(spec, np.arange(first, first + count) // spec.repeats)
    return _side_by_side(spec, columns, count)


def shared(spec: Spec, normal: FloatArray) -> FloatArray:
    """Values of independent standard normals, a column for each variable: their distribution
    function, then the variable's inverse."""
    from scipy.special import ndtr

    return _side_by_side(
        spec, [_drawn(one, ndtr(normal[:, k])) for k, one in enumerate(spec.varied)], len(normal)
    )


def place_of(one: Varied, value: float) -> float:
    """Share of a variable's distribution that lies below a value."""
    from scipy.special import ndtr

    if one.distribution == "values":
        return sum(v < value for v in one.values) / len(one.values)
    if one.high == one.low:
        return 0.5
    if one.distribution == "log_uniform":
        return math.log(value / one.low) / math.log(one.high / one.low)
    if one.distribution == "normal":
        lo, hi, at = (
            float(ndtr((v - one.mean) / one.deviation)) for v in (one.low, one.high, value)
        )
        return (at - lo) / (hi - lo)
    return (value - one.low) / (one.high - one.low)


def _side_by_side(spec: Spec, columns: list[FloatArray], count: int) -> FloatArray:
    values = np.empty((count, len(spec.varied)))
    for k, (one, column) in enumerate(zip(spec.varied, columns)):
        values[:, k] = np.rint(column) if one.variable.whole else column
    return values


def even_numbers(seed: int, first: int, count: int, width: int, stream: int = 0) -> FloatArray:
    """count x width numbers in 0 .. 1, 1 excluded; row i of case first + i. Streams have nothing in
    common."""
    blocks = max(1, math.ceil(width / _PER_BLOCK))
    generator = np.random.Philox(key=seed + (stream << 64), counter=first * blocks)
    raw = generator.random_raw(count * blocks * _PER_BLOCK).reshape(count, blocks * _PER_BLOCK)
    return (raw[:, :width] >> np.uint64(11)).astype(np.float64) * 2.0**-53


def _drawn(one: Varied, share: FloatArray) -> FloatArray:
    if one.distribution == "values":
        return np.array(one.values)[(share * len(one.values)).astype(np.int64)]
    if one.distribution == "log_uniform":
        return np.exp(math.log(one.low) + share * (math.log(one.high) - math.log(one.low))).clip(
            one.low, one.high
        )
    if one.distribution == "normal":
        from scipy.special import ndtr, ndtri

        lo, hi = (
            ndtr((one.low - one.mean) / one.deviation),
            ndtr((one.high - one.mean) / one.deviation),
        )
        return np.clip(one.mean + one.deviation * ndtri(lo + share * (hi - lo)), one.low, one.high)
    return one.low + share * (one.high - one.low)


def _grid(spec: Spec, point: NDArray[np.int64]) -> list[FloatArray]:
    """The last variable changes first."""
    columns = []
    for one in reversed(spec.varied):
        points = points_of(one, spec.method)
        at = point % points
        point = point // points
        columns.append(_at_points(one, at, points))
    return columns[::-1]


def _at_points(one: Varied, at: NDArray[np.int64], points: int) -> FloatArray:
    if one.distribution == "values":
        return np.array(one.values)[at]
    share = at / max(points - 1, 1)
    if one.distribution == "log_uniform":
        return np.where(share == 1.0, one.high, one.low * (one.high / one.low) ** share)
    return np.where(share == 1.0, one.high, one.low + share * (one.high - one.low))
