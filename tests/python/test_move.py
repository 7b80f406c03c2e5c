# SPDX-License-Identifier: MIT
"""Profile position by the tool and by a master of one's own."""

from __future__ import annotations

import re
import time
from concurrent.futures import ThreadPoolExecutor
from subprocess import CompletedProcess

from conftest import Served
from support import command, run_at, until

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
    assert there.returncode == 0 and abs(where_it_says(there.stdout).now - 15000) <= WINDOW_CNT, (
        there
    )
    assert until(drive, lambda r: r.mode == Mode.READY)
    let_go = move.where(drive).now
    assert abs(let_go - 15000) <= DRIFT_CNT
    back = command(
        "move",
        "--relative",
        "--counts",
        "--for",
        "0.2",
        "--speed",
        "600",
        *served.options(),
        "--",
        "-7500",
    )
    found = where_it_says(back.stdout)
    assert back.returncode == 0 and abs(found.now - found.target) <= WINDOW_CNT, back
    assert (
        abs(found.target - (let_go - 7500)) <= DRIFT_CNT
    )  # relative to where it stands when it is enabled again


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


def while_it_runs(drive: Drive, *words: str) -> CompletedProcess:
    """A command, while this master goes on asking."""
    with ThreadPoolExecutor(1) as one:
        done = one.submit(command, *words)
        while not done.done():
            drive.read()
            time.sleep(0.05)
        return done.result()


def test_a_run_in_another_mode_is_neither_taken_over_nor_disturbed(
    served: Served, drive: Drive
) -> None:
    run_at(drive, 100.0)
    refused = while_it_runs(drive, "move", "1", *served.options())
    assert refused.returncode == 1 and "another mode" in refused.stderr + refused.stdout, refused
    reading = drive.read()
    assert reading.mode == Mode.RUN and abs(reading.speed_e_radps - 100.0) < 5.0, reading
    session.stop(drive)


def test_a_move_is_not_made_a_run(served: Served, drive: Drive) -> None:
    session.start(drive, 0.0, move.PROFILE_POSITION)
    assert until(drive, lambda r: r.mode == Mode.RUN)
    refused = while_it_runs(drive, "run", "100", *served.options())
    assert refused.returncode == 1 and "another mode" in refused.stderr + refused.stdout, refused
    assert drive.read().mode == Mode.RUN
    session.stop(drive)
