# SPDX-License-Identifier: MIT
"""Paper A's law and field-oriented control with PI loops, on the same board with the same noise;
ten seeds each, on threads.

python host_tools/python/examples/compare_laws.py build/laws.png
"""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
from common import DRIVES, SCENARIOS, draw

import sdre

SCENARIO = SCENARIOS / "board_load_step.toml"
curves = {"speed [rad/s el.]": [], "v_q [V]": []}
for label, file in (("noc", "ipmsm_390w"), ("pi_foc", "ipmsm_390w_pi_foc_edges")):
    drive = sdre.Drive.from_toml(DRIVES / f"{file}.toml")
    with ThreadPoolExecutor() as threads:  # simulate() releases the interpreter's lock
        runs = list(
            threads.map(
                lambda seed, drive=drive: sdre.simulate(drive, SCENARIO, seed=seed), range(1, 11)
            )
        )
    steps = [list(run.measures.values())[-1] for run in runs]
    for metric in ("settling_time_s", "dip_e_radps", "ripple_e_radps", "vq_noise_V"):
        values = [np.nan if step[metric] is None else step[metric] for step in steps]
        print(f"{label:8} {metric:18} worst {np.max(values):8.4f}  mean {np.mean(values):8.4f}")
    trace = runs[0].trace
    near = (trace.time_s > 0.39) & (trace.time_s < 0.46)
    curves["speed [rad/s el.]"].append((label, trace.time_s[near], trace.omega_e_radps[near]))
    curves["v_q [V]"].append((label, trace.time_s[near], trace.vq_V[near]))
draw("Load step on the board, seed 1", curves)
