# SPDX-License-Identifier: MIT
"""A session on CAN: the same drive as over Modbus, and a motor that stops with its client."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager
from typing import Iterator

import pytest
from can_support import Bus, Command, in_process, on_both
from conftest import ROOT
from support import run_at, stay, until

from sdre_drive import load, move, params, register_map, scope, session
from sdre_drive import torque as torques
from sdre_drive.can_aborts import refusal
from sdre_drive.connection import Drive, DriveError, Refused, Target
from sdre_drive.page.state import Watcher
from sdre_drive.registers import CYCLIC_VELOCITY, WORDS, Mode

pytest.importorskip("canopen")
pytest.importorskip("can")

# A client that runs the motor, and asks until it is ended from outside.
CLIENT = """
import sys, time
from sdre_drive import session
from sdre_drive.connection import Drive, Target
with Drive(Target(can=sys.argv[1])) as drive:
    session.start(drive, 100.0)
    while True:
        print(drive.read().mode, flush=True)
        time.sleep(0.05)
"""


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
def modbus(bus: Bus) -> Iterator[Drive]:
    """The same drive over Modbus/TCP."""
    with Drive(bus.served.target()) as d:
        yield d


@pytest.fixture
def command(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Iterator[Command]:
    """sdre-drive."""
    with in_process(monkeypatch, capsys) as run:
        yield run


@contextmanager
def running_client(bus: Bus) -> Iterator[subprocess.Popen]:
    """Another process that has the motor."""
    process = subprocess.Popen(
        [sys.executable, "-B", "-c", CLIENT, bus.channel], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout
    try:
        while int(process.stdout.readline()) != Mode.RUN:
            pass
        yield process
    finally:
        process.kill()
        process.wait(10)


def test_all_that_stands_still_is_the_same_on_both(drive: Drive, modbus: Drive) -> None:
    assert drive.constants() == modbus.constants()
    assert drive.identify() == modbus.identify()
    assert drive.identify_basic()[2] == modbus.identify_basic()[2]
    assert load.in_force(drive) == load.in_force(modbus)
    for r in register_map.HOLDING:
        count = WORDS[r.type]
        assert drive.holding(r.address, count) == modbus.holding(r.address, count), r.name
    for r in (*register_map.CONSTANTS, *register_map.STORED, *register_map.COMMISSIONING):
        count = WORDS[r.type]
        assert drive.words(r.address, count) == modbus.words(r.address, count), r.name
    assert [v.value for v in params.read(drive)] == [v.value for v in params.read(modbus)]


def test_registers_of_a_block_act_together(drive: Drive, modbus: Drive) -> None:
    """Mode of operation and speed in one request; the second value is out of range."""
    drive.write_words(1, [CYCLIC_VELOCITY, 0, 500])
    assert modbus.holding(1, 3) == [CYCLIC_VELOCITY, 0, 500]
    with pytest.raises(Refused, match="out of the drive's range"):
        drive.write_words(1, [3, 0x7FFF, 0])
    assert modbus.holding(1, 3) == [CYCLIC_VELOCITY, 0, 500]
    drive.write_words(1, [3, 0, 0])


def test_refusals_have_the_words_of_modbus(drive: Drive, modbus: Drive) -> None:
    for ask in (
        lambda d: d.words(9999, 1),
        lambda d: d.words(62, 4),
        lambda d: d.write_words(3, [1]),
        lambda d: d.write("SPEED", 1e5),
        lambda d: d.write("CAN_RATE", 800),
        lambda d: d.words(scope.SCOPE_FIRST, 8),
        lambda d: d.write_words(128, [0x6576, 0x6173 + 1]),
    ):
        with pytest.raises(Refused) as over_modbus:
            ask(modbus)
        with pytest.raises(Refused) as over_can:
            ask(drive)
        assert str(over_can.value) == str(over_modbus.value)


def test_speed_position_and_torque(drive: Drive) -> None:
    assert abs(run_at(drive, 100.0).speed_e_radps - 100.0) < 5.0
    assert stay(drive, 1.0).mode == Mode.RUN  # twice the time of silence
    session.stop(drive)
    end = threading.Event()
    found = move.go(drive, move.Wanted(5000, True, 200.0), end, 0.1, lambda *_: None)
    assert abs(found.now - found.target) < 20
    reading = torques.hold(drive, torques.Wanted(0.1, 60.0), end, 0.5, lambda *_: None)
    assert reading.mode == Mode.READY and reading.why.fault == 0


def test_cyclic_velocity_follows_the_requests(drive: Drive) -> None:
    session.come_to_run(drive, CYCLIC_VELOCITY)
    for n in range(50):
        drive.write("SPEED", 2.0 * n)
        time.sleep(0.01)
    assert abs(until(drive, lambda r: r.speed_e_radps > 90.0).speed_e_radps - 98.0) < 10.0
    session.stop(drive)


def test_a_scope_picture_is_the_same_on_both(drive: Drive, modbus: Drive) -> None:
    setup = scope.Setup(("SPEED", "IQ", "DC_LINK", "THETA"))
    begun_s = modbus.read().time_s
    over_can = scope.take(drive, setup, 5.0)
    assert modbus.read().time_s - begun_s < 20.0
    assert over_can == scope.read(modbus, setup) and len(over_can.time_s) == 512


@pytest.mark.parametrize("way", [signal.SIGKILL, signal.SIGSTOP], ids=["killed", "hung"])
def test_a_client_that_ends_stops_the_motor(bus: Bus, modbus: Drive, way: signal.Signals) -> None:
    """The drive misses the heartbeats, although nobody has told it to stop."""
    with running_client(bus) as process:
        begun_s = modbus.read().time_s
        until(modbus, lambda r: r.time_s > begun_s + 1.0)
        assert modbus.read().mode == Mode.RUN
        process.send_signal(way)
        ended_s = modbus.read().time_s
        reading = until(modbus, lambda r: r.mode != Mode.RUN)
        assert reading.time_s - ended_s < 1.0
        assert reading.conditions & 2  # silent


def test_a_second_client_is_turned_away_and_disturbs_nothing(
    command: Command, bus: Bus, modbus: Drive
) -> None:
    with running_client(bus):
        for words in (["status"], ["find"]):
            looked = command(*bus.options(), *words)
            assert looked.code == 1 and "another client talks to" in looked.err, looked
        assert modbus.read().mode == Mode.RUN
        stopped = command("stop", *bus.served.options())
        assert stopped.code == 0 and modbus.read().mode == Mode.READY, stopped


def test_what_another_client_mixed_up_does_not_count(bus: Bus, drive: Drive) -> None:
    """A foreign request in the middle of a transfer: it begins again."""
    link = drive._link
    wanted, begun = drive.words(256, 2), link._others.requests  # type: ignore[attr-defined]
    upload = link._node.sdo.upload  # type: ignore[attr-defined]

    def disturbed(index: int, sub: int) -> bytes:
        link._node.sdo.upload = upload  # type: ignore[attr-defined]
        link._others.hear()  # type: ignore[attr-defined]
        return b"\1\2\3\4"

    link._node.sdo.upload = disturbed  # type: ignore[attr-defined]
    assert drive.words(256, 2) == wanted
    assert link._others.requests == begun + 1  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("where", "said"),
    [
        (Target(can="socket://127.0.0.1:1"), "no CAN adapter socket://127.0.0.1:1 .slcan.: "),
        (Target(can="/dev/no-such"), "no CAN adapter /dev/no-such .slcan.: "),
        (Target(can="no0", can_interface="socketcan"), "no CAN adapter no0 .socketcan.: "),
        (Target(can="can0", can_interface="none"), "check the channel and --can-interface"),
    ],
)
def test_an_adapter_that_is_not_there(where: Target, said: str) -> None:
    with pytest.raises(DriveError, match=said) as told, Drive(where):
        pass
    assert "\n" not in str(told.value)


def test_without_its_packages_can_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sdre_drive.can_link", None)
    with pytest.raises(DriveError, match=r"pip install 'sdre-drive\[can\]'"):
        Drive(Target(can="can0"))


def test_another_device_is_told(bus: Bus, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sdre_drive.can_link.NAME_OF_DRIVES", "a pump")
    with pytest.raises(DriveError, match='another device: its name .1008h. is "sdre-drive"'):
        Drive(bus.target()).open()


def test_an_abort_that_is_not_known_keeps_its_code() -> None:
    assert refusal(0x05040001) == "the drive answers with abort code 05040001h"
    assert "over CAN" in refusal(0x06010002)


def test_the_script_of_the_page(bus: Bus) -> None:
    """That of docs/python.md, with the virtual drive in place of can0."""
    page = (ROOT / "docs/python.md").read_text(encoding="utf-8")
    begin = page.index("from sdre_drive import session")
    script = page[begin : page.index("```", begin)]
    place = 'can="can0", can_interface="socketcan"'
    assert script.count(place) == 1
    exec(script.replace(place, f'can="{bus.channel}"'), {})


def test_the_address_is_told() -> None:
    assert Target(can="can0", node=7).words == "node 7 on CAN can0"
    assert not Target(can="can0").is_local


def test_the_page_reads_a_drive_on_can(bus: Bus) -> None:
    watcher = Watcher(bus.target(), None, None)
    watcher.start()
    end = time.monotonic() + 20.0
    while watcher.reading is None and time.monotonic() < end:
        time.sleep(0.05)
    assert watcher.reading and watcher.reading.mode == Mode.READY, watcher.trouble
    watcher.close()
    watcher.join(10.0)
    watcher.drive.close()


def test_an_adapter_that_goes_is_one_line(
    tmp_path_factory: pytest.TempPathFactory, capfd: pytest.CaptureFixture[str]
) -> None:
    with on_both(tmp_path_factory) as both, Drive(both.target()) as drive:
        assert drive.read().mode != Mode.RUN
        drive._link._network.bus.serialPortOrig.close()  # type: ignore[attr-defined]
        assert drive.read().mode != Mode.RUN  # it is opened again
        both.served.process.send_signal(signal.SIGSTOP)  # nothing is there behind it
        with pytest.raises(DriveError, match="no answer from node 1 on CAN"):
            drive.read()
        both.served.process.send_signal(signal.SIGCONT)
        assert drive.read().mode != Mode.RUN
    assert "Traceback" not in capfd.readouterr().err
