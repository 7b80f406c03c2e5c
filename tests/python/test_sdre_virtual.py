# SPDX-License-Identifier: MIT
"""sdre.VirtualDrive: the firmware in real time, by its own Modbus server."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest

import sdre

ROOT = Path(__file__).resolve().parents[2]
SHIPPED = ROOT / "firmware/config/drives/ipmsm_390w.toml"
SPEED_rpm = 600.0
NEAR_rpm = 10.0  # chosen: ten times the ripple of the register
SILENCE_s = 1.0  # twice the time after which a silent master ends a run
os.environ.setdefault("SDRE_SIL", str(ROOT / "build/host/bin/sdre-sil"))


def settled_rpm(drive: sdre.VirtualDrive, wanted_rpm: float) -> float:
    """The speed when it is near, or after ten seconds."""
    end_s = time.monotonic() + 10.0
    while abs(drive.speed_rpm - wanted_rpm) > NEAR_rpm and time.monotonic() < end_s:
        time.sleep(0.05)
    return drive.speed_rpm


def test_runs_is_loaded_and_stops() -> None:
    with sdre.VirtualDrive(SHIPPED) as drive:
        drive.run(SPEED_rpm)
        assert settled_rpm(drive, SPEED_rpm) == pytest.approx(SPEED_rpm, abs=NEAR_rpm)
        free_A = drive.read().iq_A
        drive.load(0.75)
        time.sleep(SILENCE_s)
        assert drive.read().iq_A > free_A + 0.5
        assert drive.speed_rpm == pytest.approx(SPEED_rpm, abs=NEAR_rpm)
        drive.run(-SPEED_rpm)
        assert settled_rpm(drive, -SPEED_rpm) == pytest.approx(-SPEED_rpm, abs=NEAR_rpm)
        assert drive.stop().mode_words == "ready, bridge off"
        process = drive._process
        drive.close()
    assert process.poll() is not None


def test_takes_a_drive_that_is_no_file() -> None:
    changed = sdre.Drive.from_toml(SHIPPED).replaced({"name": "slow", "motor.max_current_A": 3.0})
    with sdre.VirtualDrive(changed) as drive:
        assert drive.connection.constants().current_max_A == pytest.approx(3.0)


def test_what_is_wrong_is_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    bad = tmp_path / "bad.toml"
    bad.write_text("schema = 1\n")
    with pytest.raises(sdre.InputError, match=r"bad\.toml") as found:
        sdre.VirtualDrive(bad)
    assert "\n" not in str(found.value)
    monkeypatch.setitem(sys.modules, "sdre_drive.bench", None)
    with pytest.raises(sdre.InputError, match="pip install sdre-drive"):
        sdre.VirtualDrive(SHIPPED)
