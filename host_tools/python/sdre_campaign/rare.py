# SPDX-License-Identifier: MIT
"""Subset simulation on a cluster: level by level, all runs in parallel. The parts of a level
determine the next one."""

from __future__ import annotations

import math
from typing import List, Optional, Sequence, Tuple

import pyarrow as pa

from sdre_campaign.chains import MOST_LEVELS, Chains, run_chains
from sdre_campaign.parts import Directory
from sdre_campaign.spec import Spec
from sdre_campaign.subset import STEPS, FloatArray, Level, heads_of, judge, next_spread
from sdre_campaign.workers import Workers

# of the first chains' candidates: tried with the limit states of tests/python/test_campaign_rare.py
FIRST_SPREAD = 0.6
STUCK = 0.05  # share of the candidates: when fewer are taken a chain of ten is one sample


class Run:
    """One run, as far as it has come."""

    def __init__(self, spec: Spec, number: int) -> None:
        self.number = number
        self.levels: List[Level] = []
        self.margins: List[FloatArray] = []
        self.taken: List[float] = []  # share of the candidates, from level 1 on
        self.end = ""  # why there is no further level
        self._spec = spec
        self._heads: Optional[pa.Table] = None
        self._spread = FIRST_SPREAD

    def tasks(self) -> List[Chains]:
        """Tasks of the next level."""
        level = len(self.levels)
        if self._heads is None:
            return [Chains(self.number, level, first, count) for first, count in self._spans(level)]
        return [
            Chains(
                self.number,
                level,
                first,
                count,
                self._heads.slice(first, count),
                self.levels[-1].threshold,
                self._spread,
            )
            for first, count in self._spans(level)
        ]

    def table(self, directory: Directory, level: int) -> pa.Table:
        """All samples of a level that is there."""
        parts = [
            directory.read(Chains(self.number, level, first, count).name)
            for first, count in self._spans(level)
        ]
        return pa.concat_tables(parts).combine_chunks()

    def _spans(self, level: int) -> List[Tuple[int, int]]:
        """First and number of the samples, or chains, of each task."""
        per_row = 1 if level == 0 else STEPS
        count, size = self._spec.cases // per_row, max(1, self._spec.batch // per_row)
        return [(first, min(size, count - first)) for first in range(0, count, size)]

    def add(self, table: pa.Table) -> None:
        """The level's samples, chain after chain."""
        margin = table["margin"].to_numpy()
        level = judge(margin, self._spec.limit, bool(self.levels))
        if self.levels:
            self.taken.append(float(table["new"].to_numpy().reshape(-1, STEPS)[:, 1:].mean()))
            self._spread = next_spread(self._spread, self.taken[-1])
        before = self.levels[-1].threshold if self.levels else math.inf
        self.levels.append(level)
        self.margins.append(margin)
        self._heads = table.take(heads_of(margin))
        if level.is_last:
            self.end = "limit"
        elif self.probability() < self._spec.floor:
            self.end = "floor"
        elif (
            level.threshold >= before
            or (self.taken and self.taken[-1] < STUCK)
            or len(self.levels) == MOST_LEVELS
        ):
            self.end = "stuck"

    def probability(self) -> float:
        """Probability of a margin below the last threshold."""
        return math.prod(level.share for level in self.levels)


def walk(directory: Directory, runs: Sequence[Run], workers: Workers) -> None:
    """All runs to their ends. Parts that are there are read, not run."""
    total = 0
    while going := [run for run in runs if not run.end]:
        tasks = [task for run in going for task in run.tasks()]
        missing = [task for task in tasks if not directory.is_complete(task.name, task.rows)]
        total += sum(task.rows for task in tasks)
        workers.expect(total, total - sum(task.rows for task in missing))
        workers.run(run_chains, missing, lambda one: directory.write(one.task.name, one.table))
        for run in going:
            run.add(run.table(directory, len(run.levels)))
