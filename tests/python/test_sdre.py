# SPDX-License-Identifier: MIT
"""The Python package against the command-line tools, to the bit."""

from __future__ import annotations

import json
import os
import pickle
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any, Dict, List

import numpy as np
import pytest

import sdre
from sdre.scenario import changed

ROOT = Path(__file__).resolve().parents[2]
TOOLS = Path(os.environ.get("SDRE_TOOLS", str(ROOT / "build/host/bin")))
DRIVES = ROOT / "firmware/config/drives"
SCENARIOS = ROOT / "host_tools/sil/scenarios"
SHIPPED = DRIVES / "ipmsm_390w.toml"
LOAD_STEP = SCENARIOS / "board_load_step.toml"
PERIODS = 400  # of loops in Python: through the first transient


def tool(name: str, *words: Any, exit_codes: Any = (0,)) -> str:
    """Output of a command-line tool."""
    done = subprocess.run(
        [str(TOOLS / name), *map(str, words)], capture_output=True, text=True, timeout=120
    )
    assert done.returncode in exit_codes, done.stderr
    return done.stdout


def short(path: Path, duration_s: float = 0.1) -> Dict[str, Any]:
    """A shipped scenario, cut: loops in Python need not be long."""
    keys = changed(path, {"duration_s": duration_s})
    keys["measure"] = []
    return keys


@pytest.mark.parametrize(
    "name",
    [
        "ipmsm_390w",
        "ipmsm_390w_speed",
        "ipmsm_390w_conventional",
        "ipmsm_390w_noc_h",
        "servo_200w",
        "servo_200w_pid",
        "ipmsm_390w_pi_foc",
        "servo_200w_cdobc_printed",
    ],
)
def test_report_is_that_of_sdre_gains(name: str) -> None:
    path = DRIVES / f"{name}.toml"
    design = sdre.design(sdre.Drive.from_toml(path))

    assert design.report_text == tool("sdre-gains", "report", path, "--json", exit_codes=(0, 2))
    assert design.certificate.certified == design.report["certificate"]["certified"]
    assert design.law == design.drive.law


def test_design_has_gains_and_certificate_as_arrays() -> None:
    design = sdre.design(sdre.Drive.from_toml(SHIPPED))

    assert design.controller and design.observer and design.certificate.whole_loop
    assert design.controller.gain.shape == (design.controller.order + 1, 2, 3)
    assert design.observer.gain.shape == (design.observer.order + 1, 7, 3)
    assert np.array_equal(design.controller.gain, np.array(design.report["nosc"]["lambda"]))
    assert (design.observer.poles_1ps.real < 0.0).all()
    assert design.certificate.certified and not design.certificate.failures
    assert 0.0 < design.certificate.whole_loop.spectral_radius < 1.0
    assert max(design.certificate.whole_loop.sensitivity_peaks.values()) <= 3.0
    at_2 = design.controller.gain[0] + 2.0 * (
        design.controller.gain[1] + 2.0 * design.controller.gain[2]
    )
    assert np.array_equal(design.controller.at(2.0), at_2)


@pytest.mark.parametrize(
    "scenario",
    [
        "board_load_step",
        "fig6_load_step_varied",
        "board_flux_weakening",
        "servo_case_1_2",
        "harmonics_load_step",
        "board_torque",
    ],
)
def test_run_is_that_of_sdre_sil(scenario: str, tmp_path: Path) -> None:
    path = SCENARIOS / f"{scenario}.toml"
    tool("sdre-sil", "run", path, "--csv", tmp_path / "t.csv", "--json", tmp_path / "m.json")

    run = sdre.simulate(None, path)

    assert run.csv == (tmp_path / "t.csv").read_text()
    assert run.json == (tmp_path / "m.json").read_text()
    table = np.genfromtxt(tmp_path / "t.csv", delimiter=",", names=True)
    for name in table.dtype.names:
        assert np.allclose(run.trace.as_dict()[name], table[name], rtol=1e-8, atol=1e-12), name


def test_picture_is_that_of_the_script_of_sdre_sil(tmp_path: Path) -> None:
    csv, script = tmp_path / "t.csv", ROOT / "host_tools/python/sdre_plot/draw_trace.py"
    tool("sdre-sil", "run", LOAD_STEP, "--csv", csv)
    run = sdre.simulate(None, LOAD_STEP)
    run.plot(tmp_path / "here.svg", "a title")
    (tmp_path / "marks.json").write_text(run._native.marks)
    subprocess.run(
        [sys.executable, script, csv, "a title", tmp_path / "there.svg", tmp_path / "marks.json"],
        check=True,
    )
    assert (tmp_path / "here.svg").read_bytes() == (tmp_path / "there.svg").read_bytes()


def test_another_drive_and_another_seed_are_those_of_sdre_sil(tmp_path: Path) -> None:
    drive = DRIVES / "ipmsm_390w_pi_foc_edges.toml"
    tool(
        "sdre-sil",
        "run",
        LOAD_STEP,
        "--drive",
        drive,
        "--seed",
        7,
        "--csv",
        tmp_path / "t.csv",
        "--json",
        tmp_path / "m.json",
    )

    run = sdre.simulate(sdre.Drive.from_toml(drive), LOAD_STEP, seed=7)

    assert run.csv == (tmp_path / "t.csv").read_text()
    assert run.json == (tmp_path / "m.json").read_text()
    assert run.seed == 7


def test_files_and_dictionaries_are_the_same() -> None:
    from_file = sdre.Drive.from_toml(SHIPPED)
    from_dict = sdre.Drive.from_dict(from_file.to_dict())
    as_file = sdre.simulate(None, LOAD_STEP)

    assert from_dict.digest == from_file.digest
    assert pickle.loads(pickle.dumps(from_dict)).digest == from_file.digest
    assert sdre.simulate(from_dict, changed(LOAD_STEP, {})).csv == as_file.csv
    assert sdre.simulate(from_dict, changed(LOAD_STEP, {"seed": 2})).csv != as_file.csv


def test_a_changed_drive_is_another_drive() -> None:
    drive = sdre.Drive.from_toml(SHIPPED)
    heavy = drive.replaced({"motor.inertia_kgm2": np.float64(1e-3)})

    assert heavy.motor.inertia_kgm2 == 1e-3 and drive.motor.inertia_kgm2 == 0.00042
    assert heavy.digest != drive.digest


def test_every_quantity_has_a_unit_and_an_array() -> None:
    run = sdre.simulate(None, short(LOAD_STEP))
    arrays = run.trace.as_dict()

    assert list(arrays) == list(sdre.UNITS) == list(sdre._native.trace_columns)
    assert {array.shape for array in arrays.values()} == {(501,)}
    assert all(array.dtype == np.float64 and array.flags.c_contiguous for array in arrays.values())


def test_stepped_drive_is_the_run() -> None:
    scenario = sdre.Scenario(short(SCENARIOS / "board_speed_step.toml"))
    run = sdre.simulate(None, scenario)
    loop = sdre.Simulation(scenario)

    for k in range(PERIODS):
        state = loop.step(run.trace.omega_ref_e_radps[k])
        assert state[:-2] == tuple(values[k] for values in run.trace.as_dict().values()), k
        assert state.fault == "none" and not state.ended


def test_load_of_ones_own_acts() -> None:
    scenario = sdre.Scenario(short(LOAD_STEP))
    loop = sdre.Simulation(scenario)
    torques = [loop.step(300.0, extra_load_Nm=0.2).load_torque_Nm for _ in range(5)]

    assert torques[1:] == pytest.approx([0.95] * 4)  # the first row is of before


def test_core_and_plant_in_a_python_loop_are_the_run() -> None:
    scenario = sdre.Scenario(short(LOAD_STEP))
    run = sdre.simulate(None, scenario)
    core, plant = sdre.Core(scenario), sdre.Plant(scenario)

    for k in range(PERIODS):
        state = plant.state
        assert (state.time_s, state.omega_e_radps, state.iq_A, state.id_A) == (
            run.trace.time_s[k],
            run.trace.omega_e_radps[k],
            run.trace.iq_A[k],
            run.trace.id_A[k],
        ), k
        bridge = core.step(plant.sample, run.trace.omega_ref_e_radps[k])
        assert core.values() == {
            name: run.trace.as_dict()[name][k] for name in sdre.CORE_QUANTITIES
        }
        plant.step(bridge)
        assert plant.state.peak_current_A == run.trace.peak_current_A[k]


def test_core_in_place_of_a_law_is_the_run() -> None:
    scenario = sdre.Scenario(short(LOAD_STEP))
    run = sdre.simulate(None, scenario)

    result = sdre.simulate_with(sdre.Core(scenario).step, None, scenario)

    for name, values in result.items():
        assert np.array_equal(values, run.trace.as_dict()[name]), name


def test_open_bridge_lets_the_motor_coast() -> None:
    plant = sdre.Plant(sdre.Scenario(short(LOAD_STEP)))

    for _ in range(50):
        plant.step(sdre.Bridge(0.5, 0.5, 0.5, gate_enable=False))

    assert plant.state.iq_A == plant.state.id_A == 0.0
    assert plant.state.omega_e_radps < 300.0


def test_wrong_sample_opens_the_bridge_until_reset() -> None:
    scenario = sdre.Scenario(short(LOAD_STEP))
    core, good = sdre.Core(scenario), sdre.Plant(scenario).sample

    assert core.step(good, 300.0).gate_enable
    assert not core.step(
        good._replace(ia_A=float("nan"), ib_A=float("nan"), valid=False), 300.0
    ).gate_enable
    assert core.fault == "invalid sample"
    core.reset()
    assert core.fault == "none"


def test_voltage_comes_out_of_duty_ratios() -> None:
    dc_link_V, vd_V, vq_V, theta = 295.0, -20.0, 110.0, 0.7
    bridge, share = sdre.voltage_duty(vd_V, vq_V, theta, dc_link_V)
    a, b, c = (dc_link_V * duty for duty in bridge[:3])
    alpha, beta = (2.0 * a - b - c) / 3.0, (b - c) / np.sqrt(3.0)

    assert share == 1.0
    assert alpha == pytest.approx(
        vd_V * np.cos(theta) - vq_V * np.sin(theta), abs=1e-3
    )  # single precision of 295 V
    assert beta == pytest.approx(vd_V * np.sin(theta) + vq_V * np.cos(theta), abs=1e-3)
    assert sdre.voltage_duty(0.0, 500.0, theta, dc_link_V)[1] < 1.0


def test_care_is_that_of_sdre_gains(tmp_path: Path) -> None:
    A, B, Q, R = [[0.0, 1.0], [2.0, -1.0]], [[0.0], [1.0]], [[2.0, 0.0], [0.0, 1.0]], [[0.5]]
    problem = tmp_path / "care.json"
    problem.write_text(json.dumps({"A": A, "B": B, "Q": Q, "R": R}))
    said = json.loads(tool("sdre-gains", "care", problem, "--json"))

    x = sdre.care(A, B, R, Q)

    assert np.array_equal(x.X, np.array(said["X"]))
    assert x.relative_residual == said["relative_residual"] and x.semidefinite
    assert [[s.real, s.imag] for s in x.closed_loop_eigenvalues] == said["closed_loop_eigenvalues"]
    assert np.allclose(sdre.care(A, Q=Q, G=[[0.0, 0.0], [0.0, 2.0]]).X, x.X, rtol=1e-13)


def test_tuned_drive_is_that_of_sdre_gains(tmp_path: Path) -> None:
    out = tmp_path / "tuned.toml"
    tool("sdre-gains", "tune", SHIPPED, "--out", out, "--no-qualify")

    tuned, hardest = sdre.tune(sdre.Drive.from_toml(SHIPPED))

    assert tuned.text == out.read_text()
    assert hardest and "\n" not in hardest


def wrong_inputs() -> List[Any]:
    drive = sdre.Drive.from_toml(SHIPPED)
    return [
        (lambda: sdre.Drive.from_toml("nowhere.toml"), "nowhere.toml: cannot be read"),
        (lambda: sdre.Drive.from_text("a = ", "mine"), "mine:1: not valid TOML"),
        (lambda: sdre.Drive.from_dict({"schema": 1}), "is missing"),
        (lambda: sdre.Drive.from_dict({"schema": object()}), "cannot be TOML"),
        (
            lambda: drive.replaced({"motor.inertia_kgm2": -1.0}),
            r"\[motor\] inertia_kgm2 = -1 is not allowed",
        ),
        (lambda: drive.replaced({"motor.inertia_kgm2.x": 1.0}), "leads nowhere"),
        (lambda: sdre.simulate(None, {"duration_s": 1.0}), "drive is missing"),
        (lambda: sdre.simulate(drive, {"duration_s": 1.0, "sped": 1}), "sped is not a known key"),
        (lambda: sdre.simulate(drive, LOAD_STEP, seed=-1), "seed = -1 is not allowed"),
        (
            lambda: sdre.simulate(drive, changed(LOAD_STEP, {"load_torque.9.value_Nm": 1.0})),
            "leads nowhere",
        ),
        (lambda: sdre.care([[1.0]], Q=[[1.0]]), "either B and R or G"),
        (lambda: sdre.care([[1.0]], [[1.0, 2.0]], [[1.0]], [[1.0]]), "B is 1 x 2"),
        (lambda: sdre.care([[float("nan")]], [[1.0]], [[1.0]], [[1.0]]), "must be finite"),
        (
            lambda: sdre.Cases(
                sdre.Scenario(LOAD_STEP), drive, [sdre.Variable("x", ("load_torque.7.value_Nm",))]
            ),
            "leads nowhere",
        ),
        (
            lambda: sdre.Cases(sdre.Scenario(LOAD_STEP), drive, [], ["speed"]),
            "not the name of a metric",
        ),
    ]


@pytest.mark.parametrize("number", range(15))
def test_wrong_input_is_one_clear_line(number: int) -> None:
    call, words = wrong_inputs()[number]
    with pytest.raises(sdre.InputError, match=words) as error:
        call()
    assert "\n" not in str(error.value)


def test_no_design_is_a_design_error() -> None:
    with pytest.raises(sdre.DesignError, match="stabilisable"):
        sdre.care([[1.0]], [[0.0]], [[1.0]], [[1.0]])


def test_threads_run_while_one_simulates() -> None:
    ticks = []
    done = threading.Event()

    def count() -> None:
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    begin = time.monotonic()
    sdre.simulate(None, changed(LOAD_STEP, {"duration_s": 20.0}))
    end = time.monotonic()
    done.set()
    thread.join()

    within = [t for t in ticks if begin < t < end]
    assert end - begin > 0.05 and len(within) > 10  # with the lock held: none
