# SPDX-License-Identifier: MIT
"""Paper A, Fig. 4: the motor's parameters step from 50 % to 100 % to 150 %; how fast the estimates
follow."""

from __future__ import annotations

from typing import Any, Dict, List

from . import plots
from .paper_a import BOARD, time_of
from .settling import settle
from .tables import Figure, Table
from .tools import Run, Tools

ORDERS = range(4)
STEPS_S = (0.0, 0.4, 0.8, 1.2)
LOAD_Nm = 1.0
ESTIMATES = (
    ("d_w", "d_omega_hat", "d_w [rad/s²]"),
    ("d_q", "d_q_hat", "d_q [A/s]"),
    ("d_d", "d_d_hat", "d_d [A/s]"),
)


def load_error_Nm(run: Run, design: Dict[str, Any]) -> List[float]:
    """Load error of the conventional observer at 50, 100 and 150 % of the parameters."""
    l3 = design["reduced_parameters"]["l3"]
    names = ("at_50_percent", "to_100_percent", "to_150_percent")
    return [-run.measure(name)["d_omega_hat"] / l3 - LOAD_Nm for name in names]


def draw(ideal: List[Run], board: List[Run], load: Run, l3: float) -> Figure:
    """Order 0 and 2 on ideal signals and on the board; the conventional observer's load."""
    figure, axes = plots.grid(4, 2, 1.3, sharex=True)
    for column, (title, runs) in enumerate((("ideal signals", ideal), ("realistic board", board))):
        axes[0, column].set_title(title)
        for row, (_, name, label) in enumerate(ESTIMATES):
            for style, order in enumerate((0, 2)):
                t = runs[order].trace
                plots.line(
                    axes[row, column],
                    1e3 * t["time_s"],
                    t[name],
                    style,
                    f"N_d = {order}" if row == 0 else "",
                )
            axes[row, 0].set_ylabel(label)
    plots.line(
        axes[3, 0],
        1e3 * load.trace["time_s"],
        -load.trace["d_omega_hat"] / l3,
        0,
        "conventional observer",
    )
    axes[3, 0].axhline(LOAD_Nm, **plots.REFERENCE)
    axes[3, 0].set_ylabel("load [N m]")
    axes[3, 0].set_xlabel("time [ms]")
    axes[2, 1].set_xlabel("time [ms]")
    axes[2, 1].tick_params(labelbottom=True)
    axes[3, 1].set_axis_off()
    svg = plots.finish(figure, axes, "A-fig4", "Fig. 4: estimates while the motor changes")
    return Figure(
        "A-fig4",
        "Fig. 4: estimates while the motor's parameters step to 100 % (0.4 s) and 150 % (0.8 s)",
        svg,
        plots.names(("N_d = 0", "N_d = 2"))
        + ". Last plot: the load that the conventional observer believes; grey: the true "
        "one.",
    )


def numbers(ideal: List[Run], board: List[Run], printed: Dict[str, Any]) -> Table:
    """Convergence times per order."""
    table = Table(
        "A-fig4-numbers",
        "Fig. 4 in numbers: convergence [ms]",
        ("", *(f"N_d = {n}, {who}" for n in ORDERS for who in ("paper", "here", "board"))),
        note="Here: 5 % of the change, to 100 % and to 150 %. The paper gives one time per order. "
        "The order hardly acts: "
        'docs/errata.md, "Not reproduced".',
    )
    for key, name, _ in ESTIMATES:
        cells: List[Any] = []
        for order in ORDERS:
            cells.append(printed[f"{key}_ms"][order])
            for runs in (ideal, board):
                times = [
                    settle(runs[order].trace, name, STEPS_S[k], STEPS_S[k + 1], STEPS_S[k + 2])
                    for k in (0, 1)
                ]
                cells.append(
                    " / ".join(t if isinstance(t, str) else f"{t:.1f}" for t in map(time_of, times))
                )
        table.add(key, *cells)
    return table


def parts(tools: Tools, printed: Dict[str, Any], design: Dict[str, Any]) -> list:
    """Plot, times, load error."""
    ideal = [
        tools.run(f"fig4_parameter_steps_nd{n}", "ipmsm_390w_speed", name=f"fig4-ideal-nd{n}")
        for n in ORDERS
    ]
    board = [
        tools.run(f"fig4_parameter_steps_nd{n}", "ipmsm_390w", BOARD, f"fig4-board-nd{n}")
        for n in ORDERS
    ]
    load = tools.run(
        "fig4_parameter_steps_nd2", "ipmsm_390w_conventional", name="fig4-conventional"
    )
    table = Table(
        "A-fig4-load",
        "Fig. 4 (iv): error of the conventional observer's load [N m]",
        ("", "50 %", "100 %", "150 %"),
    )
    table.add("paper", *printed["load_error_Nm"])
    table.add("here", *(round(x, 3) for x in load_error_Nm(load, design)))
    return [
        draw(ideal, board, load, design["reduced_parameters"]["l3"]),
        numbers(ideal, board, printed),
        table,
    ]
