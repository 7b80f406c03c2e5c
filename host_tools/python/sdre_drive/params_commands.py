# SPDX-License-Identifier: MIT
"""`sdre-drive params`."""

from __future__ import annotations

from pathlib import Path
from typing import Dict, List, Optional

import typer
from rich.console import Console
from rich.table import Table
from typing_extensions import Annotated

from sdre_drive import params as parameters
from sdre_drive import record
from sdre_drive.connection import Drive, DriveError
from sdre_drive.load import NAME
from sdre_drive.options import Port, Tcp, target
from sdre_drive.params import Value, text_of
from sdre_drive.terminal import Json

params = typer.Typer(
    no_args_is_help=False,
    help="The parameters, which the drive keeps over power: list, get, set, save, defaults, "
    "export, import, compare.",
)
out = Console(soft_wrap=True)


def _table(found: List[Value]) -> Table:
    table = Table(box=None, padding=(0, 2, 0, 0))
    for title in ("", "parameter", "value", "unit", "range", "default", ""):
        table.add_column(title, no_wrap=True)
    for v in found:
        p = v.parameter
        table.add_row(
            "*" if v.changed else "",
            v.name,
            text_of(v.value),
            p.register.unit,
            f"{text_of(p.low)} .. {text_of(p.high)}",
            text_of(v.default),
            "only while stopped" if p.stopped else "",
        )
    return table


@params.callback(invoke_without_command=True)
def show(
    context: typer.Context,
    port: Port = None,
    tcp: Tcp = None,
    csv: Annotated[
        Optional[Path], typer.Option("--csv", help="into a file instead", metavar="FILE")
    ] = None,
    json: Json = None,
) -> None:
    """All of them; * is not the default."""
    if context.invoked_subcommand:
        return
    with Drive(target(port, tcp)) as drive:
        found, state = parameters.read(drive), parameters.stored(drive)
    if json:
        record.write_json(json, [dict(zip(parameters.COLUMNS, r)) for r in parameters.rows(found)])
    elif csv:
        parameters.write_csv(csv, found)
        out.print(f"{len(found)} parameters written to {csv}")
    else:
        out.width = max(out.width, 120)
        out.print(_table(found))
        out.print(f"at its start the drive had {state.words}", highlight=False)


@params.command()
def get(name: str, port: Port = None, tcp: Tcp = None) -> None:
    """The value of one, and nothing else."""
    if name.upper() not in parameters.NAMES:
        raise DriveError(f"{name} is not a parameter; sdre-drive params lists them")
    with Drive(target(port, tcp)) as drive:
        out.print(
            text_of(next(v.value for v in parameters.read(drive) if v.name == name.upper())),
            highlight=False,
        )


def _write(wanted: Dict[str, float], port: Optional[str], tcp: Optional[str]) -> None:
    parameters.require_possible(wanted)
    with Drive(target(port, tcp)) as drive:
        parameters.write(drive, wanted)
        for line in parameters.acts_as(drive, wanted):
            out.print(line, highlight=False)
    out.print(
        f"{len(wanted)} set; they last until the drive restarts, or for good with: sdre-drive "
        f"params save"
    )


@params.command(name="set")
def set_values(
    assignments: Annotated[
        List[str],
        typer.Argument(help="NAME=VALUE, in the unit of the list", metavar="NAME=VALUE.."),
    ],
    port: Port = None,
    tcp: Tcp = None,
) -> None:
    """Changes some, until the drive is switched off: `save` keeps them."""
    _write(parameters.parse(assignments), port, tcp)


def _line_words(drive: Drive) -> str:
    t = drive.target
    if t.can:
        rate_words = "" if t.can_rate == 500000 else f" --can-rate {t.can_rate}"
        node_words = "" if t.node == 1 else f" --node {t.node}"
        both = rate_words + node_words
        return f"; from now on: sdre-drive --can {t.can}{both} .." if both else ""
    if (t.baud, t.format, t.unit) == (115200, "8E1", 1):
        return ""
    return f"; from now on: sdre-drive --line {t.baud}-{t.format} --unit {t.unit} .."


@params.command()
def save(port: Port = None, tcp: Tcp = None) -> None:
    """Stores all as they are, in the drive's flash. The drive restarts; the motor has to stand
    still."""
    with Drive(target(port, tcp)) as drive:
        now = parameters.save(drive)
        out.print(f"in force: {now.words}{_line_words(drive)}", highlight=False)


@params.command()
def defaults(port: Port = None, tcp: Tcp = None) -> None:
    """Forgets what is stored. The drive restarts; the motor has to stand still."""
    with Drive(target(port, tcp)) as drive:
        out.print(f"in force: {parameters.restore(drive).words}", highlight=False)


@params.command(name="export")
def export_file(file: Path, port: Port = None, tcp: Tcp = None) -> None:
    """Writes all to a TOML file."""
    with Drive(target(port, tcp)) as drive:
        record.write_text(
            file, parameters.toml(parameters.read(drive), drive.identify().get(NAME, "a drive"))
        )
    out.print(f"{file}: written")


@params.command(name="import")
def import_file(file: Path, port: Port = None, tcp: Tcp = None) -> None:
    """Sets what stands in a TOML file; nothing, when a name or value is no good."""
    wanted = parameters.read_toml(file)
    _write(wanted, port, tcp)


@params.command(
    epilog="Example, after a new firmware: sdre-drive params compare before_update.toml"
)
def compare(file: Path, port: Port = None, tcp: Tcp = None, json: Json = None) -> None:
    """Tells what differs from a TOML file of `export`, and which names this firmware does not
    have."""
    wanted = parameters.read_toml(file)
    with Drive(target(port, tcp)) as drive:
        found = parameters.compare(drive, wanted)
    if json:
        record.write_json(json, found.as_dict())
        return
    for line in found.lines(file):
        out.print(line, highlight=False, markup=False)
