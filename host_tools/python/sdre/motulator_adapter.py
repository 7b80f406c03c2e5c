# SPDX-License-Identifier: MIT
"""motulator beside this project: their plant with our core, our plant with their control. Needs
motulator 0.5 (extra `examples`).

    theirs = motulator.drive.model.Simulation(plant_of(drive, load_Nm=lambda t: 1.0),
    CoreControl(drive, scenario, wanted_speed)) theirs.simulate(t_stop=0.5)

    trace = sdre.simulate_with(ControlLaw(their_control, drive), drive, "scenario.toml")

Both use peak values of the phase currents and act one period after the sample.
"""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any, Callable, List, Tuple

from motulator.drive import model
from motulator.drive.utils import SynchronousMachinePars

from sdre.drive import Drive
from sdre.loop import Bridge, Core, Sample
from sdre.scenario import Scenario


def machine_of(drive: Drive) -> SynchronousMachinePars:
    """The drive's motor as they write it."""
    m = drive.motor
    return SynchronousMachinePars(
        n_p=m.pole_pairs,
        R_s=m.stator_resistance_Ohm,
        L_d=m.d_axis_inductance_H,
        L_q=m.q_axis_inductance_H,
        psi_f=m.pm_flux_Wb,
    )


def plant_of(drive: Drive, load_Nm: Callable[[float], float] = lambda t: 0.0 * t) -> model.Drive:
    """The drive's motor and inverter as their plant, at rest; `load_Nm` of the time in s, for
    arrays of times too."""
    m = drive.motor
    return model.Drive(
        converter=model.VoltageSourceConverter(u_dc=drive.dc_link_V),
        machine=model.SynchronousMachine(machine_of(drive)),
        mechanics=model.StiffMechanicalSystem(
            J=m.inertia_kgm2, B_L=m.viscous_friction_Nms, tau_L=load_Nm
        ),
    )


class CoreControl:
    """The control core as their control system; `speed_e_radps` is the commanded speed at a time in
    s."""

    def __init__(
        self, drive: Drive, scenario: Scenario, speed_e_radps: Callable[[float], float]
    ) -> None:
        self._core, self._wanted = Core(scenario), speed_e_radps
        self._pole_pairs, self._period_s = drive.motor.pole_pairs, drive.control_period_s

    def __call__(self, mdl: Any) -> Tuple[float, List[float]]:
        """One control period: its length and the duty ratios."""
        ia_A, ib_A, _ = mdl.machine.meas_currents()
        angle = math.remainder(
            self._pole_pairs * float(mdl.mechanics.meas_position()), 2.0 * math.pi
        )
        speed = self._pole_pairs * float(mdl.mechanics.meas_speed())
        sample = Sample(
            float(ia_A),
            float(ib_A),
            float(mdl.converter.meas_dc_voltage()),
            angle,
            omega_e_radps=speed,
        )
        bridge = self._core.step(sample, self._wanted(mdl.t0))
        return self._period_s, list(bridge[:3])

    @property
    def fault(self) -> str:
        """Why the core opened the bridge, which their plant has no state for; "none"."""
        return self._core.fault

    def post_process(self) -> None:
        """They call it at the end."""


class ControlLaw:
    """Their control system as a law for sdre.simulate_with(); its sampling period must be the
    drive's."""

    def __init__(self, control: Any, drive: Drive) -> None:
        self._control, self._pole_pairs = control, drive.motor.pole_pairs
        self._tick, self._period_s = 0, drive.control_period_s

    def __call__(self, sample: Sample, omega_ref_e_radps: float) -> Bridge:
        """One control period."""
        phases = [sample.ia_A, sample.ib_A, -sample.ia_A - sample.ib_A]
        self._control.ref.w_m = lambda t: omega_ref_e_radps
        measured = SimpleNamespace(
            t0=self._tick * self._period_s,
            converter=SimpleNamespace(meas_dc_voltage=lambda: sample.dc_link_V),
            machine=SimpleNamespace(meas_currents=lambda: phases),
            mechanics=SimpleNamespace(
                meas_speed=lambda: sample.omega_e_radps / self._pole_pairs,
                meas_position=lambda: sample.theta_e_rad / self._pole_pairs,
            ),
        )
        self._tick += 1
        _, duty = self._control(measured)
        a, b, c = duty
        return Bridge(float(a), float(b), float(c))
