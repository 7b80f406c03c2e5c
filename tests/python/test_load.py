# SPDX-License-Identifier: MIT
"""A new motor without a compiler: found by the drive, and loaded into it."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from conftest import ROOT, SHIPPED, Served
from support import GAINS, command, image, run_at

from sdre_drive import load as loader
from sdre_drive import session
from sdre_drive.connection import Drive, DriveError, Target


@pytest.fixture
def renamed(tmp_path: Path) -> Path:
    """The shipped motor by another name, and slower."""
    text = SHIPPED.read_text().replace('name = "ipmsm_390w"', 'name = "my_motor"')
    text = text.replace("[inverter]", "max_speed_e_radps = 400.0\n\n[inverter]", 1)
    file = tmp_path / "renamed.toml"
    file.write_text(text)
    return image(file, tmp_path / "renamed.image")


def test_an_image_is_loaded_and_forgotten(served: Served, drive: Drive, renamed: Path) -> None:
    assert "ipmsm_390w" in command("load", *served.options()).stdout
    done = command("load", str(renamed), *served.options())
    assert done.returncode == 0 and "image 1: my_motor" in done.stdout, done
    with Drive(Target(tcp_port=served.tcp)) as again:
        with pytest.raises(DriveError, match="out of the drive's range"):
            again.set_speed(450.0)
        run_at(again, 300.0)
        with pytest.raises(DriveError, match="stop the motor first"):
            loader.load(again, renamed, lambda share: None)
        session.stop(again)
    done = command("load", "--forget", *served.options())
    assert done.returncode == 0 and "compiled in: ipmsm_390w" in done.stdout, done


def test_what_cannot_be_loaded_is_one_line(served: Served, tmp_path: Path, renamed: Path) -> None:
    other = image(ROOT / "firmware/config/drives/ipmsm_390w_noc_h.toml", tmp_path / "other.image")
    damaged = tmp_path / "damaged.image"
    octets = bytearray(renamed.read_bytes())
    damaged.write_bytes(octets[:-2])
    empty = tmp_path / "empty.image"
    empty.write_bytes(b"")
    for file, said in (
        (other, "is for law noc_h"),
        (damaged, "it is damaged"),
        (empty, "no image"),
        (tmp_path / "none", "No such file"),
    ):
        refused = command("load", str(file), *served.options())
        assert (
            refused.returncode == 1 and said in refused.stderr and "Traceback" not in refused.stderr
        ), refused
    assert "compiled in" in command("load", *served.options()).stdout
    refused = command("load", "--accept-fallback", *served.options())
    assert refused.returncode == 1 and "nothing is lost" in refused.stderr, refused
    refused = command("load", "--accept-fallback", "--forget", *served.options())
    assert refused.returncode == 1 and "load: give an image" in refused.stderr, refused


def test_an_image_of_another_board_is_refused_by_the_name_of_the_field(
    served: Served, tmp_path: Path
) -> None:
    board = (ROOT / "firmware/config/boards/board_390w.toml").read_text()
    board = board.replace('"board_390w"', '"own"')
    (tmp_path / "own.toml").write_text(board)
    drive_file = tmp_path / "drive.toml"
    drive_file.write_text(SHIPPED.read_text().replace('"board_390w"', '"own"'))
    for change, said in (
        ((r"dead_time_min_s .*", "dead_time_min_s = 1e-6"), "dead_time_min_s is 1e-06"),
        ((r"current_range_A .*", "current_range_A = 20.0"), "current_range_A is 20"),
        ((r"name = .*", 'name = "own"'), "it is an image for own, the drive is a board_390w"),
    ):
        (tmp_path / "own.toml").write_text(re.sub(*change, board, count=1))
        file = image(drive_file, tmp_path / "own.image")
        refused = command("load", str(file), *served.options())
        assert refused.returncode == 1 and said in refused.stderr, refused
        assert "an image for own" in refused.stderr and "board_390w" in refused.stderr
        assert "in force: what is compiled in" in refused.stderr
        assert "Traceback" not in refused.stderr


def test_a_lost_answer_is_made_good(
    served: Served, renamed: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Words that arrived although nobody heard so are not written again."""
    whole = Drive.write_words
    lost = []

    def write(self: Drive, first: int, values: list) -> None:
        whole(self, first, values)
        if first == loader.OFFSET and values[1] == 5 * loader.PER_REQUEST and not lost:
            lost.append(first)
            raise DriveError("no answer")

    monkeypatch.setattr(Drive, "write_words", write)
    with Drive(served.target()) as drive:
        assert loader.load(drive, renamed, lambda share: None).name == "my_motor"
    assert lost


def test_the_drive_finds_its_motor(served: Served, tmp_path: Path) -> None:
    found, new = tmp_path / "found.toml", tmp_path / "new.toml"
    done = command(
        "commission", "--out", str(found), "--current", "3", "--speed", "1200", *served.options()
    )
    assert done.returncode == 0, done
    subprocess.run(
        [str(GAINS), "from-commissioning", str(found), "--drive", str(SHIPPED), "--out", str(new)],
        check=True,
        capture_output=True,
    )
    text = new.read_text()
    for key, truth, share in (
        ("stator_resistance_Ohm", 2.48, 0.03),
        ("d_axis_inductance_H", 0.07498, 0.05),
        ("q_axis_inductance_H", 0.1139, 0.05),
        ("pm_flux_Wb", 0.193, 0.02),
        ("inertia_kgm2", 4.2e-4, 0.05),
    ):
        value = re.search(rf"^{key}\s*= (\S+)", text, flags=re.M)
        assert value and abs(float(value.group(1)) / truth - 1.0) < share, key
    refused = command(
        "commission",
        "--out",
        str(tmp_path / "x"),
        "--current",
        "300",
        "--speed",
        "1200",
        *served.options(),
    )
    assert (
        refused.returncode == 1
        and not (tmp_path / "x").exists()
        and "Traceback" not in refused.stderr
    )
