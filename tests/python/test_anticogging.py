# SPDX-License-Identifier: MIT
"""The ripple of a shaft that is known, and the whole way to a smooth one on a virtual drive."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Dict, List, Tuple

import pytest
from conftest import ROOT, SHIPPED, Served, serving
from support import command

from sdre_drive import anticogging, ripple
from sdre_drive.connection import DriveError
from sdre_drive.registers import Constants
from sdre_drive.units import e_radps_of

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

KNOWN = Constants(2, 2e-4, 600.0, 5.0, 10000, 10000.0, 0)
SAMPLES = 512
RPM = 240.0
COGGING = 53  # thousandths of the rated torque: 0.08 N m


def signals(orders: Dict[int, float], begin: float, way: float = 1.0) -> Tuple[List[float], ...]:
    """THETA and SPEED of a shaft that ripples by these amplitudes [r/min]."""
    period_s = ripple.decimation_of(KNOWN, RPM, SAMPLES) * KNOWN.period_s
    place, thetas, speeds = begin, [], []
    for _ in range(SAMPLES):
        rpm = RPM + sum(a * math.cos(k * place + k) for k, a in orders.items())
        thetas.append(math.remainder(place * KNOWN.pole_pairs, 2.0 * math.pi))
        speeds.append(e_radps_of(rpm, KNOWN.pole_pairs))
        place += way * rpm * 2.0 * math.pi / 60.0 * period_s
    return thetas, speeds


def ripple_with(orders: Dict[int, float]) -> ripple.Ripple:
    turns = [ripple.turn_of(*signals(orders, 0.7 * k), KNOWN) for k in range(3)]
    return ripple.ripple_of(turns, KNOWN)


@pytest.mark.parametrize("orders", [{24: 3.0}, {1: 0.5, 12: 1.0, 24: 2.0}, {7: 1.0, 48: 1.0}])
def test_a_known_ripple_is_measured(orders: Dict[int, float]) -> None:
    found = ripple_with(orders)
    assert abs(found.speed_rpm - RPM) < 0.1
    for order, amplitude in orders.items():
        # Between two samples the speed is taken as a straight line.
        assert abs(found.at(order) - amplitude) < 0.04 * amplitude + 0.01, (order, found.at(order))
    rms = math.sqrt(sum(a * a for a in orders.values()) / 2.0)
    assert abs(found.rms_rpm - rms) < 0.03 * rms
    assert found.found() == sorted(orders)


def test_backward_it_is_the_same() -> None:
    forward = ripple.turn_of(*signals({24: 1.0}, 0.0), KNOWN)
    thetas, speeds = signals({24: 1.0}, 0.0, way=-1.0)
    backward = ripple.turn_of(thetas, speeds, KNOWN)
    amplitudes = [ripple.ripple_of([t], KNOWN).at(24) for t in (forward, backward)]
    assert abs(amplitudes[0] - amplitudes[1]) < 0.01


def test_less_than_a_turn_is_refused() -> None:
    thetas, speeds = signals({}, 0.0)
    with pytest.raises(DriveError, match="not turned once"):
        ripple.turn_of(thetas[:400], speeds[:400], KNOWN)


def test_speeds_out_of_range_are_refused() -> None:
    for speed in (2.0, 5000.0):
        with pytest.raises(DriveError, match="between 3 and 4688 r/min"):
            ripple.decimation_of(KNOWN, speed, SAMPLES)


@pytest.mark.parametrize(
    ("orders", "slots", "wanted"),
    [
        ({24: 3.0}, 0, (24, [1])),
        ({24: 3.0, 48: 1.0}, 0, (24, [1, 2])),
        ({24: 1.0, 48: 3.0}, 0, (24, [1, 2])),
        ({2: 5.0, 4: 4.0, 12: 3.0, 36: 2.0}, 0, (36, [1])),  # sensors and dead time are larger
        ({12: 3.0}, 12, (12, [1])),  # a data sheet tells it from dead time
        ({}, 18, (18, [1])),
    ],
)
def test_the_cogging_is_told_from_the_rest(
    orders: Dict[int, float], slots: int, wanted: Tuple[int, List[int]]
) -> None:
    assert anticogging.cogging_of(ripple_with(orders), slots) == anticogging.Cogging(*wanted)


@pytest.mark.parametrize("orders", [{}, {1: 1.0, 2: 1.0}, {2: 1.0, 4: 1.0, 12: 1.0}])
def test_without_cogging_there_is_nothing_to_learn(orders: Dict[int, float]) -> None:
    with pytest.raises(DriveError, match="no cogging found.*--slots"):
        anticogging.cogging_of(ripple_with(orders))


def test_the_drive_file_gets_the_law_and_keeps_the_rest() -> None:
    text = anticogging.drive_text(SHIPPED, anticogging.Cogging(24, [1, 2]))
    before, after = tomllib.loads(SHIPPED.read_text()), tomllib.loads(text)
    harmonics = after.pop("harmonics")
    assert after.pop("law") == "noc_h" and after["motor"].pop("slots") == 24
    before.pop("torque")  # noc_h takes none
    assert after == before
    assert harmonics["cogging"] == [1, 2] and harmonics["sensor"] == [1, 2]
    assert abs(harmonics["cogging_weight"] / (0.07 * before["nodo"]["Q"][0]) - 1.0) < 0.01


@pytest.mark.parametrize(
    ("old", "new", "error"),
    [
        ('name = "ipmsm_390w"', 'name = "ipmsm_390w"\nlaw = "noc_h"', "learns the cogging already"),
        ('name = "ipmsm_390w"', 'name = "ipmsm_390w"\nlaw = "pid"', 'law = "pid" is not allowed'),
        ('form = "encoder"', 'form = "speed"', r"\[nodo\] form and order have to be"),
        ("schema = 1", "schema = ", "drive.toml: "),
    ],
)
def test_files_of_other_laws_are_refused(tmp_path: Path, old: str, new: str, error: str) -> None:
    file = tmp_path / "drive.toml"
    file.write_text(SHIPPED.read_text().replace(old, new))
    with pytest.raises(DriveError, match=error):
        anticogging.drive_text(file, anticogging.Cogging(24, [1]))


def beside_the_board(tmp_path: Path, name: str) -> Path:
    """A place for a drive file, whose board file is found from there."""
    boards = tmp_path / "boards"
    boards.mkdir()
    board = ROOT / "firmware/config/boards/board_390w.toml"
    (boards / board.name).write_text(board.read_text())
    (tmp_path / "drives").mkdir()
    return tmp_path / "drives" / name


def test_a_shaft_that_cogs_runs_smoothly_afterwards(tmp_path: Path) -> None:
    """Measured, written, served, measured again. The tuning between costs minutes; it is for what
    the certificate wants."""
    smooth, kept = beside_the_board(tmp_path, "smooth.toml"), tmp_path / "before.json"
    with serving(tmp_path, "--cogging", str(COGGING)) as served:
        where = ["--speed", str(RPM), *served.options()]
        done = command(
            "anticogging", "learn", str(SHIPPED), "--out", str(smooth), "--json", str(kept), *where
        )
    assert done.returncode == 0 and "cogging of 24 periods a turn" in done.stdout, done
    assert "next: sdre-gains tune" in done.stdout
    before = ripple.from_json(json.loads(kept.read_text()))
    machine = ["--machine", str(SHIPPED), "--cogging", str(COGGING)]
    with serving(tmp_path, *machine, drive=smooth) as served:
        after_file = tmp_path / "after.json"
        where = ["--speed", str(RPM), *served.options()]
        done = command(
            "anticogging", "check", "--before", str(kept), "--json", str(after_file), *where
        )
    assert done.returncode == 0 and "before" in done.stdout, done
    after = ripple.from_json(json.loads(after_file.read_text()))
    assert before.at(24) > 3.0 and after.at(24) < 0.1  # measured 3.65 and 0.024
    assert after.rms_rpm < 0.25 * before.rms_rpm


def test_what_cannot_be_is_one_line(served: Served, tmp_path: Path) -> None:
    where = served.options()
    fast = command(
        "anticogging",
        "learn",
        str(SHIPPED),
        "--out",
        str(tmp_path / "n"),
        "--speed",
        "9999",
        *where,
    )
    assert fast.returncode == 1 and "between 3 and" in fast.stderr, fast
    bad = tmp_path / "bad.json"
    bad.write_text("[]")
    check = command("anticogging", "check", "--speed", "240", "--before", str(bad), *where)
    assert check.returncode == 1 and "is no file of" in check.stderr, check
    assert not (tmp_path / "n").exists() and "Traceback" not in fast.stderr + check.stderr
