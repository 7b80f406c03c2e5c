# SPDX-License-Identifier: MIT
"""Profile position by the tool and by a master of one's own."""

from __future__ import annotations

import re

from conftest import Served
from support import command, until

from sdre_drive import move, session
from sdre_drive.connection import Drive
from sdre_drive.registers import Mode

WINDOW_CNT = 4  # POSITION_WINDOW
DRIFT_CNT = 200  # a shaft that is let go turns on, braked by its viscous friction alone


def where_it_says(output: str) -> move.Where:
    """The last line of `sdre-drive move`."""
    found = re.search(r"(-?\d+) counts, wanted (-?\d+)", output)
    assert found, output
    return move.Where(int(found.group(1)), int(found.group(2)))


def test_move_goes_there_and_back(served: Served, drive: Drive) -> None:
    there = command("move", "1.5", "--for", "0.2", *served.options())
    assert there.returncode == 0 and abs(where_it_says(there.stdout).now - 15000) <= WINDOW_CNT, there
    assert until(drive, lambda r: r.mode == Mode.READY)
    let_go = move.where(drive).now
    assert abs(let_go - 15000) <= DRIFT_CNT
    back = command("move", "--relative", "--counts", "--for", "0.2", "--speed", "600", *served.options(), "--", "-7500")
    found = where_it_says(back.stdout)
    assert back.returncode == 0 and abs(found.now - found.target) <= WINDOW_CNT, back
    assert abs(found.target - (let_go - 7500)) <= DRIFT_CNT  # relative to where it stands when it is enabled again


def test_a_load_does_not_move_it_away(served: Served, drive: Drive) -> None:
    session.start(drive, 0.0, move.PROFILE_POSITION)
    until(drive, lambda r: bool(r.statusword & move.REACHED))
    held = move.where(drive).target
    served.bench().ask("load 1.0")
    for _ in range(10):
        until(drive, lambda r: r.mode == Mode.RUN)
    until(drive, lambda r: r.iq_A > 1.2 and bool(r.statusword & move.REACHED))
    assert abs(move.where(drive).now - held) <= 2 * WINDOW_CNT
    session.stop(drive)


def test_a_run_in_another_mode_is_not_taken_over(served: Served, drive: Drive) -> None:
    session.start(drive, 100.0)
    refused = command("move", "1", *served.options())
    assert refused.returncode == 1 and "another mode" in refused.stderr + refused.stdout, refused
