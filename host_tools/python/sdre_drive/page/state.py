# SPDX-License-Identifier: MIT
"""State of the page: one thread reads drive and bench, and viewers are shown the result."""

from __future__ import annotations

import threading
import time
from typing import Any, Dict, List, Optional, Tuple

from sdre_drive import faults, move, params, register_map, scope, scope_facts
from sdre_drive.connection import DriveError, Target
from sdre_drive.page.bench_link import BenchLink
from sdre_drive.page.history import History, told
from sdre_drive.page.job import Jobs
from sdre_drive.page.page_drive import PageDrive
from sdre_drive.page.traces import Traces
from sdre_drive.page.viewers import Viewers
from sdre_drive.params import Value
from sdre_drive.registers import Constants, Mode, Reading, block, values
from sdre_drive.scope import Capture, Setup
from sdre_drive.session import MOVING
from sdre_drive.units import speed_words

PERIOD_S = 0.04
RETRY_S = 0.5
SLOW_S = 0.25  # between readings of what only a master changes
BRAKING_S = 10.0  # chosen: a shaft that still turns then is left to coast
STILL_E_RADPS = 5.0  # chosen: the shaft stands, within the noise of the estimate
STILL_S = 0.5  # chosen: a quick stop that stays enabled at rest ends after this
SETTLED_S = 0.1  # chosen: a stop on its way has arrived
QUICK_STOP = (0x6F, 0x07)  # mask and bits of the status word: quick stop active
FAREWELL_S = 2.0  # chosen: so long the end of the program waits for the shaft


class Watcher(threading.Thread):
    """Asks again and again; a drive that goes away and comes back is found again."""

    def __init__(
        self, target: Target, bench: Optional[Tuple[str, int]], pole_pairs: Optional[int]
    ) -> None:
        super().__init__(daemon=True)
        self.drive = PageDrive(target)
        self.bench = BenchLink(bench)
        self.viewers, self.jobs, self.history = Viewers(), Jobs(), History()
        self.traces = Traces()
        self.pole_pairs = pole_pairs  # None: not known yet
        self.constants: Optional[Constants] = None
        self.identity: Dict[int, str] = {}
        self.reading: Optional[Reading] = None
        self.command_e_radps: Optional[float] = None  # register SPEED
        self.where: Optional[move.Where] = None
        self.trouble = "not connected yet"
        self.capture: Optional[Capture] = None
        self.captures = 0
        self.scope_words = ""
        self.parameters: Optional[List[Value]] = None
        self.parameters_words, self.parameters_read = "", 0
        self._parameters_wanted = False
        self._scope: Optional[Setup] = None  # what the scope is at
        self._time_s = 0.0  # of the last reading
        self._slow_s = 0.0
        self._record_wanted: Optional[int] = None
        self._stopping_s: Optional[float] = None  # since when
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
                self.reading, self.where, self.command_e_radps = None, None, None
                pause_s = RETRY_S
            if self.viewers.abandoned():
                self.release()
            samples = self.bench.look(self.reading.time_s if self.reading else None)
            self.traces.take_truth(samples)
            self._end.wait(max(began_s + pause_s - time.monotonic(), 0.0))

    def close(self) -> None:
        """Stops what was started here, and waits a little until the shaft stands."""
        self._end.set()
        if self.started_here:
            self.release()
            self._wait_for_rest()
        self.drive.close()

    def begin_run(self) -> None:
        """The motor is started from here; a stop before that is over."""
        self.started_here = True
        self._stopping_s = None

    def stop_motor(self) -> str:
        """For every viewer, at any time: brakes, then opens the bridge. Asked once more, it opens
        the bridge at once. Words for the answer."""
        self.started_here = False
        self.jobs.end.set()
        reading = self.reading
        brake = bool(reading and reading.mode == Mode.RUN) and self._stopping_s is None
        self._stopping_s = time.monotonic()  # before: a stop that gets lost is sent again
        self.drive.stop_now(brake)
        self._stopping_s = time.monotonic()
        return "STOP: brakes; once more opens the bridge at once" if brake else "STOP: bridge off"

    def release(self) -> None:
        """Stops the motor if it was started here."""
        if self.started_here:
            try:
                self.stop_motor()
            except DriveError:
                pass  # it stops by itself

    def _wait_for_rest(self) -> None:
        end_s = time.monotonic() + FAREWELL_S
        try:
            while self._stopping_s is not None and time.monotonic() < end_s:
                self._stop_again(time.monotonic(), self.drive.read())
                time.sleep(PERIOD_S)
            self.drive.set_run(False)
        except DriveError:
            pass  # it stops by itself

    def require_motor(self) -> Constants:
        """Constants of a drive that answers; DriveError without one."""
        if self.constants is None or self.reading is None:
            raise DriveError(f"the drive does not answer: {self.trouble}")
        return self.constants

    def words_of_speed(self, speed_e_radps: float) -> str:
        """For messages."""
        return speed_words(speed_e_radps, self.pole_pairs)

    def arm_scope(self, setup: Setup) -> None:
        """Arms the scope; its samples are fetched when it is done."""
        scope.arm(self.drive, setup)
        self._scope = setup

    def ask_parameters(self) -> None:
        """They are read with the next look at the drive."""
        self._parameters_wanted = True

    def _look_at_drive(self) -> None:
        asked_s = time.monotonic()
        reading = self.drive.read()
        if self.constants is None:
            self.constants = self.drive.constants()
            self.identity = self.drive.identify()
        self.pole_pairs = self.pole_pairs or self.constants.pole_pairs
        if reading.time_s < self._time_s:
            self._start_again()
        self.reading, self._time_s = reading, reading.time_s
        self._look_at_motion()
        self.traces.take_reading(reading, self.pole_pairs, self.where, self.constants)
        self._stop_again(asked_s, reading)
        if reading.mode == Mode.FAULT:
            self.started_here = False
        self._look_at_fault(reading)
        self._look_at_scope()
        self._look_at_parameters()

    def _start_again(self) -> None:
        """The drive has restarted: its time begins again, and it may have another image."""
        self.traces.clear()
        self.bench.forget()
        self.identity = self.drive.identify()

    def _look_at_motion(self) -> None:
        """Where the shaft is, and what a master, this one or another, asked for."""
        if time.monotonic() >= self._slow_s:
            speed = [register_map.BY_NAME["SPEED"]]
            found = values(speed, self.drive.holding(*block(speed)))
            self.command_e_radps = found["SPEED"]
            self._slow_s = time.monotonic() + SLOW_S
        assert self.constants
        if self.constants.supported_modes & 1:
            self.where = move.where(self.drive)

    def _stop_again(self, asked_s: float, reading: Reading) -> None:
        """A drive that was stopped brakes, or its bridge is opened. A reading that was asked for
        before the stop tells nothing."""
        if self._stopping_s is None or asked_s < self._stopping_s + SETTLED_S:
            return
        age_s = asked_s - self._stopping_s
        mask, bits = QUICK_STOP
        still = abs(reading.speed_e_radps) < STILL_E_RADPS and age_s > STILL_S
        if reading.mode not in (*MOVING, Mode.COMMISSION):
            self._stopping_s = None
        elif reading.statusword & mask != bits or still or age_s > BRAKING_S:
            self.drive.set_run(False)

    def _look_at_fault(self, reading: Reading) -> None:
        self._record_wanted = self.history.see(reading) or self._record_wanted
        if self._record_wanted is not None:
            number, self._record_wanted = self._record_wanted, None
            self.history.keep(number, scope.record(self.drive))

    def _look_at_scope(self) -> None:
        if self._scope is None:
            return
        state = int(self.drive.traces()["SCOPE_STATE"])
        self.scope_words = scope_facts.STATES[state]
        if state == scope_facts.DONE:
            self.scope_words = "is read"
            self.capture, self._scope = scope.read(self.drive, self._scope), None
            self.captures += 1
            self.scope_words = scope_facts.STATES[state]
        elif state == 0:  # the drive has restarted, or another master gave up
            self._scope = None

    def _look_at_parameters(self) -> None:
        if self._parameters_wanted:
            self._parameters_wanted = False
            self.parameters = params.read(self.drive)
            self.parameters_words = f"at its start the drive had {params.stored(self.drive).words}"
            self.parameters_read += 1

    def for_page(self, viewer: str) -> Dict[str, Any]:
        """The present state, as this viewer sees it."""
        reading = self.reading
        return {
            "reading": _told(reading) if reading else None,
            "trouble": self.trouble,
            "command_e_radps": self.command_e_radps,
            "where": vars(self.where) if self.where else None,
            "bench": self.bench.for_page(),
            "armed": self.viewers.state_of(viewer),
            "viewers": self.viewers.count,
            "job": self.jobs.for_page(),
            "scope": {"words": self.scope_words, "number": self.captures},
            "parameters": {"words": self.parameters_words, "number": self.parameters_read},
            "history": self.history.number,
        }


def _told(reading: Reading) -> Dict[str, Any]:
    known = reading.mode in set(Mode)
    entries = faults.explain(reading.why) + faults.warnings(reading.conditions)
    kept = {
        name: getattr(reading, name)
        for name in (
            "mode_of_operation",
            "statusword",
            "mode_words",
            "reset_cause",
            "time_s",
            "speed_e_radps",
            "speed_demand_rpm",
            "iq_A",
            "id_A",
            "dc_link_V",
            "temperature_degC",
            "motor_heat",
            "inverter_heat",
            "derating",
        )
    }
    return {
        **kept,
        "mode": Mode(reading.mode).name if known else "UNKNOWN",
        "messages": [told(e) for e in entries],
    }
