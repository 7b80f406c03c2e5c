# SPDX-License-Identifier: MIT
"""`sdre-drive disc-map`."""

from __future__ import annotations

import shlex
from pathlib import Path

import typer
from typing_extensions import Annotated

from sdre_drive import disc
from sdre_drive.connection import Drive, DriveError
from sdre_drive.options import Port, Tcp, target
from sdre_drive.terminal import out, progress
from sdre_drive.units import e_radps_of

CHECK_CAPTURES = 4  # chosen: 2,000 readings, a scatter within 2 %

disc_map = typer.Typer(
    no_args_is_help=True, help="A map of the encoder disc: docs/disc_map.md. The shaft turns."
)

Speed = Annotated[
    float,
    typer.Option("--speed", min=0.1, help="r/min of the shaft: learned at 0.8 to 1.3 times of it"),
]


@disc_map.command()
def learn(
    file: Annotated[Path, typer.Option("--out", help="map to write, for `sdre-gains image`")],
    speed: Speed,
    visits: Annotated[
        float, typer.Option("--visits", min=1.0, max=1000.0, help="of each edge, on average")
    ] = 10.0,
    port: Port = None,
    tcp: Tcp = None,
) -> None:
    """Learns where each edge of the disc is, while the shaft turns forward at five steady
    speeds."""
    with Drive(target(port, tcp)) as drive, progress("learning") as bar:
        if disc.state(drive) != disc.NONE:
            raise DriveError("the drive has a map already: load its image without --disc-map first")
        known = drive.constants()
        tracks = disc.captures(drive, e_radps_of(speed, known.pole_pairs), visits, bar.share)
    found = disc.learn(tracks, known.encoder_counts)
    disc.require_worth(found)
    disc.write(file, found.offsets)
    out.print(
        f"{file}: {known.encoder_counts} edges, off by {found.rms:.3f} counts rms, repeat within "
        f"{found.error_rms:.3f}; next: sdre-gains image DRIVE --disc-map {shlex.quote(str(file))} "
        "--out IMAGE",
        soft_wrap=True,
        highlight=False,
    )


@disc_map.command()
def check(speed: Speed, port: Port = None, tcp: Tcp = None) -> None:
    """Tells whether the map is in force, and how far the edges are off with what is in force."""
    with Drive(target(port, tcp)) as drive:
        disc.state(drive)  # refuses firmware without maps before the shaft turns
        pairs = drive.constants().pole_pairs
        now, scatter = disc.check(drive, e_radps_of(speed, pairs), CHECK_CAPTURES)
    out.print(
        f"{disc.STATES[now]}; edges off by {scatter:.3f} counts rms",
        soft_wrap=True,
        highlight=False,
    )
    if now == disc.OTHER:
        raise typer.Exit(1)
