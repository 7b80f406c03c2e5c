# SPDX-License-Identifier: MIT
"""The report: nothing may be missing. `./dev report` runs this on the page that it has made."""

from __future__ import annotations

import asyncio
import math
import os
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "host_tools/report"), str(ROOT / "tests/python")]

import browser  # noqa: E402

from sdre_report import near_optimal, theorem  # noqa: E402
from sdre_report.printed import Printed  # noqa: E402
from sdre_report.settling import settle  # noqa: E402
from sdre_report.tables import Table, number  # noqa: E402
from sdre_report.tools import ReportError  # noqa: E402

PAGE = Path(os.environ.get("SDRE_REPORT", ROOT / "build/report/report.html"))
FIGURES = (
    [f"A-fig{n}" for n in range(4, 9)]
    + [f"B-fig{n}" for n in range(4, 9)]
    + ["G-shares", "C-margin1", "C-subset1"]
)
TABLES = [
    "A-table2",
    "A-table3",
    "A-table3-conventional",
    "A-fig4-numbers",
    "A-fig4-load",
    *(f"A-fig{n}-numbers" for n in range(5, 9)),
    "B-tables",
    "B-fig8-numbers",
    "A-optimal",
    "A-implemented",
    "A-effort",
    "B-lemma1",
    "B-theorem1",
    "G-mu",
    "G-attraction",
    "C-probability",
    "C-worst1",
    "C-subset1-levels",
    "C-rare1",
    "S-summary",
]


@pytest.mark.parametrize("gone", [None, math.nan])
def test_a_number_that_is_missing_is_an_error(gone: object) -> None:
    table = Table("t", "a table", ("", "paper", "here"))
    table.add("row", 1.0, 2.0)
    with pytest.raises(ReportError, match="t, other, here"):
        table.add("other", 1.0, gone)
    with pytest.raises(ReportError, match="2 columns"):
        table.add("short", 1.0)


def test_a_printed_number_that_nobody_shows_is_found() -> None:
    printed = Printed({"A": {"fig5": {"speed_ms": 36, "iq_ms": 65}}})
    assert printed["A"]["fig5"]["speed_ms"] == 36
    assert printed.unread() == ["A.fig5.iq_ms"]
    assert printed["A"]["fig5"].get("iq_ms", "-") == 65
    assert printed.unread() == []


def test_numbers_as_text() -> None:
    assert [number(x) for x in (0.0, 123.456, -0.0123, 7021, 1e-9, "never")] == [
        "0",
        "123",
        "-0.0123",
        "7021",
        "1.00e-09",
        "never",
    ]


@pytest.mark.parametrize("noise", [0.0, 0.02])
def test_settling_of_a_first_order_lag(noise: float) -> None:
    time = np.arange(0.0, 0.8, 1e-4)
    signal = np.where(time < 0.4, 1.0, 3.0 - 2.0 * np.exp(-(time - 0.4) / 0.01)) + noise * np.cos(
        3e4 * np.pi * time
    )
    found = settle({"time_s": time, "x": signal}, "x", 0.2, 0.4, 0.8)
    assert (
        found.moves
        and found.before == pytest.approx(1.0, abs=1e-3)
        and found.after == pytest.approx(3.0, abs=1e-3)
    )
    assert found.time_ms == pytest.approx(10.0 * math.log(20.0), abs=0.5)  # e^-t = 5 %


def test_settling_of_what_does_not() -> None:
    time = np.arange(0.0, 0.8, 1e-4)
    assert not settle({"time_s": time, "x": np.cos(1e4 * time)}, "x", 0.2, 0.4, 0.8).moves
    late = np.where(time < 0.4, 0.0, np.where(time < 0.7999, 1.0, 9.0))  # leaves in its last row
    assert settle({"time_s": time, "x": late}, "x", 0.2, 0.4, 0.8).time_ms is None


def test_the_lemma_of_paper_b() -> None:
    """Two states by hand: P = [3/2 1/2; 1/2 1/2]."""
    assert theorem.lemma(2) == pytest.approx((1 - math.sqrt(0.5), 1 + math.sqrt(0.5)))


def test_the_optimum_of_a_linear_problem_is_the_riccati_solution() -> None:
    drive = {"nosc": {"Q": [2.0, 8.0, 8.0], "T": [1e-3, 1e-3]}}
    reduced = {
        f"l{i}": v
        for i, v in enumerate(
            (2757.0, 0.24, 4762.0, 21.8, 1.69, 8.78, 33.1, 13.3, 1.52, 0.66, 0.0), 1
        )
    }
    problem = near_optimal.Problem({"reduced_parameters": reduced}, drive)
    start = np.array([-4.0, 1.0, 2.0])
    best = 0.5 * start @ problem.series(0)[0] @ start
    exact = problem.exact()
    assert near_optimal.optimum(problem, exact, tuple(start)) == pytest.approx(best, rel=1e-6)
    assert near_optimal.cost(problem, exact, tuple(start)) == pytest.approx(best, rel=1e-6)


async def look(pictures: str) -> None:
    """Findings of a reader's browser."""
    async with browser.Browser(PAGE.resolve().as_uri()) as page:
        await page.until(
            "document.readyState === 'complete' && document.querySelector('footer') !== null"
        )
        seen = await page.script(
            "Object.fromEntries([...document.querySelectorAll('figure')].map(f => "
            "[f.id, [f.querySelector('svg').getBoundingClientRect().height, "
            "f.querySelectorAll('path').length]]))"
        )
        for name in FIGURES:
            assert name in seen, f"{name} is not in the page"
        for name, (height, lines) in seen.items():
            assert height > 100 and lines > 20, f"{name} is empty"
        tables = await page.script(
            "Object.fromEntries([...document.querySelectorAll('.table')].map(t => "
            "[t.id, [...t.querySelectorAll('td')].map(c => c.innerText.trim())]))"
        )
        for name in TABLES:
            assert name in tables, f"{name} is not in the page"
        for name, cells in tables.items():
            assert cells and all(c and c.lower() not in ("nan", "none", "null") for c in cells), (
                f"{name} has an empty cell"
            )
        assert await page.script(
            "[...document.querySelectorAll('a[href^=\"#\"]')].every(a => "
            "document.getElementById(a.hash.slice(1)))"
        )
        assert (
            await page.script("document.querySelectorAll('link[href^=http], script, img').length")
            == 0
        ), "not self-contained"
        if pictures:
            await page.picture(Path(pictures) / "report.png")
        assert page.errors == []


@pytest.mark.skipif(not browser.path(), reason="there is no Chromium")
@pytest.mark.skipif(not PAGE.exists(), reason="there is no page: ./dev report")
def test_the_page_in_a_browser() -> None:
    asyncio.run(look(os.environ.get("SDRE_PICTURES", "")))
