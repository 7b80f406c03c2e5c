# SPDX-License-Identifier: MIT
"""The parameters on the page: what the drive has, and what it shall have."""

from __future__ import annotations

from typing import Any, Awaitable, Callable, Dict, List, Optional

from nicegui import ui

from sdre_drive.page.state import Watcher
from sdre_drive.params import PARAMETERS, Value, text_of

COLUMNS = "grid-template-columns: 12.5rem 6.5rem 8.5rem 8rem 4.5rem 1fr"


class ParamsCard:
    """Read when it is opened, written on request."""

    def __init__(self, watcher: Watcher, do: Callable[..., Awaitable[Any]]) -> None:
        self.watcher, self.do = watcher, do
        self.shown: Optional[List[Value]] = None
        self.fields: Dict[str, ui.number] = {}
        self.defaults: Dict[str, ui.label] = {}
        with (
            ui.expansion("Parameters: kept over power", icon="tune", on_value_change=self._opened)
            .classes("w-full")
            .mark("params")
        ):
            with ui.row().classes("items-center gap-2"):
                self.buttons = [
                    ui.button(words, color=colour, on_click=action).mark(f"params-{words}")
                    for words, colour, action in (
                        ("write", "primary", self._write),
                        ("save", "positive", self._save),
                        ("defaults", "warning", self._restore),
                    )
                ]
                self.words = ui.label("").mark("params-state")
            with ui.grid().classes("w-full items-center gap-x-3 gap-y-0").style(COLUMNS):
                for title in ("", "value", "unit", "range", "default", ""):
                    ui.label(title).classes("text-xs text-gray-600")
                for p in PARAMETERS:
                    self._row(p)

    def _row(self, p: Any) -> None:
        name = p.register.name
        ui.label(name).classes("font-mono text-sm").tooltip(p.text)
        self.fields[name] = (
            ui.number(min=p.low, max=p.high, step=p.register.step or 1).props("dense").mark(name)
        )
        ui.label(p.register.unit).classes("text-sm")
        ui.label(f"{text_of(p.low)} .. {text_of(p.high)}").classes("text-sm")
        self.defaults[name] = ui.label("").classes("text-sm")
        ui.label("needs a stop" if p.stopped else "").classes(
            "text-xs text-gray-600 whitespace-nowrap"
        )

    def refresh(self) -> None:
        """Shows what was read, once: what is being typed stays."""
        self.words.set_text(self.watcher.parameters_words)
        found = self.watcher.parameters
        if found is None or found is self.shown:
            return
        self.shown = found
        for v in found:
            shown = float(text_of(v.value))
            self.fields[v.name].set_value(int(shown) if shown.is_integer() else shown)
            self.fields[v.name].classes(remove="bg-amber-2", add="bg-amber-2" if v.changed else "")
            self.defaults[v.name].set_text(text_of(v.default))

    def _opened(self, event: Any) -> None:
        if event.value:
            self.watcher.ask_parameters()

    async def _write(self) -> None:
        had = {v.name: v for v in self.shown or []}
        typed = {
            name: field.value
            for name, field in self.fields.items()
            if name in had and field.value is not None
        }
        await self.do(
            self.watcher.write_parameters,
            {
                name: float(value)
                for name, value in typed.items()
                if text_of(float(value)) != text_of(had[name].value)
            },
        )

    async def _save(self) -> None:
        await self.do(self.watcher.save_parameters)

    async def _restore(self) -> None:
        await self.do(self.watcher.restore_parameters)
