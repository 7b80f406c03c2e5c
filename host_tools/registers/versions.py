# SPDX-License-Identifier: MIT
"""Version of the project, and digests of the map and of the stored parameters."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Dict, Iterable, List

from table import Group, Register, TableError, of_space


def version() -> str:
    """Version of the project."""
    text = (Path(__file__).resolve().parents[2] / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(sdre-drive VERSION ([0-9.]+)", text).group(1)


def _digest(lines: Iterable[str]) -> int:
    """FNV-1a, 32 bits."""
    h = 0x811C9DC5
    for line in lines:
        for c in f"{line}\n".encode():
            h = ((h ^ c) * 0x01000193) & 0xFFFFFFFF
    return h


def digest_of(groups: List[Group]) -> str:
    """Digest of the part of the map that a master can see."""
    lines = (
        f"{g.space} {r.address} {r.name} {r.type} {r.step} {r.unit} {r.range} {r.stopped} {r.saved}"
        for g in groups
        for r in g.registers
    )
    return f"{_digest(lines):08x}"


def saved(groups: List[Group]) -> List[Register]:
    """The parameters, in the order of their words in the store."""
    return [r for r in of_space(groups, "holding") if r.saved]


def id_of(register: Register) -> int:
    """A parameter is stored under this digest of name, type and unit; 0: no parameter."""
    if not register.saved:
        return 0
    h = _digest([f"{register.name} {register.type} {register.step} {register.unit}"])
    return (h >> 16) ^ (h & 0xFFFF)


def require_different_ids(groups: List[Group]) -> None:
    """TableError if two parameters would be stored under the same digest, or one under none."""
    found: Dict[int, str] = {0: "no parameter"}
    for r in saved(groups):
        other = found.setdefault(id_of(r), r.name)
        if other != r.name:
            raise TableError(f"{r.name}: its digest is that of {other}: choose another name")
