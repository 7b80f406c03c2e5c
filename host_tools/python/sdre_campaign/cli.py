# SPDX-License-Identifier: MIT
"""The command sdre-campaign."""

from __future__ import annotations

import json
import os
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import List, Optional

import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

import sdre
from sdre_campaign.batch import Done, span_of
from sdre_campaign.cluster import ClusterError, connected, run_batches
from sdre_campaign.parts import Directory, write_text
from sdre_campaign.plot import draw_sensitivity
from sdre_campaign.replay import write_worst
from sdre_campaign.spec import MOST_CASES, Spec, read_spec
from sdre_campaign.summary import Summary, summarise

EXIT_BAD_INPUT, EXIT_INTERRUPTED, EXIT_FAILED_CASES = 1, 130, 4

app = typer.Typer(add_completion=False)


@app.command()
def campaign(
    spec_file: Path = typer.Argument(..., metavar="SPEC", help="campaign file (TOML)"),
    out: Optional[Path] = typer.Option(None, help="directory of the results [default: build/campaigns/NAME]"),
    resume: bool = typer.Option(False, "--resume", help="go on with the parts that are there"),
    workers: int = typer.Option(0, min=0, help="processes of the local cluster [default: one for each core]"),
    scheduler: Optional[str] = typer.Option(None, help="tcp://HOST:PORT of a Dask scheduler instead"),
    cases: Optional[int] = typer.Option(None, min=1, max=MOST_CASES, help="instead of the file's"),
) -> None:
    """Runs a scenario with very many motors, loads, sensors, faults or seeds. Exit code 4 when a case failed."""
    spec = read_spec(spec_file)
    if cases is not None:
        if spec.method in ("grid", "corners"):
            raise sdre.InputError(f"--cases is not allowed with method = \"{spec.method}\": its variables say how many there are")
        spec = replace(spec, cases=cases)
    path = out or Path("build/campaigns") / spec.name
    with Directory(path, spec, resume) as directory:
        missing = directory.missing()
        if missing:
            try:
                print(_run(directory, missing, scheduler, workers or os.cpu_count() or 1))
            except KeyboardInterrupt:
                raise typer.Exit(_say("interrupted; --resume goes on", EXIT_INTERRUPTED)) from None
        summary = summarise(spec, directory.tables())
        _write(directory, summary)
    print(_text(spec, summary, path))
    raise typer.Exit(EXIT_FAILED_CASES if summary.failures else 0)


def _run(directory: Directory, missing: List[int], scheduler: Optional[str], workers: int) -> str:
    """Runs what is missing; gives a line about how fast."""
    spec = directory.spec
    counts = [span_of(spec, batch)[1] for batch in missing]
    spent = [0.0, 0.0]
    console = Console(stderr=True)
    with connected(scheduler, workers) as client, Progress(
        TextColumn("{task.completed:.0f} of {task.total:.0f} cases"), BarColumn(), TimeRemainingColumn(),
        TextColumn("{task.fields[rate]}"), console=console, disable=not console.is_terminal) as progress:  # fmt: skip
        task = progress.add_task("cases", total=spec.cases, completed=spec.cases - sum(counts), rate="")
        client.wait_for_workers(1, timeout=60)
        begin = time.monotonic()
        done = 0

        def keep(one: Done) -> None:
            nonlocal done
            directory.write(one.batch, one.table)
            spent[0] += one.wall_s
            spent[1] += one.cpu_s
            done += one.table.num_rows
            progress.update(task, advance=one.table.num_rows, rate=f"{done / (time.monotonic() - begin):.0f}/s")

        run_batches(client, spec, missing, keep)
        wall_s = time.monotonic() - begin
        threads = sum(client.nthreads().values())
    seconds = sum(counts) * float(spec.scenario["duration_s"])
    return (
        f"{sum(counts)} cases in {wall_s:.1f} s on {threads} workers: {sum(counts) / wall_s:.0f} cases/s; per core and second of its "
        f"time {seconds / max(spent[1], 1e-9):.0f} simulated s; workers busy {100.0 * spent[0] / (wall_s * threads):.1f} %"
    )


def _write(directory: Directory, summary: Summary) -> None:
    spec = directory.spec
    write_text(directory.path / "summary.json", json.dumps(summary.as_dict(), indent=1) + "\n")
    write_worst(spec, summary.worst, directory.path / "worst")
    if summary.sensitivities:
        title = f"{spec.name}: {summary.cases:,} cases of {spec.drive().name}, {summary.failures:,} failed"
        draw_sensitivity(summary, title, directory.path / "sensitivity.png")


def _text(spec: Spec, s: Summary, path: Path) -> str:
    low, high = s.interval
    lines = [
        f"{spec.name} on {spec.drive().name}: {s.failures} of {s.cases} cases failed",
        f"failure probability {s.failures / s.cases:.3g}, 95 % interval {low:.3g} .. {high:.3g} (Clopper-Pearson)",
        f"margin: mean {s.margin_mean:.3f}, least {s.margin_least:.3f}, below zero in {s.negative} cases",
    ]
    lines += [f"{count} x {fault}" for fault, count in s.faults.items()]
    variance = s.margin_deviation**2
    lines += [f"{one.name}: explains {100.0 * one.first_order(variance, s.margin_mean):.1f} % of the margin's variance"
        for one in s.sensitivities]  # fmt: skip
    return "\n".join(lines + [f"written: {path}/summary.json, parts/, worst/" + (", sensitivity.png" if s.sensitivities else "")])


def main() -> None:
    """With one line about what is wrong, as the other tools."""
    try:
        app()
    except (sdre.InputError, sdre.DesignError) as error:
        sys.exit(_say(str(error), EXIT_BAD_INPUT if isinstance(error, sdre.InputError) else 2))
    except ClusterError as error:
        sys.exit(_say(f"{error}; --resume goes on", EXIT_BAD_INPUT))


def _say(line: str, code: int) -> int:
    print(f"sdre-campaign: {line}", file=sys.stderr)
    return code
