# SPDX-License-Identifier: MIT
"""The bench of a virtual drive, as the page sees and commands it: what the bench itself tells, not
what was sent to it."""

from __future__ import annotations

import math
import threading
import time
from typing import Any, Dict, List, Optional, Tuple

from sdre_drive.bench import Bench
from sdre_drive.bench_faults import FAULTS, words_of
from sdre_drive.connection import DriveError

RETRY_S = 1.0
STEP_S = 5e-3  # the bench has a sample per millisecond; a screen shows less
LOOK_S = 0.5  # of its record with each look; longer than the longest pause between two


class BenchLink:
    """One connection for all threads; one that broke is made again."""

    def __init__(self, address: Optional[Tuple[str, int]]) -> None:
        self.address = address
        self.truth: Dict[str, Any] = {}  # empty: no bench answers
        self._bench: Optional[Bench] = None
        self._lock = threading.Lock()
        self._retry_s = 0.0
        self._until_s = -1.0  # simulated time
        self._ahead_s = math.inf  # of the simulated time before the drive's own

    def look(self, drive_time_s: Optional[float]) -> List[Dict[str, float]]:
        """Asks for state and record; new samples of the true motor at the drive's time."""
        if self.address is None or time.monotonic() < self._retry_s:
            return []
        try:
            with self._lock:
                self._bench = self._bench or Bench(self.address)
                self.truth = self._bench.ask("state")
                trace = self._bench.ask(f"trace {LOOK_S:g}")
        except DriveError:
            self._bench, self.truth = None, {}
            self._retry_s = time.monotonic() + RETRY_S
            return []
        return self._new(trace, drive_time_s) if drive_time_s is not None else []

    def forget(self) -> None:
        """The drive has restarted: its time begins again."""
        self._until_s, self._ahead_s = -1.0, math.inf

    def tell(self, command: str) -> Dict[str, Any]:
        """Load, supply, faults; its answer. The bench's refusal is a DriveError."""
        with self._lock:
            if self._bench is None:
                raise DriveError("there is no bench: this is not a virtual drive")
            self.truth = self._bench.ask(command)
            return self.truth

    def for_page(self) -> Optional[Dict[str, Any]]:
        """Its state; None when no bench answers."""
        truth = self.truth
        if not truth:
            return None
        return {**truth, "broken": [words_of(one) for one in truth["broken"]]}

    def load(self, torque_Nm: float, kind: str) -> None:
        """A brake, or a torque whatever the shaft does."""
        self.tell(f"load {torque_Nm:g} {kind}")

    def break_part(self, words: str) -> str:
        """One of the faults in words; what has to happen before it shows."""
        if words not in FAULTS:
            raise DriveError(f'"{words}" is no fault of the bench')
        return str(self.tell(FAULTS[words]).get("note") or "")

    def mend(self) -> None:
        """Everything is whole, and nothing pulls at the shaft, which comes to rest."""
        self.tell("mend")

    def _new(self, trace: Dict[str, List[float]], drive_time_s: float) -> List[Dict[str, float]]:
        # Asked later than the drive: the least difference is the nearest.
        self._ahead_s = min(self._ahead_s, self.truth["time_s"] - drive_time_s)
        found = []
        for k, t in enumerate(trace["time_s"]):
            if t >= self._until_s + STEP_S:
                self._until_s = t
                sample = {name: column[k] for name, column in trace.items()}
                found.append({**sample, "time_s": t - self._ahead_s})
        return found
