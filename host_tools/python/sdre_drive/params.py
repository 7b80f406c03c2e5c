# SPDX-License-Identifier: MIT
"""The parameters of a drive, which it keeps over power: docs/parameters.md."""

from __future__ import annotations

import csv
import re
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Dict, Iterable, List, Tuple

from sdre_drive import register_map
from sdre_drive.connection import FORMATS, Drive, DriveError, Refused, is_pseudo_terminal
from sdre_drive.load import NOT_TAKEN
from sdre_drive.register_map import BY_NAME, PARAMETERS, Parameter
from sdre_drive.registers import STORED_WORDS, block, values, words_of

try:
    import tomllib
except ModuleNotFoundError:  # before Python 3.11
    import tomli as tomllib  # type: ignore[no-redef]

NAMES = {p.register.name: p for p in PARAMETERS}
# The first two as in CiA 301.
SIGNATURES = {
    "STORE_PARAMETERS": b"save",
    "RESTORE_PARAMETERS": b"load",
    "ACCEPT_FALLBACK": b"take",
}
LOST = 2048 | 4096  # conditions that ACCEPT_FALLBACK ends
DONE, FLASH_FAILED = 1, 2
# data sheet: a sector is erased in 2 s typical, 15 s at most; two of them, and requests without an
# answer
BACK_S = 90.0
NEW_S = 1.0  # a drive that has just started: its time would not tell a restart


@dataclass(frozen=True)
class Value:
    """A parameter as the drive has it."""

    parameter: Parameter
    value: float
    default: float

    @property
    def name(self) -> str:
        return self.parameter.register.name

    @property
    def changed(self) -> bool:
        """Differs from the default, within the resolution of a register."""
        return abs(self.value - self.default) > 0.5 * (self.parameter.register.step or 1.0)


@dataclass(frozen=True)
class Stored:
    """How the drive has come by its parameters."""

    state: int
    done: int
    number: int
    dropped: int = 0

    @property
    def words(self) -> str:
        """As text."""
        known = (
            STORED_WORDS[self.state] if self.state < len(STORED_WORDS) else f"state {self.state}"
        )
        less = (
            f", but {self.dropped} that this firmware does not have: sdre-drive params compare "
            "YOUR_EXPORT names them; then save"
            if self.dropped
            else ""
        )
        return (f"{known}, writing {self.number}" if self.number else known) + less


def text_of(x: float) -> str:
    """A value without what single steps leave behind."""
    return f"{x:.9g}"


def read(drive: Drive) -> List[Value]:
    """All of them."""
    raw: Dict[str, float] = {}
    for group in register_map.PARAMETER_BLOCKS:
        raw.update(values(group, drive.holding(*block(group))))
    largest = drive.constants().current_max_A
    return [
        Value(p, raw[p.register.name], largest if p.default is None else p.default)
        for p in PARAMETERS
    ]


def stored(drive: Drive) -> Stored:
    """Where they come from."""
    raw = drive.values(register_map.STORED)
    return Stored(
        int(raw["PARAMETERS_STATE"]),
        int(raw["PARAMETERS_DONE"]),
        int(raw["PARAMETERS_NUMBER"]),
        int(raw["PARAMETERS_DROPPED"]),
    )


def require_possible(wanted: Dict[str, float]) -> None:
    """DriveError for a name that is none or a value out of its range; the drive looks again."""
    for name, value in wanted.items():
        if name not in NAMES:
            raise DriveError(f"{name} is not a parameter; sdre-drive params lists them")
        p = NAMES[name]
        if not p.low <= value <= p.high:
            raise DriveError(
                f"{name}: {text_of(value)} is not within {text_of(p.low)} .. {text_of(p.high)} "
                f"{p.register.unit}".rstrip()
            )
        words_of(p.register, value)


def comma_words(text: str) -> str:
    """A hint for a text with a decimal comma; empty for any other."""
    found = re.search(r"(?<!\S)-?\d+,\d+(?!\S)", text)
    return f"; the decimal sign is a point: {found.group().replace(',', '.')}" if found else ""


def parse(assignments: Iterable[str]) -> Dict[str, float]:
    """NAME=VALUE, each."""
    wanted: Dict[str, float] = {}
    for text in assignments:
        name, _, number = text.partition("=")
        try:
            wanted[name.strip().upper()] = float(number)
        except ValueError as e:
            raise DriveError(f'"{text}" is not NAME=VALUE{comma_words(number)}') from e
    return wanted


def write(drive: Drive, wanted: Dict[str, float]) -> None:
    """All that are possible, one by one. The address comes last: from then on the drive has another
    one."""
    require_possible(wanted)
    for name in sorted(wanted, key=lambda n: n == "MODBUS_ADDRESS"):
        try:
            drive.write(name, wanted[name])
        except Refused as e:
            why = "; only while stopped" if NAMES[name].stopped else ""
            raise DriveError(f"{name}: {e}{why}") from e
        if name == "MODBUS_ADDRESS" and not drive.target.can:
            drive.move_to(replace(drive.target, unit=int(wanted[name])))


def acts_as(drive: Drive, wanted: Dict[str, float]) -> List[str]:
    """A line for each value that acts otherwise than it was written."""
    known = drive.constants()
    most = {
        "MAX_CURRENT": (known.current_max_A, "CURRENT_MAX"),
        "PROFILE_VELOCITY": (known.speed_max_e_radps, "SPEED_MAX"),
    }
    lines = []
    for name, value in wanted.items():
        unit = NAMES[name].register.unit
        has = drive.parameter(name)
        if name in most and has > most[name][0]:
            limit, register = most[name]
            lines.append(
                f"{name}: {text_of(value)} {unit} acts as {text_of(limit)} {unit}, the drive's "
                f"limit ({register})"
            )
        elif text_of(has) != text_of(value):
            lines.append(f"{name}: the drive has {text_of(has)} {unit}, the nearest that it keeps")
    return lines


def _new_line(drive: Drive, after: Dict[str, float]) -> None:
    """Talks as the drive does after its restart; a virtual one has no line."""
    if drive.target.can:
        rate, node = 1000 * int(after["CAN_RATE"]), int(after["CAN_NODE"])
        if (rate, node) != (drive.target.can_rate, drive.target.node):
            drive.move_to(replace(drive.target, can_rate=rate, node=node))
        return
    t = replace(drive.target, unit=int(after["MODBUS_ADDRESS"]))
    if t.serial_port and not is_pseudo_terminal(t.serial_port):
        t = replace(
            t, baud=int(after["BAUD_RATE"]), format=list(FORMATS)[int(after["LINE_FORMAT"])]
        )
    drive.move_to(t)


def _command(drive: Drive, name: str, after: Dict[str, float]) -> Stored:
    before, begun_s = stored(drive), drive.read().time_s
    time.sleep(max(NEW_S - begun_s, 0.0))
    begun_s = drive.read().time_s
    signature = int.from_bytes(SIGNATURES[name], "little")
    try:
        drive.write_words(BY_NAME[name].address, [signature >> 16, signature & 0xFFFF])
    except Refused as e:
        raise DriveError(
            f"{e}: the motor has to stand still, with the bridge off; after eight writings since "
            f"power-on the next one has to wait for an hour"
        ) from e
    except DriveError:
        pass  # the answer was lost: what has become of it will be seen
    _new_line(drive, after)
    end = time.monotonic() + BACK_S
    while time.monotonic() < end:
        try:
            now, now_s = stored(drive), drive.read().time_s
        except DriveError:  # it restarts, or its flash keeps it
            begun_s = float("inf")
            continue
        if now_s < begun_s or now.number != before.number:
            if now.done != DONE:
                raise DriveError(f"{NOT_TAKEN}; in force: {now.words}")
            return now
        time.sleep(0.1)
    raise DriveError(
        "the drive does not come back: it restarts with what was stored when it is switched off "
        "and on"
    )


def save(drive: Drive) -> Stored:
    """Stores all as they are; the drive restarts."""
    return _command(drive, "STORE_PARAMETERS", {v.name: v.value for v in read(drive)})


def restore(drive: Drive) -> Stored:
    """Forgets what is stored; the drive restarts with its defaults."""
    return _command(drive, "RESTORE_PARAMETERS", {v.name: v.default for v in read(drive)})


def accept(drive: Drive) -> Stored:
    """Accepts what is in use instead of what is lost; the drive restarts."""
    if not drive.read().conditions & LOST:
        raise DriveError("nothing is lost: there is no fall-back to accept")
    return _command(drive, "ACCEPT_FALLBACK", {v.name: v.value for v in read(drive)})


def toml(found: List[Value], name: str) -> str:
    """TOML text for read_toml() and for the user."""
    lines = [
        f"# Parameters of {name}. Lines may be left out: sdre-drive params import changes what "
        f"stands here.",
        "[parameters]",
    ]
    for v in found:
        r = v.parameter.register
        lines.append(
            f"{v.name} = {text_of(v.value)} # "
            + (f"{r.unit}, " if r.unit else "")
            + f"default {text_of(v.default)}"
        )
    return "\n".join(lines) + "\n"


def read_toml(path: Path) -> Dict[str, float]:
    """Names and values of a file."""
    try:
        top = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as e:
        raise DriveError(f"{path}: {e.strerror}") from e
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as e:
        raise DriveError(f"{path}: {e}") from e
    table = top.get("parameters")
    if set(top) != {"parameters"} or not isinstance(table, dict):
        raise DriveError(f"{path}: has to be one table, [parameters]")
    for name, value in table.items():
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise DriveError(f"{path}: {name} is not a number")
    return {name: float(value) for name, value in table.items()}


@dataclass(frozen=True)
class Comparison:
    """A drive beside an exported file."""

    unknown: Dict[str, float]  # in the file, and no parameter of this firmware
    different: Dict[str, Tuple[float, float]]  # name: of the drive, of the file
    dropped: int  # stored parameters that the drive left out

    def as_dict(self) -> Dict[str, Any]:
        """For --json."""
        return {
            "unknown": self.unknown,
            "different": {
                name: {"drive": here, "file": there}
                for name, (here, there) in self.different.items()
            },
            "dropped": self.dropped,
        }

    def lines(self, file: Path) -> List[str]:
        """For the terminal."""
        said = [
            f"{name}: {text_of(value)} in {file}; this firmware does not have it"
            for name, value in self.unknown.items()
        ] + [
            f"{name}: {text_of(here)} in the drive, {text_of(there)} in {file}"
            for name, (here, there) in self.different.items()
        ]
        if self.dropped > len(self.unknown):
            said.append(
                f"the drive left out {self.dropped} stored parameters, and {file} has "
                f"{len(self.unknown)} of them under a name that is gone: the others have "
                "another unit or type now, or came later"
            )
        return said or [f"the drive has what stands in {file}"]


def compare(drive: Drive, wanted: Dict[str, float]) -> Comparison:
    """The drive's parameters beside those of a file, within the resolution of a register."""
    found = {v.name: v for v in read(drive)}
    return Comparison(
        {name: value for name, value in wanted.items() if name not in found},
        {
            v.name: (v.value, wanted[v.name])
            for v in found.values()
            if v.name in wanted
            and not abs(v.value - wanted[v.name]) <= 0.5 * (v.parameter.register.step or 1.0)
        },
        stored(drive).dropped,
    )


COLUMNS = ("name", "value", "unit", "least", "most", "default", "changed", "needs_stop", "object")


def rows(found: List[Value]) -> List[Tuple[str, ...]]:
    """COLUMNS of each."""
    return [
        (
            v.name,
            text_of(v.value),
            v.parameter.register.unit,
            text_of(v.parameter.low),
            text_of(v.parameter.high),
            text_of(v.default),
            str(int(v.changed)),
            str(int(v.parameter.stopped)),
            v.parameter.object,
        )
        for v in found
    ]


def write_csv(path: Path, found: List[Value]) -> None:
    """A line for each."""
    try:
        with path.open("w", newline="", encoding="utf-8") as f:
            out = csv.writer(f, lineterminator="\n")
            out.writerow(COLUMNS)
            out.writerows(rows(found))
    except OSError as e:
        raise DriveError(f"{path}: {e.strerror}") from e
