# SPDX-License-Identifier: MIT
"""The cost (12) of every order of the series on the error dynamics (10), compared with the exact
SDRE gain and the true optimum.

Direct collocation finds the optimum. Everything is solved here from the drive file alone, which
also checks sdre-gains."""

from __future__ import annotations

from typing import Any, Callable, Dict, List, Tuple

import casadi as ca
import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.linalg import solve_continuous_are, solve_continuous_lyapunov

from .tables import Table
from .tools import ReportError

END_S = 0.03  # 25 time constants of the slowest mode
INTERVALS, DEGREE = 60, 3  # of the collocation: twice as many move no digit that is shown
# Errors (w [rad/s], iq, id [A]): the load step's largest, and what the current limit of 4 A allows.
STARTS = ((-4.2, 1.0, 0.0), (0.0, 2.0, -2.0), (0.0, 3.5, 1.8), (10.0, -3.0, -2.0), (0.0, 4.0, -2.0))
# id_ref of the current limit on the MTPA curve, and of flux weakening; errors as above.
AT = tuple(
    (i, s)
    for i in (-1.85, -2.66)
    for s in ((-4.2, 1.0, 0.0), (0.0, 2.0, 0.0), (0.0, 4.0, 0.0), (10.0, -3.0, -2.0))
)
GRID_A, GRID_POINTS = (
    8.0,
    801,
)  # twice the current limit; half-way between two points the spline is within 1e-9
AGREES = 1e-6  # relative, of a gain with the one of sdre-gains
Gain = Callable[[np.ndarray], np.ndarray]


class Problem:
    """Equations (10) and (12) of one drive.

    (10) has l1 where the firmware, whose iq_ref solves (40) with id_ref, leaves l1 + l11 id_ref."""

    def __init__(
        self, design: Dict[str, Any], drive: Dict[str, Any], id_ref_A: float = 0.0
    ) -> None:
        l = {int(k[1:]): v for k, v in design["reduced_parameters"].items()}  # noqa: E741
        self.A0 = np.array([[-l[2], l[1] + l[11] * id_ref_A, 0], [-l[5], -l[4], 0], [0, 0, -l[7]]])
        self.dA = np.array([[0, 0, l[11]], [0, 0, 0], [0, 0, 0]])
        self.B = np.array([[0, 0], [l[6], 0], [0, l[8]]])
        self.Q, self.T = np.diag(drive["nosc"]["Q"]), np.diag(drive["nosc"]["T"])

    def gain(self, riccati: np.ndarray) -> np.ndarray:
        """Lambda of a solution."""
        return np.linalg.solve(self.T, self.B.T @ riccati)

    def series(self, order: int) -> List[np.ndarray]:
        """Solutions of (23) to (25)."""
        G = self.B @ np.linalg.solve(self.T, self.B.T)
        X = [solve_continuous_are(self.A0, self.B, self.Q, self.T)]
        Ac = self.A0 - G @ X[0]
        for n in range(1, order + 1):
            W = (
                X[n - 1] @ self.dA
                + self.dA.T @ X[n - 1]
                - sum((X[j] @ G @ X[n - j] for j in range(1, n)), np.zeros((3, 3)))
            )
            X.append(solve_continuous_lyapunov(Ac.T, -W))
        return X

    def exact(self) -> Gain:
        """The gain of the SDRE, which depends on e_iq alone: solved on a grid, a spline between."""
        grid = np.linspace(-GRID_A, GRID_A, GRID_POINTS)
        gains = [
            self.gain(solve_continuous_are(self.A0 + e * self.dA, self.B, self.Q, self.T))
            for e in grid
        ]
        spline = CubicSpline(grid, gains)
        return lambda x: spline(x[1])


def series_gain(gains: List[np.ndarray], hold_A: float = np.inf) -> Gain:
    """The sum (26), held beyond `hold_A` as the firmware does."""
    return lambda x: sum(g * np.clip(x[1], -hold_A, hold_A) ** n for n, g in enumerate(gains))


def cost(problem: Problem, gain: Gain, start: Tuple[float, ...]) -> float:
    """Cost of the closed loop from `start` on; infinite when it diverges."""

    def slope(_: float, z: np.ndarray) -> np.ndarray:
        x = z[:3]
        u = -gain(x) @ x
        return np.append(
            (problem.A0 + x[1] * problem.dA) @ x + problem.B @ u,
            0.5 * (x @ problem.Q @ x + u @ problem.T @ u),
        )

    def far(_: float, z: np.ndarray) -> float:
        return 1e3 - float(np.abs(z[1:3]).max())

    far.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(slope, (0.0, END_S), (*start, 0.0), rtol=1e-8, atol=1e-10, events=far)
    return float("inf") if run.status == 1 else float(run.y[3, -1])


def optimum(problem: Problem, exact: Gain, start: Tuple[float, ...]) -> float:
    """Optimal cost by direct collocation (Radau), from the exact SDRE's trajectory as the first
    guess."""
    guess = solve_ivp(
        lambda _, x: (problem.A0 + x[1] * problem.dA - problem.B @ exact(x)) @ x,
        (0.0, END_S),
        start,
        rtol=1e-6,
        dense_output=True,
    )
    taus = [0.0, *ca.collocation_points(DEGREE, "radau")]
    basis = [np.poly1d([1.0])] * (DEGREE + 1)
    for j in range(DEGREE + 1):
        for r in range(DEGREE + 1):
            if r != j:
                basis[j] = basis[j] * np.poly1d([1.0, -taus[r]]) / (taus[j] - taus[r])
    slopes = np.array([[np.polyder(p)(t) for t in taus] for p in basis])
    weights = [float(np.polyint(p)(1.0)) for p in basis]
    h = END_S * np.diff(np.linspace(0.0, 1.0, INTERVALS + 1) ** 2)  # short ones where it is fast
    unknowns, first, rules = [], [], []
    x_k: Any = ca.SX(ca.DM(start))
    total, at = ca.SX(0), 0.0
    for k, step in enumerate(h):
        states = [x_k] + [ca.SX.sym(f"x{k}_{j}", 3) for j in range(1, DEGREE + 1)]
        for j in range(1, DEGREE + 1):
            x, u = states[j], ca.SX.sym(f"u{k}_{j}", 2)
            value = guess.sol(min(at + step * taus[j], END_S))
            unknowns += [x, u]
            first += [*value, *(-exact(value) @ value)]
            slope = problem.A0 @ x + x[1] * (problem.dA @ x) + problem.B @ u
            rules.append(
                sum(float(slopes[r, j]) * states[r] for r in range(DEGREE + 1)) - step * slope
            )
            total += (
                0.5 * step * weights[j] * (ca.bilin(problem.Q, x, x) + ca.bilin(problem.T, u, u))
            )
        x_k, at = states[-1], at + step
    solver = ca.nlpsol(
        "optimum",
        "ipopt",
        {"x": ca.vertcat(*unknowns), "f": total, "g": ca.vertcat(*rules)},
        {"print_time": False, "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-10}},
    )
    found = solver(x0=first, lbg=0, ubg=0)
    if not solver.stats()["success"]:
        raise ReportError(f"the collocation finds no optimum from {start}")
    return float(found["f"])


def implemented(design: Dict[str, Any], drive: Dict[str, Any]) -> Table:
    """The same where the firmware's references leave l1 + l11 id_ref in the speed row.

    It shows what the series is worth there."""
    paper = Problem(design, drive)
    gains = [paper.gain(X) for X in paper.series(2)]
    hold_A = design["certificate"]["nosc"]["series_range_A"]
    out = Table(
        "A-implemented",
        "The same with the firmware's references: cost beyond the optimum [%]",
        ("", *(f"id_ref {i:g} A, e = ({', '.join(f'{v:g}' for v in s)})" for i, s in AT)),
        note=f"Error dynamics of {drive['name']}.toml with l1 + l11 id_ref in the speed row. The "
        "laws of (10) do not know id_ref; the last two are solved for it.",
    )
    columns = []
    for id_ref_A, start in AT:
        there = Problem(design, drive, id_ref_A)
        exact = there.exact()
        best = optimum(there, exact, start)
        laws: List[Gain] = [series_gain(gains[: n + 1]) for n in range(3)]
        laws += [series_gain(gains, hold_A), paper.exact()]
        laws += [series_gain([there.gain(X) for X in there.series(0)]), exact]
        columns.append([100.0 * (cost(there, law, start) / best - 1.0) for law in laws] + [best])
    names = [f"order {n} of (10)" for n in range(3)]
    names += [f"order 2 of (10), held beyond {hold_A:.2f} A (firmware)", "exact SDRE of (10)"]
    names += ["order 0, scheduled in id_ref", "exact SDRE with id_ref"]
    for n, name in enumerate(names):
        out.add(name, *(x[n] if np.isinf(x[n]) else f"{x[n]:.2f}" for x in columns))
    out.add("cost of the optimum", *(x[-1] for x in columns))
    return out


def table(design: Dict[str, Any], drive: Dict[str, Any]) -> Table:
    """Cost beyond the optimum, in per cent."""
    problem = Problem(design, drive)
    exact = problem.exact()
    gains = [problem.gain(X) for X in problem.series(3)]
    for ours, theirs in zip(gains, design["nosc"]["lambda"]):
        if np.abs(ours - np.array(theirs)).max() > AGREES * np.abs(gains[0]).max():
            raise ReportError("sdre-gains and the report disagree about a gain of the series")
    hold_A = design["certificate"]["nosc"]["series_range_A"]
    laws: List[Tuple[str, Gain]] = [
        (f"order {n}" + (" (LQR)" if n == 0 else ""), series_gain(gains[: n + 1])) for n in range(4)
    ]
    laws += [
        (f"order 2, held beyond {hold_A:.2f} A (firmware)", series_gain(gains[:3], hold_A)),
        ("exact SDRE", exact),
    ]
    out = Table(
        "A-optimal",
        "How near the optimum: cost (12) beyond the true optimum [%]",
        ("", *(f"e = ({', '.join(f'{v:g}' for v in s)})" for s in STARTS)),
        note="Error dynamics (10) of ipmsm_390w_speed.toml without limits, from an error (rad/s, "
        "A, A) on. The optimum by direct "
        f"collocation, Radau of degree {DEGREE} on {INTERVALS} intervals. The gains are solved "
        f"here anew and agree with those of "
        "sdre-gains.",
    )
    best = [optimum(problem, exact, s) for s in STARTS]
    for name, gain in laws:
        over = [100.0 * (cost(problem, gain, s) / b - 1.0) for s, b in zip(STARTS, best)]
        out.add(name, *(x if np.isinf(x) else f"{x:.2f}" for x in over))
    out.add("cost of the optimum", *best)
    return out
