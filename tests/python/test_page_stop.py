# SPDX-License-Identifier: MIT
"""STOP from every viewer, the arm switch, two viewers, and viewers that go away."""

from __future__ import annotations

import threading
import time
from typing import Iterator, Sequence

import pytest
from conftest import Served
from page_support import Viewer, page_of

from sdre_drive.connection import Drive, DriveError, Target
from sdre_drive.page import viewers
from sdre_drive.page.page_drive import PageDrive, Stopped
from sdre_drive.page.viewers import TooMany, Viewers
from sdre_drive.registers import ControlWord

SPEED = 300.0  # rad/s electrical


@pytest.fixture
def address(served: Served) -> Iterator[str]:
    """Address of a page for the virtual drive, with its token."""
    with page_of(served) as (where, _page):
        yield where


def runs(viewer: Viewer, speed: float = SPEED) -> None:
    """Armed, and at speed."""
    viewer.do("arm")
    viewer.until(lambda s: s["armed"] == "me")
    viewer.until_mode("READY")
    viewer.do("run", speed_e_radps=speed)
    viewer.until(lambda s: abs(s["reading"]["speed_e_radps"] - speed) < 10.0)


def test_stop_of_a_viewer_that_never_armed(address: str) -> None:
    with Viewer(address) as one, Viewer(address) as other:
        runs(one)
        began_s = time.monotonic()
        assert other.do("stop").startswith("STOP")
        assert time.monotonic() - began_s < 1.0
        assert other.until_mode("READY", 5.0)
        assert one.until_mode("READY", 5.0)
        assert abs(one.state["reading"]["speed_e_radps"]) < 30.0, "it coasts"
        assert one.state["armed"] == "me"


def test_stop_twice_opens_the_bridge_at_once(address: str) -> None:
    with Viewer(address) as one:
        runs(one, 600.0)
        one.do("stop")
        assert "bridge off" in one.do("stop")
        one.until_mode("READY", 5.0)


def test_a_run_right_after_a_stop_goes_on(address: str) -> None:
    with Viewer(address) as one:
        runs(one, 20.0)
        for _ in range(5):
            one.do("stop")
            time.sleep(0.03)  # less than until the stop is looked after
            one.do("run", speed_e_radps=20.0)
            time.sleep(1.0)
            assert one.state["reading"]["mode"] in ("ALIGN", "RUN")


def test_stop_without_a_stream(address: str) -> None:
    with Viewer(address) as one:
        runs(one)
        assert Viewer(address).do("stop").startswith("STOP")
        one.until_mode("READY", 5.0)


def test_one_is_armed_and_all_see_it(address: str) -> None:
    with Viewer(address) as one, Viewer(address) as other:
        assert other.refuse("run", speed_e_radps=SPEED) == "arm this window first"
        runs(one)
        state = other.until(lambda s: s["armed"] == "other")
        assert state["viewers"] == 2
        assert abs(state["command_e_radps"] - SPEED) < 0.1
        assert "take over" in other.refuse("arm")
        assert other.refuse("load", load_Nm=0.1, kind="brake") == "arm this window first"
        one.do("load", load_Nm=0.4, kind="brake")
        assert other.until(lambda s: abs(s["bench"]["load_Nm"] - 0.4) < 1e-6)
        other.do("arm", take_over=True)
        one.until(lambda s: s["armed"] == "other")
        assert one.refuse("run", speed_e_radps=0.0) == "arm this window first"
        assert one.state["reading"]["mode"] == "RUN"  # it is the other's motor now
        other.do("disarm")
        one.until_mode("READY", 10.0)
        one.do("arm")
        one.do("break", fault="index wire off")
        other.until(lambda s: s["bench"]["broken"] == ["index wire off"])
        one.do("mend")
        other.until(lambda s: s["bench"]["load_Nm"] == 0.0 and s["bench"]["broken"] == [])


def test_a_motor_stops_when_its_viewer_goes(address: str) -> None:
    with Viewer(address) as other:
        with Viewer(address) as one:
            runs(one)
        other.until(lambda s: s["armed"] == "none")
        other.until_mode("READY", 10.0)


def test_the_end_of_the_program_stops_the_motor(served: Served) -> None:
    with page_of(served) as (where, page):
        with Viewer(where) as one:
            runs(one)
            page.terminate()
            assert page.wait(10) == 0
        with Drive(served.target()) as drive:
            reading = drive.read()
    assert abs(reading.speed_e_radps) < 30.0 and reading.mode == 2


def test_more_than_a_browser_has_connections_for(address: str) -> None:
    all_ = [Viewer(address) for _ in range(viewers.MOST)]
    for one in all_:
        one.__enter__()
    with Viewer(address) as late:
        assert "close one of them" in late.refused
        assert late.do("stop").startswith("STOP")
    for one in all_:
        one.__exit__()


def test_bad_arguments_change_nothing(address: str) -> None:
    with Viewer(address) as one:
        one.do("arm")
        one.until_mode("READY")
        assert "speed_e_radps" in one.refuse("run")
        assert "speed_e_radps" in one.refuse("run", speed_e_radps="1")
        assert "out of the drive's range" in one.refuse("run", speed_e_radps=1e5)
        assert "is not within" in one.refuse("move", turns=1e9, speed_e_radps=1.0)
        assert "no fault of the bench" in one.refuse("break", fault="x")
        assert "X is not a parameter" in one.refuse("write", values={"X": 1.0})
        assert "at most 4 A" in one.refuse("write", values={"MAX_CURRENT": 9.0})
        assert "SPEED_WINDOW" in one.refuse("write", values={"SPEED_WINDOW": 1e9})
        assert "is nothing that" in one.refuse("halt")
        assert one.state["reading"]["mode"] == "READY"


def test_viewers_come_and_go(monkeypatch: pytest.MonkeyPatch) -> None:
    now_s = [0.0]
    monkeypatch.setattr(viewers.time, "monotonic", lambda: now_s[0])
    all_ = Viewers()
    with pytest.raises(DriveError, match="reload"):
        all_.arm("a", False)
    for name in "abcd":
        all_.come(name)
    with pytest.raises(TooMany):
        all_.come("e")
    all_.arm("a", False)
    with pytest.raises(DriveError, match="take over"):
        all_.arm("b", False)
    all_.go("a")
    now_s[0] = viewers.ABANDONED_S - 0.1
    assert not all_.abandoned()
    all_.come("a")  # its connection was broken for a moment
    now_s[0] = 100.0
    assert not all_.abandoned() and all_.state_of("a") == "me"
    all_.go("a")
    now_s[0] = 100.0 + viewers.ABANDONED_S
    assert all_.abandoned() and not all_.abandoned()
    assert all_.state_of("b") == "none"


class Line(PageDrive):
    """A drive that only remembers the control words, and takes its time."""

    def __init__(self) -> None:
        super().__init__(Target())
        self.words: list = []

    def write_words(self, first: int, values: Sequence[int]) -> None:
        time.sleep(0.05)
        self.words.append(values[0])


def test_a_stop_is_the_last_word() -> None:
    line = Line()
    with line.action():
        line.set_run(True)
        line.stop_now(brake=True)
        with pytest.raises(Stopped):
            line.set_run(True)
        line.write("CONTROLWORD", ControlWord.DISABLE_VOLTAGE)
    with line.action():
        line.set_run(True)  # what begins after it may
    assert line.words == [6, 15, 2, 6, 0, 6, 15]


def test_a_stop_waits_for_the_word_on_its_way() -> None:
    line = Line()
    starts = threading.Thread(target=lambda: line.write("CONTROLWORD", ControlWord.ENABLE))
    starts.start()
    time.sleep(0.01)
    line.stop_now(brake=False)
    starts.join()
    assert line.words == [15, 0]
