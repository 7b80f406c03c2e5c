# SPDX-License-Identifier: MIT
"""Profile position by the tool and by a master of one's own."""

from __future__ import annotations

import re

from conftest import Served
from support import command, run_at, until, while_it_runs

from sdre_drive import move, session
from sdre_drive.connection import Drive
from sdre_drive.registers import Mode
from sdre_drive.units import e_radps_of

WINDOW_CNT = 4  # POSITION_WINDOW
TURN_CNT = 10000
DRIFT_CNT = 200  # a shaft that is let go turns on, braked by its viscous friction alone


def where_it_says(output: str) -> move.Where:
    """The last line of `sdre-drive move`."""
    found = re.search(r"(-?\d+) position units, wanted (-?\d+)", output)
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
        "-7500",
        "--relative",
        "--counts",
        "--for",
        "0.2",
        "--speed",
        "600",
        *served.options(),
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
    served.bench().ask("load 1.0 active")
    for _ in range(10):
        until(drive, lambda r: r.mode == Mode.RUN)
    until(drive, lambda r: r.iq_A > 1.2 and bool(r.statusword & move.REACHED))
    assert abs(move.where(drive).now - held) <= 2 * WINDOW_CNT
    session.stop(drive)


def test_far_is_asked_for_and_the_zero_is_said(served: Served, drive: Drive) -> None:
    """A run for a while takes the shaft far from its zero."""
    run_at(drive, 600.0)
    until(drive, lambda r: move.where(drive).now > 11 * TURN_CNT)
    session.stop(drive)
    far = command("move", "0", *served.options())
    assert far.returncode == 1 and "turns away" in far.stderr and "--far" in far.stderr, far
    assert drive.read().mode == Mode.READY
    near = command("move", "0.5", "--relative", "--for", "0.1", *served.options())
    assert near.returncode == 0 and "turns; zero: " in near.stdout.replace("\n", " "), near
    back = command("move", "0", "--far", "--speed", "0", "--for", "0.1", *served.options())
    assert back.returncode == 0 and abs(where_it_says(back.stdout).now) <= WINDOW_CNT, back


def test_the_speed_on_the_way_is_a_quiet_one_unless_one_is_given(drive: Drive) -> None:
    assert abs(move.default_speed(drive) - e_radps_of(300.0, 2)) < 0.1
    drive.write("PROFILE_VELOCITY", 50.0)
    assert move.default_speed(drive) == 50.0


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
