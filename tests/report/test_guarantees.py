# SPDX-License-Identifier: MIT
"""The guarantees: arithmetic that holds what it says it holds, models that are the tool's, and the
stored proof tried at random."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "host_tools/report")]

from sdre_report.guarantees import attraction, balls, compute, lyapunov, mu  # noqa: E402
from sdre_report.guarantees import stored as stored_file
from sdre_report.guarantees.loop import Factors, Loops, corners  # noqa: E402
from sdre_report.tools import Tools  # noqa: E402

GAINS = ROOT / "build/host/bin/sdre-gains"
built = pytest.mark.skipif(not GAINS.exists(), reason="sdre-gains is not built")


@pytest.fixture(scope="module")
def tools(tmp_path_factory: pytest.TempPathFactory) -> Tools:
    return Tools(GAINS.parent, tmp_path_factory.mktemp("data"), lambda _: None)


@pytest.fixture(scope="module")
def loops(tools: Tools) -> Loops:
    return Loops(tools.loops(stored_file.DRIVE))


def test_balls_hold_values_and_slopes() -> None:
    """x in a cell: 1/(x y) and e^[0 x; -y z], against plain arithmetic and differences at random
    places."""
    centre, radius = np.array([[0.7, 1.3, -0.2]]), np.array([[0.05, 0.1, 0.02]])
    x, y, z = balls.variables(centre, radius)
    quotient = (x * y).reciprocal()
    E = balls.exponential(balls.matrix([[0, x], [-y, z]]))
    draw = np.random.default_rng(1)
    plain = lambda p: expm(np.array([[0, p[0]], [-p[1], p[2]]]))  # noqa: E731
    for _ in range(300):
        p = centre[0] + radius[0] * draw.uniform(-1, 1, 3)
        assert abs(1 / (p[0] * p[1]) - quotient.m[0, 0]) <= quotient.r[0, 0]
        assert (np.abs(plain(p) - E.m[0, 0]) <= E.r[0, 0]).all()
        for k, step in enumerate(1e-6 * np.eye(3)):
            slope = (plain(p + step) - plain(p - step)) / 2e-6
            assert (np.abs(slope - E.m[0, 1 + k]) <= E.r[0, 1 + k] + 1e-8).all()
    assert E.r[0, 0].max() < 0.5, "the radii say nothing"
    x, y, z = balls.variables(centre, 0 * radius)
    exact = balls.exponential(balls.matrix([[0, x], [-y, z]]))
    assert exact.r[0, 0].max() < 1e-9 and np.abs(exact.m[0, 0] - plain(centre[0])).max() < 1e-13


@built
def test_the_model_of_mu_is_the_loop(loops: Loops) -> None:
    p = loops.box_points[1]
    middle = mu.modelled(loops, p, 1e-9, Factors())
    assert np.abs(middle - p.believed).max() < 1e-6 * np.abs(p.believed).max()
    ends = corners(0.5)
    for k in range(16):
        f = Factors(*(v[k] for v in ends))
        of = lambda M: np.abs(np.linalg.eigvals(M)).max()  # noqa: E731
        assert of(mu.modelled(loops, p, 0.5, f)) == pytest.approx(
            float(loops.radius(p, f)), abs=5e-3
        )


@built
def test_the_stored_function_falls_at_random_places(tools: Tools, loops: Loops) -> None:
    stored = stored_file.read(tools)["lyapunov"]
    loop, region = lyapunov.Loop(loops, tools.design(stored_file.DRIVE)), lyapunov.region_of(loops)
    draw, R = np.random.default_rng(2), np.array(stored["R"])
    k = draw.integers(0, len(region.low), 3000)
    ends = np.array(lyapunov.box(stored["share"]))
    at = np.hstack(
        [
            draw.uniform(ends[:, 0], ends[:, 1], (3000, 4)),
            draw.uniform(region.low[k], region.high[k]),
        ]
    )
    norm = np.linalg.norm(R @ loop.at(at, 0 * at).m[:, 0] @ np.linalg.inv(R), 2, axis=(-2, -1))
    assert norm.max() < stored["rate"] < 1.0
    assert norm.max() > 0.9, "too easy to be the loop"


@built
def test_inside_the_ellipsoid_it_falls_though_the_voltage_is_cut(loops: Loops) -> None:
    p = compute.pick(loops, 298, 0)
    room, _ = attraction.room_V(loops, p)
    A, B, F = attraction.matrices(loops, p)
    A, B, F = (
        A * attraction.SIZES / attraction.SIZES[:, None],
        B / attraction.SIZES[:, None] * room,
        F * attraction.SIZES / room,
    )
    W = attraction.search(A, B, F)
    draw = np.random.default_rng(3)
    x = draw.normal(size=(20000, 10))
    x = (np.linalg.cholesky(W) @ (x / np.linalg.norm(x, axis=1, keepdims=True)).T).T * draw.uniform(
        0, 1, (20000, 1)
    )
    u = x @ F.T
    after = x @ A.T - (u - np.clip(u, -1, 1)) @ B.T
    V = lambda s: np.einsum("ni,ij,nj->n", s, np.linalg.inv(W), s)  # noqa: E731
    assert (V(after) < V(x)).all()
    assert (np.abs(u).max(axis=1) > 1).mean() > 0.01, "nothing was cut"


def test_the_stored_file_is_whole() -> None:
    stored = json.loads(stored_file.FILE.read_text())
    assert stored["lyapunov"]["rate"] < 1.0 and stored["lyapunov"]["share"] >= 0.1
    for p in stored["shares"]:
        assert 0.4 < p["mu"] <= p["corners"] + 0.01 and p["corners"] <= p["drawn"] + 0.01
    for p in stored["attraction"]:
        assert (
            p["returned_square"] == 1.0
            and min(p["speed_e_radps"], p["iq_A"], p["id_A"], p["load_Nm"]) > 0
        )
