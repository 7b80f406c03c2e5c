# SPDX-License-Identifier: MIT
"""Many runs of one scenario that differ in some values, in native code: the core of a campaign."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from sdre import _native
from sdre.drive import Drive
from sdre.scenario import Scenario

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Variable:
    """A quantity that varies: all of its keys get the same value.

    Keys are those of the scenario file with dots between them, a number where a key holds an array
    of tables: "plant_scale.inertia_kgm2", "sensors.adc_gain_a", "load_torque.1.value_Nm",
    "fault.0.time_s".
    """

    name: str
    keys: Tuple[str, ...]
    whole: bool = False  # its values are whole numbers


@dataclass(frozen=True)
class CaseTable:
    """Results of n cases."""

    fault: NDArray[np.int32]  # n; 0: none, sdre._native.fault_name() has the names
    failed: NDArray[
        np.bool_
    ]  # n; a fault, more than 1.1 times the current limit, or not in a measure's band at its end
    current_margin: FloatArray  # n; 1 - peak current / what is allowed; -1 after a fault
    speed_margin: (
        FloatArray  # n; 1 - largest |speed error| / band in the steady parts; -1 after a fault
    )
    metrics: FloatArray  # n x (measures x metrics); NaN: it has none


class Cases:
    """A scenario to be run with many values. Not to be shared between threads; make one for each.

    The controller does not know the values, unless a variable belongs to it: controller,
    controller_scale, max_current_A, inverter.updates_per_period. Every case then has its own
    design, which takes longer than its run.
    """

    def __init__(
        self,
        scenario: Scenario,
        drive: Drive,
        variables: Sequence[Variable],
        metrics: Sequence[str] = (),
    ) -> None:
        own = scenario.drive_path()
        keys = [([key.split(".") for key in one.keys], one.whole) for one in variables]
        self.variables = tuple(variables)
        self.metrics = tuple(metrics)
        self._native = _native.cases(
            scenario.text,
            scenario.source,
            scenario.name,
            drive._native,
            str(own or ""),
            keys,
            list(metrics),
        )

    @property
    def columns(self) -> Tuple[str, ...]:
        """Columns of CaseTable.metrics: "measure.metric"."""
        return tuple(
            f"{measure}.{metric}" for measure in self._native.measures for metric in self.metrics
        )

    def check(self, values: Sequence[float]) -> None:
        """InputError when the scenario cannot have these values, one for each variable; runs
        nothing."""
        if len(values) != len(self.variables):
            raise _native.InputError(f"{len(values)} values for {len(self.variables)} variables")
        self._native.check([float(value) for value in values])

    def run(self, values: FloatArray, seeds: NDArray[np.uint64]) -> CaseTable:
        """One run for each row of `values` (n x variables) with the seed of the same place. One
        thread.

        InputError when the scenario cannot have a value: the line of the scenario file's reader.
        """
        wide = np.ascontiguousarray(values, dtype=np.float64)
        if wide.shape != (len(seeds), len(self.variables)):
            raise _native.InputError(
                f"values are {wide.shape}, must be {(len(seeds), len(self.variables))}"
            )
        fault, failed, current, speed, metrics = self._native.run(
            wide, np.ascontiguousarray(seeds, dtype=np.uint64)
        )
        return CaseTable(fault, failed.astype(bool), current, speed, metrics)


def motor_variables() -> Tuple[Variable, ...]:
    """Those of `sdre-sil motors`, in the order of draw_motors()."""
    return (
        Variable("resistance", ("plant_scale.stator_resistance_Ohm",)),
        Variable("d_axis_inductance", ("plant_scale.d_axis_inductance_H",)),
        Variable("q_axis_inductance", ("plant_scale.q_axis_inductance_H",)),
        Variable("flux", ("plant_scale.pm_flux_Wb",)),
        Variable("inertia", ("plant_scale.inertia_kgm2",)),
    )


def draw_motors(
    scenario: Scenario, first: int, count: int, seed: Optional[int] = None
) -> FloatArray:
    """Factors of R, Ld, Lq, flux and J, count x 5. `sdre-sil motors` draws its motors first + 1 ..
    first + count so."""
    return np.asarray(
        _native.draw_motors(scenario._native, scenario.seed if seed is None else seed, first, count)
    )
