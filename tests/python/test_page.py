# SPDX-License-Identifier: MIT
"""A user of the page in a headless Chromium: hands, keyboard, two windows."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import signal
from pathlib import Path
from typing import AsyncIterator, Iterator

import browser
import pytest
from browser import Browser
from conftest import Served
from page_support import Viewer, page_of

PICTURES = os.environ.get("SDRE_PICTURES", "")
BUSY_S = 60.0  # chosen: a browser on a busy machine
needs_browser = pytest.mark.skipif(not browser.path(), reason="there is no Chromium")


@pytest.fixture
def address(served: Served) -> Iterator[str]:
    """Address of a page for the virtual drive, with its token."""
    with page_of(served) as (where, _page):
        yield where


def text(selector: str) -> str:
    """Script: words of an element."""
    return f"document.querySelector({json.dumps(selector)}).innerText"


def value(selector: str) -> str:
    """Script: what a field has."""
    return f"document.querySelector({json.dumps(selector)}).value"


@contextlib.asynccontextmanager
async def opened(address: str, width: int = 1280, height: int = 1000) -> AsyncIterator[Browser]:
    """A window that shows a drive that is ready; no error in its end."""
    async with Browser(address, width, height) as page:
        await page.until("window.page && page.facts && page.state && page.state.reading", BUSY_S)
        yield page
        assert page.errors == []


async def mode(page: Browser, name: str, longest_s: float = BUSY_S) -> None:
    """Waits for it."""
    await page.until(f"{text('#mode')} == {json.dumps(name)}", longest_s)


async def arm(page: Browser) -> None:
    """As a hand does."""
    await page.click("#arm")
    await page.until("page.armed")


async def picture(page: Browser, name: str) -> None:
    """For who asked for pictures."""
    if PICTURES:
        await page.picture(Path(PICTURES) / f"{name}.png")


def test_a_signal_ends_it_with_a_viewer_that_hangs_and_a_drive_that_is_silent(
    served: Served,
) -> None:
    with page_of(served) as (where, page), Viewer(where):
        served.process.send_signal(signal.SIGSTOP)
        try:
            page.terminate()
            page.wait(10)  # 5 s are allowed; the rest is for a busy machine
        finally:
            served.process.send_signal(signal.SIGCONT)


async def run_and_stop(address: str) -> None:
    """Hands on speed, load, scope, a fault, its reset."""
    async with opened(address) as page:
        await mode(page, "READY")
        await page.click("#run")
        assert "Arm this window first" in await page.script(text("#said"))
        await arm(page)
        await page.fill("#speed", "1000")
        await page.click("#run")
        await page.until("Math.abs(page.state.reading.speed_e_radps - 209.4) < 2", BUSY_S)
        assert await page.script(value("#speed")) == "1000"
        await page.fill("#load", "0.8")
        await page.enter()
        await page.until("Math.abs(page.state.bench.load_Nm - 0.8) < 1e-6")
        before = await page.script("document.querySelector('#traces canvas').toDataURL()")
        if PICTURES:
            await page.resize(1280, 1100)
            await page.script("scrollTo(0, 0)")
            await asyncio.sleep(2.0)
            await picture(page, "page")  # docs/page.png
            await page.resize(1280, 1000)
        await page.click("#scope > summary")
        await page.click("#take")
        await page.until("!document.querySelector('#scope .capture').hidden", BUSY_S)
        assert await page.script("page.cards.find(c => c.capture).capture.found.time_s.length") > 60
        assert before != await page.script("document.querySelector('#traces canvas').toDataURL()")
        await picture(page, "page_scope")
        places = "['control', 'break', 'traces', 'stop'].map(id => { const r = document" + (
            ".getElementById(id).getBoundingClientRect(); return [r.left, r.top, r.width] })"
        )
        await page.script("scrollTo(0, 0)")
        was = await page.script(places)
        await page.script("document.getElementById('break').click()")
        await mode(page, "FAULT")
        await page.until("!!document.querySelector('#entries .entry ul')")
        assert await page.script(places) == was, "a fault moves what is under the mouse"
        assert await page.script(text("#alarm"))
        await picture(page, "page_fault")
        await page.click("#mend")
        await page.until("page.state.bench.load_Nm === 0")
        await page.click("#reset")
        await mode(page, "READY")
        await page.click("#history > summary")
        await page.until("!!document.querySelector('#events .record')", BUSY_S)
        await page.click("#events .record")
        await page.until("!document.querySelector('#history .capture').hidden")
        assert "drive" in await page.script(text("#events li"))


async def keyboard_only(address: str) -> None:
    """The space bar stops and never types or presses; Enter does what a form is for."""
    async with opened(address) as page:
        await mode(page, "READY")
        await page.script("document.getElementById('arm').focus()")
        await page.space()
        await asyncio.sleep(0.5)
        assert not await page.script("page.armed"), "the space bar pressed a button"
        await page.enter()
        await page.until("page.armed")
        for where in ("#speed", "#fault", "#arm", "#length", "body"):
            await page.fill("#speed", "800")
            await page.enter()
            await mode(page, "RUN")
            await page.script(f"document.querySelector({json.dumps(where)}).focus()")
            await page.space()
            await mode(page, "READY", 10.0)
            assert await page.script(value("#speed")) == "800"
            assert await page.script("page.armed")
        await page.fill("#speed", "0,5")
        await page.enter()
        assert "0.5, with a point" in await page.script(text("#said"))
        await page.fill("#speed", "99999")
        await page.enter()
        assert "is not within" in await page.script(text("#said"))
        await page.script("document.querySelector('#traces canvas').focus()")
        for _ in range(3):
            await page.press("ArrowLeft")
        assert " s: speed" in await page.script(text("#traces .values"))


async def two_windows(address: str) -> None:
    """One is armed at a time, both see, both stop; nothing is stale."""
    async with opened(address) as one, opened(address) as other:
        await mode(one, "READY")
        await arm(one)
        await one.fill("#speed", "700")
        await one.enter()
        await one.until("Math.abs(page.state.reading.speed_e_radps - 146.6) < 5", BUSY_S)
        await one.fill("#load", "0.3")
        await one.enter()
        await other.until(f"{value('#speed')} == '700' && {value('#load')} == '0.30'", BUSY_S)
        assert "other" == await other.script("page.state.armed")
        assert await other.script(
            "[...document.querySelectorAll('[data-writes]')].every(b => "
            "b.getAttribute('aria-disabled') == 'true')"
        )
        await other.click("#stop")
        await mode(one, "READY", 10.0)
        await other.click("#arm")  # takes over
        await one.until("page.state.armed == 'other'")
        await other.click("#mend")
        await one.until(f"{value('#load')} == '0.00'")


async def units(address: str) -> None:
    """Chosen once, for fields, figures, ramps and files."""
    async with opened(address) as page:
        await mode(page, "READY")
        await page.script(
            "(e => { e.value = 'radps'; e.dispatchEvent(new Event('change')) })"
            "(document.getElementById('unit'))"
        )
        assert await page.script(text("#run-form label")) == "Speed [rad/s]"
        assert "rad/s" in await page.script(text("#figures"))
        await page.click("#parameters > summary")
        await page.until("!!document.getElementById('parameter-ACCELERATION')", BUSY_S)
        await arm(page)
        await page.fill("#parameter-ACCELERATION", "500")  # rad/s2 of the shaft; two pole pairs
        await page.enter()
        await page.until("!!document.querySelector('#parameters tr.changed')", BUSY_S)
        rows = "page.cards.flatMap(c => c.rows || []).find(r => r.name == 'ACCELERATION').value"
        assert await page.script(rows) == 1000
        await page.script(
            "(e => { e.value = 'rpm'; e.dispatchEvent(new Event('change')) })"
            "(document.getElementById('unit'))"
        )
        assert abs(float(await page.script(value("#parameter-ACCELERATION"))) - 4774.65) < 0.1
        assert "r/min/s" in await page.script(text("#parameters table"))
        await picture(page, "page_params")
        await page.click("#parameters-save")
        await page.until(f"{text('#parameters-state')}.includes('as stored, writing 1')", BUSY_S)
        await page.click("#parameters-defaults")
        await page.until(f"{text('#parameters-state')}.includes('nothing is stored')", BUSY_S)


@needs_browser
def test_runs_loads_breaks_and_mends(address: str) -> None:
    asyncio.run(run_and_stop(address))


@needs_browser
def test_the_keyboard_alone(address: str) -> None:
    asyncio.run(keyboard_only(address))


@needs_browser
def test_two_windows(address: str) -> None:
    asyncio.run(two_windows(address))


@needs_browser
def test_units_and_parameters(address: str) -> None:
    asyncio.run(units(address))
