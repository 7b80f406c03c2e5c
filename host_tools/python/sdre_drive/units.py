# SPDX-License-Identifier: MIT
"""Speeds of the shaft and of the field. Needs nothing but the standard library."""

from __future__ import annotations

import math
from typing import Optional


def rpm_of(speed_e_radps: float, pole_pairs: int) -> float:
    """r/min of the shaft."""
    return speed_e_radps / pole_pairs * 60.0 / (2.0 * math.pi)


def e_radps_of(speed_rpm: float, pole_pairs: int) -> float:
    """rad/s electrical."""
    return speed_rpm * pole_pairs * 2.0 * math.pi / 60.0


def speed_words(speed_e_radps: float, pole_pairs: Optional[int]) -> str:
    """In r/min too where the pole pairs are known."""
    words = f"{speed_e_radps:.1f} rad/s electrical"
    return f"{rpm_of(speed_e_radps, pole_pairs):.0f} r/min ({words})" if pole_pairs else words
