# SPDX-License-Identifier: MIT
"""Facts of the firmware's oscilloscope and record. The page has them in its generated tables."""

from __future__ import annotations

CHANNELS = 4
SAMPLES = (512, 256, 128, 64)  # of each channel: SDRE_SCOPE_SAMPLES of the firmware's build
SCOPE_FIRST, RECORD_FIRST = 16384, 24576
RECORD_SIGNALS = ("IA", "IB", "DC_LINK", "SPEED", "DUTY_A", "DUTY_B", "DUTY_C")
BLOCK = 120  # registers in a request
TRIGGERS = ("now", "rising", "falling")
STATES = ("idle", "fills", "waits for its trigger", "takes", "done")  # of register SCOPE_STATE
ARM, STOP = 1, 2
WAITS, DONE = 2, 4
