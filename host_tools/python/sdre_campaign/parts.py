# SPDX-License-Identifier: MIT
"""The directory of a campaign: parts that are complete or not there, and what they belong to.

campaign.json             what the campaign is; a directory takes parts of this one alone
parts/part-000000.parquet a batch each, written beside its place, then renamed
sums/part-000000.sha256   its SHA-256, there before the part; a part that differs is computed again
parts/run-000-level-00-from-000000.parquet   in place of them with method = "subset"
summary.json, sensitivity.png, worst/*.toml   made of the parts, again and again
"""

from __future__ import annotations

import fcntl
import hashlib
import json
import logging
import os
from contextlib import suppress
from pathlib import Path
from typing import IO, Any, Dict, Iterator, List

import pyarrow as pa
import pyarrow.parquet as pq

import sdre
from sdre_campaign.batch import batches_of, span_of
from sdre_campaign.spec import Spec

_log = logging.getLogger(__name__)


class Directory:
    """Open for one client at a time; the lock goes with the process, however it ends."""

    def __init__(self, path: Path, spec: Spec, resume: bool) -> None:
        self.path, self.spec = path, spec
        self.parts, self._sums = path / "parts", path / "sums"
        try:
            self.parts.mkdir(parents=True, exist_ok=True)
            self._sums.mkdir(exist_ok=True)
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
            before = self._before(said)
            if before.get("digest") != self.spec.digest():
                raise sdre.InputError(
                    f"{self.path}: has parts of another campaign; give another directory"
                )
            if not resume:
                raise sdre.InputError(
                    f"{self.path}: has parts of this campaign; --resume goes on with them"
                )
        for directory in (self.parts, self._sums):
            for left in directory.glob(".*.tmp"):  # of a client that was killed while it wrote
                left.unlink()
        write_text(said, json.dumps(self._about(), indent=1) + "\n")

    def _before(self, said: Path) -> Dict[str, Any]:
        try:
            before = json.loads(said.read_text(encoding="utf-8"))
        except ValueError:
            before = None
        if not isinstance(before, dict):
            raise sdre.InputError(
                f"{said}: is damaged; delete it to start again there, or give another directory"
            )
        return before

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
        """Whether a part is there with all its rows, as it was written."""
        if not self._path(name).exists():
            return False
        try:
            return self.read(name).num_rows == rows
        except sdre.InputError:
            return False

    def write(self, name: str, table: pa.Table) -> None:
        """Complete or not there."""
        sink = pa.BufferOutputStream()
        pq.write_table(table, sink, compression="zstd")
        octets = sink.getvalue().to_pybytes()
        write_text(self._sum_path(name), hashlib.sha256(octets).hexdigest() + "\n")
        _write(self._path(name), octets)
        _log.info("%s: %d rows", self._path(name), table.num_rows)

    def read(self, name: str) -> pa.Table:
        """A part; InputError when it is not what was written."""
        path = self._path(name)
        try:
            octets = path.read_bytes()
            said = self._sum_path(name).read_text(encoding="ascii").strip()
            if hashlib.sha256(octets).hexdigest() != said:
                raise ValueError
            return pq.read_table(pa.BufferReader(octets))
        except (OSError, ValueError, pa.ArrowException) as error:
            raise sdre.InputError(f"{path}: is damaged; --resume computes it again") from error

    def tables(self) -> Iterator[pa.Table]:
        """All parts in the order of the cases, one in memory at a time."""
        for batch in range(batches_of(self.spec)):
            yield self.read(part_name(batch))

    def _path(self, name: str) -> Path:
        return self.parts / f"{name}.parquet"

    def _sum_path(self, name: str) -> Path:
        return self._sums / f"{name}.sha256"

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
    _write(path, text.encode())


def _write(path: Path, octets: bytes) -> None:
    beside = path.with_name(f".{path.name}.tmp")
    try:
        with open(beside, "wb") as file:
            file.write(octets)
            file.flush()
            os.fsync(file.fileno())
    except OSError:
        with suppress(OSError):
            beside.unlink()
        raise
    os.replace(beside, path)
    directory = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(directory)
    finally:
        os.close(directory)
