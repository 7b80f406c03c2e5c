# SPDX-License-Identifier: MIT
"""Computes what guarantees.json holds: minutes. `./dev report guarantees`"""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any, Callable, Dict, List

import numpy as np

from ..tools import ReportError, Tools
from . import attraction, lyapunov, mu
from .loop import Loops, Point, random_motors
from .stored import DRIVE, FILE

MOTORS, SEED = 4000, 1  # drawn at every share
LYAPUNOV_SHARE = 0.14  # 0.15 was not finished within eight minutes on a busy machine
MU_POINTS = (
    (298, 1),
    (1191, 0),
    (1191, 1),
)  # speed [rad/s], sign of iq: beside the two that the verdict judges
ATTRACTION_POINTS = (
    (0, 0),
    (0, 1),
    (149, 0),
    (298, 0),
    (298, 1),
    (521, 0),
)  # at 521 rad/s the largest current leaves no voltage


def pick(loops: Loops, speed: float, sign: int) -> Point:
    """The tool's point nearest to this speed with current of this sign."""
    return min(
        (p for p in loops.points if np.sign(p.iq) == sign), key=lambda p: abs(p.speed - speed)
    )


def random_share(loops: Loops, p: Point) -> float:
    """Largest share at which none of the drawn motors is unstable, by bisection."""
    stable, unstable = 0.0, 1.0
    if loops.radius(p, random_motors(1.0, MOTORS, SEED)).max() < 1.0:
        return 1.0
    while unstable - stable > 0.005:
        middle = 0.5 * (stable + unstable)
        if loops.radius(p, random_motors(middle, MOTORS, SEED)).max() < 1.0:
            stable = middle
        else:
            unstable = middle
    return stable


def shares(loops: Loops, tell: Callable[[str], None]) -> List[Dict[str, float]]:
    """mu, corners and drawn motors at a few points."""
    found = []
    for p in [*loops.box_points, *(pick(loops, *at) for at in MU_POINTS)]:
        tell(f"mu at {p.speed:.0f} rad/s, iq {p.iq:.2f} A")
        corner = mu.corner_share(loops, p)
        found.append(
            {
                "speed_e_radps": p.speed,
                "iq_A": p.iq,
                "mu": mu.largest_share(loops, p, corner),
                "corners": corner,
                "drawn": random_share(loops, p),
            }
        )
    return found


def function(loops: Loops, design: Dict[str, Any], tell: Callable[[str], None]) -> Dict[str, Any]:
    """The quadratic Lyapunov function and its proof."""
    loop, region = lyapunov.Loop(loops, design), lyapunov.region_of(loops)
    tell("searching a Lyapunov function")
    R, at_corners = lyapunov.search(loop, region, LYAPUNOV_SHARE)
    tell("proving it")
    proof = lyapunov.prove(loop, region, LYAPUNOV_SHARE, R)
    if proof is None:
        raise ReportError("the Lyapunov function is not proved")
    return {
        "share": proof.share,
        "rate_at_corners": at_corners,
        "rate": proof.rate,
        "cells": proof.cells,
        "sizes": lyapunov.SIZES[:10].tolist(),
        "R": R.tolist(),
        "speed_e_radps": [float(region.low[0, 0]), float(region.high[-1, 0])],
        "iq_A": [float(region.low[:, 1].min()), float(region.high[:, 1].max())],
        "id_A": [float(region.low[:, 2].min()), float(region.high[:, 2].max())],
    }


def compute(tools: Tools) -> Dict[str, Any]:
    """All three."""
    design, loops = tools.design(DRIVE), Loops(tools.loops(DRIVE))
    out: Dict[str, Any] = {
        "drive": DRIVE,
        "digest": design["digest"],
        "verdict_share": design["whole_loop"]["box_share"],
    }
    out["attraction"] = []
    for at in ATTRACTION_POINTS:
        p = pick(loops, *at)
        tools.tell(f"attraction at {p.speed:.0f} rad/s, iq {p.iq:.2f} A")
        found = {k: float(v) for k, v in asdict(attraction.largest(loops, p)).items()}
        out["attraction"].append({"at_speed_e_radps": p.speed, "at_iq_A": p.iq, **found})
    out["shares"] = shares(loops, tools.tell)
    out["lyapunov"] = function(loops, design, tools.tell)
    return out


def write(tools: Tools) -> None:
    """Into the file that the report reads."""
    FILE.write_text(json.dumps(compute(tools), indent=1) + "\n", encoding="ascii")
