# SPDX-License-Identifier: MIT
"""The page where the drive runs in a browser, from a file system: runs, sliders, the same numbers
as sdre-sil."""

from __future__ import annotations

import asyncio
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any, Dict, List

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/python"))
from browser import Browser, path  # noqa: E402

PAGE = ROOT / "build/site/web/index.html"
SIL = ROOT / "build/host/bin/sdre-sil"
pytestmark = pytest.mark.skipif(
    path() is None or not PAGE.exists(), reason="./dev web builds the page; Chromium is needed"
)

LAST_DIGITS = 1e-8  # a trace has nine; the browser's sine is another C library's
DONE = "window.page && page.done"
FILES = (
    "({csv: page.answer.csv, scenario: page.answer.scenario_toml, drive: page.answer.drive_toml, "
    "text: page.answer.text})"
)


def move(name: str, share: float) -> str:
    """Script: one slider to a share of its way, as a hand does."""
    return (
        f"(() => {{ const one = page.sliders.find((s) => s.name === {json.dumps(name)}); "
        f"one.input.value = {round(1000 * share)};"
        " one.input.dispatchEvent(new Event('input')); })()"
    )


def choose(scenario: str) -> str:
    """Script: another scenario."""
    return (
        f"(() => {{ const s = document.getElementById('scenario'); s.value = "
        f"{json.dumps(scenario)}; s.dispatchEvent(new Event('change')); }})()"
    )


def native(files: Dict[str, str], where: Path) -> Dict[str, str]:
    """The result of sdre-sil for the page's files."""
    for name in ("scenario", "drive"):
        (where / f"{name}.toml").write_text(files[name])
    done = subprocess.run(
        [SIL, "run", "scenario.toml", "--csv", "trace.csv"],
        cwd=where,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode in (0, 4), done.stderr
    return {"csv": (where / "trace.csv").read_text(), "text": done.stdout}


def largest_difference(one: str, other: str) -> float:
    """Largest difference of any quantity, relative to its largest value."""
    a, b = (
        [[float(v) for v in line.split(",")] for line in text.splitlines()[1:]]
        for text in (one, other)
    )
    assert len(a) == len(b)
    sizes = [max(abs(v) for v in column) or 1.0 for column in zip(*b)]
    return max(abs(p - q) / size for r, s in zip(a, b) for p, q, size in zip(r, s, sizes))


async def visited(scripts: List[str], picture: str = "") -> List[Any]:
    """Opens the page, does one thing after the other; the files of each run, and the page's
    state."""
    found = []
    async with Browser(PAGE.as_uri(), 1280, 1000) as browser:
        await browser.until(DONE)
        for script in scripts:
            if script:
                await browser.script(script)
                await browser.until(DONE, 60.0)
            found.append(
                {
                    **await browser.script(FILES),
                    "state": await browser.script("document.getElementById('state').innerText"),
                }
            )
        if picture:
            await browser.picture(Path(picture))
        assert not browser.errors
    return found


def test_runs_are_those_of_sdre_sil(tmp_path: Path) -> None:
    shipped, heavy, tuned = asyncio.run(
        visited(
            ["", move("Inertia", 0.8), move("Speed error", 0.7)], os.environ.get("SDRE_PICTURE", "")
        )
    )
    assert "within 1 % [ms]" in shipped["text"]
    assert shipped["csv"] != heavy["csv"] != tuned["csv"]
    assert (
        "inertia_kgm2" in heavy["scenario"] and shipped["drive"] == heavy["drive"] != tuned["drive"]
    )
    for files in (shipped, heavy, tuned):
        here = native(files, tmp_path)
        assert (
            here["text"] == files["text"]
            and largest_difference(files["csv"], here["csv"]) < LAST_DIGITS
        )


@pytest.mark.parametrize("scenario", ["fig5_load_step", "fig8_flux_weakening", "servo_case_1_2"])
def test_ideal_signals_differ_in_the_last_digits_at_most(scenario: str, tmp_path: Path) -> None:
    (files,) = asyncio.run(visited([choose(scenario)]))
    assert largest_difference(files["csv"], native(files, tmp_path)["csv"]) < LAST_DIGITS


def test_what_cannot_be_is_one_line() -> None:
    (files,) = asyncio.run(
        visited(
            [
                move("Speed error", 0.7)
                + ";page.sliders.find((s) => s.name === 'Speed error').hi = 1e30;"
                + move("Speed error", 1.0)
            ]
        )
    )
    assert "nosc" in files["state"] and "\n" not in files["state"]
