# SPDX-License-Identifier: MIT
"""Lets the drive find its motor (docs/commissioning.md) and writes what it found for `sdre-gains
from-commissioning`."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Callable, Dict, List

from sdre_drive import register_map, session
from sdre_drive.connection import Drive, DriveError
from sdre_drive.registers import ANGLE_KNOWN, Mode
from sdre_drive.units import rpm_of

COMMISSIONING = -1  # mode of operation
STAGES = (
    "idle", "watch", "look", "resistance", "drag", "map", "spin", "ring", "finished", "aborted",
)  # fmt: skip
FINISHED, ABORTED = STAGES.index("finished"), STAGES.index("aborted")
COUPLINGS = ("not searched", "rigid", "elastic", "below", "above")
RIGID, ELASTIC, BELOW, ABOVE = 1, 2, 3, 4
FROM_HZ = 40.0  # of the search for a resonance


@dataclass(frozen=True)
class Reason:
    """Why it gave up, what mostly causes that, and by what the bounds are then multiplied."""

    words: str
    cause: str
    current: float = 1.0
    speed: float = 1.0


REASONS = {
    0: Reason("none", ""),
    1: Reason("a bound", "a bound is missing, or beyond the drive's limit"),
    2: Reason("an invalid sample", "the converter or the supply of the processor is disturbed"),
    3: Reason(
        "over-current", "a current passed 1.05 of its bound: the motor has little inductance", 1.3
    ),
    4: Reason("the dc link", "the supply is off, or cannot take what braking gives back", 1.0, 0.7),
    5: Reason("over-speed", "the shaft passed its bound", 1.0, 1.5),
    6: Reason("the encoder", "the position jumped: cable, screen, or number of lines"),
    7: Reason("a time-out", "too little torque for the inertia, or friction holds the shaft", 1.5),
    8: Reason("it was withdrawn", "Ctrl-C, another master, or requests stopped"),
    9: Reason(
        "shaft or currents were not at rest", "something turns the shaft: wait until it stands"
    ),
    10: Reason("the inductance", "the current is small against its noise, or a wire is open", 1.5),
    11: Reason(
        "the resistance", "the current is small against its noise, or a contact is bad", 1.5
    ),
    12: Reason("the rotor does not follow", "the shaft is not free, or friction holds it", 1.5),
    13: Reason(
        "the shaft does not turn as it should", "a load, or friction beside the torque", 1.5
    ),
    14: Reason("a value is no number", "the current is small against its noise", 1.5),
    15: Reason(
        "a current sensor or a motor wire does not answer",
        "a wire is open, or a sensor is dead or false; a small current looks the same",
        1.5,
    ),
    16: Reason(
        "the shaft oscillates beyond its limit",
        "a coupling with hardly any damping, or one that slips: tighten or replace it",
    ),
}
WITHDRAWN_FAULT = 14  # COMMISSION: the next try leaves it by itself
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
SHAFT_VALUES = (
    ("resonance_Hz", "FOUND_RESONANCE"),
    ("damping", "FOUND_DAMPING"),
    ("load_inertia_share", "FOUND_LOAD_SHARE"),
)
# Key of the table [inductances], registers of its bins, register of their mean.
MAP_ROWS = (
    ("ld_positive_id_H", "FOUND_LD_POSITIVE", "FOUND_LD"),
    ("ld_negative_id_H", "FOUND_LD_NEGATIVE", "FOUND_LD"),
    ("lq_beside_0_H", "FOUND_LQ_BESIDE_0", "FOUND_LQ"),
    ("lq_beside_1_H", "FOUND_LQ_BESIDE_1", "FOUND_LQ"),
    ("lq_beside_2_H", "FOUND_LQ_BESIDE_2", "FOUND_LQ"),
)
BINS = 4
START_S = 2.0
REST_WAIT_S = 60.0  # chosen: a shaft without friction coasts for minutes, and nobody waits so long
TURNS_E_RADPS = 10.0  # in READY one count in a control period is 6.3
REST_READINGS = 6


def found(drive: Drive) -> Dict[str, float]:
    """The registers of the commissioning, by name."""
    return {**drive.values(register_map.COMMISSIONING), **drive.values(register_map.MAP)}


def map_lines(values: Dict[str, float]) -> List[str]:
    """The inductances over the currents; nothing when they were not measured."""
    shares = [[values[f"{register}_{k + 1}"] for k in range(BINS)] for _, register, _ in MAP_ROWS]
    if not values["FOUND_MAP_STEP"] > 0.0 or not all(x > 0.0 for row in shares for x in row):
        return []
    lines = [
        "[inductances] # of bins of current, incremental; lq also beside -1 and -2 bias_A of id",
        f"step_A = {values['FOUND_MAP_STEP']:.5e}",
        f"bias_A = {values['FOUND_MAP_BIAS']:.5e}",
    ]
    for (key, _, mean), row in zip(MAP_ROWS, shares):
        lines.append(f"{key} = [{', '.join(f'{x * values[mean]:.4e}' for x in row)}]")
    return lines


def text(values: Dict[str, float]) -> str:
    """The file."""
    lines: List[str] = [
        "# Found by the drive itself; an uncertainty is twice the standard deviation.",
        f"direction = {values['FOUND_DIRECTION']:.0f}",
        f"pole_pairs = {values['FOUND_POLE_PAIRS']:.0f}",
        f"counts_per_turn = {values['FOUND_COUNTS']:.0f}",
        f"reluctance = {'true' if values['FOUND_RELUCTANCE'] else 'false'}",
    ]
    coupling = int(values["FOUND_COUPLING"])
    shown = VALUES + (SHAFT_VALUES if coupling == ELASTIC else ())
    if coupling in (RIGID, ELASTIC, BELOW, ABOVE):
        lines.append(f'coupling = "{COUPLINGS[coupling]}"')
        lines.append(f"searched_Hz = {values['FOUND_SEARCHED']:.1f}")
    for key, name in shown:
        lines.append(
            f"{key} = {{ value = {values[name]:.5e}, uncertainty = {values[name + '_ERROR']:.2e} }}"
        )
    return "\n".join(lines + map_lines(values)) + "\n"


def shaft_words(values: Dict[str, float]) -> str:
    """The shaft between motor and load, in one line."""
    coupling, to_Hz = int(values["FOUND_COUPLING"]), values["FOUND_SEARCHED"]
    if coupling == RIGID:
        return f"the shaft is rigid: no resonance found between {FROM_HZ:g} and {to_Hz:.0f} Hz"
    if coupling == ELASTIC:
        return (
            f"the shaft has a resonance at {values['FOUND_RESONANCE']:.4g} Hz, damping ratio "
            f"{values['FOUND_DAMPING']:.2g}, {values['FOUND_LOAD_SHARE']:.2g} of the inertia "
            "behind the coupling"
        )
    if coupling == BELOW:
        return f"the shaft has a resonance below {FROM_HZ:g} Hz"
    if coupling == ABOVE:
        return f"the shaft has a resonance above {to_Hz:.0f} Hz"
    return "the shaft was not searched for a resonance"


def bring_to_rest(
    drive: Drive, end: threading.Event, progress: Callable[[str, float], None]
) -> None:
    """A shaft that coasts is braked when the drive knows its angle; if not, it has to come to rest
    by itself."""
    still, braked, begin_s = 0, False, drive.read().time_s
    for reading in session.follow(drive, end):
        turns = abs(reading.speed_e_radps) > TURNS_E_RADPS
        still = 0 if turns else still + 1
        if still >= REST_READINGS:
            return
        if turns and not braked and reading.statusword & ANGLE_KNOWN:
            braked = True
            progress("brakes the shaft", 0.0)
            session.start(drive, 0.0)
            session.stop(drive)
        elif turns:
            progress("waits until the shaft stands", 0.0)
        if reading.time_s > begin_s + REST_WAIT_S:
            raise DriveError("the shaft still turns: brake it by hand, then try again")
    raise DriveError("ended before it began")


def give_up(number: int, current_A: float, speed_rpm: float, most_A: float) -> str:
    """The reason with its cause, and the bounds to try next."""
    reason = REASONS.get(number)
    if reason is None:
        return f"commissioning gave up: reason {number}"
    head = f"commissioning gave up: {reason.words} ({reason.cause})"
    current = min(reason.current * current_A, most_A)
    speed = reason.speed * speed_rpm
    if (current, speed) == (current_A, speed_rpm):
        return f"{head}; next: mend that, then the same again"
    return f"{head}; next: --current {current:.3g} --speed {speed:.4g}"


def get_ready(drive: Drive) -> None:
    """READY, out of what the try before has left; DriveError with what to do."""
    reading = drive.read()
    if reading.mode == Mode.FAULT and reading.why.fault == WITHDRAWN_FAULT:
        session.reset(drive)
    if session.wait_for(drive, lambda r: r.mode == Mode.READY, session.BOOT_WAIT_S) is None:
        raise DriveError("the drive is not ready: stop it, or reset its fault")


def run(
    drive: Drive,
    current_A: float,
    speed_m_radps: float,
    end: threading.Event,
    progress: Callable[[str, float], None],
) -> Dict[str, float]:
    """From READY to its end. DriveError with the reason of an abort; Ctrl-C ends it with the bridge
    off."""
    most_A = drive.constants().current_max_A
    if current_A > most_A:
        raise DriveError(f"--current {current_A:g} A is beyond this drive: at most {most_A:g} A")
    get_ready(drive)
    bring_to_rest(drive, end, progress)
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
                raise DriveError(
                    give_up(
                        int(values["COMMISSION_REASON"]),
                        current_A,
                        rpm_of(speed_m_radps, 1),
                        most_A,
                    )
                )
            if stage == FINISHED:
                return values
    finally:
        drive.set_run(False)
    raise DriveError("ended before it was done")
