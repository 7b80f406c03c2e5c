# SPDX-License-Identifier: MIT
"""The commands and programs of docs/integration.md, run against the virtual drive."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import time

import pytest
from conftest import ROOT, Served
from pymodbus.client import ModbusTcpClient
from structured_text import FunctionBlock
from support import until

from sdre_drive import register_map
from sdre_drive.connection import Drive
from sdre_drive.registers import Mode

NEEDS_LIBMODBUS = pytest.mark.skipif(
    not shutil.which("pkg-config")
    or subprocess.run(["pkg-config", "--exists", "libmodbus"], check=False).returncode != 0,
    reason="libmodbus is not installed",
)


def block(program: str, port: int) -> str:
    """The page's only block with this program, for the drive on this port."""
    page = (ROOT / "docs/integration.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```(?:sh|python)\n(.*?)```", page, flags=re.S)
    (found,) = [text for text in blocks if program in text]
    assert "1502" in found
    return found.replace("1502", str(port))


@pytest.mark.skipif(not shutil.which("mbpoll"), reason="mbpoll is not installed")
def test_mbpoll(served: Served) -> None:
    with Drive(served.target()) as drive:
        until(drive, lambda r: r.mode == Mode.READY)
    told = subprocess.run(
        ["sh", "-c", block("mbpoll", served.tcp)], capture_output=True, text=True, timeout=100
    )
    assert told.stdout.count("Written 1 references.") == 4, told
    modes = [int(m) for m in re.findall(r"^\[3\]:\s+(\d+)", told.stdout, flags=re.M)]
    assert Mode.ALIGN in modes and modes[-1] in (
        Mode.ALIGN,
        Mode.RUN,
    )  # a slow machine is still at it
    with Drive(served.target()) as drive:
        until(drive, lambda r: r.mode == Mode.READY and not r.conditions & 2)


def test_pymodbus(served: Served) -> None:
    told = subprocess.run(
        [sys.executable, "-c", block("pymodbus", served.tcp)],
        capture_output=True,
        text=True,
        timeout=200,
    )
    assert told.returncode == 0, told.stderr
    assert re.fullmatch(r"runs at (19[5-9]|20[0-9]) rad/s\n", told.stdout)
    with Drive(served.target()) as drive:
        reading = drive.read()
    assert reading.mode == Mode.READY and not reading.conditions & 2


@pytest.fixture(scope="module")
def plc(tmp_path_factory: pytest.TempPathFactory) -> str:
    """docs/examples/plc_cycle.c, compiled as its head says."""
    out = str(tmp_path_factory.mktemp("plc") / "plc_cycle")
    flags = subprocess.run(
        ["pkg-config", "--cflags", "--libs", "libmodbus"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    subprocess.run(
        [
            "cc",
            "-Wall",
            "-Wextra",
            "-Werror",
            str(ROOT / "docs/examples/plc_cycle.c"),
            "-o",
            out,
            *flags,
        ],
        check=True,
    )
    return out


def states(told: str) -> list:
    """State and what stands behind it, of each line."""
    return re.findall(r"state ([0-9A-F]+)(.*?), fault", told)


@NEEDS_LIBMODBUS
def test_plc_cycle_in_c(served: Served, plc: str) -> None:
    """From switch on disabled to the speed; silence stops it, and it starts when it is told
    anew."""
    with Drive(served.target()) as drive:
        until(drive, lambda r: r.mode == Mode.READY)
    told = subprocess.run(
        [plc, *block("plc_cycle", served.tcp).split("build/plc_cycle ")[-1].split()],
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert told.returncode == 0, told
    seen = states(told.stdout)
    order = [state for k, (state, _) in enumerate(seen) if k == 0 or state != seen[k - 1][0]]
    assert order == ["40", "21", "23", "27", "40", "21", "23", "27", "21", "23"], told.stdout
    first, silent = seen.index(("27", ", reached")), seen.index(("40", ", stopped by silence"))
    assert first < silent < len(seen) - 1 and ("27", ", reached") in seen[silent:], told.stdout
    assert "no answer" not in told.stdout


@NEEDS_LIBMODBUS
def test_plc_cycle_on_a_serial_line_acknowledges_a_fault(served: Served, plc: str) -> None:
    with Drive(served.target()) as drive:
        until(drive, lambda r: r.mode == Mode.READY)
    running = subprocess.Popen(
        [plc, served.pty, *"run 9 ack 1 stop 1".split()], stdout=subprocess.PIPE, text=True
    )
    assert running.stdout
    lines = []
    for line in running.stdout:
        lines.append(line)
        if "reached" in line:
            bench = served.bench()
            bench.ask("dc_link 20")
            time.sleep(0.5)
            bench.ask("dc_link 295")
            bench.close()
    assert running.wait(20) == 0
    seen = [state for state, _ in states("".join(lines))]
    assert "08" in seen and seen[-1] == "23", lines
    assert re.search(r"state 08, fault 10", "".join(lines)), lines


def test_plc_cycle_in_structured_text(served: Served) -> None:
    """The text of the example, a function 23 every 20 ms."""
    block = FunctionBlock(ROOT / "docs/examples/plc_cycle.st")
    with Drive(served.target()) as drive:
        until(drive, lambda r: r.mode == Mode.READY)
    with ModbusTcpClient("127.0.0.1", port=served.tcp) as line:
        known: dict = {"received": [0] * 12, "connected": False}

        def run(start: bool, wanted: str, longest_s: float = 30.0) -> list:
            """The states until an output is true."""
            seen: list = []
            end = time.monotonic() + longest_s
            while time.monotonic() < end:
                now = block(start=start, speed=-2000, **known)
                if not seen or now["state"] != seen[-1]:
                    seen.append(now["state"])
                if now[wanted]:
                    return seen
                answer = line.readwrite_registers(
                    read_address=4096, read_count=12, write_address=0, values=now["send"]
                )
                known.update(received=answer.registers, connected=True)
                time.sleep(0.02)
            raise AssertionError(f"not {wanted}: {block.values}")

        assert run(False, "connected") and known["received"][0] & 0x6F in (0x40, 0x60)
        assert run(True, "reached")[-4:] == [0x40, 0x21, 0x23, 0x27]
        speed = line.convert_from_registers(known["received"][10:12], line.DATATYPE.INT32)
        assert -2050 < speed < -1950
        time.sleep(2.0)  # the PLC stands still
        known["connected"] = False
        assert run(True, "silenced") == [0x27, 0x40]
        with pytest.raises(AssertionError, match="not running"):
            run(True, "running", 2.0)  # not by itself
        assert block.values["state"] == 0x23
        block(start=False, **known)
        assert run(True, "reached")[-1] == 0x27


def test_who_it_is_and_a_whole_exchange(served: Served) -> None:
    """Functions 43/14, 8 and 23 as pymodbus has them."""
    with ModbusTcpClient("127.0.0.1", port=served.tcp) as drive:
        told = drive.read_device_information(read_code=3, object_id=0).information
        assert told[0] == b"sdre-drive" and told[0x80] == b"ipmsm_390w"
        assert told[0x81].startswith(b"fnv1a64:") and told[0x82].decode() == register_map.DIGEST
        assert drive.diag_query_data(b"\x12\x34").message == b"\x12\x34"
        assert drive.diag_read_bus_comm_error_count().message == 0
        words = drive.convert_to_registers(-1234, drive.DATATYPE.INT32)
        got = drive.readwrite_registers(read_address=2, read_count=2, write_address=2, values=words)
        assert got.registers == words
        block = drive.read_input_registers(register_map.CONSTANTS[1].address, count=3).registers
        assert block[0] == 2 and block[1:] == [0, 10000]
