# SPDX-License-Identifier: MIT
"""The virtual drive against clients that break off, talk nonsense, or are too many: the motor turns
on."""

from __future__ import annotations

import contextlib
import json
import os
import random
import socket
import struct
import threading
import time
from typing import Iterator

import pytest
from conftest import Served
from support import run_at, stay, until

from sdre_drive import session
from sdre_drive.connection import Drive
from sdre_drive.registers import Mode

READ_ALL = bytes.fromhex("000100000006 01 04 0000 0030")


def connect(port: int) -> socket.socket:
    return socket.create_connection(("127.0.0.1", port), timeout=5)


@contextlib.contextmanager
def kept_alive(drive: Drive) -> Iterator[None]:
    """A master that goes on asking meanwhile."""
    end = threading.Event()
    asking = threading.Thread(target=lambda: list(session.follow(drive, end)))
    asking.start()
    try:
        yield
    finally:
        end.set()
        asking.join()


def kill(s: socket.socket) -> None:
    """As the operating system does with a killed client's connection: no farewell."""
    s.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    s.close()


def test_broken_off_requests(served: Served, drive: Drive) -> None:
    run_at(drive, 200.0)
    for port in (served.tcp, served.rtu, served.control):
        with kept_alive(drive):
            for length in range(1, len(READ_ALL)):
                s = connect(port)
                s.sendall(READ_ALL[:length])
                kill(s)
        s = connect(port)
        s.sendall(READ_ALL * 20)
        kill(s)
        until(drive, lambda r: r.mode == Mode.RUN, 0.5)
    assert abs(stay(drive, 0.5).speed_e_radps - 200.0) < 10.0


def test_nonsense_on_every_endpoint(served: Served, drive: Drive) -> None:
    r = random.Random(1)
    run_at(drive, 200.0)
    for port in (served.tcp, served.rtu, served.control):
        with kept_alive(drive):
            for _ in range(20):
                s = connect(port)
                try:
                    s.sendall(r.randbytes(r.randrange(1, 3000)))
                except OSError:
                    pass  # the server may hang up
                s.close()
        until(drive, lambda r: r.mode == Mode.RUN, 0.5)
    line = os.open(served.pty, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    os.write(line, r.randbytes(500))
    os.close(line)
    reading = stay(drive, 1.0)
    assert reading.mode == Mode.RUN and abs(reading.speed_e_radps - 200.0) < 10.0


def test_two_hundred_connections(served: Served, drive: Drive) -> None:
    run_at(drive, 200.0)
    with kept_alive(drive):
        crowd = [connect(served.tcp) for _ in range(200)]
        for s in crowd:
            kill(s)
    with Drive(served.target()) as another:
        until(another, lambda r: r.mode == Mode.RUN, 0.5)


def test_traces_that_nobody_reads_hold_up_no_master(served: Served, drive: Drive) -> None:
    run_at(drive, 200.0)
    s = connect(served.control)
    s.setblocking(False)
    with kept_alive(drive):
        for _ in range(40):
            with contextlib.suppress(BlockingIOError):
                s.send(b"trace 20\n" * 400)
            time.sleep(0.05)
        assert served.bench().ask("state")["time_s"] > 0.0
    s.close()
    reading = stay(drive, 0.5)
    assert reading.mode == Mode.RUN and abs(reading.speed_e_radps - 200.0) < 10.0


def test_connections_that_ask_nothing_make_room(served: Served, drive: Drive) -> None:
    run_at(drive, 200.0)
    with kept_alive(drive):
        idle = [connect(served.tcp) for _ in range(40)]
        with Drive(served.target()) as another:
            until(another, lambda r: r.mode == Mode.RUN, 0.5)
        idle[0].settimeout(5)
        assert idle[0].recv(1) == b"", "the quietest was not closed"
    for s in idle:
        s.close()
    assert stay(drive, 0.5).mode == Mode.RUN


@pytest.mark.parametrize(
    "line",
    [
        "",
        "load",
        "load x",
        "load 1e9",
        "load nan",
        "dc_link -1",
        "fault",
        'fault kind = "x"',
        'fault kind = "phase_open"',
        "trace 1e9",
        "trace -1",
        "halt",
        "fault }]",
        "\x00\xff",
    ],
)
def test_bench_refuses_in_words(served: Served, line: str) -> None:
    s = connect(served.control)
    s.sendall(line.encode("latin-1") + b"\n")
    answer = json.loads(s.makefile().readline())
    assert answer["error"]
    s.close()


def test_modbus_on_the_bench_is_hung_up_on_at_once(served: Served) -> None:
    """Whoever looks for a drive does not wait for the bench."""
    s = connect(served.control)
    s.sendall(READ_ALL)
    assert s.recv(1) == b""
    s.close()


def test_a_client_that_reads_slowly_gets_all_of_a_long_answer(served: Served) -> None:
    bench = served.bench()
    while bench.ask("state")["time_s"] < 4.0:
        time.sleep(0.2)
    s = socket.socket()
    s.setsockopt(
        socket.SOL_SOCKET, socket.SO_RCVBUF, 4096
    )  # so that the answer does not fit into what lies between
    s.settimeout(20)
    s.connect(("127.0.0.1", served.control))
    s.sendall(b"trace 20\n")
    time.sleep(0.5)
    trace = json.loads(s.makefile().readline())
    assert len(trace["time_s"]) > 3900
    assert all(len(column) == len(trace["time_s"]) for column in trace.values())
    s.close()
