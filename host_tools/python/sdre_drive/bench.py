# SPDX-License-Identifier: MIT
"""The bench around a virtual drive (`sdre-sil serve --control`): load, supply, faults, and what the
motor really does."""

from __future__ import annotations

import json
import socket
from typing import Any, Dict, Tuple

from sdre_drive.connection import DriveError

TIMEOUT_S = 5.0
DEFAULT = ("127.0.0.1", 1503)

# Faults in words, and the command for each. Keys: docs/files.md, [[fault]].
FAULTS = {
    "motor wire a broken": 'fault kind = "phase_open", phase = "a"',
    "motor wire c broken": 'fault kind = "phase_open", phase = "c"',
    "current sensor a reads nothing": 'fault kind = "current_zero", phase = "a"',
    "current sensor a frozen": 'fault kind = "current_frozen", phase = "a"',
    "current sensor a drifts "
    "to 3 A": 'fault kind = "current_drift", phase = "a", rate_Aps = 1000.0, until_A = 3.0',
    "current sensor b shows a third": 'fault kind = "current_gain", phase = "b", gain = 0.3',
    "encoder loses counts": 'fault kind = "encoder_losing", counts_per_s = 20000.0',
    "index wire off": 'fault kind = "index_missing"',
    "program hangs in the control interrupt": 'fault kind = "tick_hung"',
    "interrupts masked": 'fault kind = "interrupt_masked"',
    "no conversion is triggered": 'fault kind = "trigger_lost"',
}


class Bench:
    """One line out, one line of JSON back."""

    def __init__(self, address: Tuple[str, int] = DEFAULT) -> None:
        self.address = address
        try:
            self._socket = socket.create_connection(address, timeout=TIMEOUT_S)
        except OSError as e:
            raise DriveError(
                f"no bench of a virtual drive at {address[0]}:{address[1]}: {e.strerror or e}"
            ) from e
        self._lines = self._socket.makefile("rw", encoding="utf-8", newline="\n")

    def close(self) -> None:
        """Closes the connection; the settings stay."""
        self._lines.close()
        self._socket.close()

    def ask(self, command: str) -> Dict[str, Any]:
        """The bench's answer to one command; DriveError when it refuses."""
        if "\n" in command:
            raise DriveError("one command is one line")
        try:
            self._lines.write(command + "\n")
            self._lines.flush()
            line = self._lines.readline()
            answer: Dict[str, Any] = json.loads(line) if line else {"error": "it has gone"}
        except (OSError, ValueError) as e:
            raise DriveError(f"the bench does not answer: {e}") from e
        if "error" in answer:
            raise DriveError(f"bench: {answer['error']}")
        return answer
