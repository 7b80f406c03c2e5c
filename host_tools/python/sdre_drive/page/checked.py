# SPDX-License-Identifier: MIT
"""Arguments that a page has sent: each is what it has to be, or a DriveError says what is wrong."""

from __future__ import annotations

import math
from typing import Any, Dict, Sequence

from sdre_drive.connection import DriveError


def number(args: Dict[str, Any], key: str, low: float, high: float) -> float:
    """A finite number within a range."""
    value = args.get(key)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise DriveError(f"{key}: has to be a number")
    if not low <= value <= high:
        raise DriveError(f"{key}: {value:g} is not within {low:g} .. {high:g}")
    return float(value)


def text(args: Dict[str, Any], key: str) -> str:
    """Words."""
    value = args.get(key)
    if not isinstance(value, str):
        raise DriveError(f"{key}: has to be text")
    return value


def choice(args: Dict[str, Any], key: str, allowed: Sequence[str]) -> str:
    """One of several words."""
    value = text(args, key)
    if value not in allowed:
        raise DriveError(f"{key}: has to be one of {', '.join(allowed)}")
    return value


def flag(args: Dict[str, Any], key: str) -> bool:
    """True or false; false when it is missing."""
    value = args.get(key, False)
    if not isinstance(value, bool):
        raise DriveError(f"{key}: has to be true or false")
    return value
