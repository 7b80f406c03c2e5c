# SPDX-License-Identifier: MIT
"""The shipped drive gets a machine with five times the inertia: its old weights, and weights found
for it.

python host_tools/python/examples/retune_motor.py build/retune.png
"""

from common import DRIVES, SCENARIOS, draw

import sdre
from sdre.scenario import changed

shipped = sdre.Drive.from_toml(DRIVES / "ipmsm_390w.toml")
heavy = shipped.replaced({"name": "heavy", "motor.inertia_kgm2": 5.0 * shipped.motor.inertia_kgm2})
tuned, hardest_goal = sdre.tune(heavy)
print(f"hardest goal: {hardest_goal}")

step = changed(SCENARIOS / "board_load_step.toml", {})
curves = {"speed [rad/s el.]": [], "v_q [V]": []}
for label, drive in (("old weights", heavy), ("found weights", tuned)):
    certificate = sdre.design(drive).certificate
    run = sdre.simulate(drive, step)
    (name, metrics), *_ = [(n, m) for n, m in run.measures.items()][-1:]
    print(
        f"{label}: certified {certificate.certified}, {name}: dip {metrics['dip_e_radps']:.2f} "
        f"rad/s, "
        f"settled {1e3 * (metrics['settling_time_s'] or float('nan')):.1f} ms, noise of v_q "
        f"{metrics['vq_noise_V']:.1f} V"
    )
    near = (run.trace.time_s > 0.39) & (run.trace.time_s < 0.46)
    curves["speed [rad/s el.]"].append(
        (label, run.trace.time_s[near], run.trace.omega_e_radps[near])
    )
    curves["v_q [V]"].append((label, run.trace.time_s[near], run.trace.vq_V[near]))
draw("Load step, five times the inertia", curves)
