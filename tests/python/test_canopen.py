# SPDX-License-Identifier: MIT
"""The drive on CAN, with python-can and canopen of PyPI as its masters."""

from __future__ import annotations

import math
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from typing import Iterator

import pytest
from conftest import ROOT, Served, serving

canopen = pytest.importorskip("canopen")
can = pytest.importorskip("can")

OF_ANY_LENGTH = (
    canopen.objectdictionary.VISIBLE_STRING,
    canopen.objectdictionary.DOMAIN,
)
EDS = ROOT / "docs/sdre-drive.eds"
EXAMPLE = ROOT / "docs/examples/canopen_run.py"
SHUT_DOWN, ENABLE, FAULT_RESET = 0x06, 0x0F, 0x80
ENABLED = 0x27
STATE = 0x6F
CYCLIC_POSITION = 8
CYCLIC_VELOCITY = 9
TURN = 10000  # counts of the shipped drive's encoder


def free_port() -> int:
    """A port that nothing of this machine has."""
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


@contextmanager
def on_a_bus(tmp_path: Path, *options: str) -> Iterator[tuple[Served, int]]:
    """A virtual drive with a bus on a port of its own."""
    port = free_port()
    with serving(tmp_path, "--slcan-tcp", str(port), *options) as served:
        yield served, port


@contextmanager
def master(port: int, number: int = 1) -> Iterator[canopen.RemoteNode]:
    """A node as its master sees it."""
    network = canopen.Network()
    node = network.add_node(number, str(EDS))
    network.connect(interface="slcan", channel=f"socket://127.0.0.1:{port}", bitrate=500000)
    try:
        node.sdo.RESPONSE_TIMEOUT = 2.0  # a busy machine
        yield node
    finally:
        network.disconnect()


def wait(node: canopen.RemoteNode, state: int, longest_s: float = 20.0) -> None:
    """Until the status word shows it."""
    end = time.monotonic() + longest_s
    while node.sdo[0x6041].raw & STATE != state:
        assert time.monotonic() < end, f"status word {node.sdo[0x6041].raw:04X}h"
        time.sleep(0.02)


def enable(node: canopen.RemoteNode, mode: int) -> None:
    """From power-on to a run."""
    node.sdo[0x6060].raw = mode
    node.sdo[0x6040].raw = SHUT_DOWN
    wait(node, 0x21)
    node.sdo[0x6040].raw = ENABLE
    wait(node, ENABLED)


def lead_by_sync(node: canopen.RemoteNode, pdo: int) -> None:
    """Set-points of this received PDO act at SYNC, every 10 ms."""
    node.tpdo.read()
    node.rpdo.read()
    node.rpdo[pdo].trans_type = 1
    node.rpdo[pdo].save()
    node.sdo[0x60C2][1].raw = 10
    node.nmt.state = "OPERATIONAL"


def set_point(node: canopen.RemoteNode, pdo: int, name: str, value: int) -> None:
    """One, beside the control word."""
    node.rpdo[pdo]["CONTROLWORD"].raw = ENABLE
    node.rpdo[pdo][name].raw = value
    node.rpdo[pdo].transmit()


def test_every_object_of_the_data_sheet_answers(tmp_path: Path) -> None:
    with on_a_bus(tmp_path) as (_, port), master(port) as node:
        read = 0
        for index, entry in node.object_dictionary.items():
            parts = (
                [entry]
                if isinstance(entry, canopen.objectdictionary.ODVariable)
                else [*entry.values()]
            )
            for part in parts:
                if index == 0x1003 and part.subindex > 0:
                    continue  # nothing has happened
                data = node.sdo.upload(index, part.subindex)
                if part.data_type not in OF_ANY_LENGTH:
                    assert len(data) * 8 == len(part), part.name
                    if part.default is not None and part.access_type == "const":
                        assert part.decode_raw(data) == part.default, part.name
                read += 1
        assert read > 250
        assert node.sdo[0x1008].raw == "sdre-drive"
        assert node.sdo[0x1000].raw == 0x20192


def test_the_example_runs(tmp_path: Path) -> None:
    with on_a_bus(tmp_path) as (served, port):
        done = subprocess.run(
            [sys.executable, str(EXAMPLE), "--channel", f"socket://127.0.0.1:{port}"]
            + ["--speed", "500", "--seconds", "4"],
            capture_output=True,
            text=True,
            timeout=120,
        )
        assert done.returncode == 0, done.stderr
        assert abs(float(done.stdout.split()[-2]) - 500.0) < 5.0, done.stdout
        done = subprocess.run(
            [sys.executable, str(EXAMPLE), "--channel", f"socket://127.0.0.1:{port}"]
            + ["--node", "9"],
            capture_output=True,
            text=True,
            timeout=120,
        )
        assert done.returncode == 1 and "canopen_run: No SDO response" in done.stderr, done


def test_set_points_by_pdo_with_sync_turn_the_shaft(tmp_path: Path) -> None:
    """Cyclic velocity at 100 Hz: set-points act at SYNC, positions come back with it."""
    with on_a_bus(tmp_path) as (_, port), master(port) as node:
        lead_by_sync(node, 4)
        enable(node, CYCLIC_VELOCITY)
        positions = []
        node.tpdo[3].add_callback(lambda m: positions.append(m["POSITION_NOW"].raw))
        for n in range(300):
            set_point(node, 4, "SPEED_RPM", 10 * min(n, 300))  # up to 300 r/min
            node.network.sync.transmit()
            time.sleep(0.01)
        assert len(positions) > 280
        assert not node.emcy.log
        assert abs(node.sdo[0x606C].raw - 3000) < 60
        assert positions[-1] - positions[0] > 0


def test_positions_at_100_hz_are_followed_for_ten_seconds(tmp_path: Path) -> None:
    """Cyclic position: a sine of a turn and half a hertz, by PDO with SYNC."""
    with on_a_bus(tmp_path) as (_, port), master(port) as node:
        lead_by_sync(node, 3)
        enable(node, CYCLIC_POSITION)
        start = node.sdo[0x6064].raw
        seen = []
        node.tpdo[3].add_callback(lambda m: seen.append(m["POSITION_NOW"].raw - start))
        begin, sent = time.monotonic(), []
        for n in range(1000):
            sent.append(round(0.5 * TURN * (1.0 - math.cos(math.pi * 0.01 * n))))
            set_point(node, 3, "TARGET_POSITION", start + sent[-1])
            node.network.sync.transmit()
            time.sleep(max(0.0, begin + 0.01 * (n + 1) - time.monotonic()))
        assert len(seen) > 990
        assert not node.emcy.log
        # Two set-points later: the period of the interpolation, and the one until the next SYNC.
        late = [abs(x - wanted) for x, wanted in zip(seen[100:], sent[98:])]
        assert sorted(late)[len(late) // 2] < 0.02 * TURN
        time.sleep(0.3)
        assert abs(node.sdo[0x6064].raw - start - sent[-1]) < 0.02 * TURN


def test_a_pulled_cable_stops_the_drive_and_is_told(tmp_path: Path) -> None:
    with on_a_bus(tmp_path) as (served, port), master(port) as node:
        node.sdo[0x1016][1].raw = (0x7F << 16) | 200  # the master's heartbeat
        node.sdo[0x60FF].raw = 3000
        node.nmt.state = "OPERATIONAL"
        beat = node.network.send_periodic(0x77F, [5], 0.05)
        enable(node, 3)
        time.sleep(1.0)
        assert node.sdo[0x6041].raw & STATE == ENABLED
        served.bench().ask("can open")
        time.sleep(1.0)
        assert served.bench().ask("state")["bridge_on"] is False
        served.bench().ask("can none")
        time.sleep(1.0)
        assert node.sdo[0x6041].raw & STATE != ENABLED
        assert any(e.code == 0x8130 for e in node.emcy.log)
        beat.stop()


def test_a_broken_encoder_wire_is_an_emergency(tmp_path: Path) -> None:
    """The consumer of `canopen` has its code, and that the error is gone after a reset."""
    with on_a_bus(tmp_path) as (served, port), master(port) as node:
        node.sdo[0x60FF].raw = 3000
        enable(node, 3)
        time.sleep(1.0)
        assert not node.emcy.log
        served.bench().ask(  # the counter stands still
            'fault kind = "encoder_losing", counts_per_s = 50000.0'
        )
        error = node.emcy.wait(timeout=20.0)
        assert error is not None, "no emergency came"
        assert error.code == node.sdo[0x603F].raw != 0
        assert error.register == node.sdo[0x1001].raw != 0
        assert error.data[0] == node.sdo["FAULT"].raw != 0
        assert error.data[1] == node.sdo["DRIVE_FAULT"].raw
        assert node.sdo[0x1003][1].raw & 0xFFFF == error.code
        assert served.bench().ask("state")["bridge_on"] is False
        served.bench().ask("mend")
        node.sdo[0x6040].raw = 0
        node.sdo[0x6040].raw = FAULT_RESET
        end = time.monotonic() + 20.0
        while node.emcy.active:
            assert time.monotonic() < end, "the error has not ended"
            time.sleep(0.02)
        assert node.emcy.log[-1].code == node.emcy.log[-1].register == 0


def test_a_full_bus_leaves_the_drive_running(tmp_path: Path) -> None:
    """Foreign frames of a lower priority fill the bus; the node still answers, and runs on."""
    with on_a_bus(tmp_path) as (served, port), master(port) as node:
        node.sdo[0x60FF].raw = 3000
        enable(node, 3)
        other = can.Bus(interface="slcan", channel=f"socket://127.0.0.1:{port}", bitrate=500000)
        end = time.monotonic() + 3.0
        while time.monotonic() < end:
            for _ in range(5):
                other.send(can.Message(arbitration_id=0x6FF, data=bytes(8), is_extended_id=False))
            assert node.sdo[0x6041].raw & STATE == ENABLED
        other.shutdown()
        assert abs(node.sdo[0x606C].raw - 3000) < 60
        assert not node.emcy.log


def test_two_drives_on_one_bus_move_together(tmp_path: Path) -> None:
    """The second drive joins the bus of the first. One SYNC reads both positions."""
    first, second = tmp_path / "first", tmp_path / "second"
    first.mkdir()
    second.mkdir()
    with on_a_bus(first) as (_, port), serving(second, "--node", "2", "--join", str(port)):
        network = canopen.Network()
        nodes = [network.add_node(n, str(EDS)) for n in (1, 2)]
        network.connect(interface="slcan", channel=f"socket://127.0.0.1:{port}", bitrate=500000)
        for node in nodes:
            node.sdo.RESPONSE_TIMEOUT = 2.0
            lead_by_sync(node, 4)
        for node in nodes:
            enable(node, CYCLIC_VELOCITY)
        for n in range(200):
            for node in nodes:
                set_point(node, 4, "SPEED_RPM", min(30 * n, 3000))
            network.sync.transmit()
            time.sleep(0.01)
        for node in nodes:
            assert abs(node.sdo[0x606C].raw - 3000) < 60
            assert not node.emcy.log
        network.disconnect()
