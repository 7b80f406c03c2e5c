# SPDX-License-Identifier: MIT
"""Lets the drive find its motor (docs/commissioning.md) and writes what it found for `sdre-gains
from-commissioning`."""

from __future__ import annotations

import threading
from typing import Callable, Dict, List

from sdre_drive import register_map, session
from sdre_drive.connection import Drive, DriveError
from sdre_drive.registers import Mode

COMMISSIONING = -1  # mode of operation
FINISHED, ABORTED = 7, 8
STAGES = ("idle", "watch", "look", "resistance", "drag", "map", "spin", "finished", "aborted")
REASONS = {
    2: "an invalid sample",
    3: "over-current",
    4: "the dc link",
    5: "over-speed",
    6: "the encoder",
    7: "a time-out",
    8: "it was withdrawn",
    9: "shaft or currents were not at rest",
    10: "the inductance",
    11: "the resistance",
    12: "the rotor does not follow",
    13: "the shaft does not turn as it should",
    14: "a value is no number",
    15: "a current sensor or a motor wire does not answer",
}
# Key of the file, and the register whose error is beside it.
VALUES = (
    ("stator_resistance_Ohm", "FOUND_R"),
    ("inverter_loss_V", "FOUND_V_LOSS"),
    ("d_axis_inductance_H", "FOUND_LD"),
    ("q_axis_inductance_H", "FOUND_LQ"),
    ("pm_flux_Wb", "FOUND_FLUX"),
    ("inertia_kgm2", "FOUND_INERTIA"),
    ("viscous_friction_Nms", "FOUND_FRICTION"),
    ("coulomb_friction_Nm", "FOUND_COULOMB"),
    ("d_axis_angle_e_rad", "FOUND_OFFSET"),
)
START_S = 2.0


def found(drive: Drive) -> Dict[str, float]:
    """The registers of the commissioning, by name."""
    return drive.values(register_map.COMMISSIONING)


def text(values: Dict[str, float]) -> str:
    """The file."""
    lines: List[str] = [
        "# Found by the drive itself; an uncertainty is twice the standard deviation.",
        f"direction = {values['FOUND_DIRECTION']:.0f}",
        f"pole_pairs = {values['FOUND_POLE_PAIRS']:.0f}",
        f"counts_per_turn = {values['FOUND_COUNTS']:.0f}",
        f"reluctance = {'true' if values['FOUND_RELUCTANCE'] else 'false'}",
    ]
    for key, name in VALUES:
        lines.append(
            f"{key} = {{ value = {values[name]:.5e}, uncertainty = {values[name + '_ERROR']:.2e} }}"
        )
    return "\n".join(lines) + "\n"


def run(
    drive: Drive,
    current_A: float,
    speed_m_radps: float,
    end: threading.Event,
    progress: Callable[[str, float], None],
) -> Dict[str, float]:
    """From READY to its end. DriveError with the reason of an abort; Ctrl-C ends it with the bridge
    off."""
    if session.wait_for(drive, lambda r: r.mode == Mode.READY, session.BOOT_WAIT_S) is None:
        raise DriveError("the drive is not ready: stop it, or reset its fault")
    drive.write("MODE_OF_OPERATION", COMMISSIONING)
    drive.write("COMMISSION_CURRENT", current_A)
    drive.write("COMMISSION_SPEED", speed_m_radps)
    drive.set_run(True)
    try:
        if session.wait_for(drive, lambda r: r.mode == Mode.COMMISSION, START_S) is None:
            raise DriveError(
                "it does not start: a bound beyond the drive's limits, or a condition of "
                "`sdre-drive status`"
            )
        for _ in session.follow(drive, end):
            values = found(drive)
            stage = int(values["COMMISSION_STAGE"])
            progress(STAGES[stage], values["COMMISSION_PERCENT"] / 100.0)
            if stage == ABORTED:
                reason = int(values["COMMISSION_REASON"])
                raise DriveError(
                    f"commissioning gave up: {REASONS.get(reason, f'reason {reason}')}"
                )
            if stage == FINISHED:
                return values
    finally:
        drive.set_run(False)
    raise DriveError("ended before it was done")
