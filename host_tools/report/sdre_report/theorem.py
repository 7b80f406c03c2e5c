# SPDX-License-Identifier: MIT
"""Paper B's Theorem 1 as numbers: its lemma's constants, and the sharpest bound that its closed
loop (11) has."""

from __future__ import annotations

from dataclasses import dataclass
from math import comb, sqrt
from typing import Any, Dict, List, Tuple

import numpy as np
from scipy.linalg import expm, solve_continuous_lyapunov

from .tables import Table

LOAD_Nm, LOAD_Hz = 1.0, 25.0  # Case IV
OBSERVER_POLE = 520.0  # paper B, Sec. IV
RPM = 30.0 / np.pi
STEPS = 200000  # of the impulse response; twice as many move no digit that is shown


def lemma(n: int) -> Tuple[float, float]:
    """Smallest and largest eigenvalue of P of Lemma 1, whose A has n poles at -1."""
    A = np.diag(np.ones(n - 1), 1)
    A[-1] = [-comb(n, k) for k in range(n)]
    eigenvalues = np.linalg.eigvalsh(solve_continuous_lyapunov(A.T, -np.eye(n)))
    return float(eigenvalues[0]), float(eigenvalues[-1])


@dataclass(frozen=True)
class Loop:
    """Phi, Xi of (11) for one design: x1 = [1 0 ..] X, X' = Phi X + Xi d with d the N-th derivative
    of x7."""

    Phi: np.ndarray
    Xi: np.ndarray
    N: int


def closed_loop(design: Dict[str, Any], motor: Dict[str, float]) -> Loop:
    """Equation (11) with the gains of a drive file; b of x1' = b x2 and a of x2 as in (5)."""
    dobc, L = design["dobc"], motor["q_axis_inductance_H"]
    a, b, _ = plant(motor)
    gains, oscillators = np.array(dobc["l"]), dobc["oscillators_radps"]
    n = len(gains)
    Phi = np.zeros((n + 2, n + 2))
    Phi[0, 1] = b
    Phi[1, :3] = [-dobc["k1_Vs_per_rad"] / L, -a - dobc["k2_V_per_A"] / L, dobc["k2_V_per_A"] / L]
    Phi[2:, 2] = gains
    Phi[2, 2] -= a
    k = 3
    for w in oscillators:
        Phi[1, k] = Phi[2, k] = Phi[k, k + 1] = 1.0
        Phi[k + 1, k] = -w * w
        k += 2
    Phi[1, k] = Phi[2, k] = 1.0
    for i in range(k, n + 1):
        Phi[i, i + 1] = 1.0
    return Loop(Phi, np.eye(n + 2)[-1], n - 1 - 2 * len(oscillators))


def plant(motor: Dict[str, float]) -> Tuple[float, float, float]:
    """a, b of (5) and the torque constant."""
    K_t = 1.5 * motor["pole_pairs"] * motor["pm_flux_Wb"]
    J, L = motor["inertia_kgm2"], motor["q_axis_inductance_H"]
    return motor["viscous_friction_Nms"] / J + motor["stator_resistance_Ohm"] / L, K_t / J, K_t


def peak_gain(loop: Loop) -> float:
    """Integral of the impulse response's magnitude: the least constant c with abs(x1) <= c sup
    abs(d)."""
    length = 30.0 / float(np.abs(np.linalg.eigvals(loop.Phi).real).min())
    step = length / STEPS
    E, X, total = expm(loop.Phi * step), loop.Xi, 0.0
    for _ in range(STEPS):
        total += abs(X[0])
        X = E @ X
    return total * step


def load_derivative(motor: Dict[str, float], N: int) -> float:
    """Largest abs of the N-th derivative of x7 = (T' + R/L T)/K_t under the load of Case IV."""
    w = 2 * np.pi * LOAD_Hz
    rate = motor["stator_resistance_Ohm"] / motor["q_axis_inductance_H"]
    return w**N * float(np.hypot(w, rate)) * LOAD_Nm / plant(motor)[2]


def constants() -> Table:
    """Conditions of Lemma 1 on the poles."""
    out = Table(
        "B-lemma1",
        "Lemma 1: poles faster than the largest eigenvalue of P",
        (
            "",
            "states n",
            "smallest eigenvalue of P",
            "largest",
            "printed pole [1/s]",
            "bound of e_3 over the truth, 25 Hz",
        ),
        note="The lemma holds for poles beyond the largest eigenvalue, which has no unit in the "
        "proof: 1/s where poles are in 1/s. "
        "Last column: the lemma's bound for e_3 over the amplitude that a load at 25 Hz makes.",
    )
    for name, n, pole in (
        ("controller", 2, 200.0),
        ("observer, N = 1", 6, OBSERVER_POLE),
        ("observer, N = 2", 7, OBSERVER_POLE),
    ):
        least, most = lemma(n)
        bound = most / sqrt(least) * pole ** (1 - n) / sqrt(pole - most)
        truth = abs(1.0 / (2j * np.pi * LOAD_Hz + pole) ** n)
        out.add(name, n, least, most, pole, bound / truth)
    return out


def bounds(designs: List[Tuple[str, Dict[str, Any], Any]], motor: Dict[str, float]) -> Table:
    """In r/min, for the load of Case IV; a design comes with what was simulated."""
    out = Table(
        "B-theorem1",
        "Theorem 1: bound of the speed error for 1 N m at 25 Hz [r/min]",
        (
            "",
            "N",
            "sup of the N-th derivative of x_7",
            "bound",
            "at 25 Hz exactly",
            "simulated, Case IV",
        ),
        note="Bound: integral of the impulse response of (11) from d to x_1, the least constant "
        "there is, times the supremum. (11) is "
        "continuous and knows the load alone; the simulation has the delay, the inverter, the "
        "sensors and the cogging, which make the "
        "fluctuation of Case III by themselves.",
    )
    for name, design, simulated in designs:
        loop = closed_loop(design, motor)
        largest = load_derivative(motor, loop.N)
        n = len(loop.Xi)
        at_25_Hz = abs(np.linalg.solve(2j * np.pi * LOAD_Hz * np.eye(n) - loop.Phi, loop.Xi)[0])
        out.add(
            name,
            loop.N,
            largest,
            RPM * peak_gain(loop) * largest,
            RPM * at_25_Hz * largest,
            simulated,
        )
    return out
