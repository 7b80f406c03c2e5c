# SPDX-License-Identifier: MIT
"""Readings as a CSV or Parquet file."""

from __future__ import annotations

import csv
import json
import os
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, List

from sdre_drive.connection import DriveError
from sdre_drive.registers import Reading
from sdre_drive.scope import Capture

COLUMNS = (
    "time_s",
    "mode",
    "speed_e_radps",
    "iq_A",
    "id_A",
    "iq_ref_A",
    "id_ref_A",
    "vq_V",
    "vd_V",
    "dc_link_V",
    "temperature_degC",
    "conditions",
    "motor_heat",
    "inverter_heat",
    "derating",
)


def row(reading: Reading) -> Dict[str, Any]:
    """A reading's columns, and its fault."""
    values = {name: getattr(reading, name) for name in COLUMNS}
    return {**values, "fault": reading.why.fault, "drive_fault": reading.why.drive_fault}


def write_csv(path: Path, readings: Iterable[Reading]) -> int:
    """A line per reading as they come; how many."""
    count = 0
    try:
        with path.open("w", newline="", encoding="utf-8") as f:
            out = csv.DictWriter(f, fieldnames=[*COLUMNS, "fault", "drive_fault"])
            out.writeheader()
            for reading in readings:
                out.writerow(row(reading))
                f.flush()  # the readings stay, whatever happens
                count += 1
    except OSError as e:
        raise DriveError(f"{path}: {e.strerror}") from e
    return count


def write_capture(path: Path, capture: Capture) -> None:
    """Scope or record as a CSV file."""
    try:
        with path.open("w", newline="", encoding="utf-8") as f:
            out = csv.writer(f)
            out.writerow(["time_s", *capture.signals])
            for k, time_s in enumerate(capture.time_s):
                out.writerow([f"{time_s:.7g}", *(f"{v[k]:.7g}" for v in capture.values)])
    except OSError as e:
        raise DriveError(f"{path}: {e.strerror}") from e


def write_parquet(path: Path, readings: Iterable[Reading]) -> int:
    """All at once at the end; an earlier file stays until then."""
    try:
        import pyarrow as arrow
        import pyarrow.parquet as parquet
    except ImportError as e:
        raise DriveError(
            "--parquet needs pyarrow: pip install './host_tools/python[parquet]'"
        ) from e
    rows: List[Dict[str, Any]] = [row(r) for r in readings]
    with _beside(path) as part:
        parquet.write_table(arrow.Table.from_pylist(rows), part)
    return len(rows)


def write_json(path: Path, data: Any) -> None:
    """To a file, or with - to the terminal."""
    text = json.dumps(data, indent=1) + "\n"
    if str(path) == "-":
        sys.stdout.write(text)
    else:
        write_text(path, text)


def write_text(path: Path, text: str) -> None:
    """The whole file or none of it."""
    with _beside(path) as part:
        part.write_text(text)


def write_bytes(path: Path, octets: bytes) -> None:
    """The whole file or none of it."""
    with _beside(path) as part:
        part.write_bytes(octets)


@contextmanager
def _beside(path: Path) -> Iterator[Path]:
    """A file to write, which then takes the place of `path`."""
    beside = path.with_name(path.name + ".part")
    try:
        yield beside
        os.replace(beside, path)
    except OSError as e:
        raise DriveError(f"{path}: {e.strerror or e}") from e
