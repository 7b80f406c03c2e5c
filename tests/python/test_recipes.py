# SPDX-License-Identifier: MIT
"""Every way to see a fault in the virtual drive that the table of faults tells."""

from __future__ import annotations

from typing import Iterator

import pytest
from conftest import Served
from support import LONGEST_S, run_at, until

from sdre_drive import faults, session
from sdre_drive.connection import Drive
from sdre_drive.faults import Entry, Recipe
from sdre_drive.registers import Mode, Reading


def recipes() -> Iterator[Entry]:
    """Those for this tool; silence has a test of its own."""
    for group in faults.GROUPS:
        for entry in faults.table()[group].values():
            if isinstance(entry.reproduce, Recipe) and entry.name != "SILENT":
                yield entry


def is_there(reading: Reading, entry: Entry) -> bool:
    """Fault or condition."""
    if entry.group == "condition":
        return bool(reading.conditions & entry.number)
    return entry in faults.explain(reading.why)


@pytest.mark.parametrize("entry", recipes(), ids=lambda e: f"{e.group}_{e.name}")
def test_recipe(served: Served, drive: Drive, entry: Entry) -> None:
    how = entry.reproduce
    assert isinstance(how, Recipe)
    bench = served.bench()
    if how.at_e_radps:
        run_at(drive, how.at_e_radps)
    for line in how.bench:
        bench.ask(line)
    began_s = drive.read().time_s
    if how.then == "run":
        until(drive, lambda r: r.mode == Mode.READY)
        drive.set_run(True)
    if how.then == "stop --coast":
        until(drive, lambda r: r.time_s > began_s + how.wait_s)
        session.stop(drive, coast=True)
        began_s = drive.read().time_s
    reading = until(
        drive,
        lambda r: is_there(r, entry) or r.mode == Mode.FAULT or r.time_s > began_s + how.wait_s,
        LONGEST_S,
    )
    assert is_there(reading, entry), reading
