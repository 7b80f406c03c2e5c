# SPDX-License-Identifier: MIT
"""The page as a tool: moves, commissioning, images, the history with its records, files."""

from __future__ import annotations

import asyncio
import base64
import csv
import io
import os
import subprocess
from pathlib import Path
from typing import Any, Dict, Iterator, List

import pytest
from conftest import ROOT, SHIPPED, Served
from page_support import Viewer, page_of
from test_page import BUSY_S, arm, mode, needs_browser, opened, text

from sdre_drive.page.choices import CHOICES
from sdre_drive.params import NAMES

COUNTS = 10000  # of a turn of the shipped drive
COMMISSION_S = 110.0  # simulated: 30 s


@pytest.fixture
def address(served: Served) -> Iterator[str]:
    """Address of a page for the virtual drive, with its token."""
    with page_of(served) as (where, _page):
        yield where


@pytest.fixture
def viewer(address: str) -> Iterator[Viewer]:
    """Armed, with a drive that is ready."""
    with Viewer(address) as one:
        one.do("arm")
        one.until_mode("READY")
        yield one


def test_moves_and_holds(viewer: Viewer) -> None:
    viewer.do("move", turns=2.5, relative=True, speed_e_radps=60.0)
    fastest = lambda: max(abs(row[1]) for row in viewer.rows["drive"])  # noqa: E731
    near = lambda s: abs(s["where"]["now"] - s["where"]["target"]) < 10  # noqa: E731
    viewer.until(lambda s: fastest() > 40.0)
    state = viewer.until(near)
    assert abs(state["where"]["target"]) < 4 * COUNTS  # the alignment turns a little too
    assert fastest() < 75.0
    assert viewer.state["reading"]["mode"] == "RUN"
    viewer.do("move", turns=0.0, relative=False, speed_e_radps=60.0)  # while it holds
    viewer.until(lambda s: s["where"]["target"] == 0 and near(s))
    assert "another mode of operation" in viewer.refuse("run", speed_e_radps=100.0)
    assert "allow more than ten" in viewer.refuse(
        "move", turns=11.0, relative=True, speed_e_radps=9.0
    )
    viewer.do("stop")
    viewer.until_mode("READY", 10.0)


def test_commissioning_ends_with_a_stop(viewer: Viewer) -> None:
    assert "at most 4 A" in viewer.refuse("commission", current_A=9.0, speed_m_radps=100.0)
    viewer.do("commission", current_A=3.0, speed_m_radps=125.0)
    viewer.until_mode("COMMISSION")
    assert "commissioning runs" in viewer.refuse("run", speed_e_radps=100.0)
    viewer.do("stop")
    viewer.until(lambda s: s["reading"]["mode"] in ("READY", "FAULT"))
    job = viewer.until(lambda s: not s["job"]["running"])["job"]
    assert job["error"] and not job["file_name"]


def test_commissioning_makes_a_file_for_everybody(viewer: Viewer, address: str) -> None:
    viewer.do("commission", current_A=3.0, speed_m_radps=125.0)
    shares: List[float] = []
    with Viewer(address) as other:

        def over(state: Dict[str, Any]) -> bool:
            shares.append(state["job"]["share"])
            return not state["job"]["running"]

        job = other.until(over, COMMISSION_S)["job"]
        assert job["error"] == "" and job["file_name"] == "found.toml"
        assert shares == sorted(shares) and len(set(shares)) > 5
        found = other.get("result")["text"]
    assert "pole_pairs = 2" in found and "pm_flux_Wb" in found


def test_an_image_is_loaded_or_refused_by_its_name(viewer: Viewer, tmp_path: Path) -> None:
    gains = Path(os.environ.get("SDRE_SIL", ROOT / "build/host/bin/sdre-sil")).with_name(
        "sdre-gains"
    )
    image = tmp_path / "motor.image"
    subprocess.run([gains, "image", SHIPPED, "--out", image], check=True, capture_output=True)
    octets = image.read_bytes()
    as_text = lambda b: base64.b64encode(b).decode()  # noqa: E731
    viewer.do("image", name="../x/bad.image", octets=as_text(octets[:100]))
    job = viewer.until(lambda s: s["job"] and not s["job"]["running"])["job"]
    assert job["error"].startswith("bad.image: 100 octets are no image")
    viewer.do("image", name="motor.image", octets=as_text(octets))
    job = viewer.until(lambda s: s["job"]["number"] == 2 and not s["job"]["running"], 90.0)["job"]
    assert "in force: image 1: ipmsm_390w" in job["said"], job
    assert "not arrived whole" in viewer.refuse("image", name="x", octets="%")


def test_the_history_has_faults_with_their_records_and_restarts(viewer: Viewer) -> None:
    viewer.do("run", speed_e_radps=300.0)
    viewer.until(lambda s: abs(s["reading"]["speed_e_radps"] - 300.0) < 5.0)
    viewer.do("break", fault="index wire off")
    viewer.until_mode("FAULT")
    viewer.until(lambda s: s["history"] >= 2)
    event = viewer.get("history")[0]
    assert event["kind"] == "fault" and "INDEX" in event["what"] and event["entries"][0]["causes"]
    record = viewer.get(f"record/{event['number']}")
    assert len(record["time_s"]) == 64 and record["time_s"][-1] == 0.0
    assert len(record["values"]) == len(record["signals"]) == 7
    viewer.do("power_cycle")
    viewer.until(lambda s: s["reading"] and s["reading"]["mode"] == "READY")
    newest = viewer.get("history")[0]
    assert newest["kind"] == "restart" and "power on" in newest["what"]
    assert viewer.get("record/999999") is None


def test_a_restart_by_the_watchdog_is_said(viewer: Viewer) -> None:
    viewer.do("run", speed_e_radps=300.0)
    viewer.until(lambda s: abs(s["reading"]["speed_e_radps"] - 300.0) < 5.0)
    assert viewer.state["reading"]["reset_cause"] == 0
    assert "watchdog" in viewer.do("break", fault="program hangs in the control interrupt")
    viewer.until(lambda s: s["reading"] and s["reading"]["reset_cause"] == 1)
    viewer.until(lambda s: s["history"] >= 1)
    newest = viewer.get("history")[0]
    assert newest["kind"] == "restart" and "watchdog" in newest["what"]


def test_choices_are_within_the_ranges_and_in_the_words_of_the_register() -> None:
    for name, choices in CHOICES.items():
        p = NAMES[name]
        assert all(p.low <= number <= p.high for number, _ in choices)
        assert any(number == p.default for number, _ in choices)
    left = [n for n, p in NAMES.items() if p.high <= 8 and p.register.step == 0.0]
    assert set(left) <= set(CHOICES), "an enumeration without words"


async def files(address: str) -> None:
    """Pause holds the traces; the files have what is seen."""
    async with opened(address) as page:
        await mode(page, "READY")
        await arm(page)
        await page.fill("#speed", "500")
        await page.enter()
        await page.until("Math.abs(page.state.reading.speed_e_radps - 104.7) < 2", BUSY_S)
        await page.click("#pause")
        drawn = "document.querySelector('#traces canvas').toDataURL()"
        await asyncio.sleep(0.5)
        was = await page.script(drawn)
        await asyncio.sleep(1.5)
        assert await page.script(drawn) == was, "a pause that moves"
        traces = "page.cards.find(c => c.drive)"
        table = list(csv.DictReader(io.StringIO(await page.script(f"{traces}.file()"))))
        speeds = [float(r["drive_speed_rpm"]) for r in table if r["drive_speed_rpm"]]
        true = [float(r["motor_speed_rpm"]) for r in table if r["motor_speed_rpm"]]
        times = [float(r["time_s"]) for r in table]
        assert abs(speeds[-1] - 500.0) < 10.0 and abs(true[-1] - 500.0) < 10.0
        assert times == sorted(times) and times[-1] - times[0] <= 10.0
        picture = f"new Promise(done => {traces}.stack.picture(b => done(b.size)))"
        assert await page.script(picture) > 5000
        await page.click("#pause")
        await page.until(f"{drawn} != {was!r}")
        await page.click("#traces-csv")
        await page.click("#commission > summary")
        assert "up to 4.00 A" in await page.script(text("#commission"))


@needs_browser
def test_pause_and_files(address: str) -> None:
    asyncio.run(files(address))
