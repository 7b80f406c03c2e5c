# SPDX-License-Identifier: MIT
"""`sdre-drive`. Exit codes as those of the other tools: 0 good, 1 bad input or no answer, 4 the
drive has tripped."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import Optional

import typer
from typing_extensions import Annotated

from sdre_drive import commission as finder
from sdre_drive import discover, record, register_map, scope, session, show
from sdre_drive.anticogging_command import anticogging
from sdre_drive.bench_command import EPILOG, bench, state_beside
from sdre_drive.connection import Drive, DriveError
from sdre_drive.disc_command import disc_map
from sdre_drive.load_command import load
from sdre_drive.motion_commands import (
    MOVE_EXAMPLES,
    NUMBERS,
    RUN_EXAMPLES,
    TORQUE_EXAMPLES,
    move,
    run,
    stop,
    torque,
)
from sdre_drive.options import (
    Can,
    CanInterface,
    CanRate,
    Control,
    Line,
    Node,
    PolePairs,
    Port,
    Tcp,
    Unit,
    bench_address,
    here,
    place_words,
    pole_pairs_of,
    target,
    use_can,
    use_line,
)
from sdre_drive.page.server import serve
from sdre_drive.params import comma_words
from sdre_drive.params_commands import params
from sdre_drive.register_commands import GET_EXAMPLES, SET_EXAMPLES, get, set_registers
from sdre_drive.registers import Mode
from sdre_drive.terminal import (
    Json,
    Quiet,
    Verbose,
    end_by_signal,
    err,
    notes,
    out,
    progress,
    set_volume,
)
from sdre_drive.trace_commands import log, take_scope, watch
from sdre_drive.verify_command import verify

EXIT_BAD, EXIT_TRIPPED = 1, 4

app = typer.Typer(
    invoke_without_command=True,
    pretty_exceptions_enable=False,
    help="Reads, commands and explains an sdre-drive, real or virtual.",
    epilog="Examples: sdre-drive (which drives are here?); sdre-drive status; sdre-drive run 1000",
)
app.add_typer(params, name="params")
app.add_typer(disc_map, name="disc-map")
app.add_typer(anticogging, name="anticogging")


def show_version(wanted: bool) -> None:
    """And the register map, which has to be that of the firmware."""
    if wanted:
        out.print(
            f"sdre-drive {register_map.VERSION}, register map {register_map.DIGEST}",
            highlight=False,
        )
        raise typer.Exit


@app.callback()
def common(
    context: typer.Context,
    line: Line = "115200-8E1",
    unit: Unit = 1,
    can: Can = None,
    can_interface: CanInterface = "slcan",
    can_rate: CanRate = 500000,
    node: Node = 1,
    quiet: Quiet = False,
    verbose: Verbose = False,
    _version: Annotated[
        bool,
        typer.Option("--version", help="print it", callback=show_version, is_eager=True),
    ] = False,
) -> None:
    """For a drive on CAN, or one whose line or address is not the one that it comes with."""
    use_line(line, unit)
    use_can(can, can_interface, can_rate, node)
    set_volume(quiet, verbose)
    if not context.invoked_subcommand:
        find()


@app.command()
def find(json: Json = None) -> None:
    """Lists the drives that answer here: serial ports, TCP of this machine, or nodes of --can."""
    found = discover.find(here())
    if json:
        record.write_json(json, [one.as_dict() for one in found])
    for one in [] if json else found:
        out.print(one.words, markup=False, highlight=False, soft_wrap=True)
    if not found:
        raise DriveError(discover.nothing_words(here()))
    notes.print("sdre-drive --help lists what can be done with it")


@app.command(epilog="Examples: sdre-drive status; sdre-drive status --port /dev/ttyUSB0")
def status(
    port: Port = None,
    tcp: Tcp = None,
    pole_pairs: PolePairs = None,
    control: Control = None,
    json: Json = None,
) -> None:
    """Shows the state of the drive, and what to do about it."""
    with Drive(target(port, tcp)) as drive:
        reading = drive.read()
        bench_state = state_beside(drive.target, control)
        pairs = pole_pairs_of(pole_pairs, drive)
    if json:
        record.write_json(json, show.as_dict(reading, pairs, bench_state))
    else:
        out.print(show.status(reading, pairs, bench_state))
    if reading.mode == Mode.FAULT:
        raise typer.Exit(EXIT_TRIPPED)


app.command(context_settings=NUMBERS, epilog=RUN_EXAMPLES)(run)
app.command(context_settings=NUMBERS, epilog=MOVE_EXAMPLES)(move)
app.command(context_settings=NUMBERS, epilog=TORQUE_EXAMPLES)(torque)
app.command()(stop)


@app.command()
def reset(port: Port = None, tcp: Tcp = None) -> None:
    """Leaves FAULT, when its cause has gone."""
    with Drive(target(port, tcp)) as drive:
        if drive.read().mode != Mode.FAULT:
            out.print("there is no fault")
            return
        out.print(show.line(session.reset(drive), None))


app.command()(load)
app.command(epilog=GET_EXAMPLES)(get)
app.command(name="set", epilog=SET_EXAMPLES)(set_registers)
app.command(epilog=EPILOG, context_settings={"ignore_unknown_options": True})(bench)


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
    with Drive(target(port, tcp)) as drive, progress("begins") as bar:
        values = finder.run(
            drive,
            current,
            show.e_radps_of(speed, 1),
            end,
            bar.stage,
        )
    record.write_text(file, finder.text(values))
    out.print(finder.shaft_words(values), highlight=False, soft_wrap=True)
    out.print(
        f"{file}: written; next: sdre-gains from-commissioning {shlex.quote(str(file))} "
        "--drive DRIVE --out NEW",
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
    beside = (where.host, where.tcp_port + 1) if where.is_local else None
    bench = bench_address(control) if control else beside
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
            words = e.format_message() + comma_words(" ".join(sys.argv[1:]))
            words += place_words(e.format_message())
            err.print(f"sdre-drive: {words}", markup=False, highlight=False)
    sys.exit(code)


if __name__ == "__main__":
    main()
