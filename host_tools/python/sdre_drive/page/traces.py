# SPDX-License-Identifier: MIT
"""The last seconds of the drive's readings and, of a virtual drive, of its true motor."""

from __future__ import annotations

import math
import threading
from collections import deque
from typing import Any, Deque, Dict, List, Optional, Tuple

from sdre_drive.move import Where
from sdre_drive.registers import Constants, Reading

LENGTH_S = 10.0  # what a viewer that comes gets; it keeps more by itself
DRIVE = ("time_s", "speed_e_radps", "demand_e_radps", "iq_A", "id_A", "dc_link_V", "turns")
TRUTH = ("time_s", "speed_e_radps", "iq_A", "id_A", "dc_link_V", "torque_Nm", "load_Nm")
Row = Tuple[Optional[float], ...]


class Traces:
    """Rows are numbered, so that each viewer gets those that it has not got yet."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._rows: Dict[str, Deque[Row]] = {"drive": deque(), "truth": deque()}
        self._taken = {"drive": 0, "truth": 0}  # of all times
        self.generation = 0  # of the drive's starts

    def clear(self) -> None:
        """The drive's time begins again."""
        with self._lock:
            for rows in self._rows.values():
                rows.clear()
            self.generation += 1

    def take_reading(
        self, r: Reading, pole_pairs: int, where: Optional[Where], of: Constants
    ) -> None:
        """A reading of the drive."""
        demand = r.speed_demand_rpm * pole_pairs * 2.0 * math.pi / 60.0
        turns = where.now / of.turn_units if where and of.turn_units else None
        row = (r.time_s, r.speed_e_radps, demand, r.iq_A, r.id_A, r.dc_link_V, turns)
        self._append("drive", row)

    def take_truth(self, samples: List[Dict[str, float]]) -> None:
        """Samples of the bench."""
        for sample in samples:
            self._append("truth", tuple(sample[name] for name in TRUTH))

    def since(self, seen: Dict[str, int]) -> Dict[str, Any]:
        """Rows after those that were seen; `seen` then has them too."""
        out: Dict[str, Any] = {"generation": self.generation}
        with self._lock:
            for name, rows in self._rows.items():
                new = min(self._taken[name] - seen.get(name, 0), len(rows))
                seen[name] = self._taken[name]
                out[name] = [_short(rows[k]) for k in range(len(rows) - new, len(rows))]
        return out

    def _append(self, name: str, row: Row) -> None:
        with self._lock:
            rows = self._rows[name]
            rows.append(row)
            self._taken[name] += 1
            last_s = row[0] or 0.0
            while (rows[0][0] or 0.0) < last_s - LENGTH_S:
                rows.popleft()


def _short(row: Row) -> List[Optional[float]]:
    return [None if x is None else round(x, 4) for x in row]
