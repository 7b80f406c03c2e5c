# SPDX-License-Identifier: MIT
"""A table of TOML, read key by key: every error is one line."""

from __future__ import annotations

import math
from typing import Any, List, Mapping, Optional, Set, Tuple

import sdre


class Keys:
    """A table of the specification, read key by key."""

    def __init__(self, keys: Mapping[str, Any], where: str) -> None:
        self._keys, self._where = keys, where
        self._known: Set[str] = set()

    def fail(self, key: str, what: str) -> sdre.InputError:
        """The error in one line."""
        return sdre.InputError(f"{self._where}: {key} {what}")

    def get(self, key: str, kind: Any, default: Any = None) -> Any:
        """A value of a kind; missing without a default is an error."""
        self._known.add(key)
        if key not in self._keys:
            if default is None:
                raise self.fail(key, "is missing")
            return default
        value = self._keys[key]
        if kind is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if not isinstance(value, kind) or isinstance(value, bool) and kind is not bool:
            raise self.fail(key, f"= {value!r} is not allowed: must be of type {kind.__name__}")
        return value

    def has(self, key: str) -> bool:
        """Whether it is there."""
        self._known.add(key)
        return key in self._keys

    def whole(self, key: str, lo: int, hi: int, default: Optional[int] = None) -> int:
        """A whole number in a range."""
        value = self.get(key, int, default)
        if not lo <= value <= hi:
            raise self.fail(key, f"= {value} is not allowed: must be in {lo} .. {hi}")
        return int(value)

    def number(self, key: str, default: Optional[float] = None) -> float:
        """A finite number."""
        value = float(self.get(key, float, default))
        if not math.isfinite(value):
            raise self.fail(key, f"= {value} is not allowed: must be finite")
        return value

    def choice(self, key: str, allowed: Tuple[str, ...], default: str) -> str:
        """One of these words."""
        value = str(self.get(key, str, default))
        if value not in allowed:
            raise self.fail(key, f'= "{value}" is not allowed: must be one of {", ".join(allowed)}')
        return value

    def numbers(self, key: str, least: int) -> List[float]:
        """Finite numbers, this many at least."""
        values = self.get(key, list)
        good = all(
            isinstance(v, (int, float)) and not isinstance(v, bool) and math.isfinite(v)
            for v in values
        )
        if len(values) < least or not good:
            raise self.fail(
                key, f"= {values} is not allowed: must be {least} or more finite numbers"
            )
        return [float(v) for v in values]

    def words(self, key: str, default: Optional[List[str]] = None) -> List[str]:
        """A list of words."""
        values = self.get(key, list, default)
        if not all(isinstance(v, str) for v in values):
            raise self.fail(key, f"= {values} is not allowed: must be a list of texts")
        return list(values)

    def reject_unknown(self) -> None:
        """InputError when there is an unknown key."""
        for key in self._keys:
            if key not in self._known:
                raise self.fail(
                    key, f"is not a known key; allowed: {', '.join(sorted(self._known))}"
                )
