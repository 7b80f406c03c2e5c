# SPDX-License-Identifier: MIT
"""The page in a headless browser, and who may see it."""

from __future__ import annotations

import asyncio
import contextlib
import http.client
import json
import os
import signal
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.parse
import urllib.request
from pathlib import Path
from typing import Dict, Iterator, Tuple

import browser
import pytest
from browser import Browser
from conftest import Served

pytest.importorskip("nicegui")

CLICK = (
    "(words => { [...document.querySelectorAll('button')].find(b => "
    "b.innerText.trim().toLowerCase() == words).click(); return true })"
)
TEXT = "document.body.innerText"
# Everything that the plots hold: what moves changes it.
# Pixels of the second line's green, which nothing else on its chart has.
SCOPE_DRAWN = """(() => { const c = document.querySelectorAll('canvas')[1];
  const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
  let n = 0;
  for (let k = 0; k < d.length; k += 4) if (d[k + 1] > d[k] + 30 && d[k + 1] > d[k + 2] + 30) n++;
  return n })()"""
DRAWN = "(() => document.querySelector('canvas').toDataURL())()"


POLL = "/_nicegui_ws/socket.io/?EIO=4&transport=polling"  # what a page without WebSocket asks for


@contextlib.contextmanager
def page_of(served: Served) -> Iterator[Tuple[str, subprocess.Popen]]:
    """A page for the virtual drive: its address with its token, and its process."""
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        port = s.getsockname()[1]
    # NiceGUI takes a run below pytest for a test of its own kind.
    surroundings = {k: v for k, v in os.environ.items() if not k.startswith("PYTEST")}
    page = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "sdre_drive",
            "ui",
            "--no-browser",
            "--page-port",
            str(port),
            *served.options(),
            "--control",
            f"127.0.0.1:{served.control}",
        ],
        stdout=subprocess.PIPE,
        text=True,
        env=surroundings,
    )
    assert page.stdout
    try:
        where = page.stdout.readline().strip()
        for _ in range(100):  # it is said a little before the page listens
            with socket.socket() as s:
                if s.connect_ex(("127.0.0.1", port)) == 0:
                    break
            time.sleep(0.1)
        yield where, page
    finally:
        page.terminate()
        page.wait(20)


@pytest.fixture
def address(served: Served) -> Iterator[str]:
    """Address of a page for the virtual drive, with its token."""
    with page_of(served) as (where, _page):
        yield where


def answer(address: str, headers: Dict[str, str]) -> int:
    """HTTP status."""
    try:
        with urllib.request.urlopen(
            urllib.request.Request(address, headers=headers), timeout=20
        ) as got:
            return int(got.status)
    except urllib.error.HTTPError as e:
        return e.code


def test_only_who_has_the_token_from_this_page(address: str) -> None:
    plain = address.split("?")[0]
    assert answer(address, {}) == 200
    assert answer(plain, {}) == 403
    assert answer(plain + "?token=x", {}) == 403
    assert answer(address, {"Origin": "http://example.org"}) == 403
    assert answer(address, {"Host": "example.org"}) == 403
    assert answer(plain + "_nicegui_ws/socket.io/?EIO=4&transport=polling", {}) == 403


def test_a_signal_ends_it_with_a_client_that_hangs_and_a_drive_that_is_silent(
    served: Served,
) -> None:
    with page_of(served) as (where, page):
        at = urllib.parse.urlsplit(where)
        client = http.client.HTTPConnection("127.0.0.1", at.port)
        client.request("GET", f"{at.path}?{at.query}")
        first = client.getresponse()
        first.read()
        cookie = {"Cookie": first.getheader("Set-Cookie", "").split(";")[0]}
        client.request("GET", POLL, headers=cookie)
        opened = client.getresponse().read().decode()
        session_id = json.loads(opened[1:])["sid"]
        client.request("POST", f"{POLL}&sid={session_id}", "40", headers=cookie)
        client.getresponse().read()
        client.request("GET", f"{POLL}&sid={session_id}", headers=cookie)
        client.getresponse().read()
        client.request("GET", f"{POLL}&sid={session_id}", headers=cookie)  # waits for an event
        served.process.send_signal(signal.SIGSTOP)
        try:
            page.terminate()
            page.wait(10)  # 5 s are allowed; the rest is for a busy machine
        finally:
            served.process.send_signal(signal.SIGCONT)
            client.close()


async def use(address: str, pictures: str) -> None:
    """Actions of a user."""
    async with Browser(address) as page:
        await page.until("document.querySelector('canvas') !== null", 60.0)
        await page.until(f"{TEXT}.includes('READY') && {TEXT}.includes('Bench')")
        await page.script(f"{CLICK}('run')")  # not armed: nothing
        await asyncio.sleep(1.0)
        assert "READY" in await page.script(TEXT)
        await page.script("document.querySelector('.q-toggle').click()")
        await page.until("[...document.querySelectorAll('button')].every(b => !b.disabled)")
        await page.script(f"{CLICK}('run')")
        await page.until(f"/99[0-9] r.min|100[0-9] r.min/.test({TEXT})", 60.0)
        before = await page.script(DRAWN)
        at = await page.script(
            "(r => [r.left + 0.7 * r.width, r.top + 0.5 * r.height])"
            "(document.querySelector('.q-slider__track-container').getBoundingClientRect())"
        )
        for kind in ("mousePressed", "mouseReleased"):
            await page.call(
                "Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button="left", clickCount=1
            )
        await page.until(f"{TEXT}.includes('load 0.8')")
        await asyncio.sleep(3.0)
        assert await page.script(DRAWN) != before
        await page.script("document.querySelector('.q-expansion-item .q-item').click()")
        await page.until(f"{TEXT}.includes('samples before')")
        await asyncio.sleep(0.5)
        await page.script(f"{CLICK}('take')")
        await page.until(f"/\\bdone\\b/.test({TEXT})", 60.0)
        await page.until(
            f"document.querySelectorAll('canvas').length == 2 && {SCOPE_DRAWN} > 300", 20.0
        )
        if pictures:
            await page.resize(1280, 1570)  # traces and scope
            await asyncio.sleep(0.5)
            await page.picture(Path(pictures) / "page.png")
            await page.resize(1280, 860)
        await page.script(f"{CLICK}('break it')")
        await page.until(f"{TEXT}.includes('FAULT') && {TEXT}.includes('Check:')")
        if pictures:
            await page.picture(Path(pictures) / "page_fault.png")
        assert page.errors == []


FIELD = """(name => [...document.querySelectorAll('.q-expansion-item')]
  .find(e => e.innerText.includes('Parameters'))
  .querySelectorAll('input')[name])"""


async def use_parameters(address: str, pictures: str) -> None:
    """Actions of a user; the window is the ninth of them, 5 rad/s by default."""
    async with Browser(address, 1280, 1100) as page:
        await page.until(
            f"document.querySelector('canvas') !== null && {TEXT}.includes('READY')", 60.0
        )
        await page.script(
            "[...document.querySelectorAll('.q-expansion-item .q-item')].at(-1).click()"
        )
        await page.until(f"{TEXT}.includes('SPEED_WINDOW') && {TEXT}.includes('nothing is stored')")
        await page.until(f"Number({FIELD}(8).value) == 5")
        await page.script(f"{CLICK}('save')")  # not armed: nothing
        await page.script("document.querySelector('.q-toggle').click()")
        await page.until("[...document.querySelectorAll('button')].every(b => !b.disabled)")
        await page.script(f"(f => {{ f.focus(); f.select(); return true }})({FIELD}(8))")
        await page.call("Input.insertText", text="6.5")
        await page.script(f"{FIELD}(8).blur() || true")
        await asyncio.sleep(0.5)
        await page.script(f"{CLICK}('write')")
        await page.until(
            "document.querySelector('.bg-amber-2') !== null"
        )  # read back: not the default
        if pictures:
            await page.script("window.scrollTo(0, 1e6) || true")
            await page.picture(Path(pictures) / "page_params.png")
        await page.script(f"{CLICK}('save')")
        await page.until(f"{TEXT}.includes('as stored, writing 1')", 60.0)
        assert await page.script(f"{FIELD}(8).value") == "6.5"
        await page.script(f"{CLICK}('defaults')")
        await page.until(
            f"{TEXT}.includes('nothing is stored') && Number({FIELD}(8).value) == 5", 60.0
        )
        assert page.errors == []


@pytest.mark.skipif(not browser.path(), reason="there is no Chromium")
def test_the_parameters_on_the_page(address: str) -> None:
    asyncio.run(use_parameters(address, os.environ.get("SDRE_PICTURES", "")))


@pytest.mark.skipif(not browser.path(), reason="there is no Chromium")
def test_a_user_of_the_page(address: str) -> None:
    asyncio.run(use(address, os.environ.get("SDRE_PICTURES", "")))
