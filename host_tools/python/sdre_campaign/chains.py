# SPDX-License-Identifier: MIT
"""One task of subset simulation: free samples of the first level, or some chains of a later one,
from their heads to their ends.

A sample is a standard normal for each variable and the seed of its noise. A chain's candidate is
rho u + sqrt(1 - rho^2) z (preconditioned Crank-Nicolson). It is as likely as u, so it is accepted
when it is below the threshold; otherwise the chain stays. It keeps its seed half of the times. The
chain can then follow a slope in the variables with the same noise, and can change the noise too.
All numbers come from counters (Philox): a chain is the same in any task and at any worker.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Optional

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from sdre.scenario import LARGEST_SEED
from sdre_campaign.batch import Done, cases_of, columns_of
from sdre_campaign.draw import even_numbers, shared
from sdre_campaign.spec import Spec
from sdre_campaign.subset import STEPS, FloatArray

State = Dict[
    str, NDArray[Any]
]  # arrays of the same length: "u" (n x variables), "seed", "margin" and what goes with them
Limit = Callable[
    [FloatArray, NDArray[np.uint64]], State
]  # what is found for each u and seed, with "margin"

MOST_LEVELS = 100  # of a run; numbers of samples and of streams leave room for so many
_KEEP, _SEED = -2, -1  # columns of what is drawn: whether the seed stays, and the new one
_SAMPLE_KEYS = ("new", "case", "u")


@dataclass(frozen=True)
class Chains:
    """A task, and the part that it makes."""

    run: int
    level: int
    first: int  # chain; of level 0 sample
    count: int
    heads: Optional[pa.Table] = None  # none at level 0
    threshold: float = 0.0
    spread: float = 1.0

    @property
    def name(self) -> str:
        """Name of the part."""
        return f"run-{self.run:03d}-level-{self.level:02d}-from-{self.first:06d}"

    @property
    def rows(self) -> int:
        """Rows of the part."""
        return self.count if self.level == 0 else self.count * STEPS


@dataclass(frozen=True)
class Stream:
    """Where the numbers of a level come from."""

    seed: int
    run: int
    level: int
    fixed_seed: Optional[int] = None

    def numbers(self, first: int, count: int, variables: int) -> FloatArray:
        """count x (variables + 2); stream 0 is that of the other methods."""
        return even_numbers(
            self.seed, first, count, variables + 2, 1 + self.run * MOST_LEVELS + self.level
        )

    def noise(self, numbers: FloatArray) -> NDArray[np.uint64]:
        """Seeds, one for each row."""
        if self.fixed_seed is not None:
            return np.full(len(numbers), self.fixed_seed, dtype=np.uint64)
        return 1 + (numbers[:, _SEED] * LARGEST_SEED).astype(np.uint64)


def normals(numbers: FloatArray) -> FloatArray:
    """Standard normals of evenly distributed numbers in 0 .. 1."""
    from scipy.special import ndtri

    found: FloatArray = ndtri(np.maximum(numbers, 2.0**-54))
    return found


def drawn(stream: Stream, first: int, count: int, variables: int, limit: Limit) -> State:
    """Samples of the first level."""
    numbers = stream.numbers(first, count, variables)
    u, seed = normals(numbers[:, :variables]), stream.noise(numbers)
    return {**limit(u, seed), "u": u, "seed": seed, "new": np.full(count, True)}


def walked(
    stream: Stream, first: int, heads: State, threshold: float, spread: float, limit: Limit
) -> State:
    """Chains from these heads, chain after chain; a row whose candidate was not taken is the row
    before it again."""
    state = {**heads, "new": np.full(len(heads["seed"]), False)}
    count, variables = state["u"].shape
    rows = [state]
    every = stream.numbers(first * STEPS, count * STEPS, variables).reshape(count, STEPS, -1)
    for step in range(1, STEPS):
        numbers = every[:, step]
        u = np.sqrt(1.0 - spread**2) * state["u"] + spread * normals(numbers[:, :variables])
        seed = np.where(numbers[:, _KEEP] < 0.5, state["seed"], stream.noise(numbers))
        found = {**limit(u, seed), "u": u, "seed": seed}
        taken = found["margin"] <= threshold
        state = {
            key: np.where(taken if one.ndim == 1 else taken[:, None], one, state[key])
            for key, one in found.items()
        }
        state["new"] = taken
        rows.append(state)
    return {
        key: np.stack([row[key] for row in rows], axis=1).reshape(-1, *rows[0][key].shape[1:])
        for key in rows[-1]
    }


def run_chains(spec: Spec, task: Chains) -> Done:
    """The task, simulated."""
    cases = cases_of(spec)
    wall_s = cpu_s = 0.0

    def limit(u: FloatArray, seed: NDArray[np.uint64]) -> State:
        nonlocal wall_s, cpu_s
        values = shared(spec, u)
        wall, cpu = time.perf_counter(), time.thread_time()
        result = cases.run(values, seed)
        wall_s += time.perf_counter() - wall
        cpu_s += time.thread_time() - cpu
        both = {"speed": result.speed_margin, "current": result.current_margin}
        leads = both.get(spec.margin, np.minimum(result.speed_margin, result.current_margin))
        return {**columns_of(cases, result, values), "margin": leads}

    stream = Stream(spec.seed, task.run, task.level, spec.fixed_seed)
    if task.heads is None:
        state = drawn(stream, task.first, task.count, len(spec.varied), limit)
    else:
        state = walked(
            stream, task.first, state_of(task.heads, spec), task.threshold, task.spread, limit
        )
    first = task.first * (1 if task.heads is None else STEPS)
    case = (task.run * MOST_LEVELS + task.level) * spec.cases + np.arange(
        first, first + task.rows, dtype=np.int64
    )
    runs = task.rows if task.heads is None else task.rows - task.count  # heads are there already
    return Done(task, table_of(state, case, spec), wall_s, cpu_s, runs)


def table_of(state: State, case: NDArray[np.int64], spec: Spec) -> pa.Table:
    """As it is kept."""
    columns: Dict[str, Any] = {
        "case": case,
        "new": state["new"],
        "seed": state["seed"].astype(np.int64),
    }
    columns.update({key: one for key, one in state.items() if key not in (*_SAMPLE_KEYS, "seed")})
    columns.update(
        {f"normal.{one.variable.name}": state["u"][:, k] for k, one in enumerate(spec.varied)}
    )
    return pa.table(columns)


def state_of(table: pa.Table, spec: Spec) -> State:
    """As it is computed with."""
    names: List[str] = [f"normal.{one.variable.name}" for one in spec.varied]
    state: State = {
        key: table[key].to_numpy()
        for key in table.column_names
        if key not in (*_SAMPLE_KEYS, *names)
    }
    state["seed"] = state["seed"].astype(np.uint64)
    state["u"] = np.stack([table[name].to_numpy() for name in names], axis=1)
    return state
