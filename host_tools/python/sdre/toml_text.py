# SPDX-License-Identifier: MIT
"""TOML read and written. A float is written with as many digits as give every bit back."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any, Dict, Mapping, Union

import tomli_w

from sdre._native import InputError

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

PathLike = Union[str, Path]


def read_text(path: PathLike) -> str:
    """The file. InputError when there is none."""
    try:
        return Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "is not UTF-8"
        raise InputError(f"{path}: cannot be read: {reason}") from error


def table(text: str, source: str) -> Dict[str, Any]:
    """The text as dictionaries."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{source}: not valid TOML: {error}") from error


def written(value: Mapping[str, Any], source: str) -> str:
    """Dictionaries as a text; numbers of NumPy too."""
    try:
        return tomli_w.dumps(plain(value))
    except (TypeError, ValueError) as error:
        raise InputError(f"{source}: cannot be TOML: {error}") from error


def plain(value: Any) -> Any:
    """Mappings, sequences and numbers as Python's own."""
    if isinstance(value, Mapping):
        return {str(key): plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(one) for one in value]
    return plain(value.tolist()) if hasattr(value, "tolist") else value


def put(root: Dict[str, Any], path: str, value: Any) -> None:
    """Sets `path`, keys with dots between them; a number where a key holds an array of tables.
    Missing tables are made."""
    *way, last = path.split(".")
    node: Any = root
    for key in way:
        if isinstance(node, list):
            if not key.isdigit() or int(key) >= len(node):
                raise InputError(
                    f"{path}: leads nowhere: an array has no entry {key}, count from 0"
                )
            node = node[int(key)]
        elif isinstance(node, dict):
            node = node.setdefault(key, {})
        else:
            break
    if not isinstance(node, dict):
        raise InputError(f"{path}: leads nowhere: what holds its last key is no table")
    node[last] = value
