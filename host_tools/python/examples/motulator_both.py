# SPDX-License-Identifier: MIT
"""motulator and this project, each with the other's half: a speed step and a load step.

python host_tools/python/examples/motulator_both.py build/motulator.png
"""

import math

import motulator.drive.control.sm as control
import numpy as np
from common import DRIVES, draw
from motulator.drive.model import Simulation

import sdre
from sdre.motulator_adapter import ControlLaw, CoreControl, machine_of, plant_of

SPEED, LOAD, LOAD_AT, END = 300.0, 1.0, 0.2, 0.4
drive = sdre.Drive.from_toml(DRIVES / "ipmsm_390w.toml")
scenario = sdre.Scenario(
    {
        "duration_s": END,
        "speed_reference": [{"time_s": 0.0, "value_e_radps": SPEED}],
        "load_torque": [{"time_s": 0.0, "value_Nm": 0.0}, {"time_s": LOAD_AT, "value_Nm": LOAD}],
    },
    drive,
)

core = CoreControl(drive, scenario, lambda t: SPEED)
theirs = Simulation(plant_of(drive, lambda t: LOAD * (np.asarray(t) >= LOAD_AT)), core)
theirs.simulate(t_stop=END)
their_speed = drive.motor.pole_pairs * theirs.mdl.mechanics.data.w_M.real

references = control.CurrentReferenceCfg(
    machine_of(drive), max_i_s=drive.motor.max_current_A, nom_w_m=drive.motor.rated_speed_e_radps
)
foc = control.CurrentVectorControl(
    machine_of(drive),
    references,
    T_s=drive.control_period_s,
    J=drive.motor.inertia_kgm2,
    sensorless=False,
)
foc.speed_ctrl = control.SpeedController(drive.motor.inertia_kgm2, 2.0 * math.pi * 20.0)
ours = sdre.simulate_with(ControlLaw(foc, drive), None, scenario)
both_ours = sdre.simulate(None, scenario).trace

at = np.interp(both_ours.time_s, theirs.mdl.mechanics.data.t, their_speed)
print(
    f"our core: their plant and ours differ by {np.max(np.abs(at - both_ours.omega_e_radps)):.3f} "
    f"rad/s at most; fault: {core.fault}"
)
print(
    f"their control on our plant: "
    f"{SPEED - ours['omega_e_radps'][ours['time_s'] > LOAD_AT].min():.1f} rad/s of dip"
)
draw(
    "One motor, two simulators, two laws",
    {
        "speed [rad/s el.]": [
            ("our core, their plant", theirs.mdl.mechanics.data.t, their_speed),
            ("our core, our plant", both_ours.time_s, both_ours.omega_e_radps),
            ("their control, our plant", ours["time_s"], ours["omega_e_radps"]),
        ],
        "i_q [A]": [
            ("our core, their plant", theirs.mdl.machine.data.t, theirs.mdl.machine.data.i_s.imag),
            ("our core, our plant", both_ours.time_s, both_ours.iq_A),
            ("their control, our plant", ours["time_s"], ours["iq_A"]),
        ],
    },
)
