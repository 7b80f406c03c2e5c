# SPDX-License-Identifier: MIT
"""Scenarios: closed-loop experiments, the files of host_tools/sil/scenarios or dictionaries with
their keys."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any, Dict, Mapping, Optional, Union

from sdre import _native
from sdre.drive import Drive
from sdre.toml_text import put, read_text, table, written

LARGEST_SEED = 2147483647


class Scenario:
    """The events of a run: speeds, load, sensors, inverter, changes, faults, measures. Immutable.

    `source` is a scenario file, or a mapping with its keys (docs/files.md). `drive` is run in place
    of the one that the file names; a mapping without "drive" needs it. Paths in a mapping are
    relative to the working directory. InputError in one line on anything wrong.
    """

    def __init__(
        self,
        source: Union[str, Path, Mapping[str, Any]],
        drive: Optional[Drive] = None,
        seed: Optional[int] = None,
    ) -> None:
        if isinstance(source, Mapping):
            self.source, self.name, self.directory = "scenario", "scenario", Path()
            self.text = written(source, self.source)
        else:
            path = Path(source)
            self.source, self.name, self.directory = str(path), path.stem, path.parent
            self.text = read_text(path)
        self._native = _native.read_scenario(
            self.text, self.source, self.name, str(self.directory), drive._native if drive else None
        )
        if seed is not None:
            if not 0 <= seed <= LARGEST_SEED:
                raise _native.InputError(
                    f"seed = {seed} is not allowed: must be in 0 .. {LARGEST_SEED}"
                )
            self._native.seed = seed

    @property
    def seed(self) -> int:
        """Seed of every random draw: noise, disc, rotor angle."""
        return int(self._native.seed)

    @property
    def duration_s(self) -> float:
        """Simulated time."""
        return float(self._native.duration_s)

    @property
    def initial_speed_e_radps(self) -> float:
        """At the start, electrical."""
        return float(self._native.initial_speed_e_radps)

    def to_dict(self) -> Dict[str, Any]:
        """The keys, a copy."""
        return copy.deepcopy(table(self.text, self.source))

    def drive_path(self) -> Optional[Path]:
        """The drive file that the scenario names."""
        named = self.to_dict().get("drive")
        if named is None:
            return None
        beside = self.directory / named
        return beside if beside.exists() else Path(named)


def changed(
    source: Union[str, Path, Mapping[str, Any]], values: Mapping[str, Any]
) -> Dict[str, Any]:
    """A scenario's keys with some changed: {"plant_scale.inertia_kgm2": 2.0,
    "load_torque.1.value_Nm": 1.0}.

    The drive's path becomes absolute, so that the result can stand anywhere.
    """
    scenario_keys = (
        dict(source) if isinstance(source, Mapping) else table(read_text(source), str(source))
    )
    keys = copy.deepcopy(scenario_keys)
    if not isinstance(source, Mapping) and "drive" in keys:
        beside = Path(source).parent / keys["drive"]
        keys["drive"] = str((beside if beside.exists() else Path(keys["drive"])).resolve())
    for path, value in values.items():
        put(keys, path, value)
    return keys
