# SPDX-License-Identifier: MIT
"""The law replaced by a Python function: a PI speed loop around PI current loops, beside the
drive's own law.

python host_tools/python/examples/own_law.py build/own_law.png
"""

import math

from common import DRIVES, SCENARIOS, draw

import sdre
from sdre.scenario import changed


class PiLaw:
    """Field-oriented control in fifteen lines: no flux weakening, no anti-windup but a clamp."""

    def __init__(self, drive: sdre.Drive) -> None:
        self.m, self.ts = drive.motor, drive.control_period_s
        self.torque_per_A = 1.5 * self.m.pole_pairs * self.m.pm_flux_Wb
        self.iq_sum = self.vd_sum = self.vq_sum = 0.0

    def __call__(self, s: sdre.Sample, omega_ref: float) -> sdre.Bridge:
        m, ts, w = self.m, self.ts, s.omega_e_radps
        alpha, beta = s.ia_A, (s.ia_A + 2.0 * s.ib_A) / math.sqrt(3.0)
        c, sn = math.cos(s.theta_e_rad), math.sin(s.theta_e_rad)
        i_d, i_q = alpha * c + beta * sn, beta * c - alpha * sn
        kp = m.inertia_kgm2 / m.pole_pairs * 150.0 / self.torque_per_A  # crossover at 150 rad/s
        clamp = lambda x: max(-m.max_current_A, min(m.max_current_A, x))  # noqa: E731
        self.iq_sum = clamp(self.iq_sum + ts * 40.0 * kp * (omega_ref - w))
        error_d, error_q = -i_d, clamp(kp * (omega_ref - w) + self.iq_sum) - i_q
        bandwidth = 600.0  # of the current loops [rad/s]
        self.vd_sum += ts * bandwidth * m.stator_resistance_Ohm * error_d
        self.vq_sum += ts * bandwidth * m.stator_resistance_Ohm * error_q
        v_d = (
            bandwidth * m.d_axis_inductance_H * error_d
            + self.vd_sum
            - w * m.q_axis_inductance_H * i_q
        )
        v_q = (
            bandwidth * m.q_axis_inductance_H * error_q
            + self.vq_sum
            + w * (m.d_axis_inductance_H * i_d + m.pm_flux_Wb)
        )
        return sdre.voltage_duty(v_d, v_q, s.theta_e_rad + 1.5 * ts * w, s.dc_link_V)[0]


drive = sdre.Drive.from_toml(DRIVES / "ipmsm_390w.toml")
keys = changed(SCENARIOS / "board_load_step.toml", {"sensors.ideal": True})
mine = sdre.simulate_with(PiLaw(drive), drive, keys)
own = sdre.simulate(drive, keys).trace
near = (own.time_s > 0.35) & (own.time_s < 0.6)
for label, speed in (("PiLaw", mine["omega_e_radps"]), ("noc", own.omega_e_radps)):
    print(
        f"{label}: dip {own.omega_ref_e_radps[-1] - speed[near].min():.1f} rad/s after the load "
        f"step"
    )
draw(
    "Load step with ideal sensors",
    {
        "speed [rad/s el.]": [
            ("PiLaw", mine["time_s"][near], mine["omega_e_radps"][near]),
            ("noc", own.time_s[near], own.omega_e_radps[near]),
        ],
        "i_q [A]": [
            ("PiLaw", mine["time_s"][near], mine["iq_A"][near]),
            ("noc", own.time_s[near], own.iq_A[near]),
        ],
    },
)
