# SPDX-License-Identifier: MIT
"""Whole runs, as `sdre-sil run`."""

from __future__ import annotations

import json
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, Callable, Dict, Mapping, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from sdre import _native
from sdre.drive import Drive
from sdre.loop import Bridge, Plant, Sample
from sdre.scenario import Scenario

FloatArray = NDArray[np.float64]

#: Unit of every quantity of a trace.
UNITS: Dict[str, str] = {
    "time_s": "s",
    "omega_ref_e_radps": "rad/s",
    "omega_e_radps": "rad/s",
    "iq_A": "A",
    "id_A": "A",
    "iq_ref_A": "A",
    "id_ref_A": "A",
    "vq_V": "V",
    "vd_V": "V",
    "d_omega_hat": "rad/s^2",
    "d_q_hat": "A/s",
    "d_d_hat": "A/s",
    "sensor_offset_hat_A": "A",
    "load_torque_Nm": "N m",
    "torque_Nm": "N m",
    "dc_link_V": "V",
    "position_e_rad": "rad",
    "position_ref_e_rad": "rad",
    "ia_A": "A",
    "ib_A": "A",
    "ic_A": "A",
    "peak_current_A": "A",
}


@dataclass(frozen=True)
class Trace:
    """One entry for every control period; all arrays have the same length. Speeds are
    electrical."""

    time_s: FloatArray
    omega_ref_e_radps: FloatArray  # commanded
    omega_e_radps: FloatArray  # of the motor
    iq_A: FloatArray  # of the motor
    id_A: FloatArray
    iq_ref_A: FloatArray  # wanted by the law
    id_ref_A: FloatArray
    vq_V: FloatArray  # commanded at this instant, after the limit; acts one period later
    vd_V: FloatArray
    d_omega_hat: FloatArray  # estimated disturbances
    d_q_hat: FloatArray
    d_d_hat: FloatArray
    sensor_offset_hat_A: FloatArray  # noc_h: length of the offset that its observer has found
    load_torque_Nm: FloatArray
    torque_Nm: FloatArray
    dc_link_V: FloatArray
    # of the shaft, electrical, not wrapped; in a run to positions from the first sample
    position_e_rad: FloatArray
    position_ref_e_rad: FloatArray  # the same of the reference; the shaft's own in a speed run
    ia_A: FloatArray  # of the motor
    ib_A: FloatArray
    ic_A: FloatArray
    peak_current_A: FloatArray  # largest |i| from this instant to the next

    def as_dict(self) -> Dict[str, FloatArray]:
        """Arrays by name; the same arrays."""
        return {one.name: getattr(self, one.name) for one in fields(self)}

    def __len__(self) -> int:
        return len(self.time_s)


class Run:
    """A finished run."""

    def __init__(self, native: Any) -> None:
        self._native = native
        self.trace = Trace(**dict(zip(_native.trace_columns, native.table)))
        report = json.loads(native.json)
        self.scenario: str = report["scenario"]
        self.drive: str = report["drive"]
        self.seed: int = report["seed"]
        #: "compiled table" for the shipped drive, else "solved in process".
        self.gains: str = report["gains"]
        #: Why the gains would not have been written as a table; empty: they are certified.
        self.uncertified: Tuple[str, ...] = tuple(report["uncertified"])
        #: Why the drive opened the bridge; "none".
        self.fault: str = report["fault"]
        self.fault_time_s: Optional[float] = report["fault_time_s"]
        #: Metric by measure and name (docs/files.md); None: never, or it cannot be told.
        self.measures: Dict[str, Dict[str, Optional[float]]] = report["measures"]

    @property
    def csv(self) -> str:
        """As `sdre-sil run --csv` writes it."""
        return str(self._native.csv)

    @property
    def json(self) -> str:
        """As `sdre-sil run --json` writes it."""
        return str(self._native.json)

    def plot(self, path: Union[str, Path], title: Optional[str] = None) -> None:
        """Draws it as `sdre-sil run --plot` does, to a .png or .svg; needs matplotlib.

        The title is the scenario's name and the drive's unless given.
        """
        from sdre_plot import draw_trace

        draw_trace.draw(
            self.csv, title or f"{self.scenario}, {self.drive}", str(path), self._native.marks
        )

    def __str__(self) -> str:
        return str(self._native.text)


def simulate(
    drive: Optional[Drive],
    scenario: Union[Scenario, str, Path, Mapping[str, Any]],
    seed: Optional[int] = None,
) -> Run:
    """Runs a scenario with a drive, or with its own when `drive` is None; `seed` in place of the
    scenario's.

    The control core is the firmware's, on gains solved as `sdre-sil` does. Seeds are 0 ..
    2147483647. A trip is no error: Run.fault. InputError on a wrong scenario, DesignError when the
    gains cannot be solved.
    """
    return Run(_native.run(_scenario(drive, scenario, seed)._native))


# : Control law of one's own: law(sample, omega_ref_e_radps) at every control period; its answer
# acts one period later.
Law = Callable[[Sample, float], Bridge]


def simulate_with(
    law: Law,
    drive: Optional[Drive],
    scenario: Union[Scenario, str, Path, Mapping[str, Any]],
    seed: Optional[int] = None,
) -> Dict[str, FloatArray]:
    """Runs a scenario with a Python function in place of the control core: the slow path, to try an
    idea.

    Gives time_s, omega_ref_e_radps, omega_e_radps, iq_A, id_A, torque_Nm, load_torque_Nm,
    dc_link_V, peak_current_A, one entry for every control period. Ends early when the shaft turns
    half an electrical turn or more in a period.
    """
    chosen = _scenario(drive, scenario, seed)
    plant = Plant(chosen)
    reference = Reference(chosen)
    rows = []
    while plant.time_s <= chosen.duration_s + 1e-9 and not plant.runaway:
        state = plant.state
        omega_ref = reference.at(state.time_s)
        bridge = law(plant.sample, omega_ref)
        plant.step(bridge)
        rows.append((state.time_s, omega_ref, *state[1:-1], plant.state.peak_current_A))
    names = (
        "time_s",
        "omega_ref_e_radps",
        "omega_e_radps",
        "iq_A",
        "id_A",
        "torque_Nm",
        "load_torque_Nm",
        "dc_link_V",
        "peak_current_A",
    )
    return dict(zip(names, np.array(rows, dtype=np.float64).T))


class Reference:
    """The scenario's commanded speed."""

    def __init__(self, scenario: Scenario) -> None:
        steps = scenario.to_dict().get("speed_reference", [])
        self._steps = [(float(step["time_s"]), float(step["value_e_radps"])) for step in steps]
        self._before = scenario.initial_speed_e_radps

    def at(self, time_s: float) -> float:
        """Electrical."""
        value = self._before
        for step_s, wanted in self._steps:
            if step_s <= time_s + 1e-12:
                value = wanted
        return value


def _scenario(
    drive: Optional[Drive],
    scenario: Union[Scenario, str, Path, Mapping[str, Any]],
    seed: Optional[int],
) -> Scenario:
    if not isinstance(scenario, Scenario):
        return Scenario(scenario, drive, seed)
    if drive is not None or seed is not None:
        raise _native.InputError(
            "a Scenario has its drive and seed: give None, or its file or keys"
        )
    return scenario
