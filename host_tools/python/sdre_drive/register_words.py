# SPDX-License-Identifier: MIT
"""Values of registers in words: enumerations, bits, faults."""

from __future__ import annotations

import difflib
from typing import Dict, List

from sdre_drive import commission, faults, params, scope, scope_facts
from sdre_drive.connection import DriveError
from sdre_drive.register_map import BY_NAME, HOLDING, Register
from sdre_drive.registers import MODE_WORDS, RESET_WORDS, STORED_WORDS, state_words

MODES_OF_OPERATION = {
    -1: "commissioning",
    1: "profile position",
    3: "profile velocity",
    6: "homing",
    -2: "alignment",
}
STOPS = {
    0: "disable voltage",
    1: "DECELERATION, then off",
    2: "QUICK_STOP_DECELERATION, then off",
    5: "DECELERATION, stays enabled",
    6: "QUICK_STOP_DECELERATION, stays enabled",
}
RAMPS = {0: "`stop` of the drive file", 1: "with DECELERATION"}
ALIGN_STAGES = ("watch", "ramp", "sweep", "settle", "done", "failed")
NO_YES = {0: "no", 1: "yes"}


def _numbered(words: tuple) -> Dict[int, str]:
    return dict(enumerate(words))


ENUMERATIONS: Dict[str, Dict[int, str]] = {
    "MODE_OF_OPERATION": MODES_OF_OPERATION,
    "MODE_NOW": MODES_OF_OPERATION,
    "QUICK_STOP_OPTION": STOPS,
    "SHUTDOWN_OPTION": RAMPS,
    "DISABLE_OPTION": RAMPS,
    "LOST_OPTION": {2: "disable voltage", 3: "quick stop"},
    "LINE_FORMAT": {0: "even", 1: "odd", 2: "none"},
    "DIRECTION_PIN": {0: "input", 1: "high while the drive sends"},
    "SCOPE_TRIGGER": {0: "now", 1: "rising", 2: "falling"},
    "MODE": {int(mode): words for mode, words in MODE_WORDS.items()},
    "FIRST_MODE": {int(mode): words for mode, words in MODE_WORDS.items()},
    "REFERENCE": {0: "none", 1: "aligned", 2: "index"},
    "ALIGN_STAGE": _numbered(ALIGN_STAGES),
    "RESET_CAUSE": _numbered(RESET_WORDS),
    "COMMISSION_STAGE": _numbered(commission.STAGES),
    "COMMISSION_REASON": {n: r.words for n, r in commission.REASONS.items()},
    "FOUND_RELUCTANCE": NO_YES,
    "FOUND_COUPLING": _numbered(commission.COUPLINGS),
    "SCOPE_STATE": _numbered(scope_facts.STATES),
    "PARAMETERS_STATE": _numbered(STORED_WORDS),
    "PARAMETERS_DONE": {0: "no command", 1: "done", 2: "the flash did not accept it"},
    **{f"SCOPE_SIGNAL_{n}": _numbered(scope.NAMES) for n in (1, 2, 3, 4)},
}
GROUPS = {
    "FAULT": "application",
    "FIRST_FAULT": "application",
    "DRIVE_FAULT": "drive",
    "FIRST_DRIVE_FAULT": "drive",
}
BIT_GROUPS = {"BOARD_FAULTS": "board", "FIRST_BOARD_FAULTS": "board", "CONDITIONS": "condition"}
READ_ONLY = set(BY_NAME) - {r.name for r in HOLDING}


def register(name: str) -> Register:
    """The register of this name; DriveError with the nearest ones."""
    found = BY_NAME.get(name.upper())
    if found is None:
        near = difflib.get_close_matches(name.upper(), BY_NAME, 3)
        hint = f": {', '.join(near)}?" if near else "; sdre-drive get lists them"
        raise DriveError(f"{name} is not a register{hint}")
    return found


def words(name: str, value: float) -> str:
    """The number's meaning; empty for a quantity."""
    number = int(value)
    if name in ENUMERATIONS:
        return ENUMERATIONS[name].get(number, "unknown")
    if name in GROUPS:
        return faults.one_line(faults.find(GROUPS[name], number)) if number else "none"
    if name in BIT_GROUPS:
        entries = faults.bits(BIT_GROUPS[name], number)
        return ", ".join(e.name for e in entries) or "none"
    if name == "STATUSWORD":
        return f"{number:04X}h, {state_words(number)}"
    if name in ("CONTROLWORD", "ERROR_CODE"):
        return f"{number:04X}h"
    if name == "SUPPORTED_MODES":
        return f"{number:X}h"
    return ""


def text(name: str, value: float) -> str:
    """Number, unit and words."""
    unit = BY_NAME[name].unit
    parts = [params.text_of(value) + (f" {unit}" if unit and unit != "bits" else "")]
    parts += [words(name, value)] if words(name, value) else []
    return ": ".join(parts)


def value_of(name: str, given: str) -> float:
    """A number, or a word of the register's enumeration; DriveError with what is allowed."""
    known = ENUMERATIONS.get(name, {})
    by_word: List[int] = [n for n, w in known.items() if w.lower() == given.strip().lower()]
    if by_word:
        return float(by_word[0])
    try:
        return float(given)
    except ValueError as e:
        allowed = "; ".join(f"{n} {w}" for n, w in known.items()) or "a number"
        raise DriveError(
            f"{name}: {given} is not allowed: must be {allowed}{params.comma_words(given)}"
        ) from e
