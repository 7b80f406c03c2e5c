# SPDX-License-Identifier: MIT
"""The page without a server: Web Serial, with a fake port that leads to the virtual drive."""

from __future__ import annotations

import asyncio
import contextlib
import json
from pathlib import Path
from typing import Any, AsyncIterator, Awaitable, Callable

import browser
import pytest
from aiohttp import WSMsgType, web
from browser import Browser
from conftest import ROOT, Served

from sdre_drive import register_map
from sdre_drive.connection import Drive
from sdre_drive.registers import Mode
from sdre_drive.units import e_radps_of

STATIC = ROOT / "host_tools/python/sdre_drive/page/static"
FAKE = Path(__file__).with_name("fake_serial.js")
LOOKS = Path(__file__).with_name("page_looks.js")
BUSY_S = 60.0  # chosen: a browser on a busy machine
STOP_MS = 100.0  # from the key to the frame on the line
pytestmark = pytest.mark.skipif(not browser.path(), reason="there is no Chromium")


@contextlib.asynccontextmanager
async def site(served: Served) -> AsyncIterator[str]:
    """The page's files as any server has them, and a line to the drive: the address."""

    async def line(request: web.Request) -> web.WebSocketResponse:
        socket = web.WebSocketResponse()
        await socket.prepare(request)
        reader, writer = await asyncio.open_connection("127.0.0.1", served.rtu)

        async def back() -> None:
            while octets := await reader.read(256):
                await socket.send_bytes(octets)

        task = asyncio.create_task(back())
        async for message in socket:
            if message.type == WSMsgType.BINARY:
                writer.write(message.data)
        task.cancel()
        writer.close()
        return socket

    async def index(_request: web.Request) -> web.FileResponse:
        return web.FileResponse(STATIC / "index.html")

    app = web.Application()
    app.add_routes([web.get("/line", line), web.get("/", index), web.static("/", STATIC)])
    runner = web.AppRunner(app, shutdown_timeout=0.1)
    await runner.setup()
    server = web.TCPSite(runner, "127.0.0.1", 0)
    await server.start()
    try:
        yield f"http://127.0.0.1:{runner.addresses[0][1]}/?drive=serial"
    finally:
        await runner.cleanup()


@contextlib.asynccontextmanager
async def opened(served: Served, width: int = 1280) -> AsyncIterator[Browser]:
    """A window with the port connected and the drive read; no error in its end."""
    async with site(served) as address, Browser("about:blank", width, 1000) as page:
        await page.call("Page.addScriptToEvaluateOnNewDocument", source=FAKE.read_text())
        await page.call("Page.navigate", url=address)
        await page.until("window.page && document.querySelector('#connect') !== null", BUSY_S)
        await page.until(f"{text('#words')}.includes('Connect the serial port')")
        await page.click("#connect")
        await page.until("page.facts && page.state && page.state.reading", BUSY_S)
        yield page
        assert page.errors == []


def text(selector: str) -> str:
    """Script: words of an element."""
    return f"document.querySelector({json.dumps(selector)}).innerText"


async def mode(page: Browser, name: str) -> None:
    """Waits for it."""
    await page.until(f"{text('#mode')} == {json.dumps(name)}", BUSY_S)


async def running(page: Browser, rpm: int) -> None:
    """Armed, and at that speed."""
    await mode(page, "READY")
    await page.click("#arm")
    await page.until("page.armed")
    await page.fill("#speed", str(rpm))
    await page.click("#run")
    speed = "page.state.reading.speed_e_radps / page.facts.pole_pairs * 30 / Math.PI"
    await page.until(f"page.state.reading && Math.abs({speed} - {rpm}) < 15", BUSY_S)


def played(served: Served, scene: Callable[[Browser], Awaitable[Any]], width: int = 1280) -> None:
    """A scene in a window."""

    async def play() -> None:
        async with opened(served, width) as page:
            await scene(page)

    asyncio.run(play())


def test_it_runs_stops_and_another_master_sees_the_same(served: Served) -> None:
    async def scene(page: Browser) -> None:
        line = await page.script("line.opened")
        assert line == {"baudRate": 115200, "dataBits": 8, "parity": "even", "stopBits": 1}
        await mode(page, "READY")
        await page.click("#run")
        assert "Arm this window first" in await page.script(text("#said"))
        await running(page, 1000)
        with Drive(served.target()) as drive:
            there, here = drive.read(), await page.script("page.state.reading")
            assert there.mode == Mode.RUN
            assert abs(there.speed_e_radps - here["speed_e_radps"]) < 5.0
            assert abs(there.dc_link_V - here["dc_link_V"]) < 5.0
            known, facts = drive.constants(), await page.script("page.facts")
            assert known.pole_pairs == facts["pole_pairs"]
            assert known.speed_max_e_radps == pytest.approx(facts["speed_max_e_radps"])
            assert known.turn_units == facts["turn_units"]
            assert drive.identify()[0x80] == facts["name"]
            drive.write("QUICK_STOP_OPTION", 5)  # stays enabled: the page opens the bridge then
        # Quick stop or disable voltage to register 0: the frame after the key.
        stop = "line.sent.find((f) => f[0] > line.pressed && f[2] === 6 && f[4] === 0 && f[6] < 3)"
        await page.space()
        took_ms = await page.until(f"(f => f && f[0] - line.pressed)({stop})")
        assert took_ms < STOP_MS
        await mode(page, "READY")
        assert await page.script("page.state.traces.generation") == 0

    played(served, scene)


def test_scope_parameters_moves_and_faults(served: Served) -> None:
    async def scene(page: Browser) -> None:
        await running(page, 600)
        await page.click("#scope > summary")
        await page.click("#take")
        await page.until("!document.querySelector('#scope .capture').hidden", BUSY_S)
        found = await page.script("page.cards.find(c => c.capture).capture.found")
        assert len(found["values"]) == 4 and len(found["time_s"]) > 60
        speed = found["values"][0]
        mean = sum(speed) / len(speed)
        pole_pairs = await page.script("page.facts.pole_pairs")
        assert mean == pytest.approx(e_radps_of(600, pole_pairs), rel=0.05)
        dc_link_V = await page.script("page.state.reading.dc_link_V")
        assert [s["name"] for s in found["signals"]][3] == "DC_LINK"
        assert sum(found["values"][3]) / len(speed) == pytest.approx(dc_link_V, rel=0.02)
        served.bench().ask('fault kind = "encoder_losing", counts_per_s = 20000.0')
        await mode(page, "FAULT")
        await page.click("#history > summary")
        await page.until("document.querySelector('#events .record') !== null", BUSY_S)
        await page.click("#events .record")
        await page.until("!document.querySelector('#history .capture').hidden", BUSY_S)
        served.bench().ask("mend")
        await page.click("#reset")
        await mode(page, "READY")
        await page.click("#parameters > summary")
        await page.until("document.querySelector('#parameter-SPEED_WINDOW') !== null", BUSY_S)
        await page.fill("#parameter-SPEED_WINDOW", "50")
        await page.click("#parameters-write")
        await page.until(f"{text('#said')}.startsWith('1 written')", BUSY_S)
        with Drive(served.target()) as drive:
            window = drive.parameter("SPEED_WINDOW")
        assert window == pytest.approx(e_radps_of(50, pole_pairs), abs=0.06)
        await page.click("#parameters-save")
        await page.until("page.state && page.state.job && !page.state.job.running", BUSY_S)
        job = await page.script("page.state.job")
        assert job["said"].startswith("in force: as stored") and not job["error"], job

    played(served, scene)


def test_a_silent_line_and_a_lost_port_are_told(served: Served) -> None:
    async def scene(page: Browser) -> None:
        await mode(page, "READY")
        await page.script("line.deaf = true")
        await mode(page, "NO DRIVE")
        assert "no answer from the serial port" in await page.script(text("#words"))
        await page.script("line.deaf = false")
        await mode(page, "READY")
        await page.script("line.unplug()")
        await page.until(f"{text('#words')}.includes('has gone')")
        assert await page.script("document.querySelector('#connect-form').checkVisibility()")
        await page.click("#stop")
        await page.until(f"{text('#said')}.startsWith('STOP did not arrive')")
        await page.click("#connect")
        await mode(page, "READY")

    played(served, scene)


def test_a_move_arrives_and_a_hidden_window_stops(served: Served) -> None:
    async def scene(page: Browser) -> None:
        await running(page, 300)
        await page.click("#stop")
        await mode(page, "READY")
        turn = await page.script("page.facts.turn_units")
        await page.fill("#turns", "11")
        await page.click("#move")
        assert "Allow" in await page.script(text("#said"))
        await page.script("document.querySelector('#way').value = 'to'")
        await page.fill("#turns", "2.5")
        await page.click("#move")
        near = f"page.state.where && Math.abs(page.state.where.now - {2.5 * turn}) < 20"
        await page.until(near, BUSY_S)
        with Drive(served.target()) as drive:
            found = drive.values(register_map.POSITION)["POSITION_NOW"]
        assert abs(found - 2.5 * turn) < 20
        await page.script(
            "Object.defineProperty(document, 'hidden', { get: () => true });"
            " document.dispatchEvent(new Event('visibilitychange'))"
        )
        await mode(page, "READY")

    played(served, scene)


def test_no_start_follows_a_stop(served: Served) -> None:
    async def scene(page: Browser) -> None:
        await mode(page, "READY")
        await page.click("#arm")
        await page.until("page.armed")
        for wait_ms in (0, 5, 10, 20, 30, 40, 60, 80):
            await page.script(
                "(async () => { const started = page.link.do('run', {speed_e_radps: 100})"
                ".catch((e) => e.message);"
                f" await new Promise((done) => setTimeout(done, {wait_ms}));"
                " await page.link.stop(); window.told = await started; })()"
            )
            await mode(page, "READY")
            await asyncio.sleep(0.3)
            assert await page.script("page.state.reading.mode") == "READY", wait_ms

    played(served, scene)


@pytest.mark.parametrize("width", [390, 1280])
def test_nothing_is_beyond_the_window_and_what_it_lacks_is_said(served: Served, width: int) -> None:
    async def scene(page: Browser) -> None:
        assert await page.script("document.documentElement.scrollWidth") <= width
        for card in ("commission", "image"):
            await page.click(f"#{card} > summary")
            assert "Needs the program" in await page.script(text(f"#{card}"))
            assert await page.script(
                f"[...document.querySelectorAll('#{card} button')].every((b) => b.disabled)"
            )
        looks = await page.script(LOOKS.read_text())
        assert not looks["beyond"] and not looks["faint"], looks

    played(served, scene, width)
