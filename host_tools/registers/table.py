# SPDX-License-Identifier: MIT
"""firmware/app/registers/registers.toml, read and checked. Standard library alone (Python 3.11)."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Dict, Iterator, List, Optional, Tuple

try:
    import tomllib
except ModuleNotFoundError:  # before Python 3.11
    import tomli as tomllib  # type: ignore[no-redef]

# Structures whose members registers show, and types of members.
HOMES = ("requested", "status", "drive", "config")
MEMBERS = ("u16", "i16", "u32", "i32", "float", "bool")
WORDS = {"u16": 1, "i16": 1, "u32": 2, "i32": 2, "dec": 2}
SPACES = ("holding", "input")
SENSES = {"": 0, "speed": 0x40, "torque": 0x20}  # bits of the polarity, app_units.h
OBJECTS = ("u8", "i8", "u16", "i16", "u32", "i32")
KEYS = {
    "name",
    "type",
    "unit",
    "step",
    "at",
    "c",
    "rpm",
    "sense",
    "from",
    "to",
    "range",
    "default",
    "stopped",
    "saved",
    "signature",
    "object",
    "can",
    "sub",
    "text",
    "note",
}


class TableError(Exception):
    """One line."""


@dataclass(frozen=True)
class Register:
    """One value, of one or two registers."""

    name: str
    address: int
    type: str
    unit: str
    step: Optional[float]
    home: str
    member: str
    kind: str
    rpm: bool
    sense: int
    source: str
    target: str
    range: Optional[Tuple[float, float]]
    default: str
    stopped: bool
    saved: bool
    signature: int
    object: str
    can: str
    sub: int
    text: str
    note: str

    @property
    def words(self) -> int:
        return WORDS[self.type]

    @property
    def numbers(self) -> str:
        """Address or addresses as text."""
        return f"{self.address}" if self.words == 1 else f"{self.address}, {self.address + 1}"

    @property
    def is_real(self) -> bool:
        """Has a unit that it counts, or digits and a power of ten."""
        return self.step is not None or self.type == "dec"

    @property
    def per_unit(self) -> float:
        """Counts of one unit; 0 of a whole number."""
        return 0.0 if self.step is None else float(f"{1.0 / self.step:.9g}")

    @property
    def unit_words(self) -> str:
        """0.1 V, or 1 where there is none."""
        step = "" if self.step in (None, 1.0) else f"{self.step:g}"
        return " ".join(w for w in (step, self.unit) if w)


@dataclass(frozen=True)
class Group:
    """Registers without a gap."""

    name: str
    space: str
    first: int
    title: str
    registers: List[Register] = field(default_factory=list)

    @property
    def end(self) -> int:
        last = self.registers[-1]
        return last.address + last.words


@dataclass(frozen=True)
class Fixed:
    """A constant object of CANopen; without a value the version of the project."""

    name: str
    object: str
    sub: int
    type: str
    value: Optional[int]
    writable: bool
    text: str


@dataclass(frozen=True)
class Signal:
    """A signal of the scope."""

    number: int
    name: str
    unit: str
    source: str


def signals(path: Path) -> List[Signal]:
    """In the order of their numbers."""
    with path.open("rb") as f:
        found = tomllib.load(f)["signal"]
    return [Signal(n, s["name"], s["unit"], s["from"]) for n, s in enumerate(found)]


def fixed(path: Path) -> List[Fixed]:
    """Constant objects."""
    with path.open("rb") as f:
        found = tomllib.load(f)["fixed"]
    return [
        Fixed(
            o["name"],
            o["object"],
            o.get("sub", 0),
            o["type"],
            o.get("value"),
            o.get("writable", False),
            o["text"],
        )
        for o in found
    ]


def _register(keys: Dict[str, Any], address: int, space: str) -> Register:
    name = keys.get("name", "?")
    if not keys.keys() <= KEYS or not {"name", "type", "text"} <= keys.keys():
        raise TableError(f"{name}: keys {sorted(keys)}")
    if keys["type"] not in WORDS:
        raise TableError(f"{name}: type {keys['type']}")
    if ("at" in keys) == ("from" in keys) or ("at" in keys and "to" in keys):
        raise TableError(f"{name}: either at, or from and to")
    if keys.get("can", "u16") not in OBJECTS:
        raise TableError(f"{name}: can {keys['can']}")
    if keys.get("sense", "") not in SENSES:
        raise TableError(f"{name}: sense {keys['sense']}")
    home, _, member = keys.get("at", "").partition(".")
    real = "step" in keys or keys["type"] == "dec"
    kind = keys.get("c", "float" if real else keys["type"])
    known = kind in MEMBERS or kind.endswith("_t")
    if member and (home not in HOMES or not known or (kind == "float") != real):
        raise TableError(f"{name}: at {keys['at']}, c {kind}")
    signature = int.from_bytes(keys.get("signature", "").encode(), "little")
    given = keys.get("range") or ([signature, signature] if signature else None)
    written = "to" in keys or home == "requested"
    if (space == "holding") != (written and given is not None and "default" in keys):
        raise TableError(
            f"{name}: to or requested, range and default belong to holding registers, all of them"
        )
    if (space != "holding" and ("saved" in keys or signature)) or (
        signature and keys["type"] != "u32"
    ):
        raise TableError(
            f"{name}: holding registers alone are saved or have a signature, and that is a u32"
        )
    out = Register(
        name=name,
        address=address,
        type=keys["type"],
        unit=keys.get("unit", ""),
        step=keys.get("step"),
        home=home,
        member=member,
        kind=kind,
        rpm=keys.get("rpm", False),
        sense=SENSES[keys.get("sense", "")],
        source=keys.get("from", ""),
        target=keys.get("to", ""),
        range=(given[0], given[1]) if given else None,
        default=keys.get("default", ""),
        stopped=keys.get("stopped", False),
        saved=keys.get("saved", False),
        signature=signature,
        object=keys.get("object", ""),
        can=keys.get("can", ""),
        sub=keys.get("sub", 0),
        text=keys["text"],
        note=keys.get("note", ""),
    )
    if out.range and not _fits(out):
        raise TableError(f"{name}: its type does not hold its range")
    return out


def _fits(r: Register) -> bool:
    low, high = {
        "u16": (0, 0xFFFF),
        "i16": (-0x8000, 0x7FFF),
        "u32": (0, 0xFFFFFFFF),
        "i32": (-(2**31), 2**31 - 1),
    }[r.type]
    counts = [x / (r.step or 1.0) for x in r.range or ()]
    return low <= counts[0] <= counts[1] <= high + 1e-6 * high


def read(path: Path) -> List[Group]:
    """All groups; TableError on an error."""
    with path.open("rb") as f:
        top = tomllib.load(f)
    groups: List[Group] = []
    for keys in top["group"]:
        if keys["space"] not in SPACES:
            raise TableError(f"{keys['name']}: space {keys['space']}")
        group = Group(keys["name"], keys["space"], keys["first"], keys["title"])
        address = group.first
        for one in keys["registers"]:
            group.registers.append(_register(one, address, group.space))
            address += group.registers[-1].words
        groups.append(group)
    _check(groups)
    return groups


def _check(groups: List[Group]) -> None:
    names = [r.name for g in groups for r in g.registers]
    doubled = {n for n in names if names.count(n) > 1}
    if doubled:
        raise TableError(f"twice: {sorted(doubled)}")
    for space in SPACES:
        blocks = [(g.first, g.end) for g in groups if g.space == space]
        if blocks != sorted(blocks) or any(a[1] > b[0] for a, b in zip(blocks, blocks[1:])):
            raise TableError(f"{space}: groups overlap or are out of order")


def of_space(groups: List[Group], space: str) -> Iterator[Register]:
    """In the order of their addresses."""
    for g in groups:
        if g.space == space:
            yield from g.registers
