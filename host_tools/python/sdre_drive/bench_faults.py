# SPDX-License-Identifier: MIT
"""Faults that the bench of a virtual drive can make."""

from __future__ import annotations

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


def words_of(broken: str) -> str:
    """A fault of the bench's state ("phase_open a") in the words of FAULTS."""
    kind, _, phase = broken.partition(" ")
    for words, line in FAULTS.items():
        if f'"{kind}"' in line and (not phase or f'phase = "{phase}"' in line):
            return words
    return broken
