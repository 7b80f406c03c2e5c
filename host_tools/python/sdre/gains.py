# SPDX-License-Identifier: MIT
"""Gains and their certificate, as `sdre-gains report --json`; weights, as `sdre-gains tune`;
Riccati equations."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any, Dict, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sdre import _native
from sdre.drive import Drive

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class GainSeries:
    """A gain that is a Taylor series in a current: sum over n of gain[n] * current_A**n.

    Controller (EQ-NOSC-2, paper A eq. 26): current e_iq. gain[n] is 2 x 3, from [w - w_d, iq -
    iq_ref, id - id_ref] in rad/s and A to [v_q, v_d] in V.

    Observer (EQ-NODO-2, EQ-NODO-ENCODER-3, paper A eq. 39): current i_q. gain[n] is states x 3,
    from the measurements' errors to the rates of the states.

    The conventional law has two currents; `powers` has the exponents of every term.
    """

    order: int
    gain: FloatArray  # terms x rows x columns, in the single precision of the tables
    solutions: FloatArray  # of the Riccati (n = 0) and Lyapunov equations, terms x n x n
    poles_1ps: NDArray[np.complex128]  # at zero current
    residuals: Tuple[float, ...]  # relative, of each equation; refused above 1e-10
    powers: Tuple[Tuple[int, ...], ...] = ()

    def at(self, current_A: float) -> FloatArray:
        """The gain at a current; of one scheduling current, within the certified range."""
        value = np.zeros(self.gain.shape[1:])
        for term in self.gain[::-1]:
            value = value * current_A + term
        return value


@dataclass(frozen=True)
class SampledLoop:
    """How one sampled loop behaves over its certified range (EQ-CERT-1, 2)."""

    range_A: float  # of the scheduling current, either way
    series_range_A: float  # beyond it the gain is held
    worst_pole_1ps: float  # largest real part
    fastest_pole_times_period: float
    spectral_radius: float  # stable below 1
    series_error: Tuple[float, ...]  # of each order, against the exact gain


@dataclass(frozen=True)
class LoopVerdict:
    """Motor, observer, law and delay together (EQ-CERT-4, 5)."""

    spectral_radius: float  # worst from standstill to the largest command
    box_share: Optional[
        float
    ]  # of the box of other motors, all parameters at once; at least 0.4 required
    one_at_a_time_share: Optional[
        float
    ]  # of the same box, one parameter at a time; at least 1 required
    sensitivity_peaks: Dict[str, float]  # by channel; at most 3 allowed


@dataclass(frozen=True)
class Certificate:
    """Conditions for writing a table."""

    certified: bool
    failures: Tuple[str, ...]  # one line each
    controller: Optional[SampledLoop]
    observer: Optional[SampledLoop]
    whole_loop: Optional[LoopVerdict]


@dataclass(frozen=True)
class Design:
    """Gains of a drive. Missing parts of a law are None; `report` has all that `sdre-gains report
    --json` prints."""

    drive: Drive
    law: str
    reduced_parameters: Dict[str, float]  # l1 .. l11 of paper A
    controller: Optional[GainSeries]
    observer: Optional[GainSeries]
    certificate: Certificate
    report: Dict[str, Any] = field(repr=False)
    report_text: str = field(repr=False)  # the same, byte for byte as the tool prints it


def design(drive: Drive, extended: bool = False) -> Design:
    """Solves both state-dependent Riccati equations of the drive and certifies the gains (paper A,
    eq. 26 and 39; EQ-CERT-1 to 5).

    With `extended`, in long double as for tables that are written: several times slower, the same
    to nine digits. A refused certificate is in the result; DesignError when an equation has no
    acceptable solution.
    """
    text = _native.report(drive._native, extended)
    report = json.loads(text)
    return Design(
        drive=drive,
        law=drive.law,
        reduced_parameters=dict(report["reduced_parameters"]),
        controller=_series(report.get("nosc"), "lambda", "gamma", "closed_loop_eigenvalues"),
        observer=_series(report.get("nodo"), "gain", "pi", "eigenvalues"),
        certificate=_certificate(report),
        report=report,
        report_text=text,
    )


def tune(drive: Drive) -> Tuple[Drive, str]:
    """The drive with weights found by search, goals from the physics of its motor, and a line about
    the hardest goal.

    As `sdre-gains tune` without a specification: seconds, and the same weights every time. Laws
    `noc` and `noc_h` in the encoder form. DesignError when nothing that was found is certified.
    """
    text, hardest = _native.tune(drive.text, drive.name)
    return Drive.from_text(text, drive.name), hardest


@dataclass(frozen=True)
class CareSolution:
    """Stabilising solution of a continuous-time Riccati equation."""

    X: FloatArray  # n x n, symmetric
    semidefinite: bool  # X >= 0; an indefinite Q may leave none such
    relative_residual: float  # EQ-CARE-2
    closed_loop_eigenvalues: NDArray[np.complex128]  # of A - B R^-1 B' X, n


def care(
    A: ArrayLike,
    B: Optional[ArrayLike] = None,
    R: Optional[ArrayLike] = None,
    Q: Optional[ArrayLike] = None,
    *,
    G: Optional[ArrayLike] = None,
) -> CareSolution:
    """Solves A'X + XA - X B R^-1 B' X + Q = 0 (EQ-CARE-1); with G = B R^-1 B' in place of B and R
    if wanted.

    A, Q, G are n x n, B is n x m, R is m x m, positive definite. InputError on wrong shapes and
    numbers that are not finite. DesignError with the failed assumption: not stabilisable, not
    detectable, eigenvalues on the imaginary axis.
    """
    if Q is None or (B is None) != (R is None) or (B is None) == (G is None):
        raise _native.InputError("care: give A, Q and either B and R or G")
    X, semidefinite, residual, modes = _native.care(
        _matrix(A),
        None if B is None else _matrix(B),
        None if R is None else _matrix(R),
        None if G is None else _matrix(G),
        _matrix(Q),
    )
    return CareSolution(X, semidefinite, residual, np.asarray(modes).ravel())


def _matrix(values: ArrayLike) -> FloatArray:
    try:
        return np.asfortranarray(np.atleast_2d(np.asarray(values, dtype=np.float64)))
    except ValueError as error:
        raise _native.InputError(f"care: a matrix must be rows of numbers: {error}") from error


def _series(
    part: Optional[Dict[str, Any]], gain: str, solution: str, poles: str
) -> Optional[GainSeries]:
    if part is None:
        return None
    return GainSeries(
        order=part["order"],
        gain=np.array(part[gain], dtype=np.float64),
        solutions=np.array(part[solution], dtype=np.float64),
        poles_1ps=np.array([complex(*pole) for pole in part[poles]]),
        residuals=tuple(part["residuals"]),
        powers=tuple(tuple(powers) for powers in part.get("powers", ())),
    )


def _loop(part: Optional[Dict[str, Any]]) -> Optional[SampledLoop]:
    if part is None:
        return None
    return SampledLoop(
        part["range"]["max_A"],
        part["series_range_A"],
        part["worst_pole_1ps"],
        part["fastest_pole_times_period"],
        part["spectral_radius"],
        tuple(part["series_error"]),
    )


def _certificate(report: Dict[str, Any]) -> Certificate:
    part = report["certificate"]
    loop = report.get("whole_loop")
    verdict = loop and LoopVerdict(
        loop["spectral_radius"],
        loop.get("box_share"),
        loop.get("one_at_a_time_share"),
        {name: channel["sensitivity_peak"] for name, channel in loop.get("channels", {}).items()},
    )
    return Certificate(
        part["certified"],
        tuple(part["failures"]),
        _loop(part.get("nosc")),
        _loop(part.get("nodo")),
        verdict,
    )
