# SPDX-License-Identifier: MIT
"""`sdre-drive bench`, and the bench's line in `sdre-drive status`."""

from __future__ import annotations

from typing import Any, Dict, List, Optional

import typer
from rich.table import Table
from typing_extensions import Annotated

from sdre_drive import bench as benches
from sdre_drive import record
from sdre_drive.bench import Bench
from sdre_drive.bench_faults import FAULTS
from sdre_drive.connection import DriveError, Target, is_pseudo_terminal
from sdre_drive.options import Control, bench_address
from sdre_drive.terminal import Json, out

EPILOG = "\n\n".join(
    (
        "Examples: sdre-drive bench load 1.2 (a brake), or load -1.2 active (drives the shaft)",
        "sdre-drive bench dc_link 280; mend; power_cycle; switch home 1 1.2 (turns); "
        "holding_brake 3 0.05 0.03 (N m, s to release and to close)",
        'sdre-drive bench break "motor wire a broken"; the names: ' + ", ".join(FAULTS),
    )
)


def line_of(words: List[str]) -> str:
    """The bench's own command for words of a person."""
    if words[0] != "break":
        return " ".join(words)
    name = " ".join(words[1:])
    if name not in FAULTS:
        raise DriveError(f'"{name}" is nothing to break: give one of {", ".join(FAULTS)}')
    return FAULTS[name]


def bench(
    words: Annotated[
        Optional[List[str]], typer.Argument(metavar="COMMAND", help="none: show how it is set")
    ] = None,
    control: Control = None,
    json: Json = None,
) -> None:
    """The bench of a virtual drive: its load, its supply, what is broken."""
    one = Bench(bench_address(control))
    try:
        state = one.ask(line_of(words) if words else "state")
    finally:
        one.close()
    if json:
        record.write_json(json, state)
        return
    table = Table(show_header=False, box=None, padding=(0, 2, 0, 0))
    for name, text in benches.rows(state):
        table.add_row(name, text)
    out.print(table)


def state_beside(target: Target, control: Optional[str]) -> Optional[Dict[str, Any]]:
    """State of the bench of this drive; None when it has none here."""
    line = bool(target.serial_port and is_pseudo_terminal(target.serial_port))
    if not control and not target.is_local and not line:
        return None
    try:
        one = Bench(bench_address(control))
    except DriveError:
        if control:
            raise
        return None
    try:
        state = one.ask("state")
    finally:
        one.close()
    mine = control or line or state.get("tcp_port") == target.tcp_port
    return state if mine else None
