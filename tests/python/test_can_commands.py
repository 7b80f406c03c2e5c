# SPDX-License-Identifier: MIT
"""The commands of sdre-drive on CAN: as over Modbus, and what is said when they cannot."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Iterator

import pytest
from can_support import Bus, Command, in_process, on_both, watch_nothing, watched
from conftest import ROOT, SHIPPED
from support import image, run_at

from sdre_drive import faults, params, scope, session
from sdre_drive.connection import Drive, DriveError, Target
from sdre_drive.options import target, use_can

pytest.importorskip("canopen")
pytest.importorskip("can")


@pytest.fixture(scope="module")
def bus(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Bus]:
    """A virtual drive."""
    with on_both(tmp_path_factory) as both:
        yield both


@pytest.fixture
def drive(bus: Bus) -> Iterator[Drive]:
    """Connected over CAN."""
    with Drive(bus.target()) as d:
        yield d


@pytest.fixture
def command(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Iterator[Command]:
    """sdre-drive."""
    with in_process(monkeypatch, capsys) as run:
        yield run


def test_a_fault_is_told_with_its_record(command: Command, bus: Bus, drive: Drive) -> None:
    run_at(drive, 100.0)
    bus.served.bench().ask("load 0.7")
    bus.served.bench().ask('fault kind = "current_zero", phase = "a"')
    try:
        with pytest.raises(session.Tripped, match="phase current"):
            for reading in session.follow(drive, threading.Event(), length_s=5.0):
                session.require_moving(reading)
        told = command(*bus.options(), "faults")
        assert told.code == 4 and "phase current" in told.out, told
        assert len(scope.record(drive).time_s) == 64
    finally:
        bus.served.bench().ask("mend")
        bus.served.bench().ask("load 0")
    assert session.reset(drive).why == faults.Why(0, 0, 0)


def test_parameters_are_stored_and_a_new_node_number_is_followed(
    command: Command, bus: Bus
) -> None:
    with Drive(bus.target()) as drive:
        params.write(drive, {"SPEED_WINDOW": 7.5, "CAN_NODE": 5})
        assert params.save(drive).state == 1
        assert drive.target.node == 5 and drive.parameter("SPEED_WINDOW") == 7.5
    found = command(*bus.options(), "find")
    assert f"node 5 on CAN {bus.channel}  ipmsm_390w, firmware" in found.out, found
    back = command(*bus.options(), "--node", "5", "params", "defaults")
    assert back.code == 0 and "defaults" in back.out, back
    with Drive(bus.target()) as drive:
        assert drive.parameter("SPEED_WINDOW") == 5.0


def test_commands_that_only_look_set_no_watch(command: Command, bus: Bus) -> None:
    with Drive(bus.target()) as drive:
        watch_nothing(drive)
    for words in (["status"], ["watch", "--for", "0.3"]):
        assert command(*bus.options(), *words).code == 0
    with Drive(bus.target()) as drive:
        assert watched(drive) == 0


def test_a_session_that_has_stopped_leaves_no_watch(command: Command, bus: Bus) -> None:
    with Drive(bus.target()) as drive:
        watch_nothing(drive)
    done = command(*bus.options(), "run", "200", "--for", "0.3")
    assert done.code == 0, done
    with Drive(bus.target()) as drive:
        assert watched(drive) == 0 and not drive.read().conditions & 2


def test_an_image_is_loaded_and_forgotten(command: Command, bus: Bus, tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text(SHIPPED.read_text().replace('name = "ipmsm_390w"', 'name = "my_motor"'))
    before = command(*bus.options(), "load")
    assert "compiled in: ipmsm_390w" in before.out, before
    done = command(*bus.options(), "load", str(image(own, tmp_path / "own.image")))
    assert done.code == 0 and "image 1: my_motor" in done.out, done
    back = command(*bus.options(), "load", "--forget")
    assert back.code == 0 and "compiled in: ipmsm_390w" in back.out, back


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--can", "{bus}", "--node", "9", "status"], "nothing answers as node 9"),
        (["status", "--can", "{bus}"], "--can stands before the command"),
    ],
)
def test_what_is_wrong_is_one_line(command: Command, bus: Bus, words: list[str], said: str) -> None:
    done = command(*(word.replace("{bus}", bus.channel) for word in words))
    assert done.code == 1 and said in done.err, done
    assert done.err.count("\n") == 1 and "Traceback" not in done.err, done


def test_the_commands_of_the_page(command: Command, bus: Bus) -> None:
    """Those of docs/canopen.md for a virtual drive."""
    page = (ROOT / "docs/canopen.md").read_text(encoding="utf-8")
    channel = "socket://127.0.0.1:1600"
    lines = [line for line in page.splitlines() if f"sdre-drive --can {channel}" in line]
    assert len(lines) == 2
    for line in lines:
        words = line.replace(channel, bus.channel).replace("--for 5", "--for 0.2")
        done = command(*words.split("#")[0].split()[1:])
        assert done.code == 0, done


def test_options_that_fit_no_drive(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sdre_drive.options._line", {})
    with pytest.raises(DriveError, match="--can-rate 500 is not one of 125000, 250000"):
        use_can("can0", "socketcan", 500, 1)
    use_can("can0", "socketcan", 250000, 7)
    assert target(None, None) == Target(
        can="can0", can_interface="socketcan", can_rate=250000, node=7
    )
    with pytest.raises(DriveError, match="--can and --tcp name two drives"):
        target(None, "127.0.0.1:1502")
