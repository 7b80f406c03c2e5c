# SPDX-License-Identifier: MIT
"""A headless Chromium by its DevTools protocol: opens a page, runs script in it, keeps errors,
takes pictures."""

from __future__ import annotations

import asyncio
import base64
import json
import re
import shutil
import tempfile
from pathlib import Path
from typing import Any, Dict, List, Optional

import aiohttp

NAMES = ("chromium", "chromium-browser", "google-chrome")
START_S, ANSWER_S = 60.0, 30.0
KEYS = {"Enter": 13, " ": 32, "Escape": 27, "Tab": 9, "ArrowLeft": 37, "ArrowRight": 39}


def path() -> Optional[str]:
    """The browser of this machine, if there is one."""
    return next(filter(None, map(shutil.which, NAMES)), None)


class Browser:
    """One page; an async context."""

    def __init__(self, address: str, width: int = 1280, height: int = 860) -> None:
        self.address, self.size = address, (width, height)
        self.errors: List[str] = []
        self._count = 0
        self._waiting: Dict[int, asyncio.Future] = {}

    async def __aenter__(self) -> Browser:
        self._profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self._process = await asyncio.create_subprocess_exec(
            path(),
            "--headless=new",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-dev-shm-usage",
            "--no-first-run",
            "--hide-scrollbars",
            f"--window-size={self.size[0]},{self.size[1]}",
            "--remote-debugging-port=0",
            f"--user-data-dir={self._profile.name}",
            "about:blank",
            stderr=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.DEVNULL,
        )
        port = await asyncio.wait_for(self._port(), START_S)
        self._drain = asyncio.create_task(self._process.stderr.read())
        self._session = aiohttp.ClientSession()
        async with self._session.get(f"http://127.0.0.1:{port}/json/list") as answer:
            pages = [p for p in await answer.json() if p["type"] == "page"]
        self._socket = await self._session.ws_connect(
            pages[0]["webSocketDebuggerUrl"], max_msg_size=0
        )
        self._reader = asyncio.create_task(self._read())
        for domain in ("Page", "Runtime", "Log"):
            await self.call(f"{domain}.enable")
        await self.resize(*self.size)
        await self.call("Page.navigate", url=self.address)
        return self

    async def __aexit__(self, *_: object) -> None:
        self._reader.cancel()
        await self._session.close()
        self._process.kill()
        await self._process.wait()
        self._drain.cancel()
        self._profile.cleanup()

    async def _port(self) -> int:
        while True:
            line = (await self._process.stderr.readline()).decode()
            found = re.search(r"DevTools listening on ws://[^:]+:(\d+)/", line)
            if found:
                return int(found.group(1))
            assert line, "the browser ended"

    async def _read(self) -> None:
        async for message in self._socket:
            told = json.loads(message.data)
            method, params = told.get("method"), told.get("params", {})
            if "id" in told:
                self._waiting.pop(told["id"]).set_result(told)
            elif method == "Runtime.exceptionThrown":
                self.errors.append(str(params["exceptionDetails"]))
            elif method == "Runtime.consoleAPICalled" and params["type"] == "error":
                self.errors.append(str(params["args"]))
            elif method == "Log.entryAdded" and params["entry"]["level"] == "error":
                self.errors.append(str(params["entry"]))

    async def call(self, method: str, **params: Any) -> Dict[str, Any]:
        """One command of the protocol."""
        self._count += 1
        waiting = self._waiting[self._count] = asyncio.get_running_loop().create_future()
        await self._socket.send_json({"id": self._count, "method": method, "params": params})
        told = await asyncio.wait_for(waiting, ANSWER_S)
        assert "error" not in told, told
        return told["result"]

    async def script(self, text: str) -> Any:
        """The value of an expression in the page."""
        told = await self.call(
            "Runtime.evaluate", expression=text, returnByValue=True, awaitPromise=True
        )
        assert "exceptionDetails" not in told, told["exceptionDetails"]
        return told["result"].get("value")

    async def until(self, text: str, longest_s: float = 20.0) -> Any:
        """Waits until an expression is true."""
        for _ in range(int(longest_s / 0.1)):
            value = await self.script(text)
            if value:
                return value
            await asyncio.sleep(0.1)
        raise AssertionError(
            f"never true: {text}; the page: {await self.script('document.body.innerText')}"
        )

    async def resize(self, width: int, height: int) -> None:
        """The window, for what follows."""
        await self.call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )

    async def scheme(self, dark: bool) -> None:
        """The colour scheme of the system from now on."""
        feature = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        await self.call("Emulation.setEmulatedMedia", features=[feature])

    async def click(self, selector: str) -> None:
        """As a hand does: at the middle of what is seen, and on whatever lies on top there."""
        at = await self.script(
            f"(e => {{ e.scrollIntoView({{block: 'center'}}); const r = e.getBoundingClientRect();"
            f" return [r.left + r.width / 2, r.top + r.height / 2] }})"
            f"(document.querySelector({json.dumps(selector)}))"
        )
        for kind in ("mousePressed", "mouseReleased"):
            await self.call(
                "Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button="left", clickCount=1
            )

    async def press(self, key: str, code: str = "", text: str = "") -> None:
        """One key, down and up, where the focus is."""
        keys = {"key": key, "code": code or key, "windowsVirtualKeyCode": KEYS.get(key, 0)}
        await self.call("Input.dispatchKeyEvent", type="keyDown", text=text, **keys)
        await self.call("Input.dispatchKeyEvent", type="keyUp", **keys)

    async def enter(self) -> None:
        """The Enter key."""
        await self.press("Enter", text="\r")

    async def space(self) -> None:
        """The space bar."""
        await self.press(" ", "Space", " ")

    async def fill(self, selector: str, text: str) -> None:
        """Types into a field, in place of what it had."""
        await self.script(
            f"(e => {{ e.focus(); e.select(); }})(document.querySelector({json.dumps(selector)}))"
        )
        await self.call("Input.insertText", text=text)

    async def picture(self, file: Path) -> None:
        """Picture of the window."""
        told = await self.call("Page.captureScreenshot", format="png")
        file.write_bytes(base64.b64decode(told["data"]))
