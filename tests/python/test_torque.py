# SPDX-License-Identifier: MIT
"""Torques by the tool."""

from __future__ import annotations

import re
import threading

from conftest import Served
from support import command, run_at, until, while_it_runs

from sdre_drive import session, torque
from sdre_drive.connection import Drive
from sdre_drive.registers import PROFILE_TORQUE, Mode
from sdre_drive.units import e_radps_of

RATED_NM = 1.5
PAIRS = 2


def test_the_torque_is_there_up_to_the_speed(served: Served, drive: Drive) -> None:
    """A load takes what is commanded; without it the shaft has the speed limit."""
    until(drive, lambda r: r.mode == Mode.READY)
    end = threading.Event()
    seen: list[torque.Torque] = []
    speeds: list[float] = []

    def show(reading: session.Reading, now: torque.Torque) -> None:
        if reading.mode == Mode.RUN:
            seen.append(now)
            speeds.append(reading.speed_e_radps)

    wanted = torque.Wanted(0.6, e_radps_of(500.0, PAIRS))
    torque.hold(drive, wanted, end, 2.0, show)
    assert abs(speeds[-1] / wanted.speed_e_radps - 1.0) < 0.02
    assert abs(seen[-1].now_Nm) < 0.2  # friction alone
    assert drive.read().mode == Mode.READY


def test_one_that_runs_takes_another_torque(served: Served, drive: Drive) -> None:
    until(drive, lambda r: r.mode == Mode.READY)
    torque.begin(drive, torque.Wanted(0.3, e_radps_of(500.0, PAIRS)))
    served.bench().ask("load 3.0")  # a brake holds the shaft
    torque.begin(drive, torque.Wanted(-0.75, e_radps_of(500.0, PAIRS)))
    until(drive, lambda r: bool(r.statusword & 1 << 10))
    now = torque.now(drive)
    assert abs(now.demand_Nm + 0.75) < 0.01 and abs(now.now_Nm + 0.75) < 0.03, now
    session.stop(drive)


def test_the_command(served: Served, drive: Drive) -> None:
    until(drive, lambda r: r.mode == Mode.READY)
    ran = command("torque", "20", "--percent", "--for", "1", *served.options())
    assert ran.returncode == 0, ran
    assert drive.parameter("TORQUE") == 0.2
    assert re.search(r"READY|waits|ready", ran.stdout), ran
    far = command("torque", "1e6", *served.options())
    assert far.returncode == 1 and "out of range: at most" in far.stderr, far
    fast = command("torque", "0.1", "--speed", "1e6", *served.options())
    assert fast.returncode == 1 and "out of the drive's range" in fast.stderr, fast
    assert drive.read().mode == Mode.READY


def test_a_speed_run_is_not_made_a_torque_run(served: Served, drive: Drive) -> None:
    run_at(drive, 100.0)
    refused = while_it_runs(drive, "torque", "0.1", *served.options())
    assert refused.returncode == 1 and "another mode" in refused.stderr + refused.stdout, refused
    assert drive.read().mode_of_operation != PROFILE_TORQUE
    session.stop(drive)
