# SPDX-License-Identifier: MIT
"""Data that change seldom: constants of the drive, parameters with the meaning of their numbers,
captures."""

from __future__ import annotations

from typing import Any, Dict, Optional

from sdre_drive import bench_faults, register_map, scope, scope_facts
from sdre_drive.load import BOARD, DIGEST, NAME
from sdre_drive.page.choices import CHOICES
from sdre_drive.page.state import Watcher
from sdre_drive.scope import Capture


def facts(w: Watcher) -> Dict[str, Any]:
    """Constants of the drive and of this tool; those of the drive are missing until it answers."""
    of = w.constants
    return {
        "target": w.drive.target.words,
        "name": w.identity.get(NAME, ""),
        "digest": w.identity.get(DIGEST, ""),
        "board": w.identity.get(BOARD, ""),
        "pole_pairs": w.pole_pairs,
        "period_s": of.period_s if of else None,
        "speed_max_e_radps": of.speed_max_e_radps if of else None,
        "current_max_A": of.current_max_A if of else None,
        "turn_units": of.turn_units if of else None,
        "positions": bool(of and of.supported_modes & 1),
        "signals": [{"name": name, "unit": unit} for name, unit in register_map.SIGNALS[1:]],
        "triggers": list(scope_facts.TRIGGERS),
        "faults": list(bench_faults.FAULTS),
    }


def parameters(w: Watcher) -> Dict[str, Any]:
    """As they were read last, in units of their registers."""
    rows = []
    for v in w.parameters or []:
        p = v.parameter
        high = p.high
        if v.name == "MAX_CURRENT" and w.constants:
            high = min(high, w.constants.current_max_A)
        rows.append(
            {
                "name": v.name,
                "value": v.value,
                "default": v.default,
                "changed": v.changed,
                "unit": p.register.unit,
                "step": p.register.step,
                "low": p.low,
                "high": high,
                "stopped": p.stopped,
                "text": p.text,
                "choices": [list(c) for c in CHOICES.get(v.name, ())],
            }
        )
    return {"words": w.parameters_words, "rows": rows}


def capture(found: Optional[Capture]) -> Optional[Dict[str, Any]]:
    """A capture of the scope, or the record of a fault."""
    if found is None:
        return None
    return {
        "signals": [{"name": n, "unit": scope.UNITS[n]} for n in found.signals],
        "time_s": [round(t, 9) for t in found.time_s],
        "values": [[round(x, 6) for x in column] for column in found.values],
    }
