# SPDX-License-Identifier: MIT
"""State of the page: one thread reads drive and bench, and pages show the result."""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from typing import Any, Callable, Deque, Dict, List, NamedTuple, Optional, Tuple

from sdre_drive import params, scope, session
from sdre_drive.bench import Bench
from sdre_drive.connection import Drive, DriveError, Target
from sdre_drive.params import Stored, Value
from sdre_drive.registers import Mode, Reading
from sdre_drive.scope import Capture, Setup

TRACE_S = 10.0  # what is shown
TRUTH_STEP_S = 5e-3  # the bench has a sample per millisecond; a screen shows less
PERIOD_S = 0.04
RETRY_S = 1.0
SCOPE_STATES = ("idle", "fills", "waits for its trigger", "takes", "done")
ABANDONED_S = 2.0  # without any page that is open, a motor that was started here is stopped


class Point(NamedTuple):
    """A sample of the traces; time since the drive's start, s: a virtual one may be slower than the
    clock."""

    time_s: float
    speed_e_radps: float
    iq_A: float
    id_A: float
    dc_link_V: float


class Watcher(threading.Thread):
    """Asks again and again; a drive that goes away and comes back is found again."""

    def __init__(
        self, target: Target, bench: Optional[Tuple[str, int]], pole_pairs: Optional[int]
    ) -> None:
        super().__init__(daemon=True)
        self.drive = Drive(target)
        self.pole_pairs = pole_pairs  # None: not known yet
        self.reading: Optional[Reading] = None
        self.truth: Dict[str, Any] = {}
        self.drive_trace: Deque[Point] = deque()
        self.true_trace: Deque[Point] = deque()
        self.trouble = "not connected yet"
        self.capture: Optional[Capture] = None
        self.scope_words = ""
        self.parameters: Optional[List[Value]] = None
        self.parameters_words = ""
        self._parameters_wanted = False
        self._scope: Optional[Setup] = None  # what the scope is at
        self.bench_address = bench
        self.seen_s = time.monotonic()  # when a page was open last
        self._bench: Optional[Bench] = None
        self._bench_lock = threading.Lock()
        self._bench_retry_s = 0.0
        self._truth_until_s = -1.0  # simulated time
        self._ahead_s = math.inf  # of the simulated time before the drive's own
        self.started_here = False
        self._end = threading.Event()

    def run(self) -> None:
        """Until close()."""
        while not self._end.is_set():
            began_s = time.monotonic()
            try:
                self._look_at_drive()
                self.trouble = ""
                pause_s = PERIOD_S
            except DriveError as e:
                self.trouble = str(e)
                self.reading = None
                pause_s = RETRY_S / 2
            self._look_at_bench()
            self._end.wait(max(began_s + pause_s - time.monotonic(), 0.0))

    def close(self) -> None:
        """Stops what was started here."""
        self._end.set()
        self.release()
        self.drive.close()

    def start_motor(self, speed_e_radps: float) -> None:
        """Or gives it another speed."""
        self.started_here = True
        session.start(self.drive, speed_e_radps)

    def stop_motor(self) -> None:
        """Withdraws run; what it does then is to be seen."""
        self.started_here = False
        self.drive.set_run(False)

    def reset(self) -> None:
        """Leaves FAULT."""
        session.reset(self.drive)

    def arm_scope(self, setup: Setup) -> None:
        """Arms the scope; its samples are fetched when it is done."""
        scope.arm(self.drive, setup)
        self._scope = setup

    def ask_parameters(self) -> None:
        """They are read with the next look at the drive."""
        self._parameters_wanted = True

    def write_parameters(self, wanted: Dict[str, float]) -> None:
        """Writes the parameters that differ; all are then read again in any case."""
        try:
            params.write(self.drive, wanted)
        finally:
            self.ask_parameters()

    def save_parameters(self) -> None:
        """The drive restarts."""
        self._restart(params.save)

    def restore_parameters(self) -> None:
        """The drive restarts."""
        self._restart(params.restore)

    def _restart(self, command: Callable[[Drive], Stored]) -> None:
        self.parameters_words = "is stored: the drive restarts"
        try:
            command(self.drive)
        finally:
            self.ask_parameters()

    def tell_bench(self, command: str) -> None:
        """Load, supply, faults of a virtual drive."""
        with self._bench_lock:
            if self._bench is None:
                raise DriveError("there is no bench: this is not a virtual drive")
            self._bench.ask(command)

    def release(self) -> None:
        """Stops the motor if it was started here."""
        if self.started_here:
            try:
                self.stop_motor()
            except DriveError:
                pass  # it stops by itself

    def _look_at_drive(self) -> None:
        reading = self.drive.read()
        self.pole_pairs = self.pole_pairs or self.drive.constants().pole_pairs
        if self.reading and reading.time_s < self.reading.time_s:
            self._forget()
        self.reading = reading
        _append(
            self.drive_trace,
            Point(
                reading.time_s, reading.speed_e_radps, reading.iq_A, reading.id_A, reading.dc_link_V
            ),
        )
        if reading.mode == Mode.FAULT:
            self.started_here = False
        self._look_at_scope()
        self._look_at_parameters()
        if time.monotonic() > self.seen_s + ABANDONED_S:
            self.release()

    def _look_at_scope(self) -> None:
        if self._scope is None:
            return
        state = int(self.drive.traces()["SCOPE_STATE"])
        self.scope_words = SCOPE_STATES[state]
        if state == scope.DONE:
            self.scope_words = "is read"
            self.capture, self._scope = scope.read(self.drive, self._scope), None
            self.scope_words = SCOPE_STATES[state]
        elif state == 0:  # the drive has restarted, or another master gave up
            self._scope = None

    def _look_at_parameters(self) -> None:
        if self._parameters_wanted:
            self._parameters_wanted = False
            self.parameters = params.read(self.drive)
            self.parameters_words = f"at its start the drive had {params.stored(self.drive).words}"

    def _look_at_bench(self) -> None:
        if self.bench_address is None or time.monotonic() < self._bench_retry_s:
            return
        try:
            with self._bench_lock:
                self._bench = self._bench or Bench(self.bench_address)
                self.truth = self._bench.ask("state")
                trace = self._bench.ask("trace 0.5")
            self._take(trace)
        except DriveError:
            self._bench, self.truth = None, {}
            self._bench_retry_s = time.monotonic() + RETRY_S

    def _forget(self) -> None:
        """The drive has restarted: its time begins again."""
        self.drive_trace.clear()
        self.true_trace.clear()
        self._truth_until_s, self._ahead_s = -1.0, math.inf

    def _take(self, trace: Dict[str, List[float]]) -> None:
        """Takes new samples of the true motor, at the drive's time."""
        if self.reading is None:
            return
        # Asked later than the drive: the least difference is the nearest.
        self._ahead_s = min(self._ahead_s, self.truth["time_s"] - self.reading.time_s)
        for k, t in enumerate(trace["time_s"]):
            if t >= self._truth_until_s + TRUTH_STEP_S:
                self._truth_until_s = t
                _append(
                    self.true_trace,
                    Point(
                        t - self._ahead_s,
                        trace["speed_e_radps"][k],
                        trace["iq_A"][k],
                        trace["id_A"][k],
                        trace["dc_link_V"][k],
                    ),
                )


def _append(trace: Deque[Point], point: Point) -> None:
    trace.append(point)
    while trace and trace[0].time_s < point.time_s - TRACE_S:
        trace.popleft()


def column(
    trace: Deque[Point], value: Callable[[Point], float], now_s: float
) -> List[Tuple[float, float]]:
    """(seconds ago as a negative number, value) for a plot."""
    return [(round(p.time_s - now_s, 3), round(value(p), 3)) for p in list(trace)]
