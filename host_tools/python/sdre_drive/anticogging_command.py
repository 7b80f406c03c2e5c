# SPDX-License-Identifier: MIT
"""`sdre-drive anticogging`."""

from __future__ import annotations

import json
import shlex
from pathlib import Path
from typing import List, Optional

import typer
from rich.table import Table
from typing_extensions import Annotated

from sdre_drive import anticogging as maker
from sdre_drive import record, ripple
from sdre_drive.connection import Drive, DriveError
from sdre_drive.options import Port, Tcp, target
from sdre_drive.terminal import Json, out, progress

anticogging = typer.Typer(
    no_args_is_help=True, help="Smooths a shaft that cogs: docs/anticogging.md. The shaft turns."
)

Speed = Annotated[
    float, typer.Option("--speed", min=0.1, help="r/min of the shaft; slow shows most")
]


def _measured(speed: float, port: Port, tcp: Tcp, file: Json) -> ripple.Ripple:
    with Drive(target(port, tcp)) as drive, progress("measuring") as bar:
        found = ripple.measure(drive, speed, bar.share)
    if file:
        record.write_json(file, found.json())
    return found


def _table(found: ripple.Ripple, before: Optional[ripple.Ripple]) -> Table:
    orders = sorted({*found.found(), *(before.found() if before else ())})
    table = Table(box=None, padding=(0, 2, 0, 0))
    columns: List[str] = ["order", *(["before"] if before else []), "now" if before else "r/min"]
    for column in columns:
        table.add_column(column, justify="right")
    table.add_column("r/min, amplitude; what makes it" if before else "what makes it")
    for order in orders:
        old = [f"{before.at(order):.3g}"] if before else []
        table.add_row(str(order), *old, f"{found.at(order):.3g}", found.words(order))
    old = [f"{before.rms_rpm:.3g}"] if before else []
    table.add_row("all", *old, f"{found.rms_rpm:.3g}", "rms, with noise")
    return table


def _before(file: Optional[Path]) -> Optional[ripple.Ripple]:
    if file is None:
        return None
    try:
        return ripple.from_json(json.loads(file.read_text()))
    except OSError as e:
        raise DriveError(f"{file}: {e.strerror}") from e
    except (ValueError, TypeError) as e:
        raise DriveError(f"{file}: is no file of `sdre-drive anticogging ... --json`") from e


@anticogging.command()
def learn(
    drive_file: Annotated[Path, typer.Argument(metavar="DRIVE", help="that the drive runs")],
    file: Annotated[Path, typer.Option("--out", help="drive file to write", metavar="FILE")],
    speed: Speed,
    slots: Annotated[
        int, typer.Option("--slots", min=0, help="periods of the cogging in a turn; 0: find them")
    ] = 0,
    keep: Json = None,
    port: Port = None,
    tcp: Tcp = None,
) -> None:
    """Measures the ripple of the speed, and writes a drive file with a law that learns it."""
    maker.drive_text(drive_file, maker.Cogging(1, [1]))  # refuses before the shaft turns
    found = _measured(speed, port, tcp, keep)
    out.print(_table(found, None))
    cogging = maker.cogging_of(found, slots)
    record.write_text(file, maker.drive_text(drive_file, cogging))
    quoted = shlex.quote(str(file))
    out.print(
        f"{file}: law noc_h for a cogging of {cogging.slots} periods a turn; next: sdre-gains tune "
        f"{quoted}",
        soft_wrap=True,
        highlight=False,
    )


@anticogging.command()
def check(
    speed: Speed,
    before: Annotated[
        Optional[Path], typer.Option("--before", help="of an earlier --json", metavar="FILE")
    ] = None,
    keep: Json = None,
    port: Port = None,
    tcp: Tcp = None,
) -> None:
    """Measures the ripple of the speed, beside that of an earlier measurement."""
    earlier = _before(before)
    out.print(_table(_measured(speed, port, tcp, keep), earlier))
