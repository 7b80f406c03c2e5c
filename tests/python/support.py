# SPDX-License-Identifier: MIT
"""Common part of several tests."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Callable

from conftest import ROOT

from sdre_drive import session
from sdre_drive.connection import Drive, DriveError
from sdre_drive.registers import Mode, Reading

GAINS = ROOT / "build/host/bin/sdre-gains"
PATIENCE = 5  # times that no answer comes
LONGEST_S = 30.0  # of the drive's time; a start takes 3 s


def command(*words: str) -> subprocess.CompletedProcess:
    """sdre-drive, to its end."""
    return subprocess.run(
        [sys.executable, "-m", "sdre_drive", *words], capture_output=True, text=True, timeout=120
    )


def image(drive_file: Path, out: Path) -> Path:
    """The image of a drive file, in `out`."""
    subprocess.run(
        [str(GAINS), "image", str(drive_file), "--out", str(out)], check=True, capture_output=True
    )
    return out


def until(drive: Drive, wanted: Callable[[Reading], bool], longest_s: float = LONGEST_S) -> Reading:
    """The first reading that is wanted."""
    for _ in range(PATIENCE):
        try:
            reading = session.wait_for(drive, wanted, longest_s)
            assert reading, f"it did not come; now {drive.read()}"
            return reading
        except DriveError:
            continue  # a busy machine
    raise AssertionError("the drive does not answer")


def run_at(drive: Drive, speed_e_radps: float) -> Reading:
    """Until it has the speed, within what noise and load leave."""
    until(drive, lambda r: r.mode == Mode.READY)
    session.start(drive, speed_e_radps)
    reading = until(
        drive,
        lambda r: (
            r.mode == Mode.FAULT
            or (r.mode == Mode.RUN and abs(r.speed_e_radps - speed_e_radps) < 5.0)
        ),
    )
    assert reading.mode == Mode.RUN, reading
    return reading


def stay(drive: Drive, seconds: float) -> Reading:
    """Asks for a while, as a master has to."""
    return list(session.follow(drive, threading.Event(), length_s=seconds))[-1]


def while_it_runs(drive: Drive, *words: str) -> subprocess.CompletedProcess:
    """A command, while this master goes on asking."""
    with ThreadPoolExecutor(1) as one:
        done = one.submit(command, *words)
        while not done.done():
            drive.read()
            time.sleep(0.05)
        return done.result()
