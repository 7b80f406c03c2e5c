# SPDX-License-Identifier: MIT
"""Profile position: to a number of position units, with the hand-shake of docs/modbus.md."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Callable, Optional

from sdre_drive import register_map, session
from sdre_drive.connection import Drive, DriveError
from sdre_drive.registers import ANGLE_KNOWN, PROFILE_POSITION, ControlWord, Reading
from sdre_drive.units import e_radps_of

NEW, AT_ONCE, RELATIVE = 1 << 4, 1 << 5, 1 << 6  # of the control word
REACHED, ACKNOWLEDGED, FOLLOWING = 1 << 10, 1 << 12, 1 << 13  # of the status word
LONGEST_MOVE_S = 600.0  # chosen: the longest acceptable wait
FAR_TURNS = 10.0  # chosen: beyond, a shaft that counts from another zero unwinds for long
DEFAULT_RPM = 300.0  # chosen: five turns in a second are seen
ZEROS = {1: "where the rotor was aligned", 2: "the index mark"}  # of register REFERENCE


@dataclass(frozen=True)
class Where:
    """Position units, of the shaft and of the set-point on the way."""

    now: int
    target: int

    def words(self, turn: float) -> str:
        """In turns of the motor of so many position units."""
        return f"{self.now / turn:.4f} of {self.target / turn:.4f} turns"


def where(drive: Drive) -> Where:
    """Both of one tick."""
    found = drive.values(register_map.POSITION)
    return Where(int(found["POSITION_NOW"]), int(found["POSITION_TARGET"]))


def require_possible(drive: Drive) -> None:
    """DriveError of a drive without positions."""
    if not drive.constants().supported_modes & 1:
        raise DriveError("this drive takes no positions: its file has no [position]")


@dataclass(frozen=True)
class Wanted:
    """A command to move: position units from the zero, or from where the shaft is."""

    units: int
    relative: bool = False
    speed_e_radps: float = 0.0  # largest on the way; 0: what the drive can
    far: bool = False  # more than FAR_TURNS are meant


class Far(DriveError):
    """More than FAR_TURNS, and nobody said that they are meant."""


def require_near(drive: Drive, wanted: Wanted) -> None:
    """Far when the shaft is further away than one would think."""
    now = where(drive).now
    turn = drive.constants().turn_units
    turns = abs(wanted.units if wanted.relative else wanted.units - now) / turn
    if turns > FAR_TURNS and not wanted.far:
        raise Far(
            f"that is {turns:.1f} turns away: the shaft is {now / turn:.2f} turns from its zero; "
            f"--far goes there, --relative counts from where it is"
        )


def zero_words(drive: Drive) -> str:
    """The zero of positions."""
    reference = int(drive.values(register_map.LIVE)["REFERENCE"])
    return ZEROS.get(reference, "not known yet")


def default_speed(drive: Drive) -> float:
    """rad/s electrical: the drive's own parameter, or a quiet one."""
    kept = drive.parameter("PROFILE_VELOCITY")
    known = drive.constants()
    return kept or min(e_radps_of(DEFAULT_RPM, known.pole_pairs), known.speed_max_e_radps)


def _set_point(drive: Drive, units: int, bits: int) -> None:
    drive.write("CONTROLWORD", ControlWord.ENABLE)
    drive.write("TARGET_POSITION", units)
    drive.write("CONTROLWORD", ControlWord.ENABLE | bits | NEW)
    if (
        session.wait_for(drive, lambda r: bool(r.statusword & ACKNOWLEDGED), session.ANSWER_WAIT_S)
        is None
    ):
        raise DriveError("the drive does not take the position")
    drive.write("CONTROLWORD", ControlWord.ENABLE)


def _enable(drive: Drive, wanted: Wanted) -> None:
    """The drive has the shaft, and the way is as long as it should be."""
    session.come_to_run(drive, PROFILE_POSITION)
    require_near(drive, wanted)


def begin(drive: Drive, wanted: Wanted) -> None:
    """The shaft is on its way. Whatever goes wrong once the drive is ours: run is withdrawn."""
    require_possible(drive)
    reading = drive.read()
    session.require_mode(reading, PROFILE_POSITION)
    session.require_speed(drive, wanted.speed_e_radps)
    if reading.statusword & ANGLE_KNOWN:
        require_near(drive, wanted)
    drive.write("PROFILE_VELOCITY", wanted.speed_e_radps)
    try:
        _enable(drive, wanted)
        _set_point(drive, wanted.units, AT_ONCE | (RELATIVE if wanted.relative else 0))
    except DriveError:
        session.withdraw(drive)
        raise


def go(
    drive: Drive,
    wanted: Wanted,
    end: threading.Event,
    hold_s: Optional[float],
    show: Callable[[Reading, Where], None],
    at_once: Optional[threading.Event] = None,
) -> Where:
    """Goes there and holds the shaft until `end`, or for hold_s after it has arrived; then stops.
    Where it was in the end."""
    begin(drive, wanted)
    try:
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
    session.stop(drive, at_once)
    return found
