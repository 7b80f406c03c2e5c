# SPDX-License-Identifier: MIT
"""Habits that sdre-campaign shares with the other tools: version, quiet, verbose, completion."""

from __future__ import annotations

import json
import math
import os
import subprocess
from pathlib import Path
from typing import Any

import pytest
from man_pages import require_kept_page
from test_campaign import SHORT, command, write_spec
from test_campaign_rare import RARE_SHORT

import sdre
from sdre_campaign.cli import _finite
from sdre_campaign.subset import Estimate

SMALL = SHORT.replace("cases = 240", "cases = 8").replace("batch = 20", "batch = 4")


def ran(*words: Any, **environment: str) -> subprocess.CompletedProcess:
    """sdre-campaign, to its end."""
    return subprocess.run(
        command(*words),
        capture_output=True,
        text=True,
        timeout=300,
        env={**os.environ, **environment},
    )


def test_version_is_that_of_the_host_libraries() -> None:
    done = ran("--version")
    assert (done.returncode, done.stdout) == (0, f"sdre-campaign {sdre.__version__}\n")


def test_help_has_an_example_and_the_options_of_the_other_tools() -> None:
    said = ran("--help", COLUMNS="200").stdout
    for word in ("Example: sdre-campaign", "--version", "--quiet", "-v", "--install-completion"):
        assert word in said, word


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_offers_the_options(shell: str) -> None:
    script = ran(_SDRE_CAMPAIGN_COMPLETE=f"source_{shell}")
    assert script.returncode == 0 and "sdre-campaign" in script.stdout, script.stderr
    words = {
        "COMP_WORDS": "sdre-campaign --re",
        "COMP_CWORD": "1",
        "_TYPER_COMPLETE_ARGS": "sdre-campaign --re",
        "_TYPER_COMPLETE_FISH_ACTION": "get-args",
    }
    assert "--resume" in ran(_SDRE_CAMPAIGN_COMPLETE=f"complete_{shell}", **words).stdout


@pytest.mark.parametrize(
    "words, piece",
    [
        (["--walk"], "No such option: --walk"),
        ([], "Missing argument 'SPEC'"),
        (["a.toml", "--cases", "many"], "Invalid value for '--cases'"),
    ],
)
def test_wrong_command_line_is_one_line(words: list, piece: str) -> None:
    done = ran(*words)
    assert done.returncode == 1 and done.stdout == ""
    assert len(done.stderr.splitlines()) == 1, done.stderr
    assert done.stderr.startswith("sdre-campaign: ") and piece in done.stderr
    assert "--help" in done.stderr


def test_quiet_prints_the_result_alone_and_verbose_every_part(tmp_path: Path) -> None:
    spec = write_spec(tmp_path, SMALL)
    said = {
        option: ran(spec, "--out", tmp_path / option, "--workers", 1, option)
        for option in ("-q", "-v")
    }

    quiet, verbose = said["-q"], said["-v"]
    assert quiet.returncode == verbose.returncode != 1, quiet.stderr + verbose.stderr
    assert quiet.stderr == ""
    result = verbose.stdout.splitlines()[1:]  # the first line is about how fast it was
    assert "cases/s" in verbose.stdout.splitlines()[0]
    assert quiet.stdout.splitlines()[:-1] == result[:-1]  # the last one names the directory
    parts = tmp_path / "-v" / "parts"
    assert verbose.stderr.splitlines() == [
        "sdre-campaign: 0 of 8 cases are there",
        "sdre-campaign: workers: 1, on this machine",
        f"sdre-campaign: {parts}/part-000000.parquet: 4 rows",
        f"sdre-campaign: {parts}/part-000001.parquet: 4 rows",
    ]


def test_man_page_is_made_from_the_command() -> None:
    require_kept_page("sdre-campaign")


def refused(constant: str) -> float:
    """NaN and Infinity are no JSON."""
    raise AssertionError(constant)


@pytest.mark.parametrize(
    "text, cases, failures",
    [
        (SMALL, lambda s: s["cases"], lambda s: s["failures"]),
        (RARE_SHORT, lambda s: s["first_level_samples"], lambda s: s["failed"]["cases"]),
    ],
    ids=["plain", "rare"],
)
def test_json_is_the_summary_and_nothing_else(
    tmp_path: Path, text: str, cases: Any, failures: Any
) -> None:
    done = ran(write_spec(tmp_path, text), "--out", tmp_path / "out", "--workers", 1, "--json")
    assert done.stderr == "" and done.stdout == (tmp_path / "out/summary.json").read_text()
    summary = json.loads(done.stdout, parse_constant=refused)
    assert cases(summary) == (8 if text == SMALL else 120)
    assert done.returncode == (4 if failures(summary) else 0)


def test_json_has_null_where_no_number_is_finite() -> None:
    once = Estimate(0.0, math.inf, (0.0, 1.0), math.nan).as_dict()
    assert _finite({"found": [once]}) == {
        "found": [
            {
                "probability": 0.0,
                "coefficient_of_variation": None,
                "interval_95": [0.0, 1.0],
                "interval_variation": None,
            }
        ]
    }
