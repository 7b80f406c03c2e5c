# SPDX-License-Identifier: MIT
"""Region of attraction with a limited voltage: an ellipsoid from which the linear loop returns
although the inverter cuts.

x+ = A x - B psi(F x), psi(u) = u - sat(u): motor and observer both get the limited voltage, as in
the firmware. Each axis may use its side of the largest square in the circle that the steady voltage
leaves.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Tuple

import cvxpy
import numpy as np
from scipy.linalg import cholesky

from .loop import Factors, Loops, Point

SIZES = 2.0 ** np.array([4, 0, 0, -10, 12, 9, 9, 4, 0, 0])  # of the states, for the solver
STARTS, PERIODS, SEED = 2000, 2000, 1  # of the check: 0.4 s
RETURNED = 1e-3  # of the ellipsoid
# Off by one each: speed and currents that the observer knows, a load that it does not.
KNOWN = {"speed_e_radps": (0, 7), "iq_A": (1, 8), "id_A": (2, 9), "d_w": (4,)}


@dataclass(frozen=True)
class Ellipsoid:
    """{x: x' W^-1 x <= 1} and how far it reaches along each direction alone."""

    room_V: float  # of each axis
    speed_e_radps: float
    iq_A: float
    id_A: float
    load_Nm: float
    returned_square: (
        float  # share of the starts on the surface that came back, limited as in the proof
    )
    returned_circle: float  # the same with the vector's length cut to the circle


def room_V(loops: Loops, p: Point) -> Tuple[float, np.ndarray]:
    """Half the side of the square, and the steady voltage v_q, v_d."""
    m = loops.motor
    vq = m["stator_resistance_Ohm"] * p.iq + p.speed * (
        m["pm_flux_Wb"] + m["d_axis_inductance_H"] * p.id
    )
    vd = m["stator_resistance_Ohm"] * p.id - p.speed * m["q_axis_inductance_H"] * p.iq
    steady = np.array([vq, vd])
    return (loops.dc_link_V / np.sqrt(3.0) - float(np.linalg.norm(steady))) / np.sqrt(2.0), steady


def matrices(loops: Loops, p: Point) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A, B, F of the ten states."""
    B = np.vstack([loops.held(p, Factors())[1], p.G])
    B[3] -= B[10]
    return p.believed, B[:10], np.hstack([np.zeros((2, 4)), p.F[:, :6]])


def search(A: np.ndarray, B: np.ndarray, F: np.ndarray) -> np.ndarray:
    """W of the ellipsoid, in sizes; voltages in units of the room."""
    W, Z, d = cvxpy.Variable((10, 10), symmetric=True), cvxpy.Variable((2, 10)), cvxpy.Variable(2)
    D, rules, total = cvxpy.diag(d), [], 0
    rules.append(
        cvxpy.bmat([[W, -Z.T, W @ A.T], [-Z, 2 * D, -D @ B.T], [A @ W, -B @ D, W]])
        >> 1e-7 * np.eye(22)
    )
    for i in range(2):
        side = F[i : i + 1] @ W - Z[i : i + 1]
        rules.append(cvxpy.bmat([[W, side.T], [side, np.ones((1, 1))]]) >> 0)
    for states in KNOWN.values():
        v, t = np.zeros((10, 1)), cvxpy.Variable((1, 1))
        v[list(states)] = 1.0
        rules.append(cvxpy.bmat([[t, v.T], [v, W]]) >> 0)
        total += t[0, 0]
    problem = cvxpy.Problem(cvxpy.Minimize(total), rules)
    problem.solve(solver=cvxpy.CLARABEL)
    return W.value


def returned(A: np.ndarray, B: np.ndarray, F: np.ndarray, W: np.ndarray, cut) -> float:  # noqa: ANN001
    """Share of starts on the surface from which the state dies out."""
    x = np.random.default_rng(SEED).normal(size=(STARTS, 10))
    x = (cholesky(W, lower=True) @ (x / np.linalg.norm(x, axis=1, keepdims=True)).T).T
    inverse = np.linalg.inv(W)
    for _ in range(PERIODS):
        u = x @ F.T
        x = x @ A.T - (u - cut(u)) @ B.T
    return float((np.einsum("ni,ij,nj->n", x, inverse, x) < RETURNED).mean())


def largest(loops: Loops, p: Point) -> Ellipsoid:
    """Found, then tried."""
    room, steady = room_V(loops, p)
    A, B, F = matrices(loops, p)
    A, B, F = A * SIZES / SIZES[:, None], B / SIZES[:, None] * room, F * SIZES / room
    W = search(A, B, F)
    inverse = np.linalg.inv(W)
    reach = {}
    for name, states in KNOWN.items():
        v = np.zeros(10)
        v[list(states)] = 1.0 / SIZES[list(states)]
        reach[name] = 1.0 / float(np.sqrt(v @ inverse @ v))
    circle = loops.dc_link_V / np.sqrt(3.0)

    def length(u: np.ndarray) -> np.ndarray:
        v = steady + room * u
        size = np.linalg.norm(v, axis=1, keepdims=True)
        return (v * np.minimum(1.0, circle / np.maximum(size, 1e-9)) - steady) / room

    l3 = loops.motor["pole_pairs"] / loops.motor["inertia_kgm2"]
    return Ellipsoid(
        room,
        reach["speed_e_radps"],
        reach["iq_A"],
        reach["id_A"],
        reach["d_w"] / l3,
        returned(A, B, F, W, lambda u: np.clip(u, -1, 1)),
        returned(A, B, F, W, length),
    )
