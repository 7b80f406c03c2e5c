# SPDX-License-Identifier: MIT
"""Address, requests and errors are the same on every way to a drive."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, List, Optional, Sequence

# Numbers of the identification, as in function 43/14 of Modbus.
VERSION_OBJECT = 2
NAME_OBJECT, DIGEST_OBJECT, MAP_OBJECT, BOARD_OBJECT = 0x80, 0x81, 0x82, 0x83

NO_REGISTER, OUT_OF_RANGE, NOT_NOW = 2, 3, 4
EXCEPTION_WORDS = {
    1: "does not know this function",
    NO_REGISTER: "does not have this register",
    OUT_OF_RANGE: "refuses this value: it is out of the drive's range",
    NOT_NOW: "does not take or tell this now",
    11: "did not answer behind its gateway",
}


class DriveError(Exception):
    """One line for the user."""


class Refused(DriveError):
    """The drive has answered, with an exception."""


@dataclass(frozen=True)
class Target:
    """Where the drive is: a CAN channel, a serial port, or host and port of Modbus/TCP."""

    serial_port: Optional[str] = None
    host: str = "127.0.0.1"
    tcp_port: int = 1502
    baud: int = 115200
    format: str = "8E1"
    unit: int = 1
    can: Optional[str] = None  # channel of python-can
    can_interface: str = "slcan"  # of python-can
    can_rate: int = 500000  # bit/s
    node: int = 1

    @property
    def words(self) -> str:
        """For messages."""
        if self.can:
            return f"node {self.node} on CAN {self.can}"
        return self.serial_port or f"{self.host}:{self.tcp_port}"

    @property
    def is_local(self) -> bool:
        """Modbus/TCP of this machine, as a virtual drive has it."""
        here = self.host in ("127.0.0.1", "localhost", "::1")
        return here and self.serial_port is None and self.can is None


class Link:
    """Blocking requests to one drive, one at a time. All of them raise DriveError; Refused when the
    drive has answered with an exception."""

    def open(self) -> None:
        """Connects; a drive or adapter that is not there is known here."""
        raise NotImplementedError

    def close(self) -> None:
        """Ends the connection; the next request opens it again."""
        raise NotImplementedError

    def read_input(self, first: int, count: int) -> List[int]:
        """Input registers; up to 64 are of one tick."""
        raise NotImplementedError

    def read_holding(self, first: int, count: int) -> List[int]:
        """Holding registers."""
        raise NotImplementedError

    def write(self, first: int, words: Sequence[int]) -> None:
        """Holding registers; they act together, or none does."""
        raise NotImplementedError

    def identify(self) -> Dict[int, str]:
        """Texts by their numbers: drive, its digest, digest of the registers, board."""
        raise NotImplementedError

    def identify_basic(self) -> Dict[int, str]:
        """Vendor, product and firmware version."""
        raise NotImplementedError
