# SPDX-License-Identifier: MIT
"""A drive file of law noc_h from one of law noc, for the cogging that was measured:
docs/anticogging.md."""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List

from sdre_drive.connection import DriveError
from sdre_drive.ripple import ONCE_OR_TWICE, Ripple

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

MULTIPLES = (1, 2)  # two orders of cogging fill the firmware's eight pairs
# Weights of the pairs, as shares of the drive file's own in [nodo] Q: those that a search found for
# ipmsm_390w_noc_h_edges.toml.
SENSOR, VOLTAGE, COGGING, COGGING_VOLTAGE = 0.013, 1.4, 0.07, 0.015
WEIGHT_SPEED = 1.5  # chosen: of the rated speed, as in that file
LEAK_1PS = 0.02  # as in that file


@dataclass(frozen=True)
class Cogging:
    """Orders a turn of the shaft: slots times each multiple."""

    slots: int
    multiples: List[int]


def cogging_of(found: Ripple, slots: int = 0) -> Cogging:
    """The largest order that nothing else explains, and its double where that is found too. With
    slots from a data sheet, these. DriveError when there is none."""
    orders = found.found()
    if slots == 0:
        sensors = (found.pole_pairs, 2 * found.pole_pairs, 6 * found.pole_pairs)
        own = [k for k in orders if k not in ONCE_OR_TWICE and k not in sensors]
        if not own:
            raise DriveError(
                f"no cogging found: the speed ripples by {found.rms_rpm:.2g} r/min rms, in orders "
                f"{orders or 'that are noise'}; measure slower, or name the slots with --slots"
            )
        slots = max(own, key=found.at)
        if slots % 2 == 0 and slots // 2 in own:
            slots //= 2
    multiples = [k for k in MULTIPLES if k * slots in orders]
    return Cogging(slots, multiples or [1])


def _read(text: str, path: Path) -> Dict[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as e:
        raise DriveError(f"{path}: {e}") from e


def _require_possible(drive: Dict[str, Any], path: Path) -> None:
    law = drive.get("law", "noc")
    if law == "noc_h":
        raise DriveError(f"{path}: law noc_h learns the cogging already: anticogging check")
    if law != "noc":
        raise DriveError(f'{path}: law = "{law}" is not allowed: noc_h is made of noc')
    nodo = drive.get("nodo", {})
    if nodo.get("form") != "encoder" or nodo.get("order") != 1:
        raise DriveError(
            f'{path}: [nodo] form and order have to be "encoder" and 1 for noc_h; `sdre-gains new` '
            "makes such a file from the data sheet"
        )


def drive_text(path: Path, found: Cogging) -> str:
    """The drive file's text with law noc_h. DriveError with the key that does not allow it."""
    try:
        text = path.read_text()
    except OSError as e:
        raise DriveError(f"{path}: {e.strerror}") from e
    drive = _read(text, path)
    _require_possible(drive, path)
    q = drive["nodo"]["Q"]
    text = re.sub(r"(?m)^(law|slots)\s*=.*\n", "", text)
    # noc_h takes no torques: the section goes, with the comments above it.
    text = re.sub(r"(?m)(^#.*\n)*^\[torque\].*\n(^(?!\[|#).*(\n|\Z))*", "", text)
    text = re.sub(r"(?m)^(name\s*=.*\n)", r'\1law = "noc_h"' + "\n", text, count=1)
    slots = f"[motor]\nslots = {found.slots}  # periods of the cogging in a turn, measured\n"
    text = re.sub(r"(?m)^\[motor\].*\n", slots, text, count=1)
    return f"""{text.rstrip()}

# Weights: shares of [nodo] Q (docs/anticogging.md).
[harmonics]
sensor  = [1, 2]  # offsets, unequal gains
voltage = [6]     # dead time
cogging = {found.multiples}  # multiples of the slots
sensor_weight          = {SENSOR * q[4]:.3g}
voltage_weight         = {VOLTAGE * q[1]:.3g}
cogging_weight         = {COGGING * q[0]:.3g}
cogging_voltage_weight = {COGGING_VOLTAGE * q[1]:.3g}
weight_speed_e_radps   = {WEIGHT_SPEED * drive["motor"]["rated_speed_e_radps"]:.4g}
leak_1ps               = {LEAK_1PS}
"""
