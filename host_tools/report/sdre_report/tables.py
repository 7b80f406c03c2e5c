# SPDX-License-Identifier: MIT
"""Tables of the page. A number that is not there is an error, never an empty cell."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import List, Optional, Sequence, Union

from .tools import ReportError

Value = Union[float, int, str, None]


def number(value: Value, digits: int = 3, what: str = "") -> str:
    """As text; None or NaN is a number that is missing."""
    if isinstance(value, (str, int)):
        return str(value)
    if value is None or math.isnan(value):
        raise ReportError(f"a number is missing: {what}")
    if math.isinf(value):
        return "inf"
    if value == 0:
        return "0"
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    text = f"{value:.{decimals}f}"
    return f"{value:.{digits - 1}e}" if len(text) > 9 else ("0" if float(text) == 0 else text)


def or_never(value: Optional[float], factor: float = 1.0) -> Value:
    """A time that is not reached has a word."""
    return "never" if value is None else factor * value


@dataclass
class Table:
    """Rows of numbers, each with what it is; the first column is text."""

    ident: str
    title: str
    head: Sequence[str]
    note: str = ""
    rows: List[List[str]] = field(default_factory=list)

    def add(self, what: str, *values: Value, digits: int = 3) -> None:
        """One row; every value is a number or a word."""
        if len(values) + 1 != len(self.head):
            raise ReportError(
                f"{self.ident}: {what!r} has {len(values)} values for {len(self.head) - 1} columns"
            )
        self.rows.append(
            [
                what,
                *(
                    number(v, digits, f"{self.ident}, {what}, {h}")
                    for v, h in zip(values, self.head[1:])
                ),
            ]
        )


@dataclass(frozen=True)
class Figure:
    """A plot, ready to stand in the page."""

    ident: str
    title: str
    svg: str
    note: str = ""


@dataclass
class Section:
    """One heading of the page and what stands below it."""

    ident: str
    title: str
    text: str = ""  # HTML
    parts: List[Union[Table, Figure]] = field(default_factory=list)
