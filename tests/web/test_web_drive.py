# SPDX-License-Identifier: MIT
"""The operator's page with the drive in it: it runs, breaks and resets, and its registers are those
of the native build."""

from __future__ import annotations

import asyncio
import contextlib
import functools
import http.server
import json
import os
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any, AsyncIterator, Dict, List

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/python"))
from browser import Browser, path  # noqa: E402

SITE = ROOT / "build/site/drive"
NATIVE = ROOT / "build/host/tests/web_drive_lines"
DRIVE = "firmware/config/drives/ipmsm_390w.toml"
LAST_DIGITS = 1e-9
BUSY_S = 60.0  # chosen: a browser on a busy machine
pytestmark = pytest.mark.skipif(
    path() is None or not (SITE / "direct/sdre_web_drive.js").exists(),
    reason="./dev web builds the page; Chromium is needed",
)


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_: Any) -> None:
        pass


@contextlib.asynccontextmanager
async def opened(address: str, width: int = 1280) -> AsyncIterator[Browser]:
    """A window of the site; no error in its end."""
    handler = functools.partial(Quiet, directory=str(SITE))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        async with Browser(f"http://127.0.0.1:{server.server_port}/{address}", width, 1000) as page:
            yield page
            assert page.errors == []
        server.shutdown()


def text(selector: str) -> str:
    """Script: words of an element."""
    return f"document.querySelector({json.dumps(selector)}).innerText"


async def mode(page: Browser, name: str) -> None:
    """Waits for it."""
    await page.until(f"window.page && {text('#mode')} == {json.dumps(name)}", BUSY_S)


def test_it_runs_under_load_breaks_and_starts_again() -> None:
    async def play() -> None:
        async with opened("?drive=simulated") as page:
            await mode(page, "READY")
            await page.click("#run")
            assert "Arm this window first" in await page.script(text("#said"))
            await page.click("#arm")
            await page.until("page.armed")
            await page.fill("#speed", "1000")
            await page.click("#run")
            await mode(page, "RUN")
            speed = "page.state.reading.speed_e_radps / page.facts.pole_pairs * 30 / Math.PI"
            await page.until(f"page.state.reading && Math.abs({speed} - 1000) < 15", BUSY_S)
            await page.fill("#load", "1")
            await page.click("#set-load")
            await page.until("page.state.bench && Math.abs(page.state.bench.torque_Nm - 1) < 0.2")
            await page.until("page.state.reading.iq_A > 1.2")
            if "SDRE_DRIVE_PICTURE" in os.environ:
                await asyncio.sleep(3)
                await page.picture(Path(os.environ["SDRE_DRIVE_PICTURE"]))
            factor = await page.script("page.state.bench.real_time_factor")
            assert factor > 0.9, f"{factor} of real time"
            await page.script("document.querySelector('#fault').value = 'motor wire a broken'")
            await page.click("#break")
            await mode(page, "FAULT")
            assert "motor wire a broken" in await page.script(text("#broken"))
            await page.click("#mend")
            await page.until(f"{text('#broken')}.includes('nothing')")
            await page.click("#reset")
            await mode(page, "READY")
            hangs = "program hangs in the control interrupt"
            await page.script(f"document.querySelector('#fault').value = '{hangs}'")
            await page.click("#break")
            await page.until("page.state.reading && page.state.reading.reset_cause === 1", BUSY_S)
            await page.click("#power-cycle")
            await page.until("page.state.reading && page.state.reading.reset_cause === 0", BUSY_S)
            await mode(page, "READY")

    asyncio.run(play())


@pytest.mark.parametrize("width", [390, 1280])
def test_another_drive_and_what_it_lacks_is_said(width: int) -> None:
    async def play() -> None:
        async with opened("?drive=simulated&name=servo_200w", width) as page:
            await mode(page, "READY")
            assert "servo_200w" in await page.script(text("#target"))
            assert await page.script("document.documentElement.scrollWidth") <= width
            for card in ("commission", "image"):
                await page.click(f"#{card} > summary")
                assert "Needs the program" in await page.script(text(f"#{card}"))

    asyncio.run(play())


def test_an_unknown_drive_is_one_line() -> None:
    async def play() -> None:
        async with opened("?drive=simulated&name=nothing") as page:
            await page.until(f"window.page && {text('#words')}.includes('nothing.toml')", BUSY_S)

    asyncio.run(play())


def frame(octets: List[int]) -> str:
    """Modbus RTU with its CRC, in hexadecimal."""
    crc = 0xFFFF
    for octet in octets:
        crc ^= octet
        for _ in range(8):
            crc = (crc >> 1) ^ 0xA001 if crc & 1 else crc >> 1
    return bytes([*octets, crc & 0xFF, crc >> 8]).hex()


def requests(drive: str) -> List[Dict[str, Any]]:
    """A start to 1000 r/min with a load, looked at again and again."""
    look = frame([1, 4, 0, 0, 0, 48])
    looks = {"run_s": 0.02, "wall_s": 0.0, "frames": [look]}
    asked: List[Dict[str, Any]] = [{"drive": drive, "seed": 3}, *[looks] * 20]
    speed, shut_down, enable = (
        [1, 16, 0, 2, 0, 2, 4, 0, 0, *divmod(2094, 256)],
        [1, 6, 0, 0, 0, 6],
        [1, 6, 0, 0, 0, 15],
    )
    asked += [{**looks, "frames": [frame(write)]} for write in (speed, shut_down, enable)]
    return [*asked, *[looks] * 100, {"control": "load 1"}, *[looks] * 30]


def test_its_registers_are_those_of_the_native_build() -> None:
    lines = [json.dumps(r) for r in requests(str(ROOT / DRIVE))]
    done = subprocess.run(
        [NATIVE], input="\n".join(lines), capture_output=True, text=True, check=True
    )
    native = [json.loads(line) for line in done.stdout.splitlines()]

    async def play() -> List[Dict[str, Any]]:
        async with opened("?drive=serial") as page:
            return await page.script(
                f"""(async () => {{
                  const compiled = await (await import("/direct/sdre_web_drive.js")).default();
                  const told = (text) =>
                    compiled.ccall("sdre_drive_answer", "string", ["string"], [text]);
                  const answer = (request) => JSON.parse(told(JSON.stringify(request)));
                  return {json.dumps(requests("/" + DRIVE))}.map(answer);
                }})()"""
            )

    here = asyncio.run(play())
    assert [a.get("frames") for a in here] == [a.get("frames") for a in native]
    for one, other in zip(here, native):
        for name, value in one.items():
            if isinstance(value, float):  # the browser's sine is another C library's
                assert value == pytest.approx(other[name], rel=LAST_DIGITS, abs=LAST_DIGITS), name
    assert sum(len(a.get("frames", [])) for a in here) == 153  # each request of a frame
