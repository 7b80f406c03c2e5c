# SPDX-License-Identifier: MIT
"""The plots: the drive's readings and, of a virtual drive, the true state of its motor."""

from __future__ import annotations

from typing import Any, Callable, Dict, List, NamedTuple, Optional

from nicegui import ui

from sdre_drive.page.state import TRACE_S, Point, Watcher, column
from sdre_drive.show import rpm_of

TELLS, TRUTH = "the drive tells", "true motor"
COLOURS = {TELLS: "#1565c0", TRUTH: "#ef6c00"}


class Plot(NamedTuple):
    """One of the four."""

    title: str
    value: Callable[[Point], float]


def plots(pole_pairs: Optional[int]) -> List[Plot]:
    """From top to bottom."""
    speed = (
        Plot("speed [r/min]", lambda p: rpm_of(p.speed_e_radps, pole_pairs))
        if pole_pairs
        else Plot("speed [rad/s electrical]", lambda p: p.speed_e_radps)
    )
    return [
        speed,
        Plot("i_q [A]", lambda p: p.iq_A),
        Plot("i_d [A]", lambda p: p.id_A),
        Plot("dc link [V]", lambda p: p.dc_link_V),
    ]


class Traces:
    """A chart of four plots over the last seconds."""

    def __init__(self, watcher: Watcher, pole_pairs: Optional[int]) -> None:
        self.watcher = watcher
        self.plots = plots(pole_pairs)
        self.chart = ui.echart(self._options()).classes("w-full").style("height: 38rem")

    def refresh(self) -> None:
        """Sends the data alone, not the whole chart."""
        told = self.watcher.drive_trace
        now_s = told[-1].time_s if told else 0.0
        series = []
        for plot in self.plots:
            series.append({"data": column(self.watcher.true_trace, plot.value, now_s)})
            series.append({"data": column(self.watcher.drive_trace, plot.value, now_s)})
        self.chart.run_chart_method("setOption", {"series": series})

    def _options(self) -> Dict[str, Any]:
        count = len(self.plots)
        last = count - 1
        return {
            "animation": False,
            "legend": {"data": [TELLS, TRUTH], "top": 0},
            "grid": [
                {"left": 60, "right": 15, "top": f"{7 + 23 * k}%", "height": "18%"}
                for k in range(count)
            ],
            "xAxis": [
                {
                    "type": "value",
                    "min": -TRACE_S,
                    "max": 0,
                    "gridIndex": k,
                    "axisLine": {"onZero": False},
                    "axisLabel": {"show": k == last, "formatter": "{value} s"},
                }
                for k in range(count)
            ],
            "yAxis": [
                {
                    "type": "value",
                    "scale": True,
                    "gridIndex": k,
                    "name": p.title,
                    "nameLocation": "end",
                    "nameGap": 6,
                    "position": "left",
                    "axisLine": {"onZero": False},
                    "nameTextStyle": {"align": "left"},
                    "splitNumber": 3,
                }
                for k, p in enumerate(self.plots)
            ],
            "series": [
                {
                    "type": "line",
                    "name": name,
                    "xAxisIndex": k,
                    "yAxisIndex": k,
                    "showSymbol": False,
                    "lineStyle": {"width": 1.5},
                    "color": COLOURS[name],
                    "data": [],
                }
                for k in range(count)
                for name in (TRUTH, TELLS)
            ],
        }
