# SPDX-License-Identifier: MIT
"""Arithmetic that is sure: numbers as middle and radius, with their derivatives by several
variables, many cells at once.

A `Dual` holds, for every cell, a value and its derivatives: arrays (cells, 1 + variables, ..). The
true value over the whole cell lies within `radius` of `middle`, every rounding error included.
"""

from __future__ import annotations

from typing import Any, Callable

import numpy as np

UNIT = 2.0**-52  # twice the rounding unit of double precision
SLACK = 1.0 + 1e-10  # for the roundings in the radii themselves
TINY = 1e-300


class Dual:
    """Value and derivatives of a quantity, scalars or matrices."""

    __array_ufunc__ = None  # array @ Dual is ours

    def __init__(self, middle: np.ndarray, radius: np.ndarray) -> None:
        self.m, self.r = middle, radius

    @staticmethod
    def constant(value: Any, like: "Dual") -> "Dual":
        """The same in every cell."""
        value = np.asarray(value, dtype=float)
        m = np.zeros((*like.m.shape[:2], *value.shape))
        m[:, 0] = value
        return Dual(m, np.zeros_like(m))

    def __add__(self, other: Any) -> "Dual":
        other = other if isinstance(other, Dual) else Dual.constant(other, self)
        m = self.m + other.m
        return Dual(m, (self.r + other.r + UNIT * np.abs(m)) * SLACK)

    __radd__ = __add__

    def __neg__(self) -> "Dual":
        return Dual(-self.m, self.r)

    def __sub__(self, other: Any) -> "Dual":
        return self + (-other if isinstance(other, Dual) else -np.asarray(other, dtype=float))

    def __rsub__(self, other: Any) -> "Dual":
        return -self + other

    def __mul__(self, other: Any) -> "Dual":
        if not isinstance(other, Dual):  # a plain number
            return Dual(
                self.m * other, (self.r * abs(other) + UNIT * np.abs(self.m * other)) * SLACK
            )
        return _product(self, other, np.multiply, 1)

    __rmul__ = __mul__

    def __matmul__(self, other: Any) -> "Dual":
        other = other if isinstance(other, Dual) else Dual.constant(other, self)
        return _product(self, other, np.matmul, self.m.shape[-1])

    def __rmatmul__(self, other: Any) -> "Dual":
        return Dual.constant(other, self) @ self

    def reciprocal(self) -> "Dual":
        """Reciprocal of scalars whose cells do not contain zero."""
        m, r = self.m[:, 0], self.r[:, 0]
        assert (np.abs(m) > r).all()
        value = Dual(np.zeros_like(self.m), np.zeros_like(self.r))
        value.m[:, 0] = 1.0 / m
        value.r[:, 0] = (r / (np.abs(m) * (np.abs(m) - r)) + UNIT / np.abs(m)) * SLACK
        square = value * value  # of the values: the derivatives are still zero
        slope = Dual(-self.m.copy(), self.r.copy())
        slope.m[:, 0], slope.r[:, 0] = 0.0, 0.0
        flat = Dual(
            np.repeat(square.m[:, :1], self.m.shape[1], 1),
            np.repeat(square.r[:, :1], self.m.shape[1], 1),
        )
        m2 = slope.m * flat.m
        r2 = (
            np.abs(slope.m) * flat.r
            + slope.r * np.abs(flat.m)
            + slope.r * flat.r
            + UNIT * np.abs(m2)
        ) * SLACK
        m2[:, 0], r2[:, 0] = value.m[:, 0], value.r[:, 0]
        return Dual(m2, r2)


def _product(a: Dual, b: Dual, times: Callable, n: int) -> Dual:
    """Product rule; `times` is elementwise or of matrices with n terms in a sum."""

    def one(am: np.ndarray, ar: np.ndarray, bm: np.ndarray, br: np.ndarray) -> tuple:
        size = times(np.abs(am), np.abs(bm))
        return times(am, bm), times(np.abs(am), br) + times(ar, np.abs(bm)) + times(ar, br) + (
            n + 2
        ) * UNIT * size

    m1, r1 = one(a.m, a.r, b.m[:, :1], b.r[:, :1])
    m2, r2 = one(a.m[:, :1], a.r[:, :1], b.m, b.r)
    m, r = m1 + m2, (r1 + r2 + UNIT * (np.abs(m1) + np.abs(m2))) * SLACK + TINY
    m[:, 0], r[:, 0] = m1[:, 0], r1[:, 0] * SLACK + TINY
    return Dual(m, r)


def variables(centre: np.ndarray, radius: np.ndarray) -> list:
    """One scalar for each column: (cells, variables) in, its own derivative one."""
    out = []
    for k in range(centre.shape[1]):
        m = np.zeros((len(centre), 1 + centre.shape[1]))
        r = np.zeros_like(m)
        m[:, 0], r[:, 0], m[:, 1 + k] = centre[:, k], radius[:, k], 1.0
        out.append(Dual(m, r))
    return out


def matrix(rows: list) -> Dual:
    """Matrix of scalars and plain numbers."""
    like = next(x for row in rows for x in row if isinstance(x, Dual))
    cells = [
        [x if isinstance(x, Dual) else Dual.constant(float(x), like) for x in row] for row in rows
    ]
    stack = lambda part: np.stack([np.stack([part(x) for x in row], -1) for row in cells], -2)  # noqa: E731
    return Dual(stack(lambda x: x.m), stack(lambda x: x.r))


def exponential(X: Dual, terms: int = 16) -> Dual:
    """e^X by its series; the rest of it, and of its derivatives, by norms."""
    n = X.m.shape[-1]
    total = Dual.constant(np.eye(n), X) + X
    power = X
    for k in range(2, terms + 1):
        power = (power @ X) * (1.0 / k)
        total = total + power
    size = (np.abs(X.m) + X.r).sum(-1).max(-1)  # (cells, 1 + variables), infinity norms
    norm = size[:, 0]
    factorial = float(np.prod(np.arange(1.0, terms + 1)))
    rest = (
        np.exp(norm) * norm**terms / factorial
    )  # of e^X below this times the norm, of the derivatives times theirs
    total.r += (
        SLACK
        * 1.01
        * (rest[:, None] * np.maximum(size, norm[:, None] * (np.arange(size.shape[1]) == 0)))[
            ..., None, None
        ]
    )
    return total
