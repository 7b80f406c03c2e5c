# SPDX-License-Identifier: MIT
"""The Gymnasium environment, with an agent that has learnt nothing: a proportional rule, to show
the interface.

python host_tools/python/examples/own_agent.py build/agent.png
"""

import numpy as np
from common import DRIVES, SCENARIOS, draw

import sdre
from sdre.environment import SpeedEnv
from sdre.scenario import changed

drive = sdre.Drive.from_toml(DRIVES / "ipmsm_390w.toml")
env = SpeedEnv(drive, changed(SCENARIOS / "board_load_step.toml", {"duration_s": 0.6}))
emf_share = (
    drive.motor.pm_flux_Wb * drive.motor.rated_speed_e_radps / (drive.dc_link_V / np.sqrt(3.0))
)

observation, _ = env.reset(seed=1)
states, total, over = [], 0.0, False
while not over:
    error, speed, i_d, i_q, *_ = observation
    action = np.array([-0.5 * i_d, emf_share * speed + 4.0 * error + 0.1 * i_q], dtype=np.float32)
    observation, reward, terminated, truncated, info = env.step(action)
    total += reward
    over = terminated or truncated
    states.append(info["state"])

time_s = np.array([state.time_s for state in states])
print(f"reward of an episode of {len(states)} periods: {total:.2f}")
draw(
    "A proportional rule in the environment",
    {
        "speed [rad/s el.]": [
            ("motor", time_s, np.array([state.omega_e_radps for state in states]))
        ],
        "i_q [A]": [("motor", time_s, np.array([state.iq_A for state in states]))],
    },
)
