# SPDX-License-Identifier: MIT
"""Runs sdre-sil and sdre-gains and reads what they write: CSV traces and JSON."""

from __future__ import annotations

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Dict, Optional, Sequence

import numpy as np
import tomllib

ROOT = Path(__file__).resolve().parents[3]
SCENARIOS = ROOT / "host_tools/sil/scenarios"
DRIVES = ROOT / "firmware/config/drives"
FAULTED = 4  # exit code of sdre-sil: it ran, and a drive tripped
REFUSED = 2  # of sdre-gains: the certificate is refused, the report is there


class ReportError(Exception):
    """One line for the user."""


def read_toml(path: Path) -> Dict[str, Any]:
    """One TOML file."""
    with open(path, "rb") as file:
        return tomllib.load(file)


@dataclass(frozen=True)
class Run:
    """One scenario with one drive."""

    trace: Dict[str, np.ndarray]  # a column each
    result: Dict[str, Any]  # the JSON of the run

    def measure(self, name: str) -> Dict[str, Any]:
        """The metrics of one measure."""
        return self.result["measures"][name]


class Tools:
    """The programs, and the directory that keeps what they wrote."""

    def __init__(self, binaries: Path, data: Path, tell: Callable[[str], None]) -> None:
        self._binaries, self._data, self.tell = binaries, data, tell
        data.mkdir(parents=True, exist_ok=True)

    def _call(self, program: str, arguments: Sequence[str], accepted: Sequence[int]) -> str:
        path = self._binaries / program
        if not path.exists():
            raise ReportError(f"{path} is not there: ./dev build")
        done = subprocess.run([str(path), *arguments], capture_output=True, text=True, check=False)
        if done.returncode not in (0, *accepted):
            raise ReportError(
                f"{program} {' '.join(arguments)}: exit code {done.returncode}: "
                f"{done.stderr.strip()}"
            )
        return done.stdout

    def _simulate(self, scenario: Path, drive: str, *options: str) -> None:
        file = str(DRIVES / f"{drive}.toml")
        self._call("sdre-sil", ["run", str(scenario), "--drive", file, *options], [FAULTED])

    def run(
        self, scenario: str, drive: str, changes: Optional[Dict[str, str]] = None, name: str = ""
    ) -> Run:
        """One run; `changes` replaces text in the scenario, each exactly once."""
        name = name or f"{scenario}-{drive}"
        self.tell(f"{name}")
        path = SCENARIOS / f"{scenario}.toml"
        if changes:
            path = self._changed(path, changes, name)
        csv, result = self._data / f"{name}.csv", self._data / f"{name}.json"
        self._simulate(path, drive, "--csv", str(csv), "--json", str(result))
        return Run(read_trace(csv), json.loads(result.read_text()))

    def seeds(self, scenario: str, drive: str, count: int, name: str = "") -> Dict[str, Any]:
        """Worst and mean over seeds: {measure: {metric: {worst, mean, ..}}}."""
        name = name or f"{scenario}-{drive}-seeds"
        self.tell(name)
        result = self._data / f"{name}.json"
        path = SCENARIOS / f"{scenario}.toml"
        self._simulate(path, drive, "--seeds", str(count), "--json", str(result))
        return json.loads(result.read_text())

    def spectrum(self, scenario: str, drive: str) -> Dict[str, np.ndarray]:
        """Spectrum of the speed error: {measure: [[Hz, r/min]..]}."""
        name = f"{scenario}-{drive}-spectrum"
        self.tell(name)
        csv = self._data / f"{name}.csv"
        self._simulate(SCENARIOS / f"{scenario}.toml", drive, "--spectrum", str(csv))
        found: Dict[str, list] = {}
        for line in csv.read_text().splitlines()[1:]:
            measure, *numbers = line.split(",")
            found.setdefault(measure, []).append([float(x) for x in numbers])
        return {measure: np.array(rows) for measure, rows in found.items()}

    def design(self, drive: str) -> Dict[str, Any]:
        """The report of a drive file."""
        self.tell(f"design of {drive}")
        text = self._call(
            "sdre-gains", ["report", str(DRIVES / f"{drive}.toml"), "--json"], [REFUSED]
        )
        (self._data / f"design-{drive}.json").write_text(text)
        return json.loads(text)

    def loops(self, drive: str) -> Dict[str, Any]:
        """The matrices of its sampled loop."""
        self.tell(f"loops of {drive}")
        file = self._data / f"loops-{drive}.json"
        self._call(
            "sdre-gains", ["report", str(DRIVES / f"{drive}.toml"), "--loops", str(file)], []
        )
        return json.loads(file.read_text())

    def _changed(self, path: Path, changes: Dict[str, str], name: str) -> Path:
        text = path.read_text()
        for old, new in {'drive = "../../../': f'drive = "{ROOT}/', **changes}.items():
            if text.count(old) != 1:
                raise ReportError(
                    f"{path.name}: {old!r} stands there {text.count(old)} times, not once"
                )
            text = text.replace(old, new)
        changed = self._data / f"{name}.toml"
        changed.write_text(text)
        return changed


def read_trace(csv: Path) -> Dict[str, np.ndarray]:
    """A column for each name in the first line."""
    with open(csv, encoding="ascii") as file:
        names = file.readline().strip().split(",")
        rows = np.loadtxt(file, delimiter=",", ndmin=2)
    return {name: rows[:, i] for i, name in enumerate(names)}
