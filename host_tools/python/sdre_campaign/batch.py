# SPDX-License-Identifier: MIT
"""One task of a campaign: some thousand cases, in native code on one thread."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass
from typing import Any, Dict, Tuple

import numpy as np
import pyarrow as pa

import sdre
from sdre_campaign.draw import FloatArray, seeds_of, values_of
from sdre_campaign.spec import Spec

_kept = threading.local()  # the campaign's Cases on this thread: gains are solved once


@dataclass(frozen=True)
class Done:
    """Result of a task."""

    task: Any
    table: pa.Table
    wall_s: float  # in native code
    cpu_s: float
    cases: int  # that were run


def batches_of(spec: Spec) -> int:
    """How many there are."""
    return -(-spec.cases // spec.batch)


def span_of(spec: Spec, batch: int) -> Tuple[int, int]:
    """First case and number of cases."""
    first = batch * spec.batch
    return first, min(spec.batch, spec.cases - first)


def run_batch(spec: Spec, batch: int) -> Done:
    """Runs the cases of a batch."""
    cases = cases_of(spec)
    first, count = span_of(spec, batch)
    values = values_of(spec, first, count)
    seeds = seeds_of(spec, first, count)
    wall, cpu = time.perf_counter(), time.thread_time()
    result = cases.run(values, seeds)
    wall, cpu = time.perf_counter() - wall, time.thread_time() - cpu
    columns: Dict[str, Any] = {
        "case": np.arange(first, first + count, dtype=np.int64),
        "seed": seeds.astype(np.int64),
        **columns_of(cases, result, values),
    }
    return Done(batch, pa.table(columns), wall, cpu, count)


def columns_of(cases: sdre.Cases, result: sdre.CaseTable, values: FloatArray) -> Dict[str, Any]:
    """Columns of cases: judgement, margins, values, metrics."""
    columns: Dict[str, Any] = {
        "failed": result.failed,
        "fault": result.fault,
        "current_margin": result.current_margin,
        "speed_margin": result.speed_margin,
    }
    columns.update({f"value.{one.name}": values[:, k] for k, one in enumerate(cases.variables)})
    columns.update({name: result.metrics[:, k] for k, name in enumerate(cases.columns)})
    return columns


def cases_of(spec: Spec) -> sdre.Cases:
    """Cases of this thread."""
    digest = spec.digest()
    if getattr(_kept, "digest", None) != digest:
        drive = spec.drive()
        _kept.cases = sdre.Cases(
            sdre.Scenario(spec.scenario, drive), drive, spec.variables(), spec.metrics
        )
        _kept.digest = digest
    cases: sdre.Cases = _kept.cases
    return cases
