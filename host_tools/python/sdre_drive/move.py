# SPDX-License-Identifier: MIT
"""Profile position: to a number of counts and there, with the hand-shake of docs/modbus.md."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Callable, Optional

from sdre_drive import register_map, session
from sdre_drive.connection import Drive, DriveError
from sdre_drive.registers import ControlWord, Mode, Reading

PROFILE_POSITION = 1  # mode of operation
NEW, AT_ONCE, RELATIVE = 1 << 4, 1 << 5, 1 << 6  # of the control word
REACHED, ACKNOWLEDGED, FOLLOWING = 1 << 10, 1 << 12, 1 << 13  # of the status word
LONGEST_MOVE_S = 600.0  # chosen: the longest acceptable wait


@dataclass(frozen=True)
class Where:
    """Counts of the encoder, of the shaft and of the set-point on the way."""

    now: int
    target: int


def where(drive: Drive) -> Where:
    """Both of one tick."""
    found = drive.values(register_map.POSITION)
    return Where(int(found["POSITION_NOW"]), int(found["POSITION_TARGET"]))


def require_possible(drive: Drive) -> None:
    """DriveError of a drive without positions."""
    if not drive.constants().supported_modes & 1:
        raise DriveError("this drive takes no positions: its file has no [position]")


def _set_point(drive: Drive, counts: int, bits: int) -> None:
    drive.write("CONTROLWORD", ControlWord.ENABLE)
    drive.write("TARGET_POSITION", counts)
    drive.write("CONTROLWORD", ControlWord.ENABLE | bits | NEW)
    if (
        session.wait_for(drive, lambda r: bool(r.statusword & ACKNOWLEDGED), session.ANSWER_WAIT_S)
        is None
    ):
        raise DriveError("the drive does not take the position")
    drive.write("CONTROLWORD", ControlWord.ENABLE)


def go(
    drive: Drive,
    counts: int,
    relative: bool,
    speed_e_radps: float,
    end: threading.Event,
    hold_s: Optional[float],
    show: Callable[[Reading, Where], None],
) -> Where:
    """Goes there and holds the shaft until `end`, or for hold_s after it has arrived; then stops.
    Where it was in the end."""
    require_possible(drive)
    session.require_mode(drive.read(), PROFILE_POSITION)
    drive.write("PROFILE_VELOCITY", speed_e_radps)
    try:
        session.start(drive, 0.0, PROFILE_POSITION)
        if (
            session.wait_for(drive, lambda r: r.mode in (Mode.RUN, Mode.FAULT), session.STOP_WAIT_S)
            is None
        ):
            raise DriveError("the drive does not come to run")
        _set_point(drive, counts, AT_ONCE | (RELATIVE if relative else 0))
        arrived_s: Optional[float] = None
        found = where(drive)
        for reading in session.follow(drive, end, length_s=LONGEST_MOVE_S):
            found = where(drive)
            show(reading, found)
            session.require_moving(reading)
            if reading.statusword & REACHED and arrived_s is None:
                arrived_s = reading.time_s
            if (
                arrived_s is not None
                and hold_s is not None
                and reading.time_s - arrived_s >= hold_s
            ):
                break
    except DriveError:
        session.withdraw(drive)
        raise
    session.stop(drive)
    return found
