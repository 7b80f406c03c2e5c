# SPDX-License-Identifier: MIT
"""Driving the virtual drive: what a user does, what goes wrong, and what is said then."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Dict, List

import pytest
from conftest import Served, serving
from support import command, run_at, stay, until, while_it_runs

from sdre_drive import faults, scope, scope_facts, session
from sdre_drive.connection import Drive, DriveError, Refused, Target
from sdre_drive.registers import ControlWord, Mode, state_words


def test_runs_carries_a_load_and_stops(served: Served, drive: Drive) -> None:
    bench = served.bench()
    run_at(drive, 300.0)
    bench.ask("load 1.0")
    loaded = until(drive, lambda r: r.iq_A > 0.8)  # 1.5 N m at 2.5 A
    assert loaded.mode == Mode.RUN
    assert abs(stay(drive, 1.0).speed_e_radps - bench.ask("state")["speed_e_radps"]) < 3.0
    bench.ask("load 0")
    assert session.stop(drive).mode == Mode.READY


def state(drive: Drive) -> str:
    return state_words(drive.read().statusword)


def test_states_ramps_and_stops(drive: Drive) -> None:
    """A master that follows CiA 402."""
    until(drive, lambda r: state_words(r.statusword) == "switch on disabled")
    drive.write("CONTROLWORD", ControlWord.ENABLE)
    assert state(drive) == "switch on disabled"
    drive.write("CONTROLWORD", ControlWord.SHUT_DOWN)
    until(drive, lambda r: state_words(r.statusword) == "ready to switch on")
    drive.write("CONTROLWORD", ControlWord.SWITCH_ON)
    until(drive, lambda r: state_words(r.statusword) == "switched on")
    drive.write("ACCELERATION", 200)
    drive.write("QUICK_STOP_DECELERATION", 400)
    drive.write("SPEED_RPM", 955.0)
    drive.write("CONTROLWORD", ControlWord.ENABLE)
    began = until(drive, lambda r: r.mode == Mode.RUN)
    with pytest.raises(DriveError, match="now"):
        drive.write("LINE_FORMAT", 1)
    drive.write("MODE_OF_OPERATION", -2)  # of the next start
    assert drive.read().mode_of_operation == 3
    drive.write("MODE_OF_OPERATION", 3)
    reached = until(drive, lambda r: bool(r.statusword & 0x400))
    assert (
        0.8 < reached.time_s - began.time_s < 1.3
    )  # 195 rad/s by 200 rad/s2, as long as it is asked in time
    drive.write("CONTROLWORD", ControlWord.QUICK_STOP)
    braking = until(drive, lambda r: r.speed_e_radps < 150.0)
    assert state_words(braking.statusword) == "quick stop active"
    stopped = until(drive, lambda r: state_words(r.statusword) == "switch on disabled")
    assert 0.2 < stopped.time_s - braking.time_s < 0.6


def test_an_alignment_finds_the_angle(drive: Drive) -> None:
    until(drive, lambda r: r.mode == Mode.READY)
    drive.write("MODE_OF_OPERATION", -2)
    drive.set_run(True)
    until(drive, lambda r: r.mode == Mode.ALIGN)
    found = until(drive, lambda r: bool(r.statusword & 0x1000) and bool(r.statusword & 0x400))
    assert (
        found.mode == Mode.READY and found.statusword & 0xC000 == 0x8000
    )  # bridge off, referenced
    drive.set_run(False)
    until(drive, lambda r: state_words(r.statusword) == "switch on disabled")
    session.start(drive, 100.0)
    assert drive.read().mode == Mode.RUN  # without another alignment


def test_runs_on_a_serial_line(served: Served) -> None:
    with Drive(Target(serial_port=served.pty)) as drive:
        run_at(drive, -200.0)
        assert session.stop(drive).mode == Mode.READY


def test_a_fault_is_said_in_words_and_reset(served: Served, drive: Drive) -> None:
    bench = served.bench()
    bench.ask("load 0.75 active")
    run = subprocess.Popen(
        [sys.executable, "-m", "sdre_drive", "run", "300", "--radps", *served.options()],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    until(drive, lambda r: r.mode == Mode.RUN)
    bench.ask('fault kind = "current_zero", phase = "a"')
    _, said = run.communicate(timeout=60)
    bench.ask("load 0")  # it goes on dragging the shaft
    assert run.returncode == 4
    assert "drive 8 CURRENT_SENSOR" in said and "check" in said and "Traceback" not in said
    status = command("status", *served.options())
    assert status.returncode == 4 and "CURRENT_SENSOR" in status.stdout
    bench.ask("mend")
    until(drive, lambda r: abs(r.speed_e_radps) < 100.0)
    assert command("reset", *served.options()).returncode == 0
    kept = command("faults", *served.options())
    assert kept.returncode == 0 and "CURRENT_SENSOR" in kept.stdout and "in mode RUN" in kept.stdout


def running(served: Served, *words: str) -> subprocess.Popen:
    """`sdre-drive run`, which goes on."""
    return subprocess.Popen(
        [sys.executable, "-m", "sdre_drive", "run", *words, *served.options()],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def test_ctrl_c_stops_the_motor_by_its_ramp_and_waits(served: Served, drive: Drive) -> None:
    drive.write("DECELERATION", 200.0)
    run = running(served, "300", "--radps")
    until(drive, lambda r: r.mode == Mode.RUN and r.speed_e_radps > 295.0)
    run.send_signal(signal.SIGINT)
    slower = until(drive, lambda r: r.speed_e_radps < 200.0)
    assert slower.mode == Mode.RUN  # the drive brakes: nobody else does
    run.communicate(timeout=60)
    assert run.returncode == 0
    stands = drive.read()
    assert stands.mode == Mode.READY and not stands.conditions & 2
    assert abs(served.bench().ask("state")["speed_e_radps"]) < 5.0
    assert 0.6 < stands.time_s - slower.time_s  # 200 rad/s by 200 rad/s2, less what a reading takes


def test_a_second_ctrl_c_opens_the_bridge_at_once(served: Served, drive: Drive) -> None:
    drive.write("DECELERATION", 20.0)
    run = running(served, "300", "--radps")
    until(drive, lambda r: r.mode == Mode.RUN and r.speed_e_radps > 295.0)
    run.send_signal(signal.SIGINT)
    until(drive, lambda r: r.speed_e_radps < 290.0)
    run.send_signal(signal.SIGINT)
    run.communicate(timeout=60)
    assert run.returncode == 0
    assert drive.read().mode == Mode.READY and served.bench().ask("state")["speed_e_radps"] > 200.0


def test_stop_waits_for_the_ramp_unless_it_may_coast(served: Served, drive: Drive) -> None:
    run_at(drive, 300.0)
    assert while_it_runs(drive, "stop", *served.options()).returncode == 0
    assert abs(served.bench().ask("state")["speed_e_radps"]) < 5.0
    run_at(drive, 300.0)
    assert while_it_runs(drive, "stop", "--coast", *served.options()).returncode == 0
    assert served.bench().ask("state")["speed_e_radps"] > 200.0


def test_a_shaft_that_coasts_is_awaited_before_the_angle_is_sought(tmp_path: Path) -> None:
    with serving(tmp_path, "--speed-factor", "2") as served, Drive(served.target()) as drive:
        run_at(drive, 2.0)
        assert while_it_runs(drive, "stop", "--coast", *served.options()).returncode == 0
        served.bench().ask("power_cycle")
        assert abs(served.bench().ask("state")["speed_e_radps"]) > 0.5  # no index within its way
        done = command("run", "100", "--for", "1", *served.options())
        assert done.returncode == 0, done  # the alignment would refuse it


def test_a_negative_speed_needs_no_dashes(served: Served, drive: Drive) -> None:
    done = command("run", "-500", "--for", "0.5", *served.options())
    assert done.returncode == 0, done
    assert until(drive, lambda r: r.mode == Mode.READY)


def test_a_master_that_dies_stops_the_motor(served: Served) -> None:
    with Drive(served.target()) as first:
        session.start(first, 200.0)
    bench = served.bench()
    silent_from_s = bench.ask("state")["time_s"]
    while bench.ask("state")["time_s"] < silent_from_s + 0.8:
        time.sleep(0.05)
    with Drive(served.target()) as second:
        reading = second.read()
    assert reading.mode == Mode.READY
    assert [e.name for e in faults.warnings(reading.conditions)] == ["SILENT"]


def test_two_masters_at_once(served: Served, drive: Drive) -> None:
    run_at(drive, 200.0)
    end = threading.Event()

    def ask_too() -> None:
        with Drive(served.target()) as other:
            seen.extend(session.follow(other, end))

    seen: list = []
    asking = threading.Thread(target=ask_too)
    asking.start()
    drive.set_speed(250.0)
    until(drive, lambda r: abs(r.speed_e_radps - 250.0) < 5.0)
    stay(drive, 1.0)
    end.set()
    asking.join()
    assert len(seen) >= 5 and all(r.mode == Mode.RUN for r in seen)
    session.stop(drive)


def columns(file: Path) -> Dict[str, List[float]]:
    head, *rows = (line.split(",") for line in file.read_text().splitlines())
    return {name: [float(row[k]) for row in rows] for k, name in enumerate(head)}


def test_scope_takes_a_step_around_its_trigger(
    served: Served, drive: Drive, tmp_path: Path
) -> None:
    run_at(drive, 200.0)
    file = tmp_path / "scope.csv"
    taking = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "sdre_drive",
            "scope",
            "--csv",
            str(file),
            "--signals",
            "SPEED_WANTED,SPEED,IQ,DUTY_A",
            "--before",
            "100",
            "--trigger",
            "rising",
            "--level",
            "250",
            "--wait",
            "60",
            *served.options(),
        ],
        stdout=subprocess.PIPE,
        text=True,
    )
    until(drive, lambda r: drive.traces()["SCOPE_STATE"] == 2)  # waits
    drive.set_speed(300.0)
    taking.communicate(timeout=60)
    assert taking.returncode == 0
    taken = columns(file)
    assert (
        list(taken) == ["time_s", "SPEED_WANTED", "SPEED", "IQ", "DUTY_A"]
        and len(taken["time_s"]) == 512
    )
    assert taken["SPEED_WANTED"] == [200.0] * 100 + [300.0] * 412
    assert taken["time_s"][100] == 0.0 and abs(taken["time_s"][511] - 0.0822) < 1e-6
    assert abs(taken["SPEED"][99] - 200.0) < 5.0 and taken["SPEED"][511] > 290.0
    assert max(taken["IQ"][100:200]) > 1.0 and all(0.0 <= d <= 1.0 for d in taken["DUTY_A"])
    drive.set_speed(200.0)
    assert drive.read().mode == Mode.RUN  # the scope kept it alive


def test_the_record_shows_the_fault(served: Served, drive: Drive, tmp_path: Path) -> None:
    assert drive.traces()["RECORD_COUNT"] == 0
    run_at(drive, 300.0)
    served.bench().ask('fault kind = "current_zero", phase = "a"')
    served.bench().ask("load 0.7")
    until(drive, lambda r: r.mode == Mode.FAULT)
    file = tmp_path / "fault.csv"
    assert command("faults", "--csv", str(file), *served.options()).returncode == 4
    kept = columns(file)
    assert len(kept["time_s"]) == 64 and kept["time_s"][63] == 0.0
    assert all(abs(x) < 0.05 for x in kept["IA"][-3:]) and max(abs(x) for x in kept["IB"]) > 0.1
    assert abs(kept["SPEED"][0] - 300.0) < 50.0 and all(x > 200.0 for x in kept["DC_LINK"])
    served.bench().ask("mend")
    drive.reset()
    assert drive.traces()["RECORD_NUMBER"] == 1 and drive.traces()["RECORD_COUNT"] == 64


def test_log_is_a_table(served: Served, tmp_path: Path) -> None:
    file = tmp_path / "log.csv"
    told = command("log", "--csv", str(file), "--for", "1", *served.options())
    assert told.returncode == 0, told.stderr
    head, *rows = file.read_text().splitlines()
    assert head.startswith("time_s,mode,speed_e_radps") and len(rows) >= 3
    times = [float(r.split(",")[0]) for r in rows]
    assert times == sorted(times)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["status", "--tcp", "127.0.0.1:1"], "nothing answers at 127.0.0.1:1"),
        (
            ["status", "--port", "/dev/no-such-line"],
            "/dev/no-such-line: No such file or directory; serial",
        ),
        (["status", "--tcp", "drive"], "is not HOST:PORT"),
        (["status", "--tcp", "a:1", "--port", "b"], "give one"),
        (["run", "1000", "--tcp", "127.0.0.1:1"], "nothing answers"),
        (["run", "fast"], "Invalid value for"),
        (["run", "0,5"], "the decimal sign is a point: 0.5"),
        (["params", "set", "MAX_CURRENT=2,5"], "the decimal sign is a point: 2.5"),
        (["get", "COMISSION_REASON"], "is not a register: COMMISSION_REASON"),
        (["set", "FAULT=1"], "FAULT can only be read"),
        (["set", "LINE_FORMAT=straight"], "must be 0 even; 1 odd; 2 none"),
        (["set", "SPEED_WINDOW=1e9"], "is not within 0 .. 6553.5"),
        (["log"], "give one of --csv and --parquet"),
        (["spin"], "spin"),
        (["scope", "--csv", "x", "--signals", "TORQUE"], 'there is no signal "TORQUE"'),
    ],
)
def test_bad_input_is_one_line(words: list, said: str) -> None:
    told = command(*words)
    assert told.returncode == 1
    assert said in told.stderr and len(told.stderr.strip().splitlines()) == 1


def test_a_speed_beyond_the_drive_is_refused(drive: Drive) -> None:
    until(drive, lambda r: r.mode == Mode.READY)
    with pytest.raises(DriveError, match="out of the drive's range: at most .* r/min"):
        session.start(drive, 3000.0)
    assert drive.read().mode == Mode.READY


def test_what_acts_otherwise_than_written_is_told(served: Served, drive: Drive) -> None:
    told = command("params", "set", "MAX_CURRENT=9", "SPEED_WINDOW=10.04", *served.options())
    assert told.returncode == 0, told
    assert "MAX_CURRENT: 9 A acts as 4 A, the drive's limit (CURRENT_MAX)" in told.stdout
    assert "SPEED_WINDOW: the drive has 10 rad/s electrical" in told.stdout
    plain = command("set", "MAX_CURRENT=3", *served.options())
    assert plain.stdout == "MAX_CURRENT = 3 A\n", plain


def test_registers_by_name_with_their_meaning(served: Served, drive: Drive) -> None:
    until(drive, lambda r: r.mode == Mode.READY)
    told = command("get", "mode", "RESET_CAUSE", "FAULT", "DC_LINK", *served.options()).stdout
    assert "MODE = 2: ready, bridge off" in told and "FAULT = 0: none" in told
    assert "RESET_CAUSE = 0: power on, or the reset pin" in told and " V" in told
    assert command("set", "LOST_OPTION=Quick Stop", *served.options()).returncode == 0
    assert command("get", "LOST_OPTION", *served.options()).stdout == "3: quick stop\n"
    numbers = json.loads(command("get", "POLE_PAIRS", "--json", "-", *served.options()).stdout)
    assert numbers == {"POLE_PAIRS": 2}
    listed = command("get").stdout
    assert all(name in listed for name in ("COMMISSION_REASON", "CONTROLWORD", "CURRENT_TRIP"))


class SmallScope:
    """A firmware whose scope has that many samples; each register tells its own place."""

    def __init__(self, samples: int) -> None:
        self.end = scope_facts.SCOPE_FIRST + 2 * scope_facts.CHANNELS * samples

    def words(self, first: int, count: int) -> List[int]:
        if first + count > self.end:
            raise Refused("exception 2")
        return [(first + k) & 0xFFFF for k in range(count)]

    def constants(self) -> SimpleNamespace:
        return SimpleNamespace(period_s=1e-4)


@pytest.mark.parametrize("samples", scope_facts.SAMPLES)
def test_scope_of_every_size_is_read_whole(samples: int) -> None:
    taken = scope.read(SmallScope(samples), scope.Setup(signals=("ia", "ib")))  # type: ignore[arg-type]
    assert len(taken.time_s) == samples
    assert [len(signal) for signal in taken.values] == [samples, samples]
