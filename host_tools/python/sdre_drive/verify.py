# SPDX-License-Identifier: MIT
"""Runs the programme of `sdre-sil verify` on a drive and records it: docs/verify.md."""

from __future__ import annotations

import json
import shutil
import subprocess
import threading
from pathlib import Path
from typing import Any, Callable, Dict, List

from sdre_drive import load, registers, scope, session
from sdre_drive.connection import Drive, DriveError
from sdre_drive.registers import BY_NAME, Mode, Reading

RAMPS = ("ACCELERATION", "DECELERATION")
LONGEST_WAY_S = 60.0  # chosen: longer than any way of the programme
# Chosen: near enough for the wait that follows.
NEAR_SHARE, NEAR_E_RADPS = 0.02, 5.0
LARGEST_CURRENT_SHARE = 0.999  # the register counts mA
NOTHING, OUTSIDE = 0, 4  # exit codes of sdre-sil


def find_sil(given: str) -> str:
    """The program; DriveError when it is not there."""
    found = shutil.which(given)
    if not found:
        raise DriveError(
            f'there is no program "{given}": name it with --sil; '
            "a build of the project has it in build/host/bin"
        )
    return found


def programme(sil: str, drive_file: Path, samples: int, folder: Path) -> Dict[str, Any]:
    """Asks sdre-sil for that of a drive file, for a scope with so many samples."""
    file = folder / "programme.json"
    run_sil([sil, "verify", str(drive_file), "--programme", str(file), "--samples", str(samples)])
    found: Dict[str, Any] = json.loads(file.read_text())
    return found


def run_sil(words: List[str]) -> None:
    """DriveError with its own line when it fails."""
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != NOTHING:
        raise DriveError(done.stderr.strip().removeprefix("sdre-sil: "))


def require_same(drive: Drive, wanted: Dict[str, Any], drive_file: Path) -> None:
    """DriveError when the drive runs other constants, or with less current than its file says."""
    found = load.in_force(drive)
    if found.digest != wanted["digest"]:
        raise DriveError(
            f"the drive runs {found.words}; {drive_file} is {wanted['drive']}, {wanted['digest']}: "
            "load its image, or name the file that the drive was made from"
        )
    most_A = _value(drive, "MAX_CURRENT")
    if most_A < LARGEST_CURRENT_SHARE * wanted["max_current_A"]:
        raise DriveError(
            f"MAX_CURRENT is {most_A:g} A: the simulation has {wanted['max_current_A']:g} A; "
            "set it back first"
        )


def _value(drive: Drive, name: str) -> float:
    r = BY_NAME[name]
    return registers.value_of(r, drive.holding(r.address, registers.WORDS[r.type]))


class Programme:
    """One run of it on a drive."""

    def __init__(self, drive: Drive, wanted: Dict[str, Any], end: threading.Event) -> None:
        self.drive = drive
        self.wanted = wanted
        self.end = end

    def run(self, show: Callable[[str, float], None]) -> List[scope.Capture]:
        """Takes all records. The shaft turns both ways and has to be free. The drive stops after
        them, and its ramps are as before."""
        session.require_mode(self.drive.read())
        before = {name: _value(self.drive, name) for name in RAMPS}
        try:
            self._ramp(self.wanted["way_e_radps2"])
            session.start(self.drive, 0.0)
            self._wait(lambda r: r.mode == Mode.RUN, session.STOP_WAIT_S, "come to run")
            shots = self.wanted["shots"]
            captures = []
            for k, shot in enumerate(shots):
                show(shot["name"], k / len(shots))
                captures.append(self._take(shot))
            session.stop(self.drive)
            return captures
        except DriveError:
            session.withdraw(self.drive)
            raise
        finally:
            for name, value in before.items():
                self._write_if_there(name, value)

    def _write_if_there(self, name: str, value: float) -> None:
        try:
            self.drive.write(name, value)
        except DriveError:
            pass

    def _ramp(self, e_radps2: float) -> None:
        for name in RAMPS:
            self.drive.write(name, e_radps2)

    def _wait(self, wanted: Callable[[Reading], bool], longest_s: float, words: str) -> Reading:
        def stops(reading: Reading) -> bool:
            away = reading.mode in (Mode.FAULT, Mode.READY, Mode.BOOT)
            return self.end.is_set() or away or wanted(reading)

        reading = session.wait_for(self.drive, stops, longest_s)
        if self.end.is_set():
            raise DriveError("ended before the last record")
        if reading is None:
            raise DriveError(f"the drive does not {words} within {longest_s:g} s")
        session.require_moving(reading)
        return reading

    def _go(self, speed_e_radps: float) -> None:
        self._ramp(self.wanted["way_e_radps2"])
        self.drive.set_speed(speed_e_radps)
        near = max(NEAR_SHARE * abs(speed_e_radps), NEAR_E_RADPS)
        there = self._wait(
            lambda r: abs(r.speed_e_radps - speed_e_radps) < near, LONGEST_WAY_S, "reach a speed"
        )
        settled_s = there.time_s + self.wanted["settle_s"]
        self._wait(lambda r: r.time_s >= settled_s, LONGEST_WAY_S, "settle")

    def _take(self, shot: Dict[str, Any]) -> scope.Capture:
        self._go(shot["from_e_radps"])
        self._ramp(shot["acceleration_e_radps2"])
        setup = scope.Setup(
            tuple(shot["signals"]),
            trigger=shot["trigger"],
            level=shot["level_e_radps"],
            before=self.wanted["before"],
        )
        scope.arm(self.drive, setup)
        if shot["trigger"] != "now":
            self._wait(lambda r: scope.is_filled(self.drive), LONGEST_WAY_S, "fill its scope")
        self.drive.set_speed(shot["to_e_radps"])
        self._wait(lambda r: scope.is_done(self.drive), LONGEST_WAY_S, "finish a record")
        return scope.read(self.drive, setup)


def records(wanted: Dict[str, Any], captures: List[scope.Capture]) -> str:
    """The file for `sdre-sil verify --records`."""
    return json.dumps(
        {
            "digest": wanted["digest"],
            "fault": None,
            "shots": [
                {"name": shot["name"], "values": capture.values}
                for shot, capture in zip(wanted["shots"], captures)
            ],
        }
    )


def judge(
    sil: str, drive_file: Path, records_file: Path, table: str
) -> subprocess.CompletedProcess:
    """Compares; DriveError when it could not."""
    words = [sil, "verify", str(drive_file), "--records", str(records_file)]
    done = subprocess.run(
        words + (["--json", table] if table else []), capture_output=True, text=True, check=False
    )
    if done.returncode not in (NOTHING, OUTSIDE):
        raise DriveError(done.stderr.strip().removeprefix("sdre-sil: "))
    return done
