# SPDX-License-Identifier: MIT
"""Section of the guarantees."""

from __future__ import annotations

from typing import Any, Dict

from markupsafe import Markup

from .. import plots
from ..tables import Figure, Section, Table
from ..tools import DRIVES, read_toml
from .loop import box

TEXT = """<p>Of the default drive, <code>{drive}</code>, and its sampled loop (EQ-CERT-3), linear
about points of speed and current. The box of motors
is that of EQ-CERT-5: R, L, flux x 0.5<sup>s</sup> .. 1.5<sup>s</sup>, J x 0.5<sup>s</sup> ..
3<sup>s</sup>.</p>
<p><b>One quadratic Lyapunov function, proved.</b> For s = {share:g} (R, L, flux x {low:.2f} ..
{high:.2f}, J x {low:.2f} .. {high_J:.2f}), every speed from
{speed[0]:.0f} to {speed[1]:.0f} rad/s, i_q from {iq[0]:.2f} to {iq[1]:.2f} A and i_d from
{id[0]:.2f} to {id[1]:.2f} A (between each two
of 17 speeds a box around all that the tool judges) there is one function
V = |R x|<sup>2</sup> that falls in every period: |R A R<sup>-1</sup>| &lt; {rate:.6f} in all of
{cells} cells that cover the set, in ball arithmetic with all
rounding errors (found with cvxpy on corners: {corner:.4f} there). In every period the matrix may
be another one of the set. Negative speeds
are the mirror image.</p>
<p><b>What is not had.</b> The proof is of the linear loop with the gain Lambda(0) and a d-current
reference that stands still: not of the series in e_iq, of edges that come less often than
eight counts a period, of the references'
limits, or of the change to the voltage of EQ-VOLTAGE-2. Flux weakening goes beyond the proved i_d.
Motor and observer are linear about the same point, so nothing is said about large deviations from
it: this is no contraction. For s = 0.15 a function was found on the
corners (0.986), its proof was not finished in
eight minutes; for s = 0.3 none was found over all speeds, for s = 0.4 none at one speed alone. mu
is computed at 64 frequencies, with
the uncertainties' part of a period by the trapezoidal rule: it is no proof, the corners are exact
but corners alone.</p>"""


def shares(found: Dict[str, Any]) -> Table:
    """mu beside corners and drawn motors."""
    out = Table(
        "G-mu",
        "Share s of the box in which a constant motor leaves the loop stable",
        ("", "mu < 1", "all 16 corners, exact", "4,000 drawn motors, exact"),
        note=f"The verdict of sdre-gains, from the first two points, is "
        f"{found['verdict_share']:.2f}: it judges positions too, whose loop has "
        "one state more and stands less; at the largest command with current it is less. mu takes "
        "flux in torque and EMF, and "
        "the inductances of torque, q and d axis, as independent of each other.",
    )
    for p in found["shares"]:
        out.add(
            f"{p['speed_e_radps']:.0f} rad/s, i_q {p['iq_A']:.2f} A",
            *(f"{p[k]:.2f}" for k in ("mu", "corners", "drawn")),
        )
    return out


def picture(found: Dict[str, Any]) -> Figure:
    """The three shares, the proved one and the verdict."""
    figure, axes = plots.grid(1, 1, 2.4)
    axis, at = axes[0, 0], range(len(found["shares"]))
    for style, (key, label, mark) in enumerate(
        (("mu", "mu < 1", "o"), ("corners", "corners", "s"), ("drawn", "drawn motors", "^"))
    ):
        plots.line(
            axis,
            list(at),
            [p[key] for p in found["shares"]],
            style,
            label,
            marker=mark,
            ms=5,
            lw=0.6,
        )
    axis.axhline(found["verdict_share"], color="k", lw=0.7, ls=":")
    axis.axhline(found["lyapunov"]["share"], color="k", lw=0.7)
    axis.text(
        0, found["lyapunov"]["share"] + 0.02, "proved at all speeds at once, any change", fontsize=7
    )
    axis.text(0, found["verdict_share"] - 0.05, "verdict", fontsize=7)
    axis.set_xticks(
        list(at), [f"{p['speed_e_radps']:.0f} rad/s\n{p['iq_A']:.1f} A" for p in found["shares"]]
    )
    axis.set_ylim(0, 1)
    axis.set_ylabel("share s of the box")
    title = "How far the motor may be from what the controller believes"
    return Figure("G-shares", title, plots.finish(figure, axes, "G-shares", title))


def attraction(found: Dict[str, Any]) -> Table:
    """Half axes in what a user knows."""
    motor = read_toml(DRIVES / f"{found['drive']}.toml")["motor"]
    trip_A = 2.0 * motor["max_current_A"]
    out = Table(
        "G-attraction",
        "From where the loop returns although the inverter cuts",
        (
            "",
            "speed [rad/s]",
            "i_q [A]",
            "i_d [A]",
            "load [N m]",
            "voltage left per axis [V]",
            "came back, square",
            "came back, circle",
        ),
        note="An ellipsoid in all ten states; shown is how far it reaches along each direction "
        "alone, either way. Linear loop, dead-zone "
        "sector condition, the square in the circle that the steady voltage leaves. Last columns: "
        "of 2,000 starts on the surface, limited "
        "as in the proof, and with the vector cut to the circle. Beyond the circle the "
        "firmware's law is another one, EQ-VOLTAGE-2. Beyond the trip of "
        f"{trip_A:g} A the drive is off, wherever the ellipsoid ends.",
    )

    def reach(p: Dict[str, Any], key: str) -> Any:
        beyond = key in ("iq_A", "id_A") and p[key] > trip_A
        return "the trip" if beyond else p[key]

    for p in found["attraction"]:
        out.add(
            f"{p['at_speed_e_radps']:.0f} rad/s, i_q {p['at_iq_A']:.2f} A",
            *(reach(p, k) for k in ("speed_e_radps", "iq_A", "id_A", "load_Nm", "room_V")),
            *(f"{100 * p[k]:g} %" for k in ("returned_square", "returned_circle")),
        )
    return out


def section(found: Dict[str, Any]) -> Section:
    """Text, tables and picture."""
    v = found["lyapunov"]
    (low, high), _, _, (_, high_J) = box(v["share"])
    text = TEXT.format(
        drive=found["drive"],
        share=v["share"],
        low=low,
        high=high,
        high_J=high_J,
        speed=v["speed_e_radps"],
        iq=v["iq_A"],
        id=v["id_A"],
        rate=v["rate"],
        cells=v["cells"],
        corner=v["rate_at_corners"],
    )
    return Section(
        "guarantees",
        "Guarantees beside samples",
        Markup(text),
        [shares(found), picture(found), attraction(found)],
    )
