# SPDX-License-Identifier: MIT
"""`sdre-drive verify` on virtual drives whose machine is as the drive file says, or is not."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path

import pytest
from conftest import ROOT, SHIPPED, Served, serving
from support import command, until

from sdre_drive.connection import Drive
from sdre_drive.registers import Mode

SIL = os.environ.get("SDRE_SIL", str(ROOT / "build/host/bin/sdre-sil"))


def verify(served: Served, drive_file: Path, *words: str):
    """The command on a virtual drive."""
    return command("verify", str(drive_file), "--sil", SIL, *served.options(), *words)


def changed(tmp_path: Path, **values: float) -> Path:
    """The shipped drive file with other values."""
    text = SHIPPED.read_text()
    for key, value in values.items():
        text, count = re.subn(rf"(?m)^{key} .*$", f"{key} = {value}", text)
        assert count == 1, key
    file = tmp_path / "machine.toml"
    file.write_text(text)
    return file


def test_a_machine_as_its_file_says_is_within(served: Served, drive: Drive, tmp_path: Path) -> None:
    drive.write("ACCELERATION", 1234.0)
    table = tmp_path / "table.json"
    done = verify(served, SHIPPED, "--json", str(table))
    assert done.returncode == 0 and "within: this machine behaves" in done.stdout, done
    found = json.loads(table.read_text())
    assert found["within"] and found["cause"] is None
    assert drive.holding(7, 2) == [0, 1234]  # the ramps are as before
    assert until(drive, lambda r: r.mode == Mode.READY)


@pytest.mark.parametrize(
    "key, value, name",
    [("inertia_kgm2", 0.000504, "inertia"), ("pm_flux_Wb", 0.1737, "magnet flux")],
)
def test_another_machine_is_found_and_named(
    tmp_path: Path, key: str, value: float, name: str
) -> None:
    with serving(tmp_path, "--machine", str(changed(tmp_path, **{key: value}))) as served:
        done = verify(served, SHIPPED)
    assert done.returncode == 4 and f"OUTSIDE: {name} explains most of it" in done.stdout, done


def test_what_the_drive_does_not_run_is_refused_before_it_turns(
    served: Served, drive: Drive, tmp_path: Path
) -> None:
    other = verify(served, changed(tmp_path, inertia_kgm2=0.0005))
    assert other.returncode == 1 and "load its image" in other.stderr, other
    drive.write("MAX_CURRENT", 3.0)
    less = verify(served, SHIPPED)
    assert less.returncode == 1 and "MAX_CURRENT is 3 A" in less.stderr, less
    missing = verify(served, tmp_path / "none.toml")
    assert missing.returncode == 1 and "none.toml" in missing.stderr, missing
    assert drive.read().mode == Mode.READY
    no_program = command("verify", str(SHIPPED), "--sil", "no-sil", *served.options())
    assert no_program.returncode == 1 and 'no program "no-sil"' in no_program.stderr, no_program


def test_a_trip_is_told_as_such(served: Served, drive: Drive) -> None:
    served.bench().ask('fault kind = "phase_open", phase = "a"')
    done = verify(served, SHIPPED)
    assert done.returncode == 4 and "tripped" in done.stderr, done
