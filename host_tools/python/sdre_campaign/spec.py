# SPDX-License-Identifier: MIT
"""Specification of a campaign: read from TOML, every key checked."""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, Mapping, Optional, Tuple

import sdre
from sdre.cases import motor_variables
from sdre.scenario import LARGEST_SEED
from sdre.toml_text import plain, put, read_text, table
from sdre_campaign.keys import Keys

METHODS = ("random", "grid", "corners", "motors", "subset")
MARGINS = ("least", "speed", "current")
DISTRIBUTIONS = ("uniform", "log_uniform", "normal", "values")
#: Margins are always kept; these metrics too unless the specification names others.
METRICS = ("settling_time_s", "dip_e_radps", "ripple_e_radps")
#: Keys of [motor_ranges], of each of motor_variables().
MOTOR_RANGES = ("resistance", "inductance", "inductance", "flux", "inertia")
MOST_RARE = 1e-15  # further out a distribution function has no digits left below 1
MOST_CASES = LARGEST_SEED  # a case's number is its seed


@dataclass(frozen=True)
class Varied:
    """One variable of the campaign and how it is drawn."""

    variable: sdre.Variable
    distribution: str
    low: float
    high: float
    values: Tuple[float, ...] = ()  # of distribution "values"
    mean: float = 0.0  # of distribution "normal", cut at low and high
    deviation: float = 1.0
    points: int = 5  # of a grid


@dataclass(frozen=True)
class Spec:
    """A campaign. Case i is a function of `digest` and i alone, wherever it runs."""

    name: str
    method: str
    cases: int  # of subset: of one level
    seed: int
    batch: int  # cases of one task and of one part
    repeats: int  # of a grid: noise seeds at each of its points; of subset: independent runs
    fixed_seed: Optional[int]  # of the noise in every case; None: the case's number, from 1
    worst: int  # cases that are written as scenarios
    metrics: Tuple[str, ...]
    varied: Tuple[Varied, ...]
    scenario: Dict[str, Any]  # its keys, without what a run does not need
    drive_text: str
    drive_path: Path  # for the scenarios of the worst cases
    margin: str = "least"  # of subset: the one that leads; "least": the smaller one
    limit: float = 0.0  # of subset: how probable is a margin below it
    floor: float = 0.0  # of subset: less probable than this is not looked for

    def drive(self) -> sdre.Drive:
        """That all cases run with."""
        return sdre.Drive.from_text(self.drive_text, self.drive_path.name)

    def variables(self) -> Tuple[sdre.Variable, ...]:
        """In the order of the values."""
        return tuple(one.variable for one in self.varied)

    def digest(self) -> str:
        """Digest of everything that determines a case. The number of cases is not part of it."""
        said = {
            "tool": sdre.__version__,
            "method": self.method,
            "seed": self.seed,
            "batch": self.batch,
            "repeats": self.repeats,
            "fixed_seed": self.fixed_seed,
            "metrics": self.metrics,
            "scenario": self.scenario,
            "drive": self.drive().digest,
            "varied": [
                [
                    list(one.variable.keys),
                    one.variable.whole,
                    one.distribution,
                    one.low,
                    one.high,
                    one.values,
                    one.mean,
                    one.deviation,
                    one.points,
                ]
                for one in self.varied
            ],
        }
        if self.method == "subset":  # more runs and deeper levels keep those there are
            said.update(repeats=0, cases=self.cases, margin=self.margin, limit=self.limit)
        return "sha256:" + hashlib.sha256(json.dumps(said, sort_keys=True).encode()).hexdigest()


def read_spec(path: Path) -> Spec:
    """A specification file; its paths are relative to it. InputError in one line on anything
    wrong."""
    keys = Keys(table(read_text(path), str(path)), str(path))
    scenario_path = path.parent / keys.get("scenario", str)
    scenario = table(read_text(scenario_path), str(scenario_path))
    drive_path = _drive_path(keys, path, scenario_path, scenario)
    drive_text = read_text(drive_path)
    for key, value in keys.get("change", dict, {}).items():
        put(scenario, key, plain(value))
    method = keys.choice("method", METHODS, "random")
    varied = (
        _motors(scenario, scenario_path) if method == "motors" else _varied(keys, method, str(path))
    )
    repeats = keys.whole("repeats", 1, 1000000, 10 if method == "subset" else 1)
    spec = Spec(
        name=path.stem,
        method=method,
        cases=_cases(keys, method, varied, repeats),
        seed=keys.whole("seed", 0, LARGEST_SEED, 1),
        batch=keys.whole("batch", 1, 1000000, 1000),
        repeats=repeats,
        fixed_seed=_fixed_seed(keys),
        worst=keys.whole("worst", 0, 10000, 20),
        metrics=tuple(keys.words("metrics", list(METRICS))),
        varied=varied,
        scenario=_for_runs(scenario, method),
        drive_text=drive_text,
        drive_path=drive_path.resolve(),
        **_of_subset(keys, method),
    )
    keys.reject_unknown()
    cases = sdre.Cases(
        sdre.Scenario(spec.scenario, spec.drive()), spec.drive(), spec.variables(), spec.metrics
    )
    cases.check([one.low for one in varied])
    cases.check([one.high for one in varied])
    return spec


def _drive_path(keys: Keys, spec: Path, scenario_path: Path, scenario: Mapping[str, Any]) -> Path:
    named = str(keys.get("drive", str, ""))
    if named:
        return spec.parent / named
    if "drive" not in scenario:
        raise sdre.InputError(f"{spec}: drive is missing, and {scenario_path} names none")
    beside = scenario_path.parent / scenario["drive"]
    return beside if beside.exists() else Path(scenario["drive"])


def _for_runs(scenario: Dict[str, Any], method: str) -> Dict[str, Any]:
    """Without what only reports read: a worker need not have the files."""
    kept = {
        key: value
        for key, value in scenario.items()
        if key != "drive" and (key != "motor_ranges" or method == "motors")
    }
    kept["measure"] = [
        {key: value for key, value in measure.items() if key not in ("paper", "paper_of")}
        for measure in scenario.get("measure", [])
    ]
    return kept


def _fixed_seed(keys: Keys) -> Optional[int]:
    value = keys.whole("noise_seed", 0, LARGEST_SEED, -1) if keys.has("noise_seed") else -1
    return None if value < 0 else value


def _cases(keys: Keys, method: str, varied: Tuple[Varied, ...], repeats: int) -> int:
    if method in ("random", "motors"):
        return keys.whole("cases", 1, MOST_CASES)
    if method == "subset":
        if not varied:
            raise keys.fail("variable", "is missing")
        count = keys.whole("cases", 20, 1000000, 1000)
        if count % 10:
            raise keys.fail("cases", f"= {count} is not allowed: must be a multiple of 10")
        return count
    count = math.prod(points_of(one, method) for one in varied) * repeats
    if count > MOST_CASES:
        raise keys.fail(
            "variable", f"has {count} cases with repeats = {repeats}, must be at most {MOST_CASES}"
        )
    return count


def points_of(one: Varied, method: str) -> int:
    """Points of a grid along one variable."""
    if one.distribution == "values":
        return len(one.values)
    return 2 if method == "corners" else one.points


def _of_subset(keys: Keys, method: str) -> Dict[str, Any]:
    if method != "subset":
        return {}
    floor = keys.number("floor", 1e-9)
    if not MOST_RARE <= floor < 0.1:
        raise keys.fail("floor", f"= {floor} is not allowed: must be in {MOST_RARE} .. 0.1")
    return {
        "margin": keys.choice("margin", MARGINS, MARGINS[0]),
        "limit": keys.number("limit", 0.0),
        "floor": floor,
    }


def _motors(scenario: Mapping[str, Any], path: Path) -> Tuple[Varied, ...]:
    ranges = scenario.get("motor_ranges")
    if not isinstance(ranges, dict):
        raise sdre.InputError(f"{path}: [motor_ranges] is missing")
    try:
        return tuple(
            Varied(one, "uniform", float(ranges[key][0]), float(ranges[key][1]))
            for one, key in zip(motor_variables(), MOTOR_RANGES)
        )
    except (KeyError, IndexError, TypeError, ValueError) as error:
        raise sdre.InputError(
            f"{path}: [motor_ranges] must have a low and a high value of each of its keys"
        ) from error


def _varied(keys: Keys, method: str, source: str) -> Tuple[Varied, ...]:
    tables = keys.get("variable", list, [])
    varied = tuple(
        _one(Keys(one, f"{source}: [[variable]] number {n}"), method)
        for n, one in enumerate(tables, 1)
    )
    names = [one.variable.name for one in varied]
    if len(set(names)) < len(names):
        raise sdre.InputError(f"{source}: [[variable]] name is used twice")
    return varied


def _one(keys: Keys, method: str) -> Varied:
    variable = sdre.Variable(
        keys.get("name", str), tuple(keys.words("keys")), keys.get("whole", bool, False)
    )
    if not variable.keys:
        raise keys.fail("keys", "is empty")
    distribution = keys.choice(
        "distribution", DISTRIBUTIONS, "values" if keys.has("values") else "uniform"
    )
    points = keys.whole("points", 1, 100000, 5)
    if distribution == "values" and method == "subset":
        raise keys.fail(
            "values",
            'is not allowed with method = "subset": a slope leads to what is rare; give a range',
        )
    if distribution == "values":
        values = tuple(keys.numbers("values", 1))
        keys.reject_unknown()
        return Varied(variable, distribution, min(values), max(values), values, points=points)
    bounds = keys.numbers("range", 2)
    if (
        len(bounds) != 2
        or bounds[0] > bounds[1]
        or (distribution == "log_uniform" and bounds[0] <= 0.0)
    ):
        raise keys.fail(
            "range", f"= {bounds} is not allowed: must be [low, high], above 0 for log_uniform"
        )
    mean = keys.number("mean", 0.5 * sum(bounds)) if distribution == "normal" else 0.0
    deviation = keys.number("deviation") if distribution == "normal" else 1.0
    if deviation <= 0.0:
        raise keys.fail("deviation", f"= {deviation} is not allowed: must be above 0")
    if distribution == "normal" and method in ("grid", "corners"):
        raise keys.fail("distribution", f'= "normal" is not allowed with method = "{method}"')
    keys.reject_unknown()
    return Varied(variable, distribution, bounds[0], bounds[1], (), mean, deviation, points)
