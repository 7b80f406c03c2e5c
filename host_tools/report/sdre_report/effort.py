# SPDX-License-Identifier: MIT
"""Cost of the conventional control's second variable, counted from the gains that sdre-gains
reports."""

from __future__ import annotations

from typing import Any, Dict, List, Tuple

import numpy as np

from .tables import Table


def nonzero(gains: List[Any]) -> int:
    """Entries that the firmware has to weigh."""
    return int(sum(np.count_nonzero(np.array(g)) for g in gains))


def table(designs: List[Tuple[str, Dict[str, Any]]]) -> Table:
    """Terms, Lyapunov equations, numbers of both series."""
    out = Table(
        "A-effort",
        "What the series cost",
        (
            "",
            "controller: terms",
            "Lyapunov equations",
            "numbers, non-zero",
            "observer: terms",
            "Lyapunov equations",
            "numbers, non-zero",
        ),
        note="A term is one matrix of gains; every one but the first needs a Lyapunov equation off "
        "line, and every non-zero number a "
        "multiplication and an addition in each control period. Cycles of the dearest period, "
        "estimated: docs/errata.md, by ./dev budget.",
    )
    for name, design in designs:
        cells: List[int] = []
        for gains in (design["nosc"]["lambda"], design["nodo"]["gain"]):
            cells += [len(gains), len(gains) - 1, nonzero(gains)]
        out.add(name, *cells)
    return out
