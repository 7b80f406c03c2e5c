# SPDX-License-Identifier: MIT
"""The sampled loop of EQ-CERT-3 with any motor: the controller as `sdre-gains report --loops`
writes it, the motor exact.

State [w iq id (theta - theta^) | d_w^ d_q^ d_d^ w^ iq^ id^], of the controller alone [d_w^ d_q^
d_d^ w^ iq^ id^ theta^].
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, NamedTuple, Tuple

import numpy as np
from scipy.linalg import expm

from ..tools import ReportError

AGREES = 1e-9  # of the composed loop with the tool's, relative to its largest entry


class Factors(NamedTuple):
    """Ratios of the true motor to the nominal one; arrays are many motors at once."""

    R: Any = 1.0
    L: Any = 1.0
    flux: Any = 1.0
    J: Any = 1.0


def box(share: float) -> Tuple[Tuple[float, float], ...]:
    """R, L, flux, J of EQ-CERT-5."""
    low = 0.5**share
    return ((low, 1.5**share), (low, 1.5**share), (low, 1.5**share), (low, 3.0**share))


@dataclass(frozen=True)
class Point:
    """One operating point with its controller."""

    speed: float
    iq: float
    id: float
    A_c: np.ndarray  # 7 x 7
    B_c: np.ndarray  # 7 x 3, of measured iq, id, theta
    F: np.ndarray  # 2 x 7
    G: np.ndarray  # 7 x 2, of the voltage in the observer; part of A_c already
    believed: np.ndarray  # the whole loop with the nominal motor, from the tool


class Loops:
    """All points of one drive."""

    def __init__(self, written: Dict[str, Any]) -> None:
        self.motor, self.ts, self.drive = (
            written["motor"],
            written["control_period_s"],
            written["drive"],
        )
        self.dc_link_V = written["dc_link_V"]
        self.points = [self._point(p) for p in written["points"]]
        self.box_points = [self._point(p) for p in written["box_points"]]
        for p in self.points + self.box_points:
            if (
                np.abs(self.matrix(p, Factors()) - p.believed).max()
                > AGREES * np.abs(p.believed).max()
            ):
                raise ReportError(f"the loop at {p.speed:.0f} rad/s is not that of sdre-gains")

    @staticmethod
    def _point(p: Dict[str, Any]) -> Point:
        P, G, PL, F = (np.array(p[k]) for k in ("P", "G", "L_Ts", "F"))
        PL = P @ PL
        C = np.eye(7)[4:]
        return Point(
            p["speed_e_radps"], p["iq_A"], p["id_A"], P - PL @ C + G @ F, PL, F, G, np.array(p["A"])
        )

    def plant(self, p: Point, f: Factors) -> Tuple[np.ndarray, np.ndarray]:
        """EQ-MOTOR-2 linearised, states w, iq, id, theta; inputs v_q, v_d."""
        m, n_p = self.motor, self.motor["pole_pairs"]
        R, flux, J = (
            f.R * m["stator_resistance_Ohm"],
            f.flux * m["pm_flux_Wb"],
            f.J * m["inertia_kgm2"],
        )
        Ld, Lq = f.L * m["d_axis_inductance_H"], f.L * m["q_axis_inductance_H"]
        shape = np.broadcast(R, Ld, flux, J).shape
        A, B = np.zeros((*shape, 4, 4)), np.zeros((*shape, 4, 2))
        k = 1.5 * n_p**2 / J
        A[..., 0, 0] = -m["viscous_friction_Nms"] / J
        A[..., 0, 1], A[..., 0, 2] = k * (flux + (Ld - Lq) * p.id), k * (Ld - Lq) * p.iq
        A[..., 1, 0], A[..., 1, 1], A[..., 1, 2] = (
            -(flux + Ld * p.id) / Lq,
            -R / Lq,
            -p.speed * Ld / Lq,
        )
        A[..., 2, 0], A[..., 2, 1], A[..., 2, 2] = p.iq * Lq / Ld, p.speed * Lq / Ld, -R / Ld
        A[..., 3, 0] = 1.0
        B[..., 1, 0], B[..., 2, 1] = 1 / Lq, 1 / Ld
        return A, B

    def held(self, p: Point, f: Factors) -> Tuple[np.ndarray, np.ndarray]:
        """The motor over one period, voltages held."""
        A, B = self.plant(p, f)
        both = np.zeros((*A.shape[:-2], 6, 6))
        both[..., :4, :4], both[..., :4, 4:] = A, B
        E = expm(self.ts * both)
        return E[..., :4, :4], E[..., :4, 4:]

    def matrix(self, p: Point, f: Factors) -> np.ndarray:
        """The whole loop, 10 x 10."""
        Phi, Gamma = self.held(p, f)
        return compose(p, Phi, Gamma)

    def radius(self, p: Point, f: Factors) -> np.ndarray:
        """Spectral radius of the loop with each motor."""
        return np.abs(np.linalg.eigvals(self.matrix(p, f))).max(axis=-1)


def compose(p: Point, Phi: np.ndarray, Gamma: np.ndarray) -> np.ndarray:
    """Motor and controller; theta and theta^ become their difference, of which alone anything
    depends."""
    A = np.zeros((*Phi.shape[:-2], 11, 11))
    A[..., :4, :4], A[..., :4, 4:] = Phi, Gamma @ p.F
    A[..., 4:, 1:4], A[..., 4:, 4:] = p.B_c, p.A_c
    A[..., 3, :] -= A[..., 10, :]  # theta - theta^
    return A[..., :10, :10]


def random_motors(share: float, count: int, seed: int) -> Factors:
    """Evenly distributed over the logarithms of the box."""
    draw = np.random.default_rng(seed)
    return Factors(*(np.exp(draw.uniform(np.log(lo), np.log(hi), count)) for lo, hi in box(share)))


def corners(share: float) -> Factors:
    """All sixteen."""
    grid = np.meshgrid(*box(share), indexing="ij")
    return Factors(*(g.ravel() for g in grid))
