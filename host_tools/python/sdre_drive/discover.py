# SPDX-License-Identifier: MIT
"""Drives that answer here: serial ports and loopback, or the nodes of a CAN bus."""

from __future__ import annotations

import logging
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import Any, Dict, List, Mapping, Optional

from serial.tools import list_ports

from sdre_drive import register_map
from sdre_drive.connection import Drive, DriveError, Target, nodes_of
from sdre_drive.link import MAP_OBJECT, NAME_OBJECT, VERSION_OBJECT

log = logging.getLogger(__name__)
# 502 is Modbus's own. From 1502 on: chosen, for some virtual drives at once.
TCP_PORTS = (502, *range(1502, 1512))


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
    return _found(target, {**own, **common})


def _found(target: Target, texts: Mapping[int, str]) -> Optional[Found]:
    if MAP_OBJECT not in texts:
        return None
    return Found(
        target,
        texts.get(NAME_OBJECT, "a drive"),
        texts.get(VERSION_OBJECT, "of no version"),
        texts[MAP_OBJECT] == register_map.DIGEST,
    )


def candidates(line: Target) -> List[Target]:
    """Where a drive could be, with the line's rate, format and address."""
    ports = sorted(port.device for port in list_ports.comports())
    return [replace(line, serial_port=port) for port in ports] + [
        replace(line, tcp_port=port) for port in TCP_PORTS
    ]


def find(line: Target) -> List[Found]:
    """All that answer, at once; of a CAN bus its drives."""
    if line.can:
        return [found for found in (_found(*one) for one in nodes_of(line)) if found]
    places = candidates(line)
    with ThreadPoolExecutor(len(places)) as pool:
        return [found for found in pool.map(ask, places) if found]


def nothing_words(line: Target) -> str:
    """Where nothing was found, and what to do."""
    if line.can:
        return (
            f"no drive answers on CAN {line.can}: nodes 1 to 127 at {line.can_rate} bit/s; is it "
            "on, is --can-rate its CAN_RATE, and has the bus its two terminators?"
        )
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
