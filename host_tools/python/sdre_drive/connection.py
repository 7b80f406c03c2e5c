# SPDX-License-Identifier: MIT
"""A drive at the other end of a serial port, of a TCP connection, or of a CAN bus."""

from __future__ import annotations

import logging
import threading
from typing import Dict, List, Optional, Sequence, Tuple

from sdre_drive import register_map, registers
from sdre_drive.link import (
    EXCEPTION_WORDS,
    MAP_OBJECT,
    VERSION_OBJECT,
    DriveError,
    Link,
    Refused,
    Target,
)
from sdre_drive.modbus_link import FORMATS, ModbusLink, is_pseudo_terminal, why_closed
from sdre_drive.register_map import Register
from sdre_drive.registers import BY_NAME, Constants, ControlWord, Reading

__all__ = [
    "EXCEPTION_WORDS",
    "FORMATS",
    "MAP_OBJECT",
    "VERSION_OBJECT",
    "Drive",
    "DriveError",
    "Refused",
    "Target",
    "is_pseudo_terminal",
    "nodes_of",
    "other_map",
    "why_closed",
]

log = logging.getLogger(__name__)
TRIES = 2


def other_map(firmware: str) -> str:
    """Says which side to update when the firmware has another register map."""

    def numbers(version: str) -> Tuple[int, ...]:
        return tuple(int(n) for n in version.split(".") if n.isdigit())

    here = register_map.VERSION
    what = (
        f"the drive's firmware {firmware or 'of no version'} has other registers than this "
        f"sdre-drive {here}"
    )
    if numbers(firmware) < numbers(here):
        return f"{what}: update the firmware, or use sdre-drive {firmware or 'of its build'}"
    if numbers(firmware) > numbers(here):
        return f"{what}: update sdre-drive"
    return f"{what}: take both from one build"


def link_to(target: Target, tries: int) -> Link:
    """The link that this address needs; DriveError when CAN is not installed."""
    if not target.can:
        return ModbusLink(target, tries)
    try:
        from sdre_drive.can_link import CanLink
    except ImportError as e:
        raise DriveError(
            "CAN needs the packages python-can and canopen: pip install 'sdre-drive[can]'"
        ) from e
    return CanLink(target, tries)


def nodes_of(target: Target) -> List[Tuple[Target, Dict[int, str]]]:
    """Nodes of a CAN bus with the texts of their identification."""
    link_to(target, 1)  # what CAN needs is installed
    from sdre_drive import can_discover

    return can_discover.find(target)


class Drive:
    """Blocking requests; one at a time, from any thread. All of them raise DriveError."""

    def __init__(self, target: Target, once: bool = False) -> None:
        """`once`: a question without an answer is not asked again."""
        self.target = target
        self._tries = 1 if once else TRIES
        self._lock = threading.Lock()
        self._constants: Optional[Constants] = None
        self._link = link_to(target, self._tries)

    def move_to(self, target: Target) -> None:
        """The drive has another line or address from now on."""
        with self._lock:
            self._link.close()
            self.target = target
            self._link = link_to(target, self._tries)

    def __enter__(self) -> Drive:
        self.open()
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def open(self) -> None:
        """Connects; a drive that is not there is known here."""
        with self._lock:
            self._link.open()

    def close(self) -> None:
        """The drive stops by itself 500 ms later."""
        with self._lock:
            self._link.close()

    def read(self) -> Reading:
        """The live registers of one tick."""
        period_s = self.constants().period_s
        return registers.decode(self._block(register_map.LIVE), period_s)

    def constants(self) -> Constants:
        """Constants of the drive, read once."""
        if self._constants is None:
            self._check_map()
            self._constants = registers.constants(self._block(register_map.CONSTANTS))
            log.info("%s: %s", self.target.words, self._constants)
        return self._constants

    def _check_map(self) -> None:
        """DriveError when firmware and tool are of different register maps: which side to
        update."""
        told = self.identify()
        if told.get(MAP_OBJECT) == register_map.DIGEST:
            return
        raise DriveError(other_map(self.identify_basic().get(VERSION_OBJECT, "")))

    def traces(self) -> Dict[str, float]:
        """How scope and record stand."""
        return self.values(register_map.TRACES)

    def values(self, wanted: Sequence[Register]) -> Dict[str, float]:
        """A block of input registers of one tick, by name in SI units."""
        return registers.values(wanted, self._block(wanted))

    def words(self, first: int, count: int) -> List[int]:
        """Input registers as they are."""
        with self._lock:
            values = self._link.read_input(first, count)
        if len(values) != count:
            raise DriveError("the drive answered something else than it was asked")
        return values

    def holding(self, first: int, count: int) -> List[int]:
        """Holding registers as they are."""
        with self._lock:
            return self._link.read_holding(first, count)

    def parameter(self, name: str) -> float:
        """A holding register, in its unit."""
        r = BY_NAME[name]
        return registers.value_of(r, self.holding(r.address, registers.WORDS[r.type]))

    def write(self, name: str, value: float) -> None:
        """A holding register, in its unit."""
        r = BY_NAME[name]
        log.info("%s: writes %s = %g %s", self.target.words, name, value, r.unit)
        try:
            words = registers.words_of(r, value)
        except ValueError as e:
            raise DriveError(str(e)) from e
        self.write_words(r.address, words)

    def _block(self, wanted: Sequence[Register]) -> List[int]:
        return self.words(*registers.block(wanted))

    def set_speed(self, speed_e_radps: float) -> None:
        """rad/s electrical; acts when the drive runs."""
        self.write("SPEED", speed_e_radps)

    def set_run(self, run: bool) -> None:
        """Enables the operation after a shut down, or stops any run."""
        for word in (
            (ControlWord.SHUT_DOWN, ControlWord.ENABLE) if run else (ControlWord.DISABLE_VOLTAGE,)
        ):
            self.write("CONTROLWORD", word)

    def reset(self) -> None:
        """Leaves FAULT when what caused it has gone."""
        for word in (
            ControlWord.DISABLE_VOLTAGE,
            ControlWord.FAULT_RESET,
            ControlWord.DISABLE_VOLTAGE,
        ):
            self.write("CONTROLWORD", word)

    def identify(self) -> Dict[int, str]:
        """Texts of the drive's identification, from its name on."""
        with self._lock:
            return self._link.identify()

    def identify_basic(self) -> Dict[int, str]:
        """Vendor, product and firmware version."""
        with self._lock:
            return self._link.identify_basic()

    def write_words(self, first: int, values: Sequence[int]) -> None:
        """Holding registers as they are; they act together."""
        with self._lock:
            self._link.write(first, values)
