# SPDX-License-Identifier: MIT
"""Drive files: the only place where a motor number is written."""

from __future__ import annotations

import copy
from dataclasses import dataclass
from typing import Any, Dict, Mapping

from sdre import _native
from sdre.toml_text import PathLike, put, read_text, table, written


@dataclass(frozen=True)
class Motor:
    """A drive's [motor]. Currents and flux are peak values of a phase (amplitude-invariant)."""

    pole_pairs: int
    stator_resistance_Ohm: float
    d_axis_inductance_H: float
    q_axis_inductance_H: float
    pm_flux_Wb: float
    inertia_kgm2: float
    viscous_friction_Nms: float
    rated_speed_e_radps: float
    rated_torque_Nm: float
    max_current_A: float


class Drive:
    """One drive: motor, inverter, encoder, control law and weights. Made by from_toml, from_text or
    from_dict; never changes.

    Every value is checked as `sdre-gains` checks it: InputError in one line names source, key,
    value and what is allowed.
    """

    def __init__(self, text: str, source: str) -> None:
        self._text = text
        self._source = source
        self._native = _native.read_drive(text, source)

    @classmethod
    def from_toml(cls, path: PathLike) -> Drive:
        """From a drive file, as in firmware/config/drives."""
        return cls(read_text(path), str(path))

    @classmethod
    def from_text(cls, text: str, source: str = "drive") -> Drive:
        """From the text of a drive file; `source` names it in messages."""
        return cls(text, source)

    @classmethod
    def from_dict(cls, values: Mapping[str, Any], source: str = "drive") -> Drive:
        """From the keys of a drive file: {"schema": 1, "name": .., "motor": {..}, ..}."""
        return cls(written(values, source), source)

    def to_dict(self) -> Dict[str, Any]:
        """The keys of the drive file, a copy."""
        return copy.deepcopy(table(self._text, self._source))

    def replaced(self, values: Mapping[str, Any]) -> Drive:
        """Another drive with some keys changed: {"motor.inertia_kgm2": 1e-3, "nosc.order": 1}."""
        keys = self.to_dict()
        for path, value in values.items():
            put(keys, path, value)
        return Drive.from_dict(keys, self._source)

    @property
    def text(self) -> str:
        """The drive file."""
        return self._text

    @property
    def name(self) -> str:
        """Name in the drive file."""
        return str(self._native.name)

    @property
    def law(self) -> str:
        """The control law: noc, noc_h, noc_shaft, noc_iron, conventional_noc, cdobc, gpiobc, hdobc,
        pid, pi_foc or ladrc."""
        return str(self._native.law)

    @property
    def digest(self) -> str:
        """Digest of every value, independent of the file's layout: "fnv1a64:.."."""
        return str(self._native.digest)

    @property
    def control_period_s(self) -> float:
        """1 / (pwm_frequency_Hz updates_per_period)."""
        return float(self._native.control_period_s)

    @property
    def trip_speed_e_radps(self) -> float:
        """Where the drive trips, electrical."""
        return float(self._native.trip_speed_e_radps)

    @property
    def dc_link_V(self) -> float:
        """The supply."""
        return float(self._native.dc_link_V)

    @property
    def motor(self) -> Motor:
        """The motor's numbers."""
        numbers = dict(self._native.motor)
        return Motor(pole_pairs=int(numbers.pop("pole_pairs")), **numbers)

    def __repr__(self) -> str:
        return f"Drive({self.name!r}, law={self.law!r}, {self.digest})"

    def __reduce__(self) -> Any:
        return (Drive, (self._text, self._source))
