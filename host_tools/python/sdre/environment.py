# SPDX-License-Identifier: MIT
"""A Gymnasium environment: an agent in place of the control core. Needs gymnasium (extra
`examples`).

    env = sdre.environment.SpeedEnv(drive, scenario)

- Observation, 6 numbers: speed error / rated speed, speed / rated speed, i_d and i_q / current
limit, two voltages. The voltages are
  those of the previous action, as shares. All come from the sample, as for a core.
- Action, 2 numbers in -1 .. 1: v_d and v_q as shares of dc link / sqrt(3). It acts one control
period later.
- Reward for each period: - |speed error| / rated speed - 0.01 (|action|)^2. It is -100 when the
current exceeds twice its limit or the
  speed diverges, which terminates the episode. The episode is truncated at the scenario's end.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, Dict, Mapping, Optional, Tuple, Union

import gymnasium
import numpy as np
from numpy.typing import NDArray

from sdre.drive import Drive
from sdre.loop import NO_VOLTAGE, Plant, Sample, voltage_duty
from sdre.run import Reference
from sdre.scenario import LARGEST_SEED, Scenario

_TRIP = 2.0  # of the current limit
_EFFORT = 0.01  # of the reward
_LOST = -100.0


class SpeedEnv(gymnasium.Env):
    """The motor, its load, inverter and sensors of a scenario; the agent sees samples and sets
    voltages."""

    metadata: Dict[str, Any] = {"render_modes": []}

    def __init__(self, drive: Drive, scenario: Union[str, Path, Mapping[str, Any]]) -> None:
        self._drive, self._source = drive, scenario
        self._scenario = Scenario(scenario, drive)
        self._plant = Plant(self._scenario)
        self._action: NDArray[np.float32] = np.zeros(2, dtype=np.float32)
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (6,), np.float32)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (2,), np.float32)

    def reset(
        self, *, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None
    ) -> Tuple[NDArray[np.float32], Dict[str, Any]]:
        """The scenario from its beginning; without a seed with another one each time."""
        super().reset(seed=seed)
        drawn = int(self.np_random.integers(1, LARGEST_SEED))
        self._scenario = Scenario(self._source, self._drive, drawn)
        self._plant = Plant(self._scenario)
        self._reference = Reference(self._scenario)
        self._action = np.zeros(2, dtype=np.float32)
        self._plant.step(NO_VOLTAGE)
        return self._observation(), self._info()

    def step(
        self, action: NDArray[np.float32]
    ) -> Tuple[NDArray[np.float32], float, bool, bool, Dict[str, Any]]:
        """One control period."""
        self._action = np.clip(np.asarray(action, dtype=np.float32), -1.0, 1.0)
        sample = self._plant.sample
        circle_V = sample.dc_link_V / math.sqrt(3.0)
        middle = sample.theta_e_rad + 1.5 * self._drive.control_period_s * sample.omega_e_radps
        bridge, _ = voltage_duty(
            float(self._action[0]) * circle_V,
            float(self._action[1]) * circle_V,
            middle,
            sample.dc_link_V,
        )
        self._plant.step(bridge)
        state = self._plant.state
        lost = self._plant.runaway or state.peak_current_A > _TRIP * self._drive.motor.max_current_A
        error = (
            abs(self._reference.at(state.time_s) - state.omega_e_radps)
            / self._drive.motor.rated_speed_e_radps
        )
        reward = _LOST if lost else -error - _EFFORT * float(np.dot(self._action, self._action))
        return (
            self._observation(),
            reward,
            lost,
            state.time_s >= self._scenario.duration_s,
            self._info(),
        )

    def _observation(self) -> NDArray[np.float32]:
        sample, motor = self._plant.sample, self._drive.motor
        i_d, i_q = currents_A(sample)
        speed = sample.omega_e_radps / motor.rated_speed_e_radps
        wanted = self._reference.at(self._plant.time_s) / motor.rated_speed_e_radps
        return np.array(
            [
                wanted - speed,
                speed,
                i_d / motor.max_current_A,
                i_q / motor.max_current_A,
                *self._action,
            ],
            dtype=np.float32,
        )

    def _info(self) -> Dict[str, Any]:
        return {"state": self._plant.state, "seed": self._scenario.seed}


def currents_A(sample: Sample) -> Tuple[float, float]:
    """i_d, i_q of a sample (EQ-FRAMES-1, 2)."""
    alpha, beta = sample.ia_A, (sample.ia_A + 2.0 * sample.ib_A) / math.sqrt(3.0)
    c, s = math.cos(sample.theta_e_rad), math.sin(sample.theta_e_rad)
    return alpha * c + beta * s, beta * c - alpha * s
