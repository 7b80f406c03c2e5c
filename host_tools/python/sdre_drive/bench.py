# SPDX-License-Identifier: MIT
"""The bench around a virtual drive (`sdre-sil serve --control`): load, supply, faults, and what the
motor really does."""

from __future__ import annotations

import json
import re
import socket
from typing import Any, Dict, Iterable, List, Tuple

from sdre_drive.bench_faults import words_of
from sdre_drive.connection import DriveError

TIMEOUT_S = 5.0
DEFAULT = ("127.0.0.1", 1503)


def load_words(state: Dict[str, Any]) -> str:
    """The load as it is set."""
    if state["load_kind"] == "active":
        return f"{state['load_Nm']:g} N m against positive speed, whatever the shaft does"
    return f"{state['load_Nm']:g} N m, a brake"


def pace_words(state: Dict[str, Any]) -> str:
    """Simulated seconds per second of the clock."""
    words = f"{state['real_time_factor']:.2f} of real time"
    wanted = float(state["speed_factor"])
    return words if wanted == 1.0 else f"{words}, {wanted:g} wanted"


def rows(state: Dict[str, Any]) -> List[Tuple[str, str]]:
    """The bench as a person sees it: names and words."""
    found = [
        ("load", f"{load_words(state)}; at most {state['load_most_Nm']:.3g} N m"),
        ("true speed", f"{state['speed_rpm']:.0f} r/min"),
        ("true torque", f"{state['torque_Nm']:.3f} N m"),
        ("supply", f"{state['source_V']:g} V"),
        ("broken", ", ".join(words_of(b) for b in state["broken"]) or "nothing"),
        ("pace", f"{pace_words(state)}, {state['slipped_s']:.1f} s left out"),
        ("resets", str(state["resets"])),
        ("caught", f"{state['catches']} times, at {state['catch_speed_rpm']:.0f} r/min"),
    ]
    found += [("note", state["note"])] if state["note"] else []
    found += [("finding", text) for text in state["findings"]]
    return found


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


def served_ports(lines: Iterable[str]) -> Dict[str, int]:
    """Ports that `sdre-sil serve` names in what it prints at its start; none if it ends."""
    ports: Dict[str, int] = {}
    for line in lines:
        found = re.match(r"  (\S.*?)\s+127\.0\.0\.1:(\d+)", line)
        if found:
            ports[found.group(1)] = int(found.group(2))
        if line.startswith("Ctrl-C"):
            return ports
    return {}
