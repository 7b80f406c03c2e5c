# SPDX-License-Identifier: MIT
"""A piston compressor: its torque follows the shaft's angle, which no scenario file knows. The
drive is stepped from Python.

python host_tools/python/examples/own_load.py build/compressor.png
"""

import math

import numpy as np
from common import DRIVES, draw

import sdre

MEAN_NM, SWING_NM = 0.6, 0.5
drive = sdre.Drive.from_toml(DRIVES / "ipmsm_390w.toml")
scenario = sdre.Scenario({"duration_s": 1.0, "sensors": {"ideal": False}}, drive)
loop = sdre.Simulation(scenario)

turned_m_rad, load_Nm, states = 0.0, 0.0, []
for k in range(3000):
    wanted_e_radps = min(300.0, 1500.0 * k * drive.control_period_s)  # up in 0.2 s
    state = loop.step(wanted_e_radps, extra_load_Nm=load_Nm)
    turned_m_rad += drive.control_period_s * state.omega_e_radps / drive.motor.pole_pairs
    started = min(1.0, state.time_s / 0.2)
    load_Nm = started * (MEAN_NM + SWING_NM * math.sin(turned_m_rad))
    states.append(state)

trace = {
    name: np.array([getattr(state, name) for state in states])
    for name in (
        "time_s",
        "omega_e_radps",
        "iq_A",
        "load_torque_Nm",
        "torque_Nm",
        "omega_ref_e_radps",
    )
}
steady = trace["time_s"] > 0.4
ripple = 0.5 * np.ptp(trace["omega_e_radps"][steady])
print(
    f"fault: {states[-1].fault}; speed within +-{ripple:.2f} rad/s of its mean with "
    f"+-{SWING_NM} N m"
)
late = trace["time_s"] > 0.1
error = trace["omega_e_radps"] - trace["omega_ref_e_radps"]
draw(
    "Piston compressor, run up to 0.2 s and steady",
    {
        "speed error [rad/s el.]": [("motor", trace["time_s"][late], error[late])],
        "torque [N m]": [
            ("motor", trace["time_s"][late], trace["torque_Nm"][late]),
            ("load", trace["time_s"][late], trace["load_torque_Nm"][late]),
        ],
    },
)
