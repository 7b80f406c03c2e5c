# SPDX-License-Identifier: MIT
"""The bench of the virtual drive by the tool: load, faults, what is told."""

from __future__ import annotations

import json
import time
from pathlib import Path

import pytest
from conftest import Served, serving
from support import command, run_at, stay, until

from sdre_drive import params, session
from sdre_drive.bench_faults import FAULTS, words_of
from sdre_drive.connection import Drive
from sdre_drive.registers import Mode


def bench(served: Served, *words: str) -> str:
    """`sdre-drive bench`, which has to succeed."""
    done = command("bench", *words, "--control", f"127.0.0.1:{served.control}")
    assert done.returncode == 0, done
    return done.stdout


def test_any_client_reads_back_what_is_set(served: Served) -> None:
    assert "load         0 N m, a brake" in bench(served)
    assert "0.75 N m, a brake" in bench(served, "load", "0.75")
    assert "motor wire c broken" in bench(served, "break", "motor", "wire", "c", "broken")
    other = served.bench().ask("state")
    assert (other["load_Nm"], other["load_kind"]) == (0.75, "brake")
    assert [words_of(b) for b in other["broken"]] == ["motor wire c broken"]
    assert "-0.3 N m against positive speed" in bench(served, "load", "-0.3", "active")
    mended = bench(served, "mend")
    assert "load         0 N m, a brake" in mended and "broken       nothing" in mended


def test_every_fault_in_words_is_read_back_in_the_same_words(served: Served) -> None:
    one = served.bench()
    for words, line in FAULTS.items():
        broken = one.ask(line)["broken"]
        assert words_of(broken[-1]) == words
        one.ask("mend")


def test_status_shows_bench_pace_and_why_the_drive_has_started(served: Served) -> None:
    control = ["--control", f"127.0.0.1:{served.control}"]
    told = command("status", *served.options(), *control).stdout
    assert "load 0 N m, a brake" in told and "of real time" in told
    assert "power on, or the reset pin" in told
    served.bench().ask(FAULTS["interrupts masked"])
    with Drive(served.target()) as drive:
        until(drive, lambda r: r.reset_cause == 1)
    state = json.loads(command("status", *served.options(), *control, "--json", "-").stdout)
    assert "watchdog" in state["started_by"] and state["bench"]["resets"] == 1
    assert state["mode_words"] == "ready, bridge off" and state["faults"] == []


def test_a_fault_says_what_it_needs_and_shows_then(served: Served, drive: Drive) -> None:
    assert "start the motor" in bench(served, "break", "motor", "wire", "a", "broken")
    bench(served, "mend")
    run_at(drive, 300.0)
    one = served.bench()
    told = one.ask(FAULTS["motor wire a broken"])["note"]
    assert "set a load that takes" in told
    assert stay(drive, 1.0).mode == Mode.RUN
    one.ask(told.split('"')[1])  # the load that it names
    until(drive, lambda r: r.mode == Mode.FAULT, 3.0)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["load", "-1"], '"load -1 active" drives the shaft'),
        (["load", "1e9"], "must be a number in"),
        (["break", "the table"], "motor wire a broken"),
        (["halt"], "is not a command: load, dc_link"),
    ],
)
def test_bad_words_are_one_line(served: Served, words: list, said: str) -> None:
    told = command("bench", *words, "--control", f"127.0.0.1:{served.control}")
    assert told.returncode == 1 and said in told.stderr, told
    assert len(told.stderr.strip().splitlines()) == 1


def test_a_load_at_rest_turns_nothing(served: Served, drive: Drive) -> None:
    served.bench().ask("load 2")
    time.sleep(0.5)
    assert served.bench().ask("state")["speed_rpm"] == 0.0
    served.bench().ask("load 0")  # an alignment needs a free shaft
    run_at(drive, 200.0)
    served.bench().ask("load 0.5")
    assert session.stop(drive).mode == Mode.READY


def test_a_flash_file_keeps_what_is_stored(tmp_path: Path) -> None:
    kept = tmp_path / "flash"
    for value in (10.0, 20.0):
        with serving(tmp_path, "--flash", str(kept)) as one, Drive(one.target()) as drive:
            until(drive, lambda r: r.mode == Mode.READY)
            has = drive.parameter("SPEED_WINDOW")
            assert has == (5.0 if value == 10.0 else 10.0)
            params.write(drive, {"SPEED_WINDOW": value})
            params.save(drive)
    assert kept.stat().st_size == 4 * 0x8000 * 2
