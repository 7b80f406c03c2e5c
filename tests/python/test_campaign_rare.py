# SPDX-License-Identifier: MIT
"""Subset simulation: limit states whose probability is known, the formula by hand, and a short
campaign on the simulator."""

from __future__ import annotations

import json
import math
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any, Callable, List

import numpy as np
import pyarrow.parquet as pq
import pytest
from scipy.special import ndtr, ndtri
from test_campaign import SHORT, campaign, parts, write_spec
from test_sdre import SCENARIOS, TOOLS

import sdre
from sdre.scenario import LARGEST_SEED
from sdre_campaign import subset
from sdre_campaign.batch import run_batch
from sdre_campaign.chains import Chains, State, Stream, drawn, normals, walked
from sdre_campaign.draw import even_numbers, place_of, shared
from sdre_campaign.rare import FIRST_SPREAD
from sdre_campaign.spec import read_spec

RARE = 1e-6
# A light motor with a strong magnet and little inductance rings: two of a hundred.
RARE_SHORT = f"""
scenario = "{SCENARIOS}/board_random_motors.toml"
method = "subset"
margin = "speed"
repeats = 2
cases = 60
batch = 20
worst = 3
[change]
duration_s = 0.12
initial_speed_e_radps = 300.0
"speed_reference.0.value_e_radps" = 300.0
"speed_reference.1.time_s" = 0.02
"speed_reference.1.value_e_radps" = 360.0
"load_torque.1.time_s" = 0.08
"measure.0.time_s" = 0.02
"measure.1.time_s" = 0.08
[[variable]]
name = "inductance"
keys = ["plant_scale.d_axis_inductance_H", "plant_scale.q_axis_inductance_H"]
range = [0.6, 1.0]
[[variable]]
name = "flux"
keys = ["plant_scale.pm_flux_Wb"]
range = [1.1, 1.4]
[[variable]]
name = "inertia"
keys = ["plant_scale.inertia_kgm2"]
range = [0.5, 0.7]
"""


def linear(u: np.ndarray, _: np.ndarray) -> State:
    """A plane at a distance from the origin."""
    return {"margin": -ndtri(RARE) - u.sum(axis=1) / math.sqrt(u.shape[1])}


def two_sided(u: np.ndarray, _: np.ndarray) -> State:
    """Two planes that no chain goes between."""
    return {"margin": -ndtri(0.5 * RARE) - np.abs(u[:, 0])}


def noisy(u: np.ndarray, seed: np.ndarray) -> State:
    """A plane that the noise moves: a fifth of the variance is its own."""
    noise = ndtri((seed - 0.5) / LARGEST_SEED)
    return {"margin": -ndtri(RARE) - math.sqrt(0.8) * u[:, 0] - math.sqrt(0.2) * noise}


def corner(u: np.ndarray, _: np.ndarray) -> State:
    """Three of four even variables in their lowest hundredth."""
    return {"margin": ndtr(u[:, :3]).max(axis=1) - RARE ** (1.0 / 3.0)}


def one_run(limit: Callable[..., State], seed: int, samples: int) -> subset.Estimate:
    """As the campaign does it, without a cluster."""
    levels: List[subset.Level] = []
    spread = FIRST_SPREAD
    state = drawn(Stream(seed, 0, 0), 0, samples, 4, limit)
    while True:
        levels.append(subset.judge(state["margin"], 0.0, bool(levels)))
        if levels[-1].is_last:
            return subset.estimate(levels)
        assert len(levels) < 12
        rows = subset.heads_of(state["margin"])
        heads = {key: one[rows] for key, one in state.items()}
        state = walked(Stream(seed, 0, len(levels)), 0, heads, levels[-1].threshold, spread, limit)
        spread = subset.next_spread(
            spread, float(state["new"].reshape(-1, subset.STEPS)[:, 1:].mean())
        )


@pytest.mark.parametrize("limit", [linear, two_sided, noisy, corner])
def test_known_probability_lies_in_the_interval_as_often_as_it_says(
    limit: Callable[..., State],
) -> None:
    """With 1,000 samples the mean of very many runs is a twentieth too high: a threshold is chosen
    by the samples that it judges."""
    runs = [one_run(limit, seed, 1000) for seed in range(1, 201)]
    found = np.array([run.probability for run in runs])
    inside = np.mean([run.interval[0] <= RARE <= run.interval[1] for run in runs])

    assert found.mean() == pytest.approx(1.05 * RARE, abs=3.0 * found.std() / math.sqrt(len(runs)))
    assert inside >= 0.95 - 3.0 * math.sqrt(0.95 * 0.05 / len(runs))
    assert 0.6 < np.mean([run.variation for run in runs]) / (found.std() / found.mean()) < 1.1
    ten = [subset.combined(runs[k : k + 10]) for k in range(0, 200, 10)]
    assert sum(one.interval[0] <= RARE <= one.interval[1] for one in ten) >= 18
    assert all(one.interval[1] < 4.0 * RARE for one in ten), "the interval says nothing"


def test_formula_of_the_variation_by_hand() -> None:
    """Chains that never move are one sample each; independent samples are ten; equations 25 to
    29."""
    still = np.repeat(np.arange(100) < 30, subset.STEPS)
    assert subset.correlation(still) == pytest.approx(9.0)  # 2 (0.9 + 0.8 + .. + 0.1)
    free = even_numbers(1, 0, 100000, 1)[:, 0] < 0.3
    assert subset.correlation(free) == pytest.approx(0.0, abs=0.03)
    halves = np.tile(
        np.repeat([True, False], 5), 40
    )  # R(k) = (5 - k) / (10 - k) - 1/4 up to k = 5, then -1/4
    by_hand = sum((1 - k / 10) * (max(5 - k, 0) / (10 - k) - 0.25) for k in range(1, 10)) * 2 / 0.25
    assert subset.correlation(halves) == pytest.approx(max(0.0, by_hand))

    level = subset.Level(0.1, 0.1, 2.0, 1000, False)
    last = subset.Level(0.0, 0.2, 1.0, 1000, True)
    found = subset.estimate([level, last])
    assert (level.variation**2, last.variation**2) == pytest.approx(
        (0.9 / 0.1 / 1000 * 3.0, 0.8 / 0.2 / 1000 * 2.0)
    )
    assert found.probability == pytest.approx(0.02)
    assert found.variation == pytest.approx(math.sqrt(0.027 + 0.008))
    assert found.wide == pytest.approx(
        math.sqrt(0.027) + math.sqrt(0.008)
    )  # neighbours wholly dependent
    assert found.interval[1] / found.probability == pytest.approx(
        found.probability / found.interval[0]
    )


def test_levels_of_known_margins() -> None:
    margin = np.arange(200.0)[::-1]
    level = subset.judge(margin, 0.0, False)
    assert (level.threshold, level.share, level.is_last) == (19.5, 0.1, False)
    assert margin[subset.heads_of(margin)].tolist() == list(range(20))
    last = subset.judge(margin, 30.0, False)
    assert (last.threshold, last.share, last.is_last) == (30.0, 0.15, True)
    tied = subset.judge(np.where(margin < 50.0, 3.0, margin), 0.0, False)
    assert (tied.threshold, tied.share) == (3.0, 0.25)  # all that are equal count
    levels, at = [level, replace(last, threshold=0.0)], np.array([-1.0, 5.0, 100.0])
    assert subset.below(levels, [margin, 0.1 * margin], at).tolist() == [
        0.0,
        0.1 * 51 / 200,
        101 / 200,
    ]


def test_chain_is_the_same_in_any_task() -> None:
    heads = drawn(Stream(3, 1, 0), 0, 6, 2, linear)
    together = walked(Stream(3, 1, 1), 0, heads, 9.0, 0.5, linear)
    pieces = [
        walked(
            Stream(3, 1, 1),
            k,
            {key: one[k : k + 3] for key, one in heads.items()},
            9.0,
            0.5,
            linear,
        )
        for k in (0, 3)
    ]

    for key, one in together.items():
        assert np.array_equal(one, np.concatenate([piece[key] for piece in pieces])), key
    assert (
        together["new"].reshape(6, -1)[:, 1:].all()
        and not together["new"].reshape(6, -1)[:, 0].any()
    )
    seeds = together["seed"].reshape(6, -1)
    assert 0.2 < np.mean(seeds[:, 1:] == seeds[:, :-1]) < 0.8  # half of them stay
    assert (
        walked(Stream(3, 1, 1, 7), 0, {**heads, "seed": 0 * heads["seed"] + 7}, 9.0, 0.5, linear)[
            "seed"
        ]
        == 7
    ).all()
    assert not np.array_equal(
        together["u"], walked(Stream(3, 2, 1), 0, heads, 9.0, 0.5, linear)["u"]
    )


def test_normals_become_the_variables_distributions(tmp_path: Path) -> None:
    text = RARE_SHORT.replace("[1.1, 1.4]", '[1.1, 1.4]\ndistribution = "log_uniform"')
    text = text.replace("[0.5, 0.7]", '[0.5, 0.7]\ndistribution = "normal"\ndeviation = 0.04')
    spec = read_spec(write_spec(tmp_path, text))
    u = normals(even_numbers(1, 0, 4000, 3))
    _, flux, inertia = shared(spec, u).T

    assert (
        np.abs(u.mean(axis=0)).max() < 5.0 / math.sqrt(4000.0)
        and np.abs(u.std(axis=0) - 1.0).max() < 0.05
    )
    assert np.log(flux) == pytest.approx(math.log(1.1) + ndtr(u[:, 1]) * math.log(1.4 / 1.1))
    cut = ndtr(-2.5)
    assert ndtr((inertia - 0.6) / 0.04) == pytest.approx(cut + ndtr(u[:, 2]) * (1.0 - 2.0 * cut))
    places = [place_of(one, value) for one, value in zip(spec.varied[1:], (flux[0], inertia[0]))]
    assert places == pytest.approx(ndtr(u[0, 1:]).tolist())


@pytest.fixture(scope="module")
def rare(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A short one on the simulator, by one worker."""
    path = tmp_path_factory.mktemp("rare")
    campaign(write_spec(path, RARE_SHORT), "--out", path / "out", "--workers", 1)
    return path / "out"


def test_workers_and_interruption_change_no_byte(rare: Path, tmp_path: Path) -> None:
    spec, out = write_spec(tmp_path, RARE_SHORT), tmp_path / "out"
    campaign(spec, "--out", out, "--workers", 2)
    assert parts(out) == parts(rare)
    (
        out / "parts" / "run-001-level-01-from-000002.parquet"
    ).unlink()  # as if killed before it was written
    for late in out.glob("parts/run-*-level-02-*"):
        late.unlink()
    lost = 18 + 54 * len({path.name[:16] for path in rare.glob("parts/run-*-level-02-*")})
    said = campaign(spec, "--out", out, "--workers", 1, "--resume")

    assert f"{lost} cases in" in said
    assert parts(out) == parts(rare)
    for name in ("summary.json", "levels.png"):
        assert (out / name).read_bytes() == (rare / name).read_bytes(), name


def test_summary_is_that_of_the_parts(rare: Path) -> None:
    said: Any = json.loads((rare / "summary.json").read_text())
    for number, run in enumerate(said["runs"]):
        above = math.inf
        for k, level in enumerate(run["levels"]):
            files = sorted(rare.glob(f"parts/run-{number:03d}-level-{k:02d}-*"))
            margin = np.concatenate([pq.read_table(file)["margin"].to_numpy() for file in files])
            assert len(margin) == 60 and (margin <= above).all()
            above = level["threshold"]
            assert level["share"] == np.mean(margin < above if above == 0.0 else margin <= above)
        assert above == 0.0 and run["end"] == "limit"
        assert run["probability"] == pytest.approx(
            math.prod(level["share"] for level in run["levels"])
        )
    assert said["below_limit"]["probability"] == pytest.approx(
        np.mean([run["probability"] for run in said["runs"]])
    )
    assert said["cases"] == sum(60 + 54 * (len(run["levels"]) - 1) for run in said["runs"])
    assert 0.0 < said["failed"]["probability"] <= said["below_limit"]["probability"] < 0.1


def test_probability_is_that_of_plain_cases(rare: Path, tmp_path: Path) -> None:
    """Compared with 1,000 freely drawn cases."""
    low, high = json.loads((rare / "summary.json").read_text())["below_limit"]["interval_95"]
    spec = read_spec(
        write_spec(
            tmp_path,
            RARE_SHORT.replace('"subset"\nmargin = "speed"\nrepeats = 2', '"random"')
            .replace("cases = 60", "cases = 1000")
            .replace("batch = 20", "batch = 1000"),
        )
    )
    share = float(np.mean(run_batch(spec, 0).table["speed_margin"].to_numpy() < 0.0))
    assert 0.0 < share and low < share < high


def test_rarest_cases_replay_to_the_bit(rare: Path, tmp_path: Path) -> None:
    tables = [pq.read_table(file) for file in rare.glob("parts/*.parquet")]
    rows = {row["case"]: row for table in tables for row in table.to_pylist()}
    files = sorted((rare / "worst").glob("*.toml"))
    assert len(files) == 3
    for file in files:
        out = tmp_path / "run.json"
        subprocess.run(
            [str(TOOLS / "sdre-sil"), "run", str(file), "--json", str(out)],
            check=False,
            capture_output=True,
        )
        said, row = json.loads(out.read_text()), rows[int(file.stem.split("_case_")[1])]
        assert said["seed"] == row["seed"] and (said["fault"] == "none") == (row["fault"] == 0)
        assert (
            said["measures"]["load_step"]["dip_e_radps"] == row["load_step.dip_e_radps"]
            or row["fault"]
        )


def test_what_nothing_leads_to_is_said_to_be_unknown(tmp_path: Path) -> None:
    """The current's margin is the noise's alone; a floor that is reached ends the search."""
    text = RARE_SHORT.replace("[0.6, 1.0]", "[0.9, 1.0]").replace("repeats = 2", "repeats = 1")
    stuck, floor = tmp_path / "stuck", tmp_path / "floor"
    one_motor = text.replace('"speed"', '"current"')
    for bounds, point in (("0.9, 1.0", 0.95), ("1.1, 1.4", 1.2), ("0.5, 0.7", 0.6)):
        assert bounds in one_motor
        one_motor = one_motor.replace(bounds, f"{point}, {point + 1e-6}")
    said = campaign(
        write_spec(stuck, one_motor),
        "--out",
        stuck / "out",
        "--workers",
        1,
        exit_code=0,
    )
    assert (
        "no slope leads further down" in said
        and not json.loads((stuck / "out/summary.json").read_text())["reached"]
    )
    said = campaign(
        write_spec(floor, text.replace("cases", "floor = 0.05\ncases")),
        "--out",
        floor / "out",
        "--workers",
        1,
        exit_code=0,
    )
    assert "less than 0.05 was not looked for" in said
    assert "less_than" in json.loads((floor / "out/summary.json").read_text())["below_limit"]


@pytest.mark.parametrize(
    "text, words",
    [
        (
            RARE_SHORT.replace("range = [0.6, 1.0]", "values = [1.0, 1.2]"),
            'values is not allowed with method = "subset"',
        ),
        (
            RARE_SHORT.replace("cases = 60", "cases = 64"),
            "cases = 64 is not allowed: must be a multiple of 10",
        ),
        (RARE_SHORT.replace("cases = 60", "floor = 0.5"), "floor = 0.5 is not allowed"),
        (RARE_SHORT.replace('"speed"', '"voltage"'), 'margin = "voltage" is not allowed'),
        (RARE_SHORT[: RARE_SHORT.index("[[variable]]")], "variable is missing"),
        (SHORT.replace("worst = 3", "floor = 1e-6"), "floor is not a known key"),
    ],
)
def test_wrong_specification_is_one_clear_line(text: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(sdre.InputError) as error:
        read_spec(write_spec(tmp_path, text))
    assert words in str(error.value) and "\n" not in str(error.value)


def test_names_of_parts() -> None:
    assert Chains(2, 3, 40, 20).name == "run-002-level-03-from-000040"
