# SPDX-License-Identifier: MIT
"""`sdre-drive run`, `move`, `torque` and `stop`."""

from __future__ import annotations

from typing import Optional

import typer
from rich.live import Live
from typing_extensions import Annotated

from sdre_drive import move as mover
from sdre_drive import session, show
from sdre_drive import torque as torques
from sdre_drive.connection import Drive
from sdre_drive.options import PolePairs, Port, Tcp, pole_pairs_of, target
from sdre_drive.terminal import For, end_by_signal, live_line, out
from sdre_drive.units import e_radps_of

NUMBERS = {"ignore_unknown_options": True}  # -500 is a number
RUN_EXAMPLES = "Examples: sdre-drive run 1000; sdre-drive run -500 --for 10"
MOVE_EXAMPLES = "Examples: sdre-drive move 2.5; sdre-drive move -1 --relative --speed 60 --for 2"

TORQUE_EXAMPLES = "Examples: sdre-drive torque 0.2; sdre-drive torque -50 --percent --speed 1000"


def run(
    speed: Annotated[
        float, typer.Argument(help="r/min, or rad/s electrical; negative: the other way")
    ],
    rpm: Annotated[
        bool, typer.Option("--rpm/--radps", help="r/min of the shaft, or rad/s electrical")
    ] = True,
    length_s: For = None,
    port: Port = None,
    tcp: Tcp = None,
    pole_pairs: PolePairs = None,
) -> None:
    """Runs at SPEED until Ctrl-C, then stops by the drive's ramp; a second Ctrl-C opens the bridge
    at once."""
    end = end_by_signal()
    with Drive(target(port, tcp)) as drive, Live(console=live_line, auto_refresh=False) as live:
        pairs = pole_pairs_of(pole_pairs, drive)
        wanted = e_radps_of(speed, pairs) if rpm else speed
        update = lambda r: live.update(show.line(r, pairs), refresh=True)  # noqa: E731
        update(session.hold(drive, wanted, end, length_s, update, end.at_once))


def move(
    to: Annotated[
        float,
        typer.Argument(
            metavar="TARGET",
            help="turns of the shaft from the zero: the index mark, or where it was aligned",
        ),
    ],
    counts: Annotated[
        bool,
        typer.Option("--counts/--turns", help="TARGET is position units: counts, without a gear"),
    ] = False,
    relative: Annotated[bool, typer.Option("--relative", help="from where it is")] = False,
    speed: Annotated[
        Optional[float],
        typer.Option(
            "--speed",
            min=0.0,
            help="largest on the way, r/min; 0: what the drive can (default: the parameter "
            f"PROFILE_VELOCITY, or {mover.DEFAULT_RPM:g})",
        ),
    ] = None,
    far: Annotated[
        bool, typer.Option("--far", help=f"more than {mover.FAR_TURNS:g} turns away are meant")
    ] = False,
    length_s: Annotated[
        Optional[float],
        typer.Option("--for", min=0.0, help="holds it for so long, then stops", metavar="S"),
    ] = None,
    port: Port = None,
    tcp: Tcp = None,
    pole_pairs: PolePairs = None,
) -> None:
    """Turns the shaft to TARGET and holds it there until Ctrl-C."""
    end = end_by_signal()
    with Drive(target(port, tcp)) as drive, Live(console=live_line, auto_refresh=False) as live:
        pairs, turn = pole_pairs_of(pole_pairs, drive), drive.constants().turn_units
        top = mover.default_speed(drive) if speed is None else e_radps_of(speed, pairs)
        wanted = mover.Wanted(round(to if counts else to * turn), relative, top, far)
        found = mover.go(
            drive,
            wanted,
            end,
            length_s,
            lambda r, w: live.update(
                show.line(r, pairs) + f"  {w.words(turn)} from its zero", refresh=True
            ),
            end.at_once,
        )
        zero = mover.zero_words(drive)
        live.update(
            f"{found.now} position units, wanted {found.target}: {found.words(turn)}; zero: {zero}",
            refresh=True,
        )


def torque(
    wanted: Annotated[
        float, typer.Argument(metavar="TORQUE", help="N m at the air gap; negative: the other way")
    ],
    percent: Annotated[
        bool, typer.Option("--percent/--Nm", help="TORQUE is in percent of the rated torque")
    ] = False,
    speed: Annotated[
        float,
        typer.Option(
            "--speed", min=0.0, help="speed limit either way, r/min; 0: what the drive can"
        ),
    ] = torques.DEFAULT_RPM,
    length_s: For = None,
    port: Port = None,
    tcp: Tcp = None,
    pole_pairs: PolePairs = None,
) -> None:
    """Holds TORQUE up to a speed until Ctrl-C, then stops by the drive's ramp; a second Ctrl-C
    opens the bridge at once."""
    end = end_by_signal()
    with Drive(target(port, tcp)) as drive, Live(console=live_line, auto_refresh=False) as live:
        pairs = pole_pairs_of(pole_pairs, drive)
        torque_Nm = wanted * torques.rated_Nm(drive) / 100.0 if percent else wanted
        reading = torques.hold(
            drive,
            torques.Wanted(torque_Nm, e_radps_of(speed, pairs)),
            end,
            length_s,
            lambda r, t: live.update(show.line(r, pairs) + f"  {t.words(torque_Nm)}", refresh=True),
            end.at_once,
        )
        live.update(show.line(reading, pairs), refresh=True)


def stop(
    coast: Annotated[
        bool, typer.Option("--coast", help="open the bridge at once, without the ramp")
    ] = False,
    port: Port = None,
    tcp: Tcp = None,
) -> None:
    """Stops the drive by its ramp, and opens the bridge."""
    end = end_by_signal()
    with Drive(target(port, tcp)) as drive:
        out.print(show.line(session.stop(drive, end, coast), None))
