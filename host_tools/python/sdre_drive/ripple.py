# SPDX-License-Identifier: MIT
"""How much the speed ripples with the shaft's angle, order by order, from pictures of the scope:
docs/anticogging.md."""

from __future__ import annotations

import cmath
import math
import statistics
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Sequence

from sdre_drive import scope, session
from sdre_drive.connection import Drive, DriveError
from sdre_drive.registers import Constants
from sdre_drive.units import e_radps_of, rpm_of

SIGNALS = ("THETA", "SPEED")
CAPTURES = 6  # chosen: their mean scatters by a tenth where there is noise alone
SETTLE_S = 3.0  # chosen, of the drive's time: noc_h has found its harmonics within 2 s
SPEED_WITHIN = 0.2  # chosen: cogging moves a slow shaft by as much
LONGEST_S = 60.0
LONGEST_TURN_S = 20.0
LEAST_SAMPLES = 64  # chosen: of a turn; orders up to a third of them are told apart
SPARE = 1.05  # chosen: a picture is so much longer than a turn
ABOVE_NOISE = 5.0  # chosen: times the median of all orders; noise alone exceeds it once in 10 ** 7
ABOVE_LARGEST = 0.1  # chosen: of the largest order; less is not worth a pair of states
ONCE_OR_TWICE = (1, 2)  # a turn: a disc that runs out, a bent shaft


@dataclass(frozen=True)
class Ripple:
    """Ripple of the speed in steady state."""

    speed_rpm: float
    pole_pairs: int
    rms_rpm: float  # of all orders
    noise_rpm: float  # median of the orders' amplitudes
    amplitude_rpm: List[float]  # of order 1 a turn, 2, ..

    def found(self) -> List[int]:
        """Orders that noise does not explain."""
        least = max(ABOVE_NOISE * self.noise_rpm, ABOVE_LARGEST * max(self.amplitude_rpm))
        return [k + 1 for k, a in enumerate(self.amplitude_rpm) if a > least]

    def at(self, order: int) -> float:
        """Amplitude [r/min]; 0 beyond the largest order."""
        return self.amplitude_rpm[order - 1] if order <= len(self.amplitude_rpm) else 0.0

    def words(self, order: int) -> str:
        """Says what makes such an order."""
        pairs = self.pole_pairs
        causes = {
            pairs: "offset of a current sensor",
            2 * pairs: "gains of the current sensors",
            6 * pairs: "dead time; cogging too, if the slots say so",
            12 * pairs: "dead time, or cogging",
        }
        if order in ONCE_OR_TWICE:
            return "encoder disc or shaft off centre, or the load"
        return causes.get(order, "cogging")

    def json(self) -> Dict[str, Any]:
        """For from_json()."""
        return dict(vars(self))


def from_json(read: Dict[str, Any]) -> Ripple:
    """TypeError or KeyError when that is no ripple."""
    return Ripple(**read)


def turn_of(thetas: Sequence[float], speeds: Sequence[float], known: Constants) -> List[float]:
    """Speeds [rad/s electrical] at equal steps of the shaft's angle, over exactly one turn.
    Straight lines between samples make an order of a fifth of their number 13 % too small."""
    places = [0.0]
    for before, now in zip(thetas, thetas[1:]):
        places.append(places[-1] + math.remainder(now - before, 2.0 * math.pi))
    turn = math.copysign(2.0 * math.pi * known.pole_pairs, places[-1])
    share = [place / turn for place in places]
    if share[-1] < 1.0:
        raise DriveError("the shaft has not turned once within a picture: its speed is not steady")
    count = next(k for k, s in enumerate(share) if s >= 1.0)
    turned, at = [], 0
    for k in range(count):
        wanted = k / count
        while share[at + 1] < wanted:
            at += 1
        step = share[at + 1] - share[at]
        part = (wanted - share[at]) / step if step > 0.0 else 0.0
        turned.append(speeds[at] + part * (speeds[at + 1] - speeds[at]))
    return turned


def ripple_of(turns: Sequence[Sequence[float]], known: Constants) -> Ripple:
    """Amplitudes of the orders, from several turns."""
    means = [statistics.fmean(turn) for turn in turns]
    orders = min(len(turn) for turn in turns) // 3
    power = [0.0] * orders
    for turn in turns:
        root = cmath.exp(-2j * math.pi / len(turn))
        for order in range(1, orders + 1):
            step, by = 1.0 + 0.0j, root**order
            total = 0.0j
            for value in turn:
                total += value * step
                step *= by
            power[order - 1] += abs(2.0 * total / len(turn)) ** 2 / len(turns)
    squares = [statistics.fmean((v - m) ** 2 for v in turn) for turn, m in zip(turns, means)]
    pairs = known.pole_pairs
    amplitudes = [rpm_of(math.sqrt(p), pairs) for p in power]
    return Ripple(
        rpm_of(statistics.fmean(means), pairs),
        pairs,
        rpm_of(math.sqrt(statistics.fmean(squares)), pairs),
        statistics.median(amplitudes),
        amplitudes,
    )


def decimation_of(known: Constants, speed_rpm: float, samples: int) -> int:
    """Periods between samples, so that a picture has a turn. DriveError with the range."""
    periods = 60.0 / speed_rpm / known.period_s
    least = 60.0 / LONGEST_TURN_S
    most = 60.0 / (LEAST_SAMPLES * known.period_s)
    if not least <= speed_rpm <= most:
        raise DriveError(f"ripple is measured between {least:.0f} and {most:.0f} r/min, forward")
    return math.ceil(SPARE * periods / samples)


def measure(drive: Drive, speed_rpm: float, show: Callable[[float], None]) -> Ripple:
    """Runs the drive at this speed of the shaft. It stops the drive in the end, whatever
    happens."""
    known = drive.constants()
    speed = e_radps_of(speed_rpm, known.pole_pairs)
    samples = scope.samples_of(drive)
    setup = scope.Setup(SIGNALS, decimation_of(known, speed_rpm, samples))
    session.require_speed(drive, speed)
    turns: List[List[float]] = []
    try:
        session.run_steady(drive, speed, SPEED_WITHIN, SETTLE_S, LONGEST_S)
        while len(turns) < CAPTURES:
            session.require_moving(drive.read())
            thetas, speeds = scope.take(drive, setup, LONGEST_S).values
            turns.append(turn_of(thetas, speeds, known))
            show(len(turns) / CAPTURES)
    except DriveError:
        session.withdraw(drive)
        raise
    session.stop(drive)
    return ripple_of(turns, known)
