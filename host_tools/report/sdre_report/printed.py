# SPDX-License-Identifier: MIT
"""The printed numbers of the papers. A number that no table shows is an error."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping

import tomllib


class Printed(Mapping[str, Any]):
    """A table of published.toml that knows which of its numbers were read."""

    def __init__(self, values: Dict[str, Any], name: str = "") -> None:
        self._name = name
        self._read: set = set()
        self._values = {
            k: Printed(v, f"{name}{k}.") if isinstance(v, dict) else v for k, v in values.items()
        }

    def __getitem__(self, key: str) -> Any:
        value = self._values[key]
        self._read.add(key)
        return value

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def unread(self) -> List[str]:
        """Full names of the unused numbers."""
        found: List[str] = []
        for key, value in self._values.items():
            if isinstance(value, Printed):
                found += value.unread()
            elif key not in self._read:
                found.append(self._name + key)
        return found


def read(path: Path = Path(__file__).parent / "published.toml") -> Printed:
    """The file beside this one."""
    with open(path, "rb") as file:
        return Printed(tomllib.load(file))
