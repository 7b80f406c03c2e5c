# SPDX-License-Identifier: MIT
"""Writes the tables of a page that talks to a drive by itself: registers, parameters, and the words
of the Python client. Standard library alone (Python 3.11)."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any, Dict, List

from table import Group, Signal
from versions import digest_of, saved, version

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))

from sdre_drive import bench_faults, faults, registers, scope_facts  # noqa: E402
from sdre_drive.page.choices import CHOICES  # noqa: E402

HEAD = (
    "// SPDX-License-Identifier: MIT\n"
    "// Generated from firmware/app/registers/registers.toml and the words of sdre_drive. "
    "Do not edit: host_tools/registers/generate.py.\n"
)


def _groups(groups: List[Group]) -> Dict[str, Any]:
    return {
        g.name.upper(): {
            "space": g.space,
            "registers": [[r.name, r.address, r.type, r.step or 0, r.unit] for r in g.registers],
        }
        for g in groups
    }


def _parameters(groups: List[Group]) -> List[Dict[str, Any]]:
    return [
        {
            "name": r.name,
            "low": r.range[0] if r.range else 0,
            "high": r.range[1] if r.range else 0,
            "default": None if r.default == "largest" else float(r.default),
            "stopped": r.stopped,
            "text": f"{r.text}. {r.note}" if r.note else r.text,
            "choices": [list(c) for c in CHOICES.get(r.name, ())],
        }
        for r in saved(groups)
    ]


def _faults(groups: List[Group]) -> Dict[str, Any]:
    at = {r.name: r.address for g in groups for r in g.registers}
    return {
        group: [
            {
                "number": e["number"],
                "name": e["name"],
                "meaning": e["meaning"].format_map(at),
                "causes": [text.format_map(at) for text in e["causes"]],
                "check": [text.format_map(at) for text in e["check"]],
            }
            for e in entries
        ]
        for group, entries in faults.raw_table().items()
    }


def page_text(groups: List[Group], found: List[Signal]) -> str:
    """tables.js: a constant for each table, one line of JSON for each entry."""
    tables: Dict[str, Any] = {
        "GROUPS": _groups(groups),
        "PARAMETERS": _parameters(groups),
        "PARAMETER_GROUPS": [g.name.upper() for g in groups if any(r.saved for r in g.registers)],
        "SIGNALS": [{"name": s.name, "unit": s.unit} for s in found],
        "SCOPE": {name: fact for name, fact in vars(scope_facts).items() if name.isupper()},
        "FAULTS": _faults(groups),
        "MODES": {int(m): [m.name, words] for m, words in registers.MODE_WORDS.items()},
        "RESET_WORDS": list(registers.RESET_WORDS),
        "STORED_WORDS": list(registers.STORED_WORDS),
        "BENCH_FAULTS": bench_faults.FAULTS,
        "SIGNATURES": {r.name: r.signature for g in groups for r in g.registers if r.signature},
    }
    lines = [HEAD, f'export const DIGEST = "{digest_of(groups)}";']
    lines.append(f'export const VERSION = "{version()}";')
    for name, table in tables.items():
        ends = "[]" if isinstance(table, list) else "{}"
        lines.append(f"export const {name} = {ends[0]}")
        entries = (
            [json.dumps(e) for e in table]
            if isinstance(table, list)
            else [f"{json.dumps(str(k))}: {json.dumps(e)}" for k, e in table.items()]
        )
        lines += [f"  {entry}," for entry in entries]
        lines.append(f"{ends[1]};")
    return "\n".join(lines) + "\n"
