# SPDX-License-Identifier: MIT
"""`sdre-drive load`."""

from __future__ import annotations

from pathlib import Path
from typing import Optional

import serial
import typer
from typing_extensions import Annotated

from sdre_drive import boot_rom
from sdre_drive import load as loader
from sdre_drive import params as parameters
from sdre_drive.connection import Drive, DriveError
from sdre_drive.faults import bits
from sdre_drive.options import Port, Tcp, target
from sdre_drive.terminal import err, out, progress


def _load_ram(file: Path, rate: int, port: Optional[str]) -> None:
    program = boot_rom.read_program(file)
    if not port:
        raise DriveError("load --boot-rom: name the serial port with --port")
    try:
        with (
            serial.Serial(port, rate, timeout=boot_rom.ECHO_S) as line,
            progress("loading") as bar,
        ):
            boot_rom.send(line, program, bar.share)
    except serial.SerialException as e:
        raise DriveError(f"{port}: {e}") from e
    out.print(f"{program.words} words in RAM, started at {program.entry:06X}h", soft_wrap=True)


def load(
    image: Annotated[
        Optional[Path], typer.Argument(help="of `sdre-gains image`; none: show what is in force")
    ] = None,
    forget: Annotated[
        bool, typer.Option("--forget", help="back to the constants that are compiled in")
    ] = False,
    accept: Annotated[
        bool,
        typer.Option(
            "--accept-fallback",
            help="the drive lost what was stored last: let it run with what it uses instead",
        ),
    ] = False,
    boot: Annotated[
        Optional[Path],
        typer.Option(
            "--boot-rom",
            help="a program for an F28335's RAM, of hex2000 --boot --sci8 -a",
            metavar="FILE",
        ),
    ] = None,
    rate: Annotated[
        int, typer.Option("--rate", min=300, max=115200, help="Bd, of --boot-rom")
    ] = 38400,
    port: Port = None,
    tcp: Tcp = None,
) -> None:
    """Writes a motor's constants into the drive's flash, and restarts it with them."""
    if sum(map(bool, (image, forget, accept, boot))) > 1:
        raise DriveError("load: give an image, --forget, --accept-fallback or --boot-rom")
    if boot:
        _load_ram(boot, rate, port)
        return
    with Drive(target(port, tcp)) as drive:
        if forget:
            found = loader.forget(drive)
        elif image:
            with progress("writing") as bar:
                found = loader.load(drive, image, bar.share)
        else:
            if accept:
                parameters.accept(drive)
            found = loader.in_force(drive)
        lost = bits("condition", drive.read().conditions & parameters.LOST)
    out.print(f"in force: {found.words}", soft_wrap=True)
    for entry in lost:
        err.print(f"{entry.name}: {entry.meaning}", soft_wrap=True)
