# SPDX-License-Identifier: MIT
"""The quantities of a trace in the Python package against the list of sdre-sil. Standard
library alone, nothing compiled."""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path
from typing import Dict, List

ROOT = Path(__file__).resolve().parents[2]
TOOLS = ROOT / "host_tools"


def fields_of(file: str, name: str) -> List[str]:
    """Names of a class's fields, in order."""
    tree = ast.parse((TOOLS / "python/sdre" / file).read_text(encoding="utf-8"))
    (found,) = (node for node in tree.body if isinstance(node, ast.ClassDef) and node.name == name)
    return [
        item.target.id
        for item in found.body
        if isinstance(item, ast.AnnAssign) and isinstance(item.target, ast.Name)
    ]


def units() -> List[str]:
    """Quantities that have a unit."""
    tree = ast.parse((TOOLS / "python/sdre/run.py").read_text(encoding="utf-8"))
    (found,) = (
        node.value
        for node in tree.body
        if isinstance(node, ast.AnnAssign)
        and isinstance(node.target, ast.Name)
        and node.target.id == "UNITS"
    )
    assert isinstance(found, ast.Dict)
    return [ast.literal_eval(key) for key in found.keys if key is not None]


def differences() -> List[str]:
    """In words."""
    native = re.findall(
        r'\{"(\w+)", ', (TOOLS / "sil/run/trace_columns.cpp").read_text(encoding="utf-8")
    )
    lists: Dict[str, List[str]] = {
        "sdre.Trace": fields_of("run.py", "Trace"),
        "sdre.State": [
            name for name in fields_of("loop.py", "State") if name not in ("fault", "ended")
        ],
        "sdre.UNITS": units(),
    }
    return [
        f"{name}: {quantities} instead of {native}"
        for name, quantities in lists.items()
        if quantities != native
    ]


if __name__ == "__main__":
    all_found = differences()
    print("\n".join(all_found) or "the package has all quantities of a trace")
    sys.exit(1 if all_found else 0)
