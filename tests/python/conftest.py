# SPDX-License-Identifier: MIT
"""A virtual drive for each test that asks for one."""

from __future__ import annotations

import os
import subprocess
from contextlib import contextmanager
from pathlib import Path
from typing import Iterator, List, NamedTuple

import pytest

from sdre_drive.bench import Bench, served_ports
from sdre_drive.connection import Drive, Target

ROOT = Path(__file__).resolve().parents[2]
SHIPPED = ROOT / "firmware/config/drives/ipmsm_390w.toml"
LONGEST_S = 120.0  # simulated: none is left behind


class Served(NamedTuple):
    """Where the virtual drive is."""

    tcp: int
    rtu: int
    control: int
    pty: str
    process: subprocess.Popen

    def target(self) -> Target:
        """Address on Modbus/TCP."""
        return Target(tcp_port=self.tcp)

    def bench(self) -> Bench:
        """Its surroundings."""
        return Bench(("127.0.0.1", self.control))

    def options(self) -> List[str]:
        """For the command line."""
        return ["--tcp", f"127.0.0.1:{self.tcp}"]


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    """`sdre-sil serve` on ports of its own."""
    with serving(tmp_path) as one:
        yield one


@contextmanager
def serving(tmp_path: Path, *options: str, drive: Path = SHIPPED) -> Iterator[Served]:
    """The same with further options."""
    sil = os.environ.get("SDRE_SIL", str(ROOT / "build/host/bin/sdre-sil"))
    pty = str(tmp_path / "drive")
    process = subprocess.Popen(
        [
            sil,
            "serve",
            str(drive),
            "--tcp",
            "0",
            "--rtu-tcp",
            "0",
            "--control",
            "0",
            "--pty",
            pty,
            "--for",
            str(LONGEST_S),
            *options,
        ],
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout
    ports = served_ports(process.stdout)
    try:
        yield Served(ports["Modbus/TCP"], ports["RTU over TCP"], ports["control"], pty, process)
        assert process.poll() is None, "the server has ended"
    finally:
        process.terminate()
        process.wait(10)


@pytest.fixture
def drive(served: Served) -> Iterator[Drive]:
    """Connected to the virtual drive."""
    with Drive(served.target()) as d:
        yield d
