# SPDX-License-Identifier: MIT
"""Structured singular value: the largest share of the box of EQ-CERT-5 in which no constant motor
makes the loop unstable.

Real uncertainties: 1/J, flux in the torque and in the EMF, R, 1/L of both axes, L in the torque.
They are taken as independent, which the motor's are not. The share is therefore a lower bound. Over
a period the middle of the box is exact; the trapezoidal rule adds the uncertainties. `modelled`
compared with Loops.matrix shows the error of that.
"""

from __future__ import annotations

from typing import List, Tuple

import numpy as np
import slycot
from scipy.linalg import expm

from .loop import Factors, Loops, Point, box, corners

FREQUENCIES = (
    64  # chosen: evenly over the logarithm from a ten-thousandth of the sampling rate to half of it
)
REAL = np.ones(8, dtype=np.int32)
ACCURACY = 0.01  # of the share
BLOCKS = 8


def uncertain(loops: Loops, p: Point, share: float) -> Tuple[np.ndarray, ...]:
    """Matrices in the middle of the box.

    x' = A x + B v + B_w w,   z = C x + D_v v + D_w w,   w = delta z with abs(delta) <= 1
    """
    m, n_p = loops.motor, loops.motor["pole_pairs"]
    (R0, R1), (L0, L1), (f0, f1), (J0, J1) = box(share)
    middle = lambda a, b: (0.5 * (a + b), 0.5 * (b - a))  # noqa: E731
    (R, dR), (f, df), (L, dL) = middle(R0, R1), middle(f0, f1), middle(L0, L1)
    (g, dg), (i, di) = middle(1 / L1, 1 / L0), middle(1 / J1, 1 / J0)
    Rs, psi = m["stator_resistance_Ohm"], m["pm_flux_Wb"]
    Ld, Lq = m["d_axis_inductance_H"], m["q_axis_inductance_H"]
    # Rows of linear forms in (w, iq, id, theta | vq, vd | 8 inputs).
    e = np.eye(4 + 2 + BLOCKS)
    w, iq, id_, _, vq, vd = e[:6]
    W = e[6:]
    z: List[np.ndarray] = []

    def times(form: np.ndarray, centre: float, half: float) -> np.ndarray:
        z.append(half * form)
        return centre * form + W[len(z) - 1]

    torque = times(psi * iq, f, df) + times((Ld - Lq) * (p.id * iq + p.iq * id_), L, dL)
    w_dot = times(
        (1.5 * n_p**2 * torque - m["viscous_friction_Nms"] * w) / m["inertia_kgm2"], i, di
    )
    iq_dot = times((vq - times(Rs * iq, R, dR) - times(psi * w, f, df)) / Lq, g, dg) - Ld / Lq * (
        p.speed * id_ + p.id * w
    )
    id_dot = times((vd - times(Rs * id_, R, dR)) / Ld, g, dg) + Lq / Ld * (p.speed * iq + p.iq * w)
    x_dot = np.array([w_dot, iq_dot, id_dot, w])
    Z = np.array(z)
    return (x_dot[:, :4], x_dot[:, 4:6], x_dot[:, 6:], Z[:, :4], Z[:, 4:6], Z[:, 6:])


def closed(
    loops: Loops, p: Point, share: float
) -> Tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """The whole sampled loop from w to z: A, B, C, D."""
    A, B, Bw, C, Dv, Dw = uncertain(loops, p, share)
    h = loops.ts
    inverse = np.linalg.inv(np.eye(4) - 0.5 * h * A)
    Phi, Gamma, Gw = inverse @ (np.eye(4) + 0.5 * h * A), h * inverse @ B, h * inverse @ Bw
    Cx, Cv, Cw = 0.5 * C @ (np.eye(4) + Phi), Dv + 0.5 * C @ Gamma, Dw + 0.5 * C @ Gw
    E = expm(h * np.block([[A, B], [np.zeros((2, 6))]]))  # the middle of the box exactly
    whole = np.zeros((11, 11))
    whole[:4, :4], whole[:4, 4:], whole[4:, 1:4], whole[4:, 4:] = (
        E[:4, :4],
        E[:4, 4:] @ p.F,
        p.B_c,
        p.A_c,
    )
    inputs = np.zeros((11, BLOCKS))
    inputs[:4] = Gw
    outputs = np.hstack([Cx, Cv @ p.F])
    whole[3] -= whole[10]  # nothing depends on theta and theta^ but by their difference
    inputs[3] -= inputs[10]
    return whole[:10, :10], inputs[:10], outputs[:, :10], Cw


def modelled(loops: Loops, p: Point, share: float, f: Factors) -> np.ndarray:
    """The loop that the model has for one motor of the box: to be held against the exact one."""
    A, B, C, D = closed(loops, p, share)
    ends = box(share)
    place = lambda v, lo, hi: (v - 0.5 * (lo + hi)) / (0.5 * (hi - lo))  # noqa: E731
    R, L, flux = (place(v, *e) for v, e in zip((f.R, f.L, f.flux), ends))
    i, g = (place(1 / v, 1 / e[1], 1 / e[0]) for v, e in ((f.J, ends[3]), (f.L, ends[1])))
    delta = np.diag([flux, L, i, R, flux, g, R, g])
    return A + B @ delta @ np.linalg.solve(np.eye(BLOCKS) - D @ delta, C)


def peak(loops: Loops, p: Point, share: float) -> float:
    """Largest upper bound of mu over the frequencies; infinite when the middle of the box is
    unstable."""
    A, B, C, D = closed(loops, p, share)
    if np.abs(np.linalg.eigvals(A)).max() >= 1.0:
        return float("inf")
    worst = 0.0
    for angle in np.pi * np.geomspace(2e-4, 1.0, FREQUENCIES):
        M = C @ np.linalg.solve(np.exp(1j * angle) * np.eye(10) - A, B) + D
        bound = slycot.ab13md(M, REAL, REAL)[0]
        worst = max(worst, float(bound))
        if worst >= 1.0:
            break
    return worst


def largest_share(loops: Loops, p: Point, most: float) -> float:
    """The largest share of the box with mu below one, by bisection below `most`."""
    stable, unstable = 0.0, most
    middle = 0.8 * most  # where it usually is
    while unstable - stable > ACCURACY:
        if peak(loops, p, middle) < 1.0:
            stable = middle
        else:
            unstable = middle
        middle = 0.5 * (stable + unstable)
    return stable


def corner_share(loops: Loops, p: Point) -> float:
    """Largest share at which the exact loop is stable in all corners: no share that is proved can
    be larger."""
    stable, unstable = 0.0, 1.0
    while unstable - stable > 0.001:
        middle = 0.5 * (stable + unstable)
        if loops.radius(p, corners(middle)).max() < 1.0:
            stable = middle
        else:
            unstable = middle
    return stable
