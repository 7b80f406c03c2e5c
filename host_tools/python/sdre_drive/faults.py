# SPDX-License-Identifier: MIT
"""Faults and conditions in plain words, from faults.toml. Needs nothing but the standard library
(Python 3.11)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any, Dict, List, Tuple, Union

from sdre_drive.registers import BY_NAME, Why

try:
    import tomllib
except ModuleNotFoundError:  # before Python 3.11
    import tomli as tomllib  # type: ignore[no-redef]

GROUPS = ("application", "drive", "board", "condition")
BIT_GROUPS = ("board", "condition")
APPLICATION_BOARD, APPLICATION_DRIVE = 2, 10  # what sends the reader on to another group
# Conditions that keep a drive from starting.
NO_START = 1 | 8 | 16 | 2048 | 4096
# Conditions that need no action.
NOT_A_WARNING = 4


@dataclass(frozen=True)
class Recipe:
    """How to see an entry in the virtual drive."""

    # The drive runs at this speed first, rad/s electrical; 0: it does not run.
    at_e_radps: float = 0.0
    bench: Tuple[str, ...] = ()
    wait_s: float = 3.0  # it is there at the latest after this
    then: str = ""
    restore: Tuple[str, ...] = ()


@dataclass(frozen=True)
class Entry:
    """One fault or condition."""

    group: str
    number: int
    name: str
    meaning: str
    causes: Tuple[str, ...]
    check: Tuple[str, ...]
    reproduce: Union[str, Recipe] = field(default="")


def _addressed(text: str) -> str:
    """With addresses for the names of input registers."""
    return text.format_map({name: r.address for name, r in BY_NAME.items()})


def _entry(group: str, keys: Dict[str, Any]) -> Entry:
    how = keys["reproduce"]
    if isinstance(how, dict):
        recipe: Dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in how.items()}
        how = Recipe(**recipe)
    rest: Dict[str, Any] = {
        k: tuple(map(_addressed, v)) if isinstance(v, list) else v
        for k, v in keys.items()
        if k != "reproduce"
    }
    rest["meaning"] = _addressed(rest["meaning"])
    return Entry(group=group, reproduce=how, **rest)


def raw_table() -> Dict[str, List[Dict[str, Any]]]:
    """faults.toml as it is, by group."""
    with (Path(__file__).parent / "faults.toml").open("rb") as f:
        read = tomllib.load(f)
    return {g: read[g] for g in GROUPS}


@lru_cache(maxsize=None)
def table() -> Dict[str, Dict[int, Entry]]:
    """All entries by group and number."""
    return {g: {e["number"]: _entry(g, e) for e in found} for g, found in raw_table().items()}


def find(group: str, number: int) -> Entry:
    """The entry; one of a newer firmware gets a plain one."""
    unknown = Entry(
        group,
        number,
        "UNKNOWN",
        "This tool does not know that number.",
        ("the firmware is newer than the tool",),
        ("docs/modbus.md of the firmware",),
    )
    return table()[group].get(number, unknown)


def bits(group: str, value: int) -> List[Entry]:
    """An entry for each bit that is set."""
    return [find(group, 1 << k) for k in range(16) if value & (1 << k)]


def explain(why: Why) -> List[Entry]:
    """Faults of the drive, the most specific first; empty without a fault."""
    if why.fault == 0:
        return []
    first = find("application", why.fault)
    if why.fault == APPLICATION_DRIVE and why.drive_fault:
        return [find("drive", why.drive_fault), first]
    if why.fault == APPLICATION_BOARD and why.board_faults:
        return [*bits("board", why.board_faults), first]
    return [first]


def one_line(entry: Entry) -> str:
    """Number, name and meaning."""
    return f"{entry.group} {entry.number} {entry.name}: {entry.meaning}"


def warnings(conditions: int) -> List[Entry]:
    """Conditions to show to the user."""
    return bits("condition", conditions & ~NOT_A_WARNING)
