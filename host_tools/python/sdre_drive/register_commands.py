# SPDX-License-Identifier: MIT
"""`sdre-drive get` and `sdre-drive set`: any register by its name."""

from __future__ import annotations

from typing import Dict, List, Optional

import typer
from rich.table import Table
from typing_extensions import Annotated

from sdre_drive import params as parameters
from sdre_drive import record, register_words
from sdre_drive.connection import Drive, DriveError, Refused
from sdre_drive.options import Port, Tcp, target
from sdre_drive.register_map import BY_NAME, HOLDING, INPUT, Register
from sdre_drive.registers import WORDS, value_of
from sdre_drive.terminal import Json, out

GET_EXAMPLES = (
    "Examples: sdre-drive get COMMISSION_REASON; sdre-drive get SPEED_NOW_RPM IQ; sdre-drive get"
)
SET_EXAMPLES = "Examples: sdre-drive set DECELERATION=400; sdre-drive set LOST_OPTION='quick stop'"


def read(drive: Drive, r: Register) -> float:
    """One register, in its unit."""
    count = WORDS[r.type]
    if r.name in register_words.READ_ONLY:
        return value_of(r, drive.words(r.address, count))
    return drive.parameter(r.name)


def _list() -> None:
    table = Table(box=None, padding=(0, 2, 0, 0))
    for title in ("register", "address", "unit", ""):
        table.add_column(title, no_wrap=True)
    for r in (*HOLDING, *INPUT):
        space = "input" if r.name in register_words.READ_ONLY else "holding"
        table.add_row(r.name, str(r.address), r.unit, space)
    out.print(table)


def get(
    names: Annotated[
        Optional[List[str]], typer.Argument(metavar="NAME..", help="none: list all registers")
    ] = None,
    json: Json = None,
    port: Port = None,
    tcp: Tcp = None,
) -> None:
    """Reads registers by name, with what the numbers mean."""
    if not names:
        _list()
        return
    wanted = [register_words.register(name) for name in names]
    with Drive(target(port, tcp)) as drive:
        drive.constants()  # of the same register map
        found = {r.name: read(drive, r) for r in wanted}
    if json:
        record.write_json(json, found)
        return
    for name, value in found.items():
        before = f"{name} = " if len(found) > 1 else ""
        out.print(
            before + register_words.text(name, value), markup=False, highlight=False, soft_wrap=True
        )


def wanted_of(assignments: List[str]) -> Dict[str, float]:
    """NAME=VALUE, each; DriveError before anything is written."""
    wanted: Dict[str, float] = {}
    for text in assignments:
        name, equals, given = text.partition("=")
        if not equals:
            raise DriveError(f'"{text}" is not NAME=VALUE')
        r = register_words.register(name.strip())
        if r.name in register_words.READ_ONLY:
            raise DriveError(f"{r.name} can only be read")
        wanted[r.name] = register_words.value_of(r.name, given)
    parameters.require_possible({k: v for k, v in wanted.items() if k in parameters.NAMES})
    return wanted


def set_registers(
    assignments: Annotated[
        List[str], typer.Argument(metavar="NAME=VALUE..", help="in the register's unit")
    ],
    port: Port = None,
    tcp: Tcp = None,
) -> None:
    """Writes holding registers by name; a parameter lasts until the drive restarts."""
    wanted = wanted_of(assignments)
    with Drive(target(port, tcp)) as drive:
        drive.constants()
        for name, value in wanted.items():
            try:
                drive.write(name, value)
            except Refused as e:
                raise DriveError(f"{name}: {e}") from e
        kept = {k: v for k, v in wanted.items() if k in parameters.NAMES}
        for line in parameters.acts_as(drive, kept):
            out.print(line, markup=False, highlight=False, soft_wrap=True)
        for name in wanted:
            has = read(drive, BY_NAME[name])
            out.print(
                f"{name} = {register_words.text(name, has)}",
                markup=False,
                highlight=False,
                soft_wrap=True,
            )
