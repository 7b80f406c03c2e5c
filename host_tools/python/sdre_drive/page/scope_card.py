# SPDX-License-Identifier: MIT
"""The scope on the page: what to take, and what was taken."""

from __future__ import annotations

from typing import Any, Awaitable, Callable, Dict, List, Optional

from nicegui import ui

from sdre_drive import scope
from sdre_drive.page.state import Watcher
from sdre_drive.scope import Capture, Setup

SIGNALS = [name for name in scope.NAMES if name != "NONE"]
FIRST = ("SPEED", "SPEED_WANTED", "IQ", "DC_LINK")
NOTHING = "-"
COLOURS = ("#1565c0", "#2e7d32", "#ef6c00", "#6a1b9a")


def _chart(capture: Capture) -> Dict[str, Any]:
    """A plot for each signal, one above the other: their units differ."""
    count = len(capture.signals)
    height = 78 / count
    each = range(count)
    axis = {
        "type": "value",
        "min": round(1e3 * capture.time_s[0], 4),
        "max": round(1e3 * capture.time_s[-1], 4),
    }
    return {
        "animation": False,
        "tooltip": {"trigger": "axis"},
        "axisPointer": {"link": [{"xAxisIndex": "all"}]},
        "grid": [
            {
                "left": 70,
                "right": 20,
                "top": f"{5 + k * (height + 2):.1f}%",
                "height": f"{height - 3:.1f}%",
            }
            for k in each
        ],
        "xAxis": [
            {
                **axis,
                "gridIndex": k,
                "axisLabel": {"show": k == count - 1, "formatter": "{value} ms"},
                "axisLine": {"onZero": False},
            }
            for k in each
        ],
        "yAxis": [
            {
                "type": "value",
                "scale": True,
                "gridIndex": k,
                "name": _title(capture.signals[k]),
                "nameTextStyle": {"align": "left"},
            }
            for k in each
        ],
        "dataZoom": [
            {"type": "inside", "xAxisIndex": list(each)},
            {"type": "slider", "bottom": 5, "xAxisIndex": list(each)},
        ],
        "series": [_line(capture, k) for k in each],
    }


def _title(name: str) -> str:
    return f"{name} [{scope.UNITS[name]}]" if scope.UNITS[name] else name


def _line(capture: Capture, k: int) -> Dict[str, Any]:
    points = [[round(1e3 * t, 4), round(v, 5)] for t, v in zip(capture.time_s, capture.values[k])]
    return {
        "type": "line",
        "name": _title(capture.signals[k]),
        "xAxisIndex": k,
        "yAxisIndex": k,
        "showSymbol": False,
        "step": "end",
        "lineStyle": {"color": COLOURS[k], "width": 1.5},
        "itemStyle": {"color": COLOURS[k]},
        "data": points,
    }


class ScopeCard:
    """Settings, and the last capture: zoom with the wheel, values where the pointer is."""

    def __init__(self, watcher: Watcher, do: Callable[..., Awaitable[Any]]) -> None:
        self.watcher, self.do = watcher, do
        self.shown: Optional[Capture] = None
        with (
            ui.expansion(
                "Scope: 512 samples of four signals in the control interrupt", icon="timeline"
            )
            .classes("w-full")
            .mark("scope")
        ):
            with ui.row().classes("items-end gap-2"):
                self.signals = [
                    ui.select([NOTHING, *SIGNALS], value=name, label=f"signal {k + 1}").classes(
                        "w-36"
                    )
                    for k, name in enumerate(FIRST)
                ]
                self.decimation = ui.number(
                    "every .. periods", value=1, min=1, max=65535, precision=0
                ).classes("w-24")
                self.trigger = ui.select(
                    list(scope.TRIGGERS), value="now", label="trigger"
                ).classes("w-24")
                self.channel = ui.select([1, 2, 3, 4], value=1, label="of signal").classes("w-20")
                self.level = ui.number("level", value=0.0).classes("w-24")
                self.before = ui.number(
                    "samples before", value=100, min=0, max=511, precision=0
                ).classes("w-28")
                self.arm = ui.button("take", color="primary", on_click=self._take).mark("take")
            self.words = ui.label("").mark("scope-state")
            self.chart = ui.echart({"series": []}).classes("w-full").style("height: 36rem")

    def refresh(self) -> None:
        """Shows what has come."""
        self.words.set_text(self.watcher.scope_words)
        capture = self.watcher.capture
        if capture is not None and capture is not self.shown:
            self.shown = capture
            self.chart.options.update(_chart(capture))
            self.chart.update()

    async def _take(self) -> None:
        names: List[str] = [str(s.value) for s in self.signals if s.value != NOTHING]
        await self.do(
            self.watcher.arm_scope,
            Setup(
                names,
                int(self.decimation.value or 1),
                str(self.trigger.value),
                int(self.channel.value),
                float(self.level.value or 0.0),
                int(self.before.value or 0),
            ),
        )
