# SPDX-License-Identifier: MIT
"""What docs/integration.md tells people to type does what it says."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys

import pytest
from conftest import ROOT, Served
from pymodbus.client import ModbusTcpClient
from support import until

from sdre_drive import register_map
from sdre_drive.connection import Drive
from sdre_drive.registers import Mode


def block(language: str, port: int) -> str:
    """The page's only block of this language, for the drive on this port."""
    page = (ROOT / "docs/integration.md").read_text(encoding="utf-8")
    blocks = re.findall(rf"```{language}\n(.*?)```", page, flags=re.S)
    assert len(blocks) == 1 and "1502" in blocks[0]
    return blocks[0].replace("1502", str(port))


@pytest.mark.skipif(not shutil.which("mbpoll"), reason="mbpoll is not installed")
def test_mbpoll(served: Served) -> None:
    with Drive(served.target()) as drive:
        until(drive, lambda r: r.mode == Mode.READY)
    told = subprocess.run(["sh", "-c", block("sh", served.tcp)], capture_output=True, text=True, timeout=100)
    assert told.stdout.count("Written 1 references.") == 4, told
    modes = [int(m) for m in re.findall(r"^\[3\]:\s+(\d+)", told.stdout, flags=re.M)]
    assert Mode.ALIGN in modes and modes[-1] in (Mode.ALIGN, Mode.RUN)  # a slow machine is still at it
    with Drive(served.target()) as drive:
        until(drive, lambda r: r.mode == Mode.READY and not r.conditions & 2)


def test_pymodbus(served: Served) -> None:
    told = subprocess.run([sys.executable, "-c", block("python", served.tcp)], capture_output=True, text=True, timeout=200)
    assert told.returncode == 0, told.stderr
    assert re.fullmatch(r"runs at (19[5-9]|20[0-9]) rad/s\n", told.stdout)
    with Drive(served.target()) as drive:
        reading = drive.read()
    assert reading.mode == Mode.READY and not reading.conditions & 2


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
