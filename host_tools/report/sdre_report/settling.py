# SPDX-License-Identifier: MIT
"""Settling time of a signal.

The papers name no band. Here it is 5 % of the largest distance from the final value, plus the noise
of the tail.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, Optional

import numpy as np

SHARE = 0.05  # chosen: the 5 % that is usual
TAIL = 0.2  # of the window, as sdre-sil's metrics
NOTHING = 1e-3  # a departure of less than this share of the signal's largest value is none


@dataclass(frozen=True)
class Settled:
    """Settling of one signal after one step."""

    before: float
    after: float
    time_ms: Optional[float]  # none: it does not leave its noise, or it does not settle
    overshoot: float  # beyond the final value, in the direction of the change
    moves: bool  # out of its noise


def settle(
    trace: Dict[str, np.ndarray], name: str, from_s: float, step_s: float, to_s: float
) -> Settled:
    """Settling of one signal from `step_s` on; `from_s` .. `step_s` is the steady state before the
    step."""
    time, signal = trace["time_s"], trace[name]
    early = signal[(time >= from_s - 1e-9) & (time < step_s - 1e-9)]
    window = (time >= step_s - 1e-9) & (time < to_s - 1e-9)
    late, at = signal[window], time[window]
    before = float(early[-max(1, int(TAIL * len(early))) :].mean())
    tail = late[-max(1, int(TAIL * len(late))) :]
    after = float(tail.mean())
    noise = float(tail.max() - tail.min()) / 2
    departure = float(np.abs(late - after).max())
    if departure <= max(NOTHING * float(np.abs(signal).max()), 3 * noise):
        return Settled(before, after, None, 0.0, False)
    outside = np.flatnonzero(np.abs(late - after) > SHARE * departure + noise)
    first = outside[-1] + 1
    time_ms = None if first >= len(late) else 1e3 * float(at[first] - step_s)
    beyond = float((np.sign(after - before) * (late - after)).max()) - noise
    return Settled(before, after, time_ms, max(beyond, 0.0), True)
