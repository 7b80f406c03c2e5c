# SPDX-License-Identifier: MIT
"""Drives that answer here: serial ports and loopback, asked for their identification (43/14)."""

from __future__ import annotations

import logging
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import Any, Dict, List, Optional

from serial.tools import list_ports

from sdre_drive import register_map
from sdre_drive.connection import MAP_OBJECT, VERSION_OBJECT, Drive, DriveError, Target

log = logging.getLogger(__name__)
# 502 is Modbus's own. From 1502 on: chosen, for some virtual drives at once.
TCP_PORTS = (502, *range(1502, 1512))
NAME_OBJECT = 0x80


@dataclass(frozen=True)
class Found:
    """A drive that has answered."""

    target: Target
    name: str
    firmware: str
    same_map: bool

    @property
    def words(self) -> str:
        """In a line."""
        other = "" if self.same_map else ", with other registers than this sdre-drive"
        return f"{self.target.words}  {self.name}, firmware {self.firmware}{other}"

    def as_dict(self) -> Dict[str, Any]:
        """For --json."""
        return {
            "where": self.target.words,
            "name": self.name,
            "firmware": self.firmware,
            "same_registers": self.same_map,
        }


def ask(target: Target) -> Optional[Found]:
    """None when nothing answers there, or nothing of this kind."""
    try:
        with Drive(target, once=True) as drive:
            own, common = drive.identify(), drive.identify_basic()
    except DriveError:
        return None
    if MAP_OBJECT not in own:
        return None
    return Found(
        target,
        own.get(NAME_OBJECT, "a drive"),
        common.get(VERSION_OBJECT, "of no version"),
        own[MAP_OBJECT] == register_map.DIGEST,
    )


def candidates(line: Target) -> List[Target]:
    """Where a drive could be, with the line's rate, format and address."""
    ports = sorted(port.device for port in list_ports.comports())
    return [replace(line, serial_port=port) for port in ports] + [
        replace(line, tcp_port=port) for port in TCP_PORTS
    ]


def find(line: Target) -> List[Found]:
    """All that answer, at once."""
    places = candidates(line)
    with ThreadPoolExecutor(len(places)) as pool:
        return [found for found in pool.map(ask, places) if found]


def nothing_words(line: Target) -> str:
    """Where nothing was found, and what to do."""
    ports = ", ".join(t.serial_port for t in candidates(line) if t.serial_port) or "none here"
    return (
        f"no drive answers: serial ports ({ports}) at {line.baud}-{line.format}, unit {line.unit}, "
        f"and TCP ports {TCP_PORTS[0]}, {TCP_PORTS[1]} to {TCP_PORTS[-1]} of {line.host}; is it "
        f"on, or `./dev serve` running?"
    )


def the_only_one(line: Target) -> Target:
    """DriveError when there is none, or a choice."""
    all_found = find(line)
    if not all_found:
        raise DriveError(nothing_words(line))
    if len(all_found) > 1:
        places = "; ".join(found.words for found in all_found)
        raise DriveError(f"several drives answer, name one with --port or --tcp: {places}")
    log.info("the only drive here: %s", all_found[0].words)
    return all_found[0].target
