# SPDX-License-Identifier: MIT
"""The figures of paper A that are run."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Case:
    """One figure of the paper."""

    number: int
    scenario: str
    measure: str
    title: str
    shown_ms: float  # after the step
    end_s: float


CASES = (
    Case(
        5,
        "fig5_load_step",
        "load_step",
        "load 0.75 to 1.5 N m at 300 rad/s, the controller knows the motor",
        60,
        0.8,
    ),
    Case(
        6,
        "fig6_load_step_varied",
        "load_step",
        "the same, controller with 200 % J, B and 150 % R, L, flux",
        60,
        0.8,
    ),
    Case(
        7,
        "fig7_speed_step",
        "speed_step",
        "200 to 400 rad/s at 0.75 N m, 200/150 % controller",
        100,
        0.8,
    ),
    Case(
        8,
        "fig8_flux_weakening",
        "speed_step",
        "400 to 720 rad/s at 0.1 N m, dc link 173 V, 200/150 % controller",
        200,
        1.2,
    ),
)
