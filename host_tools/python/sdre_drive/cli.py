# SPDX-License-Identifier: MIT
"""`sdre-drive`. Exit codes as those of the other tools: 0 good, 1 bad input or no answer, 4 the
drive has tripped."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Optional

import typer
from rich.live import Live
from rich.progress import Progress
from typing_extensions import Annotated

from sdre_drive import commission as finder
from sdre_drive import move as mover
from sdre_drive import record, scope, session, show
from sdre_drive.connection import Drive, DriveError
from sdre_drive.load_command import load
from sdre_drive.options import (
    Control,
    Line,
    PolePairs,
    Port,
    Tcp,
    Unit,
    bench_address,
    pole_pairs_of,
    target,
    use_line,
)
from sdre_drive.page.server import serve
from sdre_drive.params_commands import params
from sdre_drive.registers import Mode
from sdre_drive.terminal import For, end_by_signal, err, out
from sdre_drive.trace_commands import log, take_scope, watch
from sdre_drive.verify_command import verify

EXIT_BAD, EXIT_TRIPPED = 1, 4

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="Reads, commands and explains an sdre-drive, real or virtual.",
)
app.add_typer(params, name="params")


@app.callback()
def common(line: Line = "115200-8E1", unit: Unit = 1) -> None:
    """For a drive whose line or address is not the one that it comes with."""
    use_line(line, unit)


@app.command()
def status(port: Port = None, tcp: Tcp = None, pole_pairs: PolePairs = None) -> None:
    """Shows the state of the drive, and what to do about it."""
    with Drive(target(port, tcp)) as drive:
        reading = drive.read()
        out.print(show.status(reading, pole_pairs_of(pole_pairs, drive)))
    if reading.mode == Mode.FAULT:
        raise typer.Exit(EXIT_TRIPPED)


@app.command()
def run(
    speed: Annotated[
        float, typer.Argument(help="negative: the other way; after -- on the command line")
    ],
    rpm: Annotated[
        bool, typer.Option("--rpm/--radps", help="r/min of the shaft, or rad/s electrical")
    ] = True,
    length_s: For = None,
    port: Port = None,
    tcp: Tcp = None,
    pole_pairs: PolePairs = None,
) -> None:
    """Runs at SPEED until Ctrl-C, then stops."""
    end = end_by_signal()
    with Drive(target(port, tcp)) as drive, Live(console=out, auto_refresh=False) as live:
        pairs = pole_pairs_of(pole_pairs, drive)
        wanted = show.e_radps_of(speed, pairs) if rpm else speed
        update = lambda r: live.update(show.line(r, pairs), refresh=True)  # noqa: E731
        update(session.hold(drive, wanted, end, length_s, update))


@app.command()
def move(
    to: Annotated[
        float,
        typer.Argument(
            metavar="TARGET",
            help="turns of the shaft from the zero; negative after -- on the command line",
        ),
    ],
    counts: Annotated[
        bool,
        typer.Option("--counts/--turns", help="TARGET is counts of the encoder, four per line"),
    ] = False,
    relative: Annotated[bool, typer.Option("--relative", help="from where it is")] = False,
    speed: Annotated[
        float,
        typer.Option("--speed", min=0.0, help="largest on the way, r/min; 0: what the drive can"),
    ] = 0.0,
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
    with Drive(target(port, tcp)) as drive, Live(console=out, auto_refresh=False) as live:
        pairs = pole_pairs_of(pole_pairs, drive) or 1
        wanted = round(to if counts else to * drive.constants().encoder_counts)
        found = mover.go(
            drive,
            wanted,
            relative,
            show.e_radps_of(speed, pairs),
            end,
            length_s,
            lambda r, w: live.update(
                show.line(r, pairs) + f"  {w.now} counts of {w.target}", refresh=True
            ),
        )
        live.update(f"{found.now} counts, wanted {found.target}", refresh=True)


@app.command()
def stop(port: Port = None, tcp: Tcp = None) -> None:
    """Stops the drive."""
    with Drive(target(port, tcp)) as drive:
        out.print(show.line(session.stop(drive), None))


@app.command()
def reset(port: Port = None, tcp: Tcp = None) -> None:
    """Leaves FAULT, when its cause has gone."""
    with Drive(target(port, tcp)) as drive:
        if drive.read().mode != Mode.FAULT:
            out.print("there is no fault")
            return
        out.print(show.line(session.reset(drive), None))


app.command()(load)


@app.command()
def commission(
    file: Annotated[
        Path, typer.Option("--out", help="what was found, for `sdre-gains from-commissioning`")
    ],
    current: Annotated[float, typer.Option("--current", min=0.01, help="A, peak: its bound")],
    speed: Annotated[float, typer.Option("--speed", min=0.1, help="r/min: its bound")],
    port: Port = None,
    tcp: Tcp = None,
) -> None:
    """Finds the motor: the shaft turns, both ways, and has to be free."""
    end = end_by_signal()
    with Drive(target(port, tcp)) as drive, Progress(console=err, transient=True) as bar:
        task = bar.add_task("begins", total=1.0)
        values = finder.run(
            drive,
            current,
            show.e_radps_of(speed, 1),
            end,
            lambda stage, share: bar.update(task, description=stage, completed=share),
        )
    record.write_text(file, finder.text(values))
    out.print(
        f"{file}: written; next: sdre-gains from-commissioning {file} --drive DRIVE --out NEW",
        soft_wrap=True,
    )


@app.command()
def faults(
    port: Port = None,
    tcp: Tcp = None,
    pole_pairs: PolePairs = None,
    csv: Annotated[
        Optional[Path], typer.Option("--csv", help="the last 64 periods before it", metavar="FILE")
    ] = None,
) -> None:
    """The fault now and what the drive kept of the last one."""
    with Drive(target(port, tcp)) as drive:
        reading = drive.read()
        if csv:
            record.write_capture(csv, scope.record(drive))
        pairs = pole_pairs_of(pole_pairs, drive)
    for text in show.reasons(reading):
        out.print(text)
    out.print(show.first_fault(reading, pairs))
    if reading.mode == Mode.FAULT:
        raise typer.Exit(EXIT_TRIPPED)


app.command()(verify)
app.command()(watch)
app.command()(log)
app.command(name="scope")(take_scope)


@app.command()
def ui(
    port: Port = None,
    tcp: Tcp = None,
    control: Control = None,
    pole_pairs: PolePairs = None,
    page_port: Annotated[
        int, typer.Option("--page-port", min=1, max=65535, help="of the page, on this machine only")
    ] = 8503,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="open it")] = True,
) -> None:
    """A page with traces and switches, on this machine only."""
    where = target(port, tcp)
    bench = bench_address(control) if control or where.is_local else None
    serve(where, bench, pole_pairs, page_port, browser)


def main() -> None:
    """Every error is one line."""
    code = EXIT_BAD
    try:
        code = typer.main.get_command(app).main(prog_name="sdre-drive", standalone_mode=False) or 0
    except session.Tripped as e:
        err.print(f"sdre-drive: {e}", markup=False, highlight=False)
        for text in show.reasons(e.reading):
            err.print(text)
        code = EXIT_TRIPPED
    except DriveError as e:
        err.print(f"sdre-drive: {e}", markup=False, highlight=False)
    except Exception as e:  # those of the command line have no common base over typer's releases
        if not hasattr(e, "format_message"):
            raise
        if e.format_message():  # no command at all: the help is there already
            err.print(f"sdre-drive: {e.format_message()}", markup=False, highlight=False)
    sys.exit(code)


if __name__ == "__main__":
    main()
