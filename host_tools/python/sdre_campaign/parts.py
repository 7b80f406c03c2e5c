# SPDX-License-Identifier: MIT
"""The directory of a campaign: parts that are complete or not there, and what they belong to.

campaign.json             what the campaign is; a directory takes parts of this one alone
parts/part-000000.parquet a batch each, written beside its place, then renamed
parts/run-000-level-00-from-000000.parquet   in place of them with method = "subset"
summary.json, sensitivity.png, worst/*.toml   made of the parts, again and again
"""

from __future__ import annotations

import fcntl
import json
import os
from pathlib import Path
from typing import IO, Any, Dict, Iterator, List

import pyarrow as pa
import pyarrow.parquet as pq

import sdre
from sdre_campaign.batch import batches_of, span_of
from sdre_campaign.spec import Spec


class Directory:
    """Open for one client at a time; the lock goes with the process, however it ends."""

    def __init__(self, path: Path, spec: Spec, resume: bool) -> None:
        self.path, self.spec = path, spec
        self.parts = path / "parts"
        try:
            self.parts.mkdir(parents=True, exist_ok=True)
            self._lock: IO[str] = open(path / "lock", "w", encoding="utf-8")
        except OSError as error:
            raise sdre.InputError(f"{path}: cannot be written: {error.strerror}") from error
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise sdre.InputError(f"{path}: another campaign is writing there") from error
        self._claim(resume)

    def _claim(self, resume: bool) -> None:
        said = self.path / "campaign.json"
        if said.exists():
            before = json.loads(said.read_text(encoding="utf-8"))
            if before.get("digest") != self.spec.digest():
                raise sdre.InputError(
                    f"{self.path}: has parts of another campaign; give another directory"
                )
            if not resume:
                raise sdre.InputError(
                    f"{self.path}: has parts of this campaign; --resume goes on with them"
                )
        for left in self.parts.glob(".*.tmp"):  # of a client that was killed while it wrote
            left.unlink()
        write_text(said, json.dumps(self._about(), indent=1) + "\n")

    def _about(self) -> Dict[str, Any]:
        spec, drive = self.spec, self.spec.drive()
        variables = [
            {
                "name": one.variable.name,
                "distribution": one.distribution,
                "low": one.low,
                "high": one.high,
            }
            for one in spec.varied
        ]
        return {
            "name": spec.name,
            "digest": spec.digest(),
            "method": spec.method,
            "cases": spec.cases,
            "batch": spec.batch,
            "variables": variables,
            "drive": drive.name,
            "drive_digest": drive.digest,
            "tool": sdre.__version__,
        }

    def missing(self) -> List[int]:
        """Batches that have no part."""
        count = batches_of(
            self.spec
        )  # the last part of a campaign that had fewer cases is not complete
        return [
            batch
            for batch in range(count)
            if not self.is_complete(part_name(batch), span_of(self.spec, batch)[1])
        ]

    def is_complete(self, name: str, rows: int) -> bool:
        """Whether a part is there with all its rows."""
        path = self._path(name)
        if not path.exists():
            return False
        try:
            return bool(pq.read_metadata(path).num_rows == rows)
        except (pa.ArrowException, OSError):
            return False

    def write(self, name: str, table: pa.Table) -> None:
        """Complete or not there."""
        path = self._path(name)
        beside = path.with_name(f".{path.name}.tmp")
        pq.write_table(table, beside, compression="zstd")
        _put_in_place(beside, path)

    def read(self, name: str) -> pa.Table:
        """A part."""
        return pq.read_table(self._path(name))

    def tables(self) -> Iterator[pa.Table]:
        """All parts in the order of the cases, one in memory at a time."""
        for batch in range(batches_of(self.spec)):
            yield self.read(part_name(batch))

    def _path(self, name: str) -> Path:
        return self.parts / f"{name}.parquet"

    def close(self) -> None:
        """Another client may come."""
        self._lock.close()

    def __enter__(self) -> Directory:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()


def part_name(batch: int) -> str:
    """Name of a batch's part."""
    return f"part-{batch:06d}"


def write_text(path: Path, text: str) -> None:
    """Complete or as it was."""
    beside = path.with_name(f".{path.name}.tmp")
    beside.write_text(text, encoding="utf-8")
    _put_in_place(beside, path)


def _put_in_place(beside: Path, path: Path) -> None:
    with open(beside, "rb+") as file:
        os.fsync(file.fileno())
    os.replace(beside, path)
    directory = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(directory)
    finally:
        os.close(directory)
