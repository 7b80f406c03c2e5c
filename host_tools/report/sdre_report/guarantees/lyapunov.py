# SPDX-License-Identifier: MIT
"""One quadratic Lyapunov function for the sampled loop over the box of motors, all speeds and all
currents. Solver cvxpy finds it on corners; ball arithmetic proves it everywhere. The motor may
change at any rate within the box."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Any, Dict, Tuple

import cvxpy
import numpy as np
from scipy.linalg import cholesky, solve_discrete_lyapunov

from ..tools import ReportError
from .balls import Dual, exponential, matrix, variables
from .loop import AGREES, Loops, box

# Sizes of [w iq id theta | d_w d_q d_d w iq id theta]: powers of two, so that scaling is exact.
SIZES = 2.0 ** np.array([8, 2, 2, -9, 14, 10, 10, 8, 2, 2, -9])
VARIABLES = 7  # R, L, flux, J, speed, iq, id
SEARCHED = 8  # every eighth box of speeds has corners in the search
BATCH = 256  # cells at once
LARGEST_CELLS = 60000  # of the search; beyond it the box is given up
ROUNDING = 1e-11  # of a spectral norm of 10 x 10 numbers near one in double precision, generously


class Loop:
    """The loop as a function of its seven variables, in scaled states; from the gains that the tool
    wrote."""

    def __init__(self, loops: Loops, design: Dict[str, Any]) -> None:
        self.loops, self.l = loops, {int(k[1:]): v for k, v in design["reduced_parameters"].items()}
        self.Lambda = np.array(design["nosc"]["lambda"][0])
        self.gains = [loops.ts * np.array(g) for g in design["nodo"]["gain"]]
        tool = loops.points
        centre = np.array([[1.0, 1.0, 1.0, 1.0, p.speed, p.iq, p.id] for p in tool])
        found = self.at(centre, np.zeros_like(centre)).m[:, 0]
        wanted = np.array([(p.believed * SIZES[:10]) / SIZES[:10, None] for p in tool])
        if np.abs(found - wanted).max() > AGREES * np.abs(wanted).max():
            raise ReportError("the loop of the Lyapunov function is not that of sdre-gains")

    def at(self, centre: np.ndarray, radius: np.ndarray) -> Dual:
        """EQ-CERT-3 over cells."""
        R, L, flux, J, w, iq, id_ = variables(centre, radius)
        E = self._motor(R, L, flux, J, w, iq, id_)
        P, G = self._observer(w, iq, id_)
        F, gain = self._law(w, iq, id_), self._gain(iq)
        PL = P @ gain
        x_and_v = (
            np.eye(6)[:, 4:] @ F @ np.eye(7, 11, 4) + np.eye(6, 11) * (np.arange(6) < 4)[:, None]
        )
        motor = np.eye(11, 4) @ (np.eye(4, 6) @ E @ x_and_v)
        C = np.eye(7)[4:]
        controller = PL @ (np.eye(3, 4, 1) @ np.eye(4, 11)) + (P - PL @ C + G @ F) @ np.eye(
            7, 11, 4
        )
        whole = motor + np.eye(11)[:, 4:] @ controller
        keep = np.eye(11)[:10].copy()
        keep[3, 10] = -1.0  # theta - theta^
        back = np.eye(11)[:, :10]
        scaled = keep @ whole @ back
        return Dual(
            scaled.m * SIZES[:10] / SIZES[:10, None], scaled.r * SIZES[:10] / SIZES[:10, None]
        )

    def _motor(self, R: Dual, L: Dual, flux: Dual, J: Dual, w: Dual, iq: Dual, id_: Dual) -> Dual:
        m, n_p, h = self.loops.motor, self.loops.motor["pole_pairs"], self.loops.ts
        Rs, psi, Ld, Lq = (
            m[k]
            for k in (
                "stator_resistance_Ohm",
                "pm_flux_Wb",
                "d_axis_inductance_H",
                "q_axis_inductance_H",
            )
        )
        k = J.reciprocal() * (1.5 * n_p**2 / m["inertia_kgm2"])
        g = L.reciprocal()
        friction = J.reciprocal() * (-m["viscous_friction_Nms"] / m["inertia_kgm2"])
        rows = [
            [friction, k * (flux * psi + L * id_ * (Ld - Lq)), k * L * iq * (Ld - Lq), 0, 0, 0],
            [
                -(g * flux * (psi / Lq) + id_ * (Ld / Lq)),
                -(g * R * (Rs / Lq)),
                -(w * (Ld / Lq)),
                0,
                g * (1 / Lq),
                0,
            ],
            [iq * (Lq / Ld), w * (Lq / Ld), -(g * R * (Rs / Ld)), 0, 0, g * (1 / Ld)],
            [1, 0, 0, 0, 0, 0],
            [0] * 6,
            [0] * 6,
        ]
        size = 2.0 ** np.array([8, 2, 2, -4, 7, 7])  # so that the norm of X is about one
        X = matrix(rows) * h
        X = Dual(X.m * size / size[:, None], X.r * size / size[:, None])
        E = exponential(X)
        return Dual(E.m / size * size[:, None], E.r / size * size[:, None])

    def _observer(self, w: Dual, iq: Dual, id_: Dual) -> Tuple[Dual, Dual]:
        l, h = self.l, self.loops.ts  # noqa: E741
        zero = [0.0] * 7
        jacobian = matrix(
            [
                zero,
                zero,
                zero,
                [1, 0, 0, -l[2], id_ * l[11] + l[1], iq * l[11], 0],
                [0, 1, 0, -l[5] - id_ * l[10], -l[4], -(w * l[10]), 0],
                [0, 0, 1, iq * l[9], w * l[9], -l[7], 0],
                [0, 0, 0, 1, 0, 0, 0],
            ]
        )
        B = np.zeros((7, 2))
        B[4, 0], B[5, 1] = l[6], l[8]
        half = jacobian * (0.5 * h) + np.eye(7)
        return (jacobian @ half) * h + np.eye(7), (half @ B) * h

    def _law(self, w: Dual, iq: Dual, id_: Dual) -> Dual:
        l, K = self.l, self.Lambda  # noqa: E741
        D = (id_ * l[11] + l[1]).reciprocal()
        k_ref = K[0, 1] + l[4] / l[6]
        return matrix(
            [
                [
                    D * -k_ref,
                    -1 / l[6],
                    0,
                    id_ * (l[10] / l[6]) - K[0, 0],
                    -K[0, 1],
                    w * (l[10] / l[6]) - K[0, 2] - iq * D * (k_ref * l[11]),
                    0,
                ],
                [
                    0,
                    0,
                    -1 / l[8],
                    -(iq * (l[9] / l[8])) - K[1, 0],
                    -(w * (l[9] / l[8])) - K[1, 1],
                    -K[1, 2] + w * 0.0,
                    0,
                ],
            ]
        )

    def _gain(self, iq: Dual) -> Dual:
        power, total = None, Dual.constant(self.gains[0], iq)
        for term in self.gains[1:]:
            power = iq if power is None else power * iq
            total = (
                total
                + Dual(
                    power.m[..., None, None] * np.ones((7, 3)),
                    power.r[..., None, None] * np.ones((7, 3)),
                )
                * term
            )
        return total


@dataclass(frozen=True)
class Region:
    """Speeds and currents: boxes of (speed, iq, id) that hold every point the tool judges."""

    low: np.ndarray  # (boxes, 3)
    high: np.ndarray


def region_of(loops: Loops) -> Region:
    """Between each two speeds of the tool's points, the smallest box around both ends."""
    speeds = sorted({p.speed for p in loops.points})
    low, high = [], []
    for a, b in zip(speeds, speeds[1:]):
        inside = np.array([[p.speed, p.iq, p.id] for p in loops.points if a <= p.speed <= b])
        low.append(inside.min(0))
        high.append(inside.max(0))
    return Region(np.array(low), np.array(high))


def corners_of(region: Region, share: float) -> np.ndarray:
    """Motors, currents and some of the speeds at their ends: enough for the search, which proves
    nothing."""
    out = []
    for k in range(0, len(region.low), SEARCHED):
        low, high = region.low[k], region.high[k]
        out += list(product(*box(share), (low[0],), *zip(low[1:], high[1:])))
    out += list(
        product(*box(share), (region.high[-1, 0],), *zip(region.low[-1, 1:], region.high[-1, 1:]))
    )
    return np.unique(np.array(out), axis=0)


def search(loop: Loop, region: Region, share: float) -> Tuple[np.ndarray, float]:
    """Factor R of P = R'R on the corners, and the largest norm there."""
    at = corners_of(region, share)
    A = loop.at(at, np.zeros_like(at)).m[:, 0]
    round_ = np.mean(
        [solve_discrete_lyapunov(M.T, np.eye(10)) for M in A[:: max(1, len(A) // 40)]], axis=0
    )
    R0 = cholesky(round_)
    back = np.linalg.inv(R0)
    P, margin = cvxpy.Variable((10, 10), symmetric=True), cvxpy.Variable()
    rules = [P >> np.eye(10), P << 1e4 * np.eye(10)]
    rules += [N.T @ P @ N - P << -margin * np.eye(10) for N in R0 @ A @ back]
    cvxpy.Problem(cvxpy.Maximize(margin), rules).solve(solver=cvxpy.CLARABEL)
    R = cholesky(0.5 * (P.value + P.value.T)) @ R0
    return R, float(np.linalg.norm(R @ A @ np.linalg.inv(R), 2, axis=(-2, -1)).max())


@dataclass(frozen=True)
class Proof:
    """Proof that V = |R x|^2 falls by `rate`^2 in every period, everywhere."""

    share: float
    rate: float
    cells: int
    R: np.ndarray


def prove(loop: Loop, region: Region, share: float, R: np.ndarray) -> Proof | None:
    """Splits cells until each one's bound is below one; none when it takes too many."""
    back = np.linalg.inv(R)
    apart = (
        float(np.linalg.norm(R @ back - np.eye(10), 2)) + 1e-12
    )  # `back` is not quite the inverse: V is |back^-1 x|^2
    ends = np.array(box(share))
    low = np.hstack([np.tile(ends[:, 0], (len(region.low), 1)), region.low])
    high = np.hstack([np.tile(ends[:, 1], (len(region.high), 1)), region.high])
    signs = np.array(list(product((-1.0, 1.0), repeat=VARIABLES)))
    worst, done = 0.0, 0
    while len(low):
        now_low, now_high, low, high = low[:BATCH], high[:BATCH], low[BATCH:], high[BATCH:]
        centre, radius = 0.5 * (now_low + now_high), 0.5 * (now_high - now_low) * (1 + 1e-12)
        exact = loop.at(centre, np.zeros_like(centre))
        wide = loop.at(centre, radius)
        middle = R @ exact.m[:, 0] @ back
        slopes = (R @ wide.m[:, 1:] @ back) * radius[:, :, None, None]
        spread = np.abs(R) @ wide.r[:, 1:] @ np.abs(back) * radius[:, :, None, None]
        rest = spread.sum(1) + np.abs(R) @ exact.r[:, 0] @ np.abs(back)
        ends_of_cell = middle[:, None] + np.einsum("sv,cvij->csij", signs, slopes)
        norm = (
            np.linalg.norm(ends_of_cell, 2, axis=(-2, -1)).max(1)
            + np.linalg.norm(rest, axis=(-2, -1))
            + ROUNDING
        )
        norm = norm / (1.0 - apart)
        bad = norm >= 1.0
        worst, done = max(worst, float(norm[~bad].max(initial=0.0))), done + len(norm)
        if done > LARGEST_CELLS or (np.linalg.norm(middle[bad], 2, axis=(-2, -1)) >= 1.0).any():
            return None
        if bad.any():
            split = np.linalg.norm(spread[bad], axis=(-2, -1)).argmax(1)
            rows = np.arange(len(split))
            half = centre[bad][rows, split]
            first_high, second_low = now_high[bad].copy(), now_low[bad].copy()
            first_high[rows, split] = second_low[rows, split] = half
            low, high = (
                np.vstack([now_low[bad], second_low, low]),
                np.vstack([first_high, now_high[bad], high]),
            )
    return Proof(share, worst, done, R)
