# SPDX-License-Identifier: MIT
"""An interpreter for the part of IEC 61131-3 Structured Text that docs/examples/plc_cycle.st needs.
It is no PLC, and it refuses everything else."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, Callable, Dict, List

TOKEN = re.compile(r"16#[0-9A-Fa-f]+|\d+|[A-Za-z_]\w*|:=|<>|[=\[\](),;]")
FUNCTIONS: Dict[str, Callable[..., Any]] = {
    "SEL": lambda which, zero, one: one if which else zero,
    "SHR": lambda x, n: x >> n,
    "DINT_TO_DWORD": lambda x: x & 0xFFFFFFFF,
    "DWORD_TO_WORD": lambda x: x & 0xFFFF,
}
START = {"BOOL": False, "WORD": 0, "DINT": 0}


class FunctionBlock:
    """Variables by name; call it once in a cycle."""

    def __init__(self, path: Path) -> None:
        text = re.sub(r"\(\*.*?\*\)", "", path.read_text(encoding="utf-8"), flags=re.S)
        inner = re.fullmatch(r"\s*FUNCTION_BLOCK\s+\w+(.*)END_FUNCTION_BLOCK\s*", text, flags=re.S)
        assert inner
        self.values: Dict[str, Any] = {}
        for section in re.findall(
            r"VAR(?:_INPUT|_OUTPUT)?\b(.*?)END_VAR", inner.group(1), flags=re.S
        ):
            for name, first, last, kind in re.findall(
                r"(\w+)\s*:\s*(?:ARRAY\s*\[(\d+)\.\.(\d+)\]\s*OF\s+)?(\w+);", section
            ):
                self.values[name] = (
                    [START[kind]] * (int(last) - int(first) + 1) if last else START[kind]
                )
        body = re.sub(r"VAR(?:_INPUT|_OUTPUT)?\b.*?END_VAR", "", inner.group(1), flags=re.S)
        assert not re.sub(r"\s", "", TOKEN.sub("", body)), "characters that are no part of it"
        self._tokens: List[str] = TOKEN.findall(body)

    def __call__(self, **inputs: Any) -> Dict[str, Any]:
        """A cycle; all variables after it."""
        assert inputs.keys() <= self.values.keys()
        self.values.update(inputs)
        self._at = 0
        self._statements(True, ())
        assert self._at == len(self._tokens)
        return self.values

    def _next(self, wanted: str = "") -> str:
        token = self._tokens[self._at]
        assert wanted in ("", token), f"{token} instead of {wanted}"
        self._at += 1
        return token

    def _is(self, *tokens: str) -> bool:
        return self._at < len(self._tokens) and self._tokens[self._at] in tokens

    def _statements(self, act: bool, ends: tuple) -> None:
        while self._at < len(self._tokens) and not self._is(*ends):
            if self._is("IF"):
                self._choice(act)
            else:
                self._assignment(act)

    def _choice(self, act: bool) -> None:
        done = False
        while not self._is("ELSE", "END_IF"):
            self._next()  # IF, ELSIF
            true = bool(self._or())
            self._next("THEN")
            self._statements(act and true and not done, ("ELSIF", "ELSE", "END_IF"))
            done = done or true
        if self._is("ELSE"):
            self._next()
            self._statements(act and not done, ("END_IF",))
        self._next("END_IF")
        self._next(";")

    def _assignment(self, act: bool) -> None:
        name = self._next()
        place = None
        if self._is("["):
            place = self._index()
        self._next(":=")
        value = self._or()
        self._next(";")
        assert name in self.values and type(value) is type(
            self.values[name] if place is None else 0
        ), name
        if act and place is None:
            self.values[name] = value
        elif act:
            self.values[name][place] = value

    def _index(self) -> int:
        self._next("[")
        place = self._or()
        self._next("]")
        return int(place)

    def _or(self) -> Any:
        value = self._and()
        while self._is("OR"):
            self._next()
            value = value | self._and()
        return value

    def _and(self) -> Any:
        value = self._equal()
        while self._is("AND"):
            self._next()
            value = value & self._equal()
        return value

    def _equal(self) -> Any:
        value = self._one()
        while self._is("=", "<>"):
            same = self._next() == "="
            value = (value == self._one()) == same
        return value

    def _one(self) -> Any:
        token = self._next()
        if token == "NOT":
            return not self._one()
        if token == "(":
            value = self._or()
            self._next(")")
            return value
        if token in ("TRUE", "FALSE"):
            return token == "TRUE"
        if token in FUNCTIONS:
            self._next("(")
            given = [self._or()]
            while self._is(","):
                self._next()
                given.append(self._or())
            self._next(")")
            return FUNCTIONS[token](*given)
        if token[0].isdigit():
            return int(token[3:], 16) if token.startswith("16#") else int(token)
        return self.values[token][self._index()] if self._is("[") else self.values[token]
