# SPDX-License-Identifier: MIT
"""Cases as scenario files: `sdre-sil run` does the same again, to the bit."""

from __future__ import annotations

import copy
import os
from pathlib import Path
from typing import Any, Dict, List

from sdre.toml_text import put, written
from sdre_campaign.parts import write_text
from sdre_campaign.spec import Spec
from sdre_campaign.summary import Worst


def case_keys(spec: Spec, values: Dict[str, float], seed: int) -> Dict[str, Any]:
    """The scenario of a case, without its drive."""
    keys = copy.deepcopy(spec.scenario)
    keys.pop("motor_ranges", None)
    keys["seed"] = seed
    for one in spec.varied:
        value = values[one.variable.name]
        for path in one.variable.keys:
            put(keys, path, round(value) if one.variable.whole else value)
    return keys


def write_worst(spec: Spec, worst: List[Worst], directory: Path) -> List[Path]:
    """A file for each, named by rank and number; earlier ones go."""
    directory.mkdir(exist_ok=True)
    for old in directory.glob("*.toml"):
        old.unlink()
    paths = []
    for rank, one in enumerate(worst, 1):
        keys = {"drive": Path(os.path.relpath(spec.drive_path, directory.resolve())).as_posix()}
        keys.update(case_keys(spec, one.values, one.seed))
        path = directory / f"{rank:03d}_case_{one.case}.toml"
        verdict = (
            f"fault: {one.fault}" if one.fault != "none" else "failed" if one.failed else "good"
        )
        write_text(
            path,
            f"# Case {one.case} of {spec.name}: {verdict}, margin {one.margin:.4f}.\n"
            + written(keys, str(path)),
        )
        paths.append(path)
    return paths
