# SPDX-License-Identifier: MIT
"""One control period per call, for your own closed loops. An object belongs to one thread.

    Simulation   drive and motor:    commanded speed and load in, state out
    Core         the drive alone:    sample in, duty ratios out
    Plant        the motor's side:   duty ratios in, sample out

An input at a tick acts from the next tick on, as on the board. A Core and a Plant in a Python loop
give the same numbers as a Simulation and sdre.simulate(), to the bit.
"""

from __future__ import annotations

import math
from typing import Dict, NamedTuple, Tuple

from sdre import _native
from sdre.scenario import Scenario


class Sample(NamedTuple):
    """The core's sample at a tick, in single precision (firmware/control/base/sample.h)."""

    ia_A: float  # phase currents, positive into the motor
    ib_A: float
    dc_link_V: float
    theta_e_rad: float  # electrical angle, -2 pi .. 2 pi
    band_rad: float = 0.0  # differences to the angle up to here say nothing; 0: it is a measurement
    edge_gap_s: float = (
        0.0  # time between the edges of the encoder that the angle rests on; 0: another measurement
    )
    omega_e_radps: float = 0.0  # electrical speed
    edge_age_s: float = 0.0  # time since the edge that the angle was timed with; 0: none
    edge_of_pattern: int = 0  # its place in the disc's pattern, 1 .. 16; 0: none
    valid: bool = True


class Bridge(NamedTuple):
    """Duty ratios of the upper switches, 0 .. 1; gate_enable False opens all six at once."""

    duty_a: float
    duty_b: float
    duty_c: float
    gate_enable: bool = True


#: The bridge switches, without voltage.
NO_VOLTAGE = Bridge(0.5, 0.5, 0.5)


class State(NamedTuple):
    """One period of a Simulation: the quantities of sdre.Trace at its tick, and the drive's
    fault."""

    time_s: float
    omega_ref_e_radps: float
    omega_e_radps: float
    iq_A: float
    id_A: float
    iq_ref_A: float
    id_ref_A: float
    vq_V: float
    vd_V: float
    d_omega_hat: float
    d_q_hat: float
    d_d_hat: float
    sensor_offset_hat_A: float
    load_torque_Nm: float
    torque_Nm: float
    dc_link_V: float
    position_e_rad: float
    position_ref_e_rad: float
    ia_A: float
    ib_A: float
    ic_A: float
    peak_current_A: float
    fault: str  # "none"
    ended: bool  # nothing can follow: the shaft turns half an electrical turn or more in a period


class PlantState(NamedTuple):
    """The motor at a tick."""

    time_s: float
    omega_e_radps: float
    iq_A: float
    id_A: float
    torque_Nm: float
    load_torque_Nm: float
    dc_link_V: float
    peak_current_A: float  # largest |i| in the period before


#: What Core.values() gives beside the answer.
CORE_QUANTITIES = (
    "iq_ref_A",
    "id_ref_A",
    "vq_V",
    "vd_V",
    "d_omega_hat",
    "d_q_hat",
    "d_d_hat",
    "sensor_offset_hat_A",
)


class Simulation:
    """A drive and its motor. The scenario's speeds have no effect; all else happens as in the
    scenario."""

    def __init__(self, scenario: Scenario) -> None:
        self._native = _native.Loop(scenario._native)

    def step(self, omega_ref_e_radps: float, extra_load_Nm: float = 0.0) -> State:
        """One control period with this commanded speed and this load beside the scenario's.

        InputError once the run has ended.
        """
        values, fault, ended = self._native.step(omega_ref_e_radps, extra_load_Nm)
        return State._make((*values, fault, ended))


class Core:
    """The firmware's control core with the gains of the scenario's drive."""

    def __init__(self, scenario: Scenario) -> None:
        self._native = _native.Core(scenario._native)

    def step(self, sample: Sample, omega_ref_e_radps: float, run: bool = True) -> Bridge:
        """One tick. `run` False opens the bridge. A fault stays until reset()."""
        return Bridge(*self._native.tick(tuple(sample), omega_ref_e_radps, run))

    def reset(self) -> None:
        """Out of a fault."""
        self._native.reset()

    @property
    def fault(self) -> str:
        """Why the bridge is open; "none"."""
        return str(self._native.fault)

    def values(self) -> Dict[str, float]:
        """References, voltage and estimates of the last tick: CORE_QUANTITIES."""
        return dict(zip(CORE_QUANTITIES, self._native.values))


class Plant:
    """The simulated motor with its load, inverter and sensors; `sample` is what the present tick
    shows."""

    def __init__(self, scenario: Scenario) -> None:
        self._native = _native.Plant(scenario._native)
        self._period_s = scenario._native.drive.control_period_s

    @property
    def sample(self) -> Sample:
        """Sample of the present tick."""
        return Sample(*self._native.sample)

    @property
    def state(self) -> PlantState:
        """True state at the present tick, without measurement errors."""
        return PlantState(*self._native.state)

    @property
    def time_s(self) -> float:
        """Time of the present tick."""
        return self.state.time_s

    @property
    def runaway(self) -> bool:
        """The shaft turns half an electrical turn or more in a period: nothing can follow."""
        return not abs(self.state.omega_e_radps) * self._period_s < math.pi

    def step(self, bridge: Bridge, extra_load_Nm: float = 0.0) -> Sample:
        """To the next tick; `bridge` acts from there on. InputError after a runaway."""
        return Sample(*self._native.step(tuple(bridge), extra_load_Nm))


def voltage_duty(
    vd_V: float, vq_V: float, theta_e_rad: float, dc_link_V: float
) -> Tuple[Bridge, float]:
    """Duty ratios for a voltage in the rotor frame at an angle, and the share of it that the
    hexagon leaves (EQ-SVPWM-1, 2).

    The voltage acts for one period, one period later: take the angle in its middle, theta + 1.5
    period omega.
    """
    a, b, c, share = _native.duty_of(vd_V, vq_V, theta_e_rad, dc_link_V)
    return Bridge(a, b, c), share
