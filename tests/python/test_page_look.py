# SPDX-License-Identifier: MIT
"""The page at a phone's width and at a desk's, light and dark. Nothing is cut off, all text can be
read, and every control has a name for a screen reader."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any, Dict, List

import pytest
from browser import Browser
from conftest import Served
from page_support import page_of
from test_page import BUSY_S, arm, mode, needs_browser, opened, picture

LOOKS = (Path(__file__).parent / "page_looks.js").read_text(encoding="utf-8").partition("\n(")[2]
HEIGHTS = {390: 844, 1280: 860}
LEAST_CONTRAST = 4.5
NAMED = {"button", "textbox", "combobox", "slider", "switch", "checkbox", "img", "progressbar"}
NAMED |= {"image", "form", "region", "heading", "DisclosureTriangle", "spinbutton"}


async def wrong(page: Browser) -> List[str]:
    """Lists what cannot be read, reached or seen."""
    found: Dict[str, Any] = await page.script("(" + LOOKS)
    lines = [f"{kind}: {one}" for kind in ("faint", "beyond", "small") for one in found[kind]]
    lines += [f"{n}: {x:.2f}" for n, x in found["drawn"].items() if x < LEAST_CONTRAST]
    if found["width"] > found["inner"]:
        lines.append(f"scrolls sideways: {found['width']} of {found['inner']} pixels")
    return lines


async def nameless(page: Browser) -> List[str]:
    """Lists what a screen reader cannot name."""
    await page.call("Accessibility.enable")
    tree = await page.call("Accessibility.getFullAXTree")
    return [
        str(node["role"]["value"])
        for node in tree["nodes"]
        if not node["ignored"]
        and node["role"]["value"] in NAMED
        and not node.get("name", {}).get("value", "").strip()
    ]


async def stop_is_on_top(page: Browser) -> bool:
    """Wherever the page is scrolled to."""
    return bool(
        await page.script(
            "(e => { const r = e.getBoundingClientRect(); return document.elementFromPoint("
            "r.left + r.width / 2, r.top + 4) === e })(document.getElementById('stop'))"
        )
    )


async def looks(address: str, width: int) -> None:
    """At rest, running under load, in a fault, with every card open, in both schemes."""
    async with opened(address, width, HEIGHTS[width]) as page:
        await mode(page, "READY")

        async def check(name: str) -> None:
            for scheme in ("light", "dark"):
                await page.scheme(scheme == "dark")
                await asyncio.sleep(0.3)
                assert await wrong(page) == [], f"{name}, {scheme}"
                await picture(page, f"look_{width}_{scheme}_{name}")

        await check("rest")
        await arm(page)
        await page.fill("#speed", "1000")
        await page.enter()
        await page.until("Math.abs(page.state.reading.speed_e_radps - 209.4) < 3", BUSY_S)
        await page.fill("#load", "0.8")
        await page.enter()
        await asyncio.sleep(1.0)
        await page.script("scrollTo(0, 0)")
        await check("run")
        await page.script("document.querySelectorAll('details').forEach(d => { d.open = true })")
        await page.until("!!document.getElementById('parameter-ACCELERATION')", BUSY_S)
        await page.click("#take")
        await page.until("!document.querySelector('#scope .capture').hidden", BUSY_S)
        await page.script("document.getElementById('break').click()")
        await mode(page, "FAULT")
        await page.until("!!document.querySelector('#events .record')", BUSY_S)
        await page.script("document.querySelectorAll('details').forEach(d => { d.open = true })")
        for name in ("messages", "scope", "history", "parameters", "commission", "image"):
            await page.script(f"document.getElementById('{name}').scrollIntoView()")
            await page.script("scrollBy(0, -130)")
            await check(name)
            assert await stop_is_on_top(page)
        assert await nameless(page) == []
        told = await page.script("document.getElementById('alarm').getAttribute('role')")
        assert told == "alert" and await page.script("document.getElementById('alarm').textContent")


@needs_browser
@pytest.mark.parametrize("width", sorted(HEIGHTS))
def test_looks(served: Served, width: int) -> None:
    with page_of(served) as (address, _page):
        asyncio.run(looks(address, width))
