# SPDX-License-Identifier: MIT
"""Starting, following and stopping a drive, with its own rules: docs/modbus.md."""

from __future__ import annotations

import math
import threading
import time
from typing import Callable, Iterator, Optional

from sdre_drive import faults, register_map
from sdre_drive.connection import Drive, DriveError
from sdre_drive.registers import (
    ANGLE_KNOWN,
    PROFILE_VELOCITY,
    RUNS,
    ControlWord,
    Mode,
    Reading,
)
from sdre_drive.units import speed_words

MOVING = (Mode.PRECHARGE, Mode.ALIGN, Mode.RUN)
PERIOD_S = 0.05  # well below the 500 ms after which the drive stops by itself
BOOT_WAIT_S = 3.0  # chosen: the firmware needs 0.3 s
ANSWER_WAIT_S = 1.0  # a command acts within a tick or two
STOP_WAIT_S = 20.0  # chosen: mode STOP brakes first
HALT = 1 << 8  # of the control word: to zero speed, and stays enabled
STILL_E_RADPS = 2.0  # chosen: less than the estimate's noise at rest would never come
STILL_READINGS = 3  # in a row: a shaft that only passes zero does not stand
SLOWER_E_RADPS = 1.0  # in STOP_WAIT_S: with less a ramp does not end
REST_CNT = 4  # as the alignment's (host_tools/design/board): more is no rest
REST_S = 0.15  # chosen: half as long again as it watches
REST_WAIT_S = 30.0  # chosen: a motor with bearings alone has come to rest; what turns on is driven
MOST_ERRORS = 3  # in a row; a single lost answer is nothing


class Tripped(DriveError):
    """The drive is in FAULT."""

    def __init__(self, reading: Reading) -> None:
        entries = faults.explain(reading.why)
        super().__init__(
            "the drive has tripped: " + (faults.one_line(entries[0]) if entries else "unknown")
        )
        self.reading = reading


def wait_for(
    drive: Drive, wanted: Callable[[Reading], bool], longest_s: float
) -> Optional[Reading]:
    """The first matching reading; None when it does not come. Time is the drive's own, because a
    virtual drive may be slow."""
    begin_s = None
    while True:
        reading = drive.read()
        if wanted(reading):
            return reading
        if begin_s is None or reading.time_s < begin_s:  # it has restarted
            begin_s = reading.time_s
        if reading.time_s > begin_s + longest_s:
            return None
        time.sleep(PERIOD_S / 2)


def require_mode(reading: Reading, mode: int = PROFILE_VELOCITY) -> None:
    """DriveError when the drive runs in another mode of operation than this; to be asked before
    anything is written."""
    if reading.mode in MOVING and reading.mode_of_operation != mode:
        raise DriveError("the drive runs in another mode of operation: stop it first")


def require_speed(drive: Drive, speed_e_radps: float) -> None:
    """DriveError with the limit when the drive does not take that speed."""
    known = drive.constants()
    if abs(speed_e_radps) > known.speed_max_e_radps:
        raise DriveError(
            f"{speed_words(speed_e_radps, known.pole_pairs)} is out of the drive's range: at most "
            f"{speed_words(known.speed_max_e_radps, known.pole_pairs)}, either way"
        )


def wait_for_rest(drive: Drive) -> None:
    """Waits for a shaft that coasts, REST_WAIT_S at most: an alignment refuses one that turns."""
    counts = drive.constants().encoder_counts
    mark_s, mark_cnt = math.inf, 0.0

    def rests(reading: Reading) -> bool:
        nonlocal mark_s, mark_cnt
        now_cnt = drive.values(register_map.LIVE)["POSITION"]
        restarted = reading.time_s < mark_s  # or the first reading
        if restarted or abs(math.remainder(now_cnt - mark_cnt, counts)) > REST_CNT:
            mark_s, mark_cnt = reading.time_s, now_cnt
        return reading.time_s > mark_s + REST_S

    wait_for(drive, rests, REST_WAIT_S)


def start(drive: Drive, speed_e_radps: float, mode: int = PROFILE_VELOCITY) -> None:
    """Starts it in a mode of operation, or gives one that runs in it this speed (rad/s
    electrical)."""
    reading = wait_for(drive, lambda r: r.mode in (Mode.READY, Mode.FAULT, *MOVING), BOOT_WAIT_S)
    if reading is None:
        raise DriveError(f"the drive does not get ready: it {drive.read().mode_words}")
    if reading.mode == Mode.FAULT:
        raise Tripped(reading)
    require_mode(reading, mode)
    require_speed(drive, speed_e_radps)
    drive.set_speed(speed_e_radps)
    if reading.mode in MOVING:
        return
    in_the_way = faults.bits("condition", reading.conditions & faults.NO_START)
    if in_the_way:
        raise DriveError("the drive cannot start: " + " ".join(e.meaning for e in in_the_way))
    drive.write("MODE_OF_OPERATION", mode)
    if not reading.statusword & ANGLE_KNOWN:
        wait_for_rest(drive)
    drive.set_run(False)  # enabling has to rise
    drive.set_run(True)
    reading = wait_for(drive, lambda r: r.mode != Mode.READY, ANSWER_WAIT_S)
    if reading is None:
        raise DriveError("the drive does not start")
    if reading.mode == Mode.FAULT:
        raise Tripped(reading)


def come_to_run(drive: Drive, mode: int) -> Reading:
    """Starts it in a mode of operation at rest, and waits until it runs or is in FAULT."""
    start(drive, 0.0, mode)
    reading = wait_for(drive, lambda r: r.mode in (Mode.RUN, Mode.FAULT), STOP_WAIT_S)
    if reading is None:
        raise DriveError("the drive does not come to run")
    return reading


def run_steady(
    drive: Drive, speed_e_radps: float, within: float, settle_s: float, longest_s: float
) -> None:
    """Starts it at this speed (rad/s electrical), and waits until the speed is there within this
    share, and settle_s more."""
    start(drive, speed_e_radps)

    def is_there(reading: Reading) -> bool:
        require_moving(reading)
        off = abs(reading.speed_e_radps / speed_e_radps - 1.0)
        return reading.mode == Mode.RUN and off < within

    first = wait_for(drive, is_there, longest_s)
    if first is None:
        raise DriveError("the drive does not reach the speed")
    wait_for(drive, lambda r: r.time_s > first.time_s + settle_s, longest_s)


class _Ramp:
    """Whether a shaft that is to stop stands, or gets no slower."""

    def __init__(self) -> None:
        self._still = 0
        self._least = math.inf
        self._since_s = math.inf

    def is_over(self, reading: Reading) -> bool:
        """After each reading."""
        speed = abs(reading.speed_e_radps)
        self._still = self._still + 1 if speed < STILL_E_RADPS else 0
        if speed < self._least - SLOWER_E_RADPS:
            self._least, self._since_s = speed, reading.time_s
        stuck = reading.time_s > self._since_s + STOP_WAIT_S
        return self._still >= STILL_READINGS or stuck


def ramp_down(drive: Drive, at_once: Optional[threading.Event] = None) -> None:
    """Brings a shaft that the drive has to rest, with the drive's own ramp (DECELERATION). Ends
    early by `at_once`, with the drive, or when the shaft gets no slower."""
    reading = drive.read()
    if reading.mode != Mode.RUN or reading.mode_of_operation not in RUNS:
        return
    drive.write("CONTROLWORD", ControlWord.ENABLE | HALT)
    ramp = _Ramp()
    for reading in follow(drive, at_once or threading.Event(), PERIOD_S / 2):
        if reading.mode != Mode.RUN or ramp.is_over(reading):
            return


def stop(drive: Drive, at_once: Optional[threading.Event] = None, coast: bool = False) -> Reading:
    """Ends a run or commissioning, and waits until the bridge is off. A run comes to rest by its
    ramp first, unless it may coast."""
    try:
        if not coast:
            ramp_down(drive, at_once)
    finally:
        drive.set_run(False)
    reading = wait_for(
        drive, lambda r: r.mode not in (*MOVING, Mode.STOP, Mode.COMMISSION), STOP_WAIT_S
    )
    if reading is None:
        raise DriveError(f"the drive does not stop: it {drive.read().mode_words}")
    return reading


def reset(drive: Drive) -> Reading:
    """Leaves FAULT; Tripped when it comes back or stays."""
    drive.reset()
    reading = wait_for(drive, lambda r: r.mode == Mode.READY, ANSWER_WAIT_S)
    if reading is None:
        raise Tripped(drive.read())
    return reading


def follow(
    drive: Drive, end: threading.Event, period_s: float = PERIOD_S, length_s: Optional[float] = None
) -> Iterator[Reading]:
    """Readings until `end` is set or length_s is over. The readings keep the drive running."""
    began_s = time.monotonic()
    next_s = began_s
    errors = 0
    while not end.is_set() and (length_s is None or time.monotonic() - began_s < length_s):
        try:
            reading = drive.read()
        except DriveError:
            errors += 1
            if errors >= MOST_ERRORS:
                raise
            continue
        errors = 0
        yield reading
        next_s = max(next_s + period_s, time.monotonic())
        end.wait(max(next_s - time.monotonic(), 0.0))


def require_moving(reading: Reading) -> None:
    """Raises the reason why a started drive has stopped."""
    if reading.mode == Mode.FAULT:
        raise Tripped(reading)
    if reading.mode in (Mode.BOOT, Mode.CALIBRATE):
        watchdog = (
            "; its watchdog flag is set: the program before may have hung"
            if reading.reset_cause == 1
            else ""
        )
        raise DriveError(f"the drive has restarted{watchdog}")
    if reading.mode == Mode.READY:
        silent = reading.conditions & 2
        raise DriveError(
            "the drive has stopped: "
            + (faults.find("condition", 2).meaning if silent else "another master stopped it")
        )


def hold(
    drive: Drive,
    speed_e_radps: float,
    end: threading.Event,
    length_s: Optional[float],
    show: Callable[[Reading], None],
    at_once: Optional[threading.Event] = None,
) -> Reading:
    """Runs at this speed until `end` or for length_s, then stops by its ramp. Whatever goes wrong
    once it is ours: run is withdrawn."""
    require_mode(drive.read())
    try:
        start(drive, speed_e_radps)
        for reading in follow(drive, end, length_s=length_s):
            show(reading)
            require_moving(reading)
    except DriveError:
        withdraw(drive)
        raise
    return stop(drive, at_once)


def withdraw(drive: Drive) -> None:
    """As far as it still listens; if not, it stops by itself."""
    try:
        drive.set_run(False)
    except DriveError:
        pass
