# SPDX-License-Identifier: MIT
"""Profile torque: along a slope to a torque, with a speed limit, as in docs/modbus.md."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Callable, Optional

from sdre_drive import register_map, session
from sdre_drive.connection import Drive, DriveError
from sdre_drive.registers import PROFILE_TORQUE, Reading
from sdre_drive.units import rpm_of

SUPPORTED = 1 << (PROFILE_TORQUE - 1)  # of SUPPORTED_MODES
MOST_SHARE = 32.0  # of the rated torque, that the register holds
DEFAULT_RPM = 300.0  # chosen: a free shaft turns as fast as this, and is seen to


@dataclass(frozen=True)
class Torque:
    """Torques by the drive's model: that of its currents, and that of their references."""

    now_Nm: float
    demand_Nm: float

    def words(self, wanted_Nm: float) -> str:
        """Beside what was asked for."""
        return f"{self.now_Nm:.3f} of {wanted_Nm:.3f} N m"


def rated_Nm(drive: Drive) -> float:
    """Returns the torque that the shares are of."""
    return drive.values(register_map.TORQUE_NOW)["RATED_TORQUE"]


def now(drive: Drive) -> Torque:
    """Both of one tick."""
    found = drive.values(register_map.TORQUE_NOW)
    per_share = found["RATED_TORQUE"]
    return Torque(found["TORQUE_NOW"] * per_share, found["TORQUE_DEMAND"] * per_share)


def require_possible(drive: Drive) -> None:
    """DriveError of a drive without torques."""
    if not drive.constants().supported_modes & SUPPORTED:
        raise DriveError("this drive takes no torques: its file has no [torque]")


@dataclass(frozen=True)
class Wanted:
    """A command: a torque and its speed limit."""

    torque_Nm: float
    speed_e_radps: float  # either way

    def share(self, drive: Drive) -> float:
        """Returns the share of the rated torque; DriveError beyond what a register holds."""
        share = self.torque_Nm / rated_Nm(drive)
        if not abs(share) <= MOST_SHARE:
            raise DriveError(
                f"{self.torque_Nm:g} N m is out of range: at most {MOST_SHARE:g} times the rated "
                "torque"
            )
        return share


def begin(drive: Drive, wanted: Wanted) -> None:
    """The torque is on its way; a drive that runs in this mode changes to it. Whatever goes wrong
    once the drive is ours: run is withdrawn."""
    require_possible(drive)
    reading = drive.read()
    session.require_mode(reading, PROFILE_TORQUE)
    session.require_speed(drive, wanted.speed_e_radps)
    share = wanted.share(drive)
    if reading.mode not in session.MOVING:
        drive.write("TORQUE", 0.0)
    drive.write("TORQUE_SPEED_MAX", rpm_of(wanted.speed_e_radps, drive.constants().pole_pairs))
    try:
        session.require_moving(session.come_to_run(drive, PROFILE_TORQUE))
        drive.write("TORQUE", share)
    except DriveError:
        session.withdraw(drive)
        raise


def hold(
    drive: Drive,
    wanted: Wanted,
    end: threading.Event,
    length_s: Optional[float],
    show: Callable[[Reading, Torque], None],
    at_once: Optional[threading.Event] = None,
) -> Reading:
    """Holds this torque until `end` or for length_s, then stops by the ramp of the speed."""
    begin(drive, wanted)
    try:
        for reading in session.follow(drive, end, length_s=length_s):
            show(reading, now(drive))
            session.require_moving(reading)
    except DriveError:
        session.withdraw(drive)
        raise
    return session.stop(drive, at_once)
