# SPDX-License-Identifier: MIT
"""Events of the drive while the page watched: faults with their records, restarts, stops by
silence."""

from __future__ import annotations

import time
from collections import deque
from typing import Any, Deque, Dict, List, Optional

from sdre_drive import faults
from sdre_drive.faults import Entry
from sdre_drive.registers import Mode, Reading
from sdre_drive.scope import Capture

MOST = 50  # chosen: more than a screen shows
SILENT = 2  # condition: the master was silent


def told(entry: Entry) -> Dict[str, Any]:
    """A fault or condition for the page."""
    return {
        "group": entry.group,
        "number": entry.number,
        "name": entry.name,
        "meaning": entry.meaning,
        "causes": list(entry.causes),
        "check": list(entry.check),
    }


class History:
    """The newest events, newest first."""

    def __init__(self) -> None:
        self.number = 0  # changes with every event
        self._events: Deque[Dict[str, Any]] = deque(maxlen=MOST)
        self._before: Optional[Reading] = None

    def see(self, reading: Reading) -> Optional[int]:
        """Notes what is new in a reading. The number of a new fault: its record is to be
        fetched."""
        before, self._before = self._before, reading
        if before is not None and reading.time_s < before.time_s:
            self._note(reading, "restart", f"the drive has restarted: {reading.reset_words}", [])
        if reading.mode == Mode.FAULT and (before is None or before.mode != Mode.FAULT):
            entries = faults.explain(reading.why)
            what = faults.one_line(entries[0]) if entries else "a fault"
            return self._note(reading, "fault", what, entries)
        silent = reading.conditions & SILENT
        if silent and before is not None and not before.conditions & SILENT:
            entry = faults.find("condition", SILENT)
            self._note(reading, "stop", faults.one_line(entry), [entry])
        return None

    def keep(self, number: int, record: Capture) -> None:
        """The periods before a fault."""
        for event in self._events:
            if event["number"] == number:
                event["record"] = record
                self.number += 1

    def record_of(self, number: int) -> Optional[Capture]:
        """The record of a fault, when there is one."""
        return next((e["record"] for e in self._events if e["number"] == number), None)

    def for_page(self) -> List[Dict[str, Any]]:
        """Newest first."""
        return [
            {**{k: v for k, v in e.items() if k != "record"}, "record": e["record"] is not None}
            for e in self._events
        ]

    def _note(self, reading: Reading, kind: str, what: str, entries: List[Entry]) -> int:
        self.number += 1
        first = reading.first_fault
        self._events.appendleft(
            {
                "number": self.number,
                "kind": kind,
                "what": what,
                "clock": time.strftime("%H:%M:%S"),
                "time_s": first.time_s if kind == "fault" else reading.time_s,
                "speed_e_radps": first.speed_e_radps if kind == "fault" else reading.speed_e_radps,
                "wanted_e_radps": first.wanted_e_radps if kind == "fault" else None,
                "entries": [told(e) for e in entries],
                "record": None,
            }
        )
        return self.number
