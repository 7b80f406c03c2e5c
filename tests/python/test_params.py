# SPDX-License-Identifier: MIT
"""The parameters, by `sdre-drive params`."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest
from conftest import Served
from support import command, run_at

from sdre_drive import params, session
from sdre_drive.connection import Drive, DriveError, Target
from sdre_drive.modbus_link import ModbusLink
from sdre_drive.options import target, use_line


def test_set_save_and_defaults_over_restarts(served: Served, drive: Drive, tmp_path: Path) -> None:
    def get(name: str) -> str:
        return command("params", "get", name, *served.options()).stdout.strip()

    listed = command("params", *served.options())
    assert (
        listed.returncode == 0 and "nothing is stored" in listed.stdout and "*" not in listed.stdout
    ), listed
    for p in params.PARAMETERS:
        assert p.register.name in listed.stdout
    done = command("params", "set", "acceleration=500", "SPEED_WINDOW=7.5", *served.options())
    assert done.returncode == 0, done
    assert get("ACCELERATION") == "500" and get("speed_window") == "7.5"
    changed = [
        line
        for line in command("params", *served.options()).stdout.splitlines()
        if line.startswith("*")
    ]
    assert len(changed) == 2
    assert command("params", "export", str(tmp_path / "a.toml"), *served.options()).returncode == 0

    done = command("params", "save", *served.options())
    assert done.returncode == 0 and "as stored, writing 1" in done.stdout, done
    assert get("ACCELERATION") == "500"
    done = command("params", "defaults", *served.options())
    assert done.returncode == 0 and "nothing is stored" in done.stdout, done
    assert get("ACCELERATION") == "0" and get("SPEED_WINDOW") == "5"

    done = command("params", "import", str(tmp_path / "a.toml"), *served.options())
    assert done.returncode == 0 and get("SPEED_WINDOW") == "7.5", done
    assert command("params", "--csv", str(tmp_path / "a.csv"), *served.options()).returncode == 0
    rows = {r["name"]: r for r in csv.DictReader((tmp_path / "a.csv").open())}
    assert len(rows) == len(params.PARAMETERS)
    assert rows["SPEED_WINDOW"]["value"] == "7.5" and rows["SPEED_WINDOW"]["changed"] == "1"
    assert (
        rows["BAUD_RATE"]["needs_stop"] == "1"
        and rows["MAX_CURRENT"]["default"] == rows["MAX_CURRENT"]["value"]
    )


def test_compare_names_what_the_firmware_does_not_have(served: Served, tmp_path: Path) -> None:
    file, was = tmp_path / "before.toml", tmp_path / "was.json"
    assert command("params", "export", str(file), *served.options()).returncode == 0
    same = command("params", "compare", str(file), *served.options())
    assert same.returncode == 0 and "the drive has what stands in" in same.stdout, same

    text = file.read_text().replace("SPEED_WINDOW = 5 ", "SPEED_WINDOW = 5.1 ")
    assert "SPEED_WINDOW = 5.1 " in text
    file.write_text(text + "OLD_RAMP = 12.5 # of a firmware that had it\n")
    said = command("params", "compare", str(file), *served.options())
    assert said.returncode == 0 and said.stdout.splitlines() == [
        f"OLD_RAMP: 12.5 in {file}; this firmware does not have it",
        f"SPEED_WINDOW: 5 in the drive, 5.1 in {file}",
    ], said
    assert command("params", "compare", str(file), "--json", str(was), *served.options())
    assert json.loads(was.read_text()) == {
        "unknown": {"OLD_RAMP": 12.5},
        "different": {"SPEED_WINDOW": {"drive": 5.0, "file": 5.1}},
        "dropped": 0,
    }


def test_what_was_left_out_is_told_with_the_command_that_names_it(tmp_path: Path) -> None:
    assert "but 2 that" in params.Stored(5, 1, 7, 2).words
    assert "params compare" in params.Stored(5, 1, 7, 2).words
    assert "compare" not in params.Stored(1, 1, 7).words
    file = tmp_path / "a.toml"
    one = params.Comparison({"OLD": 1.0}, {}, 1).lines(file)
    assert one == [f"OLD: 1 in {file}; this firmware does not have it"]
    two = params.Comparison({"OLD": 1.0}, {}, 2).lines(file)
    assert two[0] == one[0] and "left out 2" in two[1] and "has 1 of them" in two[1]


def test_a_motor_that_runs_keeps_them(served: Served, drive: Drive) -> None:
    run_at(drive, 100.0)
    with pytest.raises(DriveError, match="BAUD_RATE.*only while stopped"):
        params.write(drive, {"BAUD_RATE": 9600.0})
    with pytest.raises(DriveError, match="has to stand still"):
        params.save(drive)
    params.write(drive, {"ACCELERATION": 3000.0})
    session.stop(drive)


def test_a_new_address_is_followed(served: Served, drive: Drive) -> None:
    params.write(drive, {"MODBUS_ADDRESS": 9.0, "SPEED_WINDOW": 6.0})
    assert params.save(drive).number == 1
    assert drive.target.unit == 9
    with Drive(Target(tcp_port=served.tcp, unit=9)) as again:
        assert {v.name: v.value for v in params.read(again) if v.changed} == {
            "MODBUS_ADDRESS": 9.0,
            "SPEED_WINDOW": 6.0,
        }
    asked = command("--unit", "9", "params", "get", "MODBUS_ADDRESS", *served.options())
    assert asked.stdout.strip() == "9", asked
    params.restore(drive)
    assert drive.target.unit == 1


def test_what_is_no_good_changes_nothing(served: Served, drive: Drive, tmp_path: Path) -> None:
    file = tmp_path / "x.toml"
    for words, said in (
        (["set", "NONE=1"], "is not a parameter"),
        (["set", "ACCELERATION"], "NAME=VALUE"),
        (["set", "ACCELERATION=x"], "NAME=VALUE"),
        (["set", "SPEED_WINDOW=6", "LINE_FORMAT=7"], "not within"),
        (["set", "BAUD_RATE=9601"], "out of the drive's range"),
        (["get", "NONE"], "is not a parameter"),
        (["set", "ACCELERATION=nan"], "not within"),
        (["import", str(file)], "No such file"),
    ):
        refused = command("params", *words, *served.options())
        assert (
            refused.returncode == 1 and said in refused.stderr and "Traceback" not in refused.stderr
        ), refused
    for text, said in (
        ("[parameters]\nSPEED_WINDOW = 6\nNONE = 1", "is not a parameter"),
        ("x = 1", "[parameters]"),
        ("[parameters]\nSPEED_WINDOW = 'a'", "not a number"),
        ("[", "x.toml"),
    ):
        file.write_text(text)
        refused = command("params", "import", str(file), *served.options())
        assert (
            refused.returncode == 1 and said in refused.stderr and "Traceback" not in refused.stderr
        ), refused
    assert not any(v.changed for v in params.read(drive))


def test_the_line_of_the_command_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sdre_drive.options._line", dict(baud=115200, format="8E1", unit=1))
    use_line("9600-8N2", 7)
    t = target("/dev/ttyUSB9", None)
    assert (t.baud, t.format, t.unit) == (9600, "8N2", 7)
    client = ModbusLink(t, 1).client
    assert (
        client.comm_params.baudrate == 9600
        and client.comm_params.parity == "N"
        and client.comm_params.stopbits == 2
    )
    for wrong in ("9600", "x-8E1", "9600-7E1"):
        with pytest.raises(DriveError, match="BAUD-FORMAT"):
            use_line(wrong, 1)
