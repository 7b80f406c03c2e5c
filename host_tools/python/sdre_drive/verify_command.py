# SPDX-License-Identifier: MIT
"""`sdre-drive verify`."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Optional

import typer
from typing_extensions import Annotated

from sdre_drive import record, scope
from sdre_drive import verify as verifier
from sdre_drive.connection import Drive
from sdre_drive.options import Port, Tcp, target
from sdre_drive.terminal import end_by_signal, notes, out, progress


def verify(
    drive_file: Annotated[Path, typer.Argument(metavar="DRIVE", help="that the drive runs")],
    keep: Annotated[
        Optional[Path], typer.Option("--records", help="keep what was recorded", metavar="FILE")
    ] = None,
    table: Annotated[str, typer.Option("--json", help="write the table", metavar="FILE")] = "",
    sil: Annotated[
        str, typer.Option("--sil", help="the program that simulates", envvar="SDRE_SIL")
    ] = "sdre-sil",
    port: Port = None,
    tcp: Tcp = None,
) -> None:
    """Does it behave as its simulation says? The shaft turns, both ways, and has to be free."""
    program = verifier.find_sil(sil)
    end = end_by_signal()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with Drive(target(port, tcp)) as drive:
            wanted = verifier.programme(program, drive_file, scope.samples_of(drive), folder)
            verifier.require_same(drive, wanted, drive_file)
            with progress("begins") as bar:
                captures = verifier.Programme(drive, wanted, end).run(bar.stage)
        file = keep or folder / "records.json"
        record.write_text(file, verifier.records(wanted, captures))
        notes.print("recorded; some 1,000 simulations follow: 10 s to a minute")
        done = verifier.judge(program, drive_file, file, table)
    out.print(done.stdout, end="", markup=False, highlight=False, soft_wrap=True)
    raise typer.Exit(done.returncode)
