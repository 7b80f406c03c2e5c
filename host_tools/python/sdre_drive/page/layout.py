# SPDX-License-Identifier: MIT
"""Layout of the page."""

from __future__ import annotations

import time
from typing import Any, Callable, List

from nicegui import run, ui

from sdre_drive import faults
from sdre_drive.bench import FAULTS
from sdre_drive.connection import DriveError
from sdre_drive.faults import Entry
from sdre_drive.page.params_card import ParamsCard
from sdre_drive.page.scope_card import ScopeCard
from sdre_drive.page.state import Watcher
from sdre_drive.page.traces import Traces
from sdre_drive.registers import Mode
from sdre_drive.show import e_radps_of, speed_words

REFRESH_S = 0.1
CARD = "w-full p-3 gap-2"


class Page:
    """One browser tab."""

    def __init__(self, watcher: Watcher) -> None:
        self.watcher, self.pole_pairs = watcher, watcher.pole_pairs
        self.client = ui.context.client
        self.shown: List[Entry] = []
        ui.colors(primary="#1565c0")
        with ui.row().classes("w-full items-center gap-4"):
            ui.label("sdre-drive").classes("text-xl font-bold")
            ui.label(watcher.drive.target.words).classes("text-gray-600")
            self.badge = ui.badge("").classes("text-base p-2").mark("mode")
            self.state = ui.label("").mark("state")
        with ui.row().classes("w-full no-wrap items-start gap-4"):
            with ui.column().classes("gap-3").style("width: 24rem"):
                self._commands()
                self.reasons = ui.column().classes("w-full gap-2").mark("reasons")
                self.bench = ui.card().classes(CARD)
                with self.bench:
                    self._bench_card()
            with ui.column().classes("grow"):
                self.traces = Traces(watcher, self.pole_pairs)
                self.scope = ScopeCard(watcher, self._do)
                self.params = ParamsCard(watcher, self._do)
        for button in (self.scope.arm, *self.params.buttons):
            button.bind_enabled_from(self.arm, "value")
        self.timer = ui.timer(REFRESH_S, self._refresh)

    def _commands(self) -> None:
        unit = "r/min" if self.pole_pairs else "rad/s electrical"
        with ui.card().classes(CARD):
            self.arm = ui.switch(
                "arm: let this page write to the drive", on_change=self._armed
            ).mark("arm")
            self.speed = (
                ui.number(f"speed [{unit}]", value=1000 if self.pole_pairs else 200)
                .classes("w-full")
                .mark("speed")
            )
            with ui.row():
                for words, colour, action in (
                    ("run", "positive", self._run),
                    ("stop", "negative", self._stop),
                    ("reset", "primary", self._reset),
                ):
                    button = ui.button(words, color=colour, on_click=action).mark(words)
                    button.bind_enabled_from(self.arm, "value")

    def _bench_card(self) -> None:
        ui.label("Bench of the virtual drive").classes("font-bold")
        self.load_words = ui.label("")
        self.load = ui.slider(min=-2.0, max=2.0, step=0.05, value=0.0).mark("load")
        self.load.on("update:model-value", self._set_load, throttle=0.1)
        self.fault = (
            ui.select(list(FAULTS), value=next(iter(FAULTS)), label="break")
            .classes("w-full")
            .mark("fault")
        )
        with ui.row():
            inject = ui.button("break it", color="warning", on_click=self._break)
            mend = ui.button("mend all", on_click=self._mend)
        for element, mark in ((self.load, "load"), (inject, "inject"), (mend, "mend")):
            element.bind_enabled_from(self.arm, "value").mark(mark)

    async def _do(self, action: Callable[..., Any], *args: Any) -> None:
        """Runs in a thread, so that the page stays alive; errors are shown."""
        if not self.arm.value:
            ui.notify("arm first", type="warning")
            return
        try:
            await run.io_bound(action, *args)
        except DriveError as e:
            ui.notify(str(e), type="negative", multi_line=True)

    async def _armed(self) -> None:
        """Turning the arm switch off stops the motor."""
        if not self.arm.value and self.watcher.started_here:
            await run.io_bound(self.watcher.release)

    async def _run(self) -> None:
        speed = float(self.speed.value or 0.0)
        await self._do(
            self.watcher.start_motor,
            e_radps_of(speed, self.pole_pairs) if self.pole_pairs else speed,
        )

    async def _stop(self) -> None:
        await self._do(self.watcher.stop_motor)

    async def _reset(self) -> None:
        await self._do(self.watcher.reset)

    async def _set_load(self) -> None:
        await self._do(self.watcher.tell_bench, f"load {float(self.load.value):g}")

    async def _break(self) -> None:
        await self._do(self.watcher.tell_bench, FAULTS[str(self.fault.value)])

    async def _mend(self) -> None:
        await self._do(self.watcher.tell_bench, "mend")

    def _refresh(self) -> None:
        if not self.client.has_socket_connection:
            return
        self.watcher.seen_s = time.monotonic()
        reading = self.watcher.reading
        known = reading is not None and reading.mode in set(Mode)
        self.badge.set_text(Mode(reading.mode).name if reading and known else "NO DRIVE")
        colour = (
            {Mode.RUN: "green", Mode.FAULT: "red", Mode.READY: "blue"}.get(Mode(reading.mode))
            if reading and known
            else None
        )
        self.badge.props(f"color={colour or 'orange'}")
        self.state.set_text(
            f"{reading.mode_words}; {speed_words(reading.speed_e_radps, self.pole_pairs)}, "
            f"{reading.dc_link_V:.0f} V, "
            f"{reading.temperature_degC:.0f} degC"
            if reading
            else self.watcher.trouble
        )
        self._show_reasons(
            faults.explain(reading.why) + faults.warnings(reading.conditions) if reading else []
        )
        truth = self.watcher.truth
        self.bench.set_visibility(bool(truth))
        if truth:
            self.load_words.set_text(
                f"load {truth['load_Nm']:.2f} N m, torque {truth['torque_Nm']:.2f} N m"
            )
        self.traces.refresh()
        self.scope.refresh()
        self.params.refresh()

    def _show_reasons(self, entries: List[Entry]) -> None:
        if entries == self.shown:
            return
        self.shown = entries
        self.reasons.clear()
        with self.reasons:
            for entry in entries:
                with ui.card().classes(
                    CARD + (" bg-amber-1" if entry.group == "condition" else " bg-red-1")
                ):
                    ui.label(f"{entry.group} {entry.number} {entry.name}").classes("font-bold")
                    ui.label(entry.meaning)
                    ui.label("Causes: " + "; ".join(entry.causes) + ".").classes("text-sm")
                    ui.label("Check: " + "; ".join(entry.check) + ".").classes("text-sm")
