# SPDX-License-Identifier: MIT
"""Parameters whose numbers stand for words: docs/modbus.md."""

from __future__ import annotations

from typing import Dict, Tuple

INPUTS = ("negative limit switch", "positive limit switch", "home switch")  # from bit 0 on


def _inputs(none: str) -> Tuple[Tuple[int, str], ...]:
    """Every set of inputs."""
    return tuple(
        (word, ", ".join(name for bit, name in enumerate(INPUTS) if word >> bit & 1) or none)
        for word in range(1 << len(INPUTS))
    )


CHOICES: Dict[str, Tuple[Tuple[int, str], ...]] = {
    "QUICK_STOP_OPTION": (
        (0, "opens the bridge, as disable voltage"),
        (1, "brakes with DECELERATION, then off"),
        (2, "brakes with QUICK_STOP_DECELERATION, then off"),
        (5, "brakes with DECELERATION, stays enabled"),
        (6, "brakes with QUICK_STOP_DECELERATION, stays enabled"),
    ),
    "SHUTDOWN_OPTION": ((0, "as `stop` of the drive file"), (1, "brakes with DECELERATION")),
    "DISABLE_OPTION": ((0, "as `stop` of the drive file"), (1, "brakes with DECELERATION")),
    "LOST_OPTION": ((2, "disable voltage"), (3, "quick stop")),
    "BAUD_RATE": (
        (9600, "9600 Bd"),
        (19200, "19200 Bd"),
        (38400, "38400 Bd"),
        (57600, "57600 Bd"),
        (115200, "115200 Bd"),
    ),
    "LINE_FORMAT": (
        (0, "8E1: even parity"),
        (1, "8O1: odd parity"),
        (2, "8N2: no parity, two stop bits"),
    ),
    "SENSOR_TRIM": ((0, "believes them"), (1, "learns their errors in a run")),
    "INPUTS_USED": _inputs("none"),
    "INPUTS_INVERTED": _inputs("none: each is active when high or open"),
    "BRAKE_USED": ((0, "none"), (1, "a holding brake at its output")),
    "DIRECTION_PIN": ((0, "not used"), (1, "high while the drive sends (RS-485)")),
}
