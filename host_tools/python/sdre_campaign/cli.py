# SPDX-License-Identifier: MIT
"""The command sdre-campaign."""

from __future__ import annotations

import json
import logging
import math
import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any, Optional, Union

import typer

import sdre
from sdre_campaign.batch import run_batch, span_of
from sdre_campaign.cluster import ClusterError
from sdre_campaign.parts import Directory, part_name, write_text
from sdre_campaign.plot import draw_levels, draw_sensitivity
from sdre_campaign.rare import Run, walk
from sdre_campaign.rare_summary import RareSummary, summarise_runs
from sdre_campaign.replay import write_worst
from sdre_campaign.spec import MOST_CASES, read_spec
from sdre_campaign.summary import Summary, summarise
from sdre_campaign.workers import Workers

EXIT_BAD_INPUT, EXIT_INTERRUPTED, EXIT_FAILED_CASES = 1, 130, 4

app = typer.Typer(pretty_exceptions_enable=False)


def show_version(wanted: bool) -> None:
    """The host libraries have the same one."""
    if wanted:
        print(f"sdre-campaign {sdre.__version__}")
        raise typer.Exit


@app.command(epilog="Example: sdre-campaign my_campaign.toml --out build/campaigns/mine -v")
def campaign(
    spec_file: Path = typer.Argument(..., metavar="SPEC", help="campaign file (TOML)"),
    out: Optional[Path] = typer.Option(
        None, help="directory of the results [default: build/campaigns/NAME]"
    ),
    resume: bool = typer.Option(False, "--resume", help="go on with the parts that are there"),
    workers: int = typer.Option(
        0, min=0, help="processes of the local cluster [default: one for each core]"
    ),
    scheduler: Optional[str] = typer.Option(
        None, help="address of a Dask scheduler instead, such as tls://HOST:PORT"
    ),
    cases: Optional[int] = typer.Option(None, min=1, max=MOST_CASES, help="instead of the file's"),
    quiet: bool = typer.Option(False, "-q", "--quiet", help="print only the result"),
    verbose: bool = typer.Option(
        False, "-v", "--verbose", help="tell what is there, who computes, and every part"
    ),
    as_json: bool = typer.Option(
        False, "--json", help="print summary.json, one JSON object, and nothing else"
    ),
    _version: bool = typer.Option(
        False, "--version", help="print it", callback=show_version, is_eager=True
    ),
) -> None:
    """Runs a scenario with very many motors, loads, sensors, faults or seeds. Exit code 4 when a
    case failed."""
    if verbose:
        _tell_everything()
    spec = read_spec(spec_file)
    if cases is not None:
        if spec.method not in ("random", "motors"):
            raise sdre.InputError(
                f'--cases is not allowed with method = "{spec.method}": its file says how many '
                f"there are"
            )
        spec = replace(spec, cases=cases)
    path = out or Path("build/campaigns") / spec.name
    with (
        Directory(path, spec, resume) as directory,
        Workers(spec, scheduler, workers or os.cpu_count() or 1, quiet or as_json) as crew,
    ):
        try:
            summary = (_rare if spec.method == "subset" else _plain)(directory, crew)
        except KeyboardInterrupt:
            raise typer.Exit(_say("interrupted; --resume goes on", EXIT_INTERRUPTED)) from None
    print(_json(summary) if as_json else summary.text(spec, path))
    raise typer.Exit(EXIT_FAILED_CASES if summary.failures else 0)


def _json(summary: Union[Summary, RareSummary]) -> str:
    """One object. JSON has no infinity and no NaN: they become null."""
    return json.dumps(_finite(summary.as_dict()), indent=1, allow_nan=False)


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _finite(one) for name, one in value.items()}
    if isinstance(value, list):
        return [_finite(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _tell_everything() -> None:
    """-v."""
    handler = logging.StreamHandler()
    handler.setFormatter(logging.Formatter("sdre-campaign: %(message)s"))
    log = logging.getLogger("sdre_campaign")
    log.addHandler(handler)
    log.setLevel(logging.INFO)
    log.propagate = False


def _plain(directory: Directory, crew: Workers) -> Summary:
    """Every case by itself."""
    spec = directory.spec
    missing = directory.missing()
    sizes = [span_of(spec, batch)[1] for batch in missing]
    crew.expect(spec.cases, spec.cases - sum(sizes))
    crew.run(run_batch, missing, lambda one: directory.write(part_name(one.task), one.table))
    crew.tell()
    summary = summarise(spec, directory.tables())
    _write(directory, summary)
    return summary


def _rare(directory: Directory, crew: Workers) -> RareSummary:
    """Level by level."""
    spec = directory.spec
    runs = [Run(spec, number) for number in range(spec.repeats)]
    walk(directory, runs, crew)
    crew.tell()
    summary = summarise_runs(spec, runs, directory)
    write_text(directory.path / "summary.json", _json(summary) + "\n")
    write_worst(spec, summary.worst, directory.path / "worst")
    draw_levels(
        summary, f"{spec.name}: margins of {spec.drive().name}", directory.path / "levels.png"
    )
    return summary


def _write(directory: Directory, summary: Summary) -> None:
    spec = directory.spec
    write_text(directory.path / "summary.json", _json(summary) + "\n")
    write_worst(spec, summary.worst, directory.path / "worst")
    if summary.sensitivities:
        title = (
            f"{spec.name}: {summary.cases:,} cases of {spec.drive().name}, {summary.failures:,} "
            f"failed"
        )
        draw_sensitivity(summary, title, directory.path / "sensitivity.png")


def main() -> None:
    """With one line about what is wrong, as the other tools."""
    run = typer.main.get_command(app).main
    try:
        sys.exit(run(prog_name="sdre-campaign", standalone_mode=False) or 0)
    except (sdre.InputError, sdre.DesignError) as error:
        sys.exit(_say(str(error), EXIT_BAD_INPUT if isinstance(error, sdre.InputError) else 2))
    except ClusterError as error:
        sys.exit(_say(f"{error}; --resume goes on", EXIT_BAD_INPUT))
    except OSError as error:  # a full disk, a directory that is gone
        sys.exit(_say(str(error), EXIT_BAD_INPUT))
    except typer.Abort:  # Ctrl-C before the first case
        sys.exit(_say("interrupted", EXIT_INTERRUPTED))
    except Exception as error:  # those of the command line have no common base in typer
        if not hasattr(error, "format_message"):
            raise
        words = error.format_message()
        sys.exit(_say(f"{words} (sdre-campaign --help has what there is)", EXIT_BAD_INPUT))


def _say(line: str, code: int) -> int:
    print(f"sdre-campaign: {line}", file=sys.stderr)
    return code
