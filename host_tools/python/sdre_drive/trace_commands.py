# SPDX-License-Identifier: MIT
"""`sdre-drive watch`, `log` and `scope`."""

from __future__ import annotations

from pathlib import Path
from typing import Optional

import typer
from rich.live import Live
from typing_extensions import Annotated

from sdre_drive import record, scope, session, show
from sdre_drive.connection import Drive, DriveError
from sdre_drive.options import PolePairs, Port, Tcp, pole_pairs_of, target
from sdre_drive.terminal import For, end_by_signal, live_line, out

LOG_PERIOD_S = 0.02  # the line carries about 50 readings per second


def watch(
    length_s: For = None, port: Port = None, tcp: Tcp = None, pole_pairs: PolePairs = None
) -> None:
    """Shows the drive until Ctrl-C. A running drive keeps running meanwhile."""
    end = end_by_signal()
    with Drive(target(port, tcp)) as drive, Live(console=live_line, auto_refresh=False) as live:
        pairs = pole_pairs_of(pole_pairs, drive)
        for reading in session.follow(drive, end, 0.1, length_s):
            live.update(show.status(reading, pairs), refresh=True)


def log(
    csv: Annotated[
        Optional[Path], typer.Option("--csv", help="file of lines", metavar="FILE")
    ] = None,
    parquet: Annotated[
        Optional[Path], typer.Option("--parquet", help="file of columns", metavar="FILE")
    ] = None,
    period_s: Annotated[
        float, typer.Option("--period", min=0.0, max=0.4, help="seconds between readings")
    ] = LOG_PERIOD_S,
    length_s: For = None,
    port: Port = None,
    tcp: Tcp = None,
) -> None:
    """Writes readings to a file until Ctrl-C. A running drive keeps running meanwhile."""
    if (csv is None) == (parquet is None):
        raise DriveError("give one of --csv and --parquet")
    end = end_by_signal()
    with Drive(target(port, tcp)) as drive:
        readings = session.follow(drive, end, period_s, length_s)
        count = (
            record.write_csv(csv, readings)
            if csv
            else record.write_parquet(parquet or Path(), readings)
        )
    out.print(f"{count} readings written to {csv or parquet}")


def take_scope(
    csv: Annotated[Path, typer.Option("--csv", help="file of 512 lines", metavar="FILE")],
    signals: Annotated[
        str, typer.Option("--signals", help="up to four of " + ", ".join(scope.NAMES[1:]))
    ] = "SPEED,IQ,ID,DC_LINK",
    decimation: Annotated[
        int, typer.Option("--decimation", min=1, max=65535, help="control periods between samples")
    ] = 1,
    trigger: Annotated[str, typer.Option("--trigger", help="now, rising or falling")] = "now",
    channel: Annotated[
        int, typer.Option("--channel", min=1, max=4, help="the signal that triggers")
    ] = 1,
    level: Annotated[float, typer.Option("--level", help="in its unit")] = 0.0,
    before: Annotated[
        int, typer.Option("--before", min=0, max=511, help="samples before the trigger")
    ] = 0,
    wait_s: Annotated[
        float, typer.Option("--wait", min=0.0, help="for the trigger", metavar="S")
    ] = 10.0,
    port: Port = None,
    tcp: Tcp = None,
) -> None:
    """Takes 512 samples of four signals in the control interrupt. A running drive keeps running
    meanwhile."""
    setup = scope.Setup(signals.split(","), decimation, trigger, channel, level, before)
    scope.require_possible(setup)
    with Drive(target(port, tcp)) as drive:
        capture = scope.take(drive, setup, wait_s)
    record.write_capture(csv, capture)
    out.print(f"{len(capture.time_s)} samples of {', '.join(capture.signals)} written to {csv}")
