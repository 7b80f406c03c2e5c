# SPDX-License-Identifier: MIT
"""Options that the commands share."""

from __future__ import annotations

import re
from typing import Any, Dict, Optional, Tuple

import typer
from typing_extensions import Annotated

from sdre_drive import discover
from sdre_drive.bench import DEFAULT
from sdre_drive.connection import FORMATS, Drive, DriveError, Target

Port = Annotated[
    Optional[str], typer.Option("--port", help="serial port of the drive", metavar="TTY")
]
Tcp = Annotated[
    Optional[str],
    typer.Option(
        "--tcp",
        help="Modbus/TCP; without --port and --tcp the only drive that answers here",
        metavar="HOST:PORT",
    ),
]
Control = Annotated[
    Optional[str],
    typer.Option(
        "--control", help="bench of the virtual drive (default 127.0.0.1:1503)", metavar="HOST:PORT"
    ),
]
PolePairs = Annotated[
    Optional[int],
    typer.Option(
        "--pole-pairs",
        min=1,
        max=100,
        envvar="SDRE_POLE_PAIRS",
        help="of the motor, for r/min, instead of what the drive tells",
    ),
]


Line = Annotated[
    str,
    typer.Option(
        "--line",
        help="baud rate and format of the serial line: 8E1, 8O1 or 8N2",
        envvar="SDRE_LINE",
        metavar="BAUD-FORMAT",
    ),
]
Unit = Annotated[
    int, typer.Option("--unit", min=1, max=247, help="address of the drive", envvar="SDRE_UNIT")
]

Can = Annotated[
    Optional[str],
    typer.Option(
        "--can",
        help="CAN bus of the drive: a serial device, can0, or socket://HOST:PORT",
        metavar="CHANNEL",
    ),
]
CanInterface = Annotated[
    str,
    typer.Option(
        "--can-interface",
        help="driver of python-can for --can: slcan, socketcan, pcan ..",
        envvar="SDRE_CAN_INTERFACE",
        metavar="NAME",
    ),
]
CanRate = Annotated[
    int, typer.Option("--can-rate", help="bit/s, as CAN_RATE", envvar="SDRE_CAN_RATE")
]
Node = Annotated[
    int,
    typer.Option(
        "--node", min=1, max=127, help="of the drive on CAN, CAN_NODE", envvar="SDRE_NODE"
    ),
]
CAN_RATES = (125000, 250000, 500000, 1000000)
BEFORE = ("--can", "--can-interface", "--can-rate", "--node", "--line", "--unit")

_line: Dict[str, Any] = {"baud": 115200, "format": "8E1", "unit": 1}  # of all commands


def use_line(line: str, unit: int) -> None:
    """Sets the options before the command."""
    baud, _, words = line.partition("-")
    if not baud.isdigit() or words not in FORMATS:
        raise DriveError(f'--line "{line}" is not BAUD-FORMAT, as 115200-8E1')
    _line.update(baud=int(baud), format=words, unit=unit)


def use_can(can: Optional[str], interface: str, rate: int, node: int) -> None:
    """Sets the options of CAN before the command."""
    if rate not in CAN_RATES:
        rates = ", ".join(map(str, CAN_RATES))
        raise DriveError(f"--can-rate {rate} is not one of {rates} bit/s")
    _line.update(can=can, can_interface=interface, can_rate=rate, node=node)


def place_words(text: str) -> str:
    """A hint for an option that stands behind its command."""
    found = re.match(r"No such option: (--[a-z-]+)", text)
    late = found is not None and found.group(1) in BEFORE
    return f"; {found.group(1)} stands before the command" if found and late else ""


def address(text: str, option: str) -> Tuple[str, int]:
    """HOST:PORT."""
    host, _, port = text.rpartition(":")
    if not host or not port.isdigit() or not 0 < int(port) <= 65535:
        raise DriveError(f'{option} "{text}" is not HOST:PORT')
    return host.strip("[]"), int(port)


def target(port: Optional[str], tcp: Optional[str]) -> Target:
    """Address of the drive; by default the only one that answers on this machine."""
    ways = {"--can": _line.get("can"), "--port": port, "--tcp": tcp}
    given = [name for name, way in ways.items() if way]
    if len(given) > 1:
        raise DriveError(f"{' and '.join(given)} name two drives: give one")
    if given == ["--can"]:
        return here()
    if port:
        return Target(serial_port=port, **_line)
    if tcp:
        host, number = address(tcp, "--tcp")
        return Target(host=host, tcp_port=number, **_line)
    return discover.the_only_one(here())


def here() -> Target:
    """This machine, with the options before the command."""
    return Target(**_line)


def bench_address(control: Optional[str]) -> Tuple[str, int]:
    """Address of the virtual drive's bench."""
    return address(control, "--control") if control else DEFAULT


def pole_pairs_of(given: Optional[int], drive: Drive) -> int:
    """The given value, or that of the drive."""
    return given or drive.constants().pole_pairs
