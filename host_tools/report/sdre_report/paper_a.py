# SPDX-License-Identifier: MIT
"""Paper A: Fig. 5 to 8, Table 2 and 3, with the proposed and the conventional control, on ideal
signals and on the board."""

from __future__ import annotations

from typing import Any, Dict, List

from . import plots
from .paper_a_cases import CASES, Case
from .paper_a_tables import table_2, table_3, table_3_conventional
from .settling import Settled, settle
from .tables import Figure, Section, Table, Value, or_never
from .tools import Run, Tools

SIGNALS = {
    "d_w": "d_omega_hat",
    "d_q": "d_q_hat",
    "d_d": "d_d_hat",
    "iq": "iq_A",
    "id": "id_A",
}
WORDS = {"d_w": "d_w", "d_q": "d_q", "d_d": "d_d", "iq": "i_q", "id": "i_d"}
BEFORE_S = 0.2  # from here on the scenarios are steady
STEP_S = 0.4
# The shipped board in place of exact signals.
BOARD = {"ideal = true": "ideal = false"}


COLUMNS = ("proposed, ideal", "conventional, ideal", "proposed, board", "conventional, board")


def runs_of(tools: Tools, case: Case) -> List[Run]:
    """In the order of COLUMNS. The board's proposed control is the shipped drive: its observer
    measures the angle."""

    def of(drive: str, where: str, changes: Any) -> Run:
        return tools.run(case.scenario, drive, changes, f"fig{case.number}-{where}-{drive}")

    return [
        of("ipmsm_390w_speed", "ideal", None),
        of("ipmsm_390w_conventional", "ideal", None),
        of("ipmsm_390w", "board", BOARD),
        of("ipmsm_390w_conventional", "board", BOARD),
    ]


def settled(run: Run, case: Case, signal: str) -> Settled:
    """One signal after the case's step."""
    return settle(run.trace, SIGNALS[signal], BEFORE_S, STEP_S, case.end_s)


def time_of(s: Settled) -> Value:
    """A time, or why there is none."""
    if s.before == s.after == 0.0:
        return "not there"
    return or_never(s.time_ms) if s.moves else "in its noise"


def draw(case: Case, runs: List[Run]) -> Figure:
    """Speed, currents and estimates of both controls; left exact signals, right the board."""
    figure, axes = plots.grid(6, 2, 1.25, sharex=True)
    for column, title in enumerate(("ideal signals", "realistic board")):
        axes[0, column].set_title(title)
        for style, run in enumerate(runs[2 * column : 2 * column + 2]):
            shown = plots.window(run.trace, STEP_S - 0.01, STEP_S + 1e-3 * case.shown_ms)
            at = shown["ms"] - 1e3 * STEP_S
            if style == 0:
                axes[0, column].plot(at, shown["omega_ref_e_radps"], **plots.REFERENCE)
            label = ("proposed", "conventional")[style]
            for row, name in enumerate(
                ("omega_e_radps", "iq_A", "id_A", "d_omega_hat", "d_q_hat", "d_d_hat")
            ):
                plots.line(axes[row, column], at, shown[name], style, label if row == 0 else "")
        axes[-1, column].set_xlabel("time after the step [ms]")
    for row, label in enumerate(
        ("speed [rad/s el.]", "i_q [A]", "i_d [A]", "d_w [rad/s²]", "d_q [A/s]", "d_d [A/s]")
    ):
        axes[row, 0].set_ylabel(label)
    ident = f"A-fig{case.number}"
    svg = plots.finish(figure, axes, ident, f"Fig. {case.number}: {case.title}")
    return Figure(
        ident,
        f"Fig. {case.number}: {case.title}",
        svg,
        "Thin grey: reference. " + plots.names(("proposed", "conventional")) + ".",
    )


def add_pair(table: Table, what: str, printed: Any, pairs: List[Settled]) -> None:
    """Before and after the step."""
    word = " → ".join(f"{x:g}" for x in printed) if isinstance(printed, list) else f"{printed:g}"
    shown = []
    for s in pairs:
        decimals = 0 if max(abs(s.before), abs(s.after)) > 100 else 2
        shown.append(f"{s.before:.{decimals}f} → {s.after:.{decimals}f}")
    table.add(what, word, "-", *shown)


def compare(case: Case, runs: List[Run], printed: Dict[str, Any]) -> Table:
    """Every number that the paper gives for the figure."""
    ours, others = printed["proposed"], printed["conventional"]
    table = Table(
        f"A-fig{case.number}-numbers",
        f"Fig. {case.number} in numbers",
        ("", "paper, proposed", "paper, conventional", *COLUMNS),
    )
    speed = [or_never(r.measure(case.measure)["settling_time_s"], 1e3) for r in runs]
    table.add("speed within 1 % [ms]", ours["speed_ms"], others["speed_ms"], *speed)
    error = [r.measure(case.measure)["steady_state_error_e_radps"] for r in runs]
    table.add(
        "steady error [rad/s]",
        ours.get("error", "-"),
        others.get("error", "-"),
        *(f"{x:.3f}" for x in error),
    )
    if case.number <= 6:
        table.add("dip [rad/s]", "-", "-", *(r.measure(case.measure)["dip_e_radps"] for r in runs))
    else:
        table.add(
            "overshoot of the speed [rad/s]",
            "-",
            "-",
            *(f"{r.measure(case.measure)['overshoot_e_radps']:.3f}" for r in runs),
        )
    for signal in ("iq", "id", "d_w", "d_q", "d_d"):
        key = f"{signal}_ms"
        table.add(
            f"{WORDS[signal]} settled [ms]",
            ours.get(key, "-"),
            others.get(key, "-"),
            *(time_of(settled(r, case, signal)) for r in runs),
        )
    for signal in ("iq", "id"):
        key = f"{signal}_overshoot_A"
        if key in ours:
            table.add(
                f"{WORDS[signal]} beyond its final value [A]",
                ours[key],
                others[key],
                *(settled(r, case, signal).overshoot for r in runs),
                digits=2,
            )
    for signal in ("d_w", "d_q", "d_d"):
        add_pair(table, WORDS[signal], ours[signal], [settled(r, case, signal) for r in runs])
    if "id_A" in ours:
        add_pair(table, "i_d [A]", ours["id_A"], [settled(r, case, "id") for r in runs])
    table.note = (
        "Currents and estimates: within 5 % of how far they leave their final value, beyond the "
        "noise of the last fifth; the "
        'paper names no band. "In its noise": they leave it by no more than that noise. The '
        "conventional observer has no "
        "d_q and d_d. Fig. 7: beyond the final value is here all of the current that accelerates."
    )
    return table


def section(
    tools: Tools, printed: Dict[str, Any], design: Dict[str, Any], drive: Dict[str, Any]
) -> Section:
    """All of paper A's runs."""
    out = Section("paper-a", "Paper A: near optimal control of the interior magnet motor")
    found: Dict[int, List[Run]] = {}
    out.parts.append(table_2(design, drive, printed["parameters"]))
    for case in CASES:
        runs = found[case.number] = runs_of(tools, case)
        out.parts += [draw(case, runs), compare(case, runs, printed[f"fig{case.number}"])]
    out.parts += [table_3(found, printed), table_3_conventional(found, printed)]
    return out
