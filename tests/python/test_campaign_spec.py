# SPDX-License-Identifier: MIT
"""Campaigns: what a specification says, and the values that are drawn for it."""

from __future__ import annotations

import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from test_campaign import SHORT, write_spec
from test_sdre import SCENARIOS

import sdre
from sdre_campaign.batch import run_batch
from sdre_campaign.draw import even_numbers, seeds_of, values_of
from sdre_campaign.spec import Spec, read_spec
from sdre_campaign.summary import clopper_pearson

ROOT = Path(__file__).resolve().parents[2]
CAMPAIGNS = sorted((ROOT / "host_tools/python/campaigns").glob("*.toml"))


@pytest.mark.parametrize("file", CAMPAIGNS, ids=lambda file: file.stem)
def test_shipped_specification_is_read(file: Path) -> None:
    assert read_spec(file).cases >= 490


def test_map_of_the_docs_prints_the_worst_points(tmp_path: Path) -> None:
    plane = next(file for file in CAMPAIGNS if file.stem == "ipmsm_390w_plane")
    spec = replace(read_spec(plane), repeats=1, cases=49, batch=49)
    parts = tmp_path / "build/campaigns/plane/parts"
    parts.mkdir(parents=True)
    pq.write_table(run_batch(spec, 0).table, parts / "part-000000.parquet")
    page = (ROOT / "docs/campaign.md").read_text(encoding="utf-8")
    block = page[page.index("## A map") :].split("```python\n")[1].split("```")[0]
    done = subprocess.run(
        [sys.executable, "-c", block], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    found = re.findall(r"^(v[qd]): ([0-9.]+) V rms at \d+ rad/s", done.stdout, flags=re.M)
    assert [name for name, _ in found] == ["vq", "vd"]
    assert [float(value) for _, value in found] == pytest.approx([6.5, 3.2], rel=0.2)


def test_case_is_the_same_in_any_batch() -> None:
    together = even_numbers(7, 0, 1000, 5)
    pieces = np.vstack([even_numbers(7, first, 250, 5) for first in range(0, 1000, 250)])

    assert np.array_equal(together, pieces)
    assert ((together >= 0.0) & (together < 1.0)).all()
    assert abs(together.mean() - 0.5) < 5.0 / np.sqrt(12.0 * 5000.0)
    assert np.abs(np.corrcoef(together.T) - np.eye(5)).max() < 5.0 / np.sqrt(1000.0)
    assert not np.array_equal(together, even_numbers(8, 0, 1000, 5))
    assert len(np.unique(together)) == together.size


def test_noise_seed_is_the_number_of_the_case(tmp_path: Path) -> None:
    spec = read_spec(write_spec(tmp_path))

    assert seeds_of(spec, 20, 3).tolist() == [21, 22, 23]
    assert seeds_of(replace(spec, fixed_seed=4), 20, 3).tolist() == [4, 4, 4]


def drawn(tmp_path: Path, method: str, *variables: str) -> Spec:
    """A campaign with these variables of the load."""
    head = f'scenario = "{SCENARIOS}/board_load_step.toml"\nmethod = "{method}"\n' + (
        "cases = 4000\n" if method == "random" else ""
    )
    keys = ["load_torque.1.value_Nm", "plant_scale.inertia_kgm2", "sensors.adc_bits"]
    text = "".join(
        f'[[variable]]\nname = "{key}"\nkeys = ["{key}"]\n{one}\n'
        for key, one in zip(keys, variables)
    )
    return read_spec(write_spec(tmp_path, head + text))


def test_grid_and_corners_have_every_combination(tmp_path: Path) -> None:
    grid = drawn(
        tmp_path,
        "grid",
        "range = [1.0, 2.0]\npoints = 3",
        'range = [0.5, 2.0]\ndistribution = "log_uniform"\npoints = 3',
        "values = [10, 12]\nwhole = true",
    )
    corners = drawn(tmp_path, "corners", "range = [1.0, 2.0]", "range = [0.5, 2.0]")

    assert grid.cases == 18 and corners.cases == 4
    assert values_of(grid, 0, 3).tolist() == [[1.0, 0.5, 10.0], [1.0, 0.5, 12.0], [1.0, 1.0, 10.0]]
    assert len(np.unique(values_of(grid, 0, 18), axis=0)) == 18
    assert np.array_equal(values_of(grid, 5, 13), values_of(grid, 0, 18)[5:])
    assert values_of(corners, 0, 4).tolist() == [[1.0, 0.5], [1.0, 2.0], [2.0, 0.5], [2.0, 2.0]]
    twice = replace(corners, repeats=2, cases=8)
    assert values_of(twice, 2, 2).tolist() == [[1.0, 2.0], [1.0, 2.0]]


def test_distributions_are_what_they_say(tmp_path: Path) -> None:
    spec = drawn(
        tmp_path,
        "random",
        'range = [0.0, 3.0]\ndistribution = "normal"\nmean = 1.0\ndeviation = 0.5',
        'range = [0.1, 10.0]\ndistribution = "log_uniform"',
        "values = [10, 12, 14]\nwhole = true",
    )
    load, inertia, bits = values_of(spec, 0, spec.cases).T
    error = 5.0 / np.sqrt(spec.cases)

    # A normal distribution cut at -2 and +4 deviations: mean 1 + 0.5 (phi(-2) - phi(4)) / (Phi(4) -
    # Phi(-2)).
    assert load.mean() == pytest.approx(
        1.0 + 0.5 * (0.05399097 - 0.00013383) / (0.99996833 - 0.02275013), abs=0.5 * error
    )
    assert 0.0 <= load.min() and load.max() <= 3.0
    assert np.log10(inertia).mean() == pytest.approx(0.0, abs=0.6 * error)
    assert [float(np.mean(bits == value)) for value in (10, 12, 14)] == pytest.approx(
        [1.0 / 3.0] * 3, abs=0.5 * error
    )


def test_interval_is_that_of_the_books() -> None:
    # Clopper and Pearson's table and the rule of three's exact form.
    assert clopper_pearson(0, 100) == pytest.approx((0.0, 1.0 - 0.025**0.01))
    assert clopper_pearson(3, 20) == pytest.approx((0.0320709, 0.3789268), abs=1e-6)
    assert clopper_pearson(20, 20) == pytest.approx((0.025**0.05, 1.0))


@pytest.mark.parametrize(
    "text, words",
    [
        (SHORT.replace("cases = 240", "cases = 0"), "cases = 0 is not allowed: must be in 1"),
        (SHORT.replace("cases = 240\n", ""), "cases is missing"),
        (SHORT.replace('"random"', '"sobol"'), 'method = "sobol" is not allowed'),
        (SHORT.replace("worst = 3", "wurst = 3"), "wurst is not a known key"),
        (SHORT.replace("board_random_motors", "nowhere"), "cannot be read"),
        (SHORT.replace("load_torque.1.value_Nm", "load_torque.9.value_Nm"), "leads nowhere"),
        (SHORT.replace('name = "load"', 'name = "flux"'), "name is used twice"),
        (SHORT.replace("[0.5, 2.5]", "[2.5, 0.5]"), "must be [low, high]"),
        (SHORT.replace("worst = 3", 'metrics = ["speed"]'), "not the name of a metric"),
        (SHORT.replace("batch = 20", "batch = true"), "batch = True is not allowed"),
        (SHORT.replace("duration_s = 0.12", "duration_s = -1.0"), "duration_s = -1 is not allowed"),
        ("scenario = ", "not valid TOML"),
    ],
)
def test_wrong_specification_is_one_clear_line(text: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(sdre.InputError) as error:
        read_spec(write_spec(tmp_path, text))
    assert words in str(error.value) and "\n" not in str(error.value)
