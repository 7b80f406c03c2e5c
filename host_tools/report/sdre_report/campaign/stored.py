# SPDX-License-Identifier: MIT
"""Results of the last campaigns: campaign.json, so that a report needs no campaign. `./dev report
campaign DIRECTORY..` writes it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Dict, List, Sequence

from ..tools import ReportError, Tools

DRIVE = "ipmsm_390w"
FILE = Path(__file__).resolve().parents[1] / "campaign.json"
WORST = 8  # cases that the page shows
DIGITS = 6  # of a number


def read(tools: Tools) -> List[Dict[str, Any]]:
    """If it is of the drive file that there is."""
    found = json.loads(FILE.read_text(encoding="ascii"))
    if found["digest"] != tools.design(DRIVE)["digest"]:
        raise ReportError(
            f"{FILE.name} is not of this {DRIVE}.toml: run its campaigns again, then ./dev report "
            f"campaign DIRECTORY.."
        )
    return list(found["campaigns"])


def write(tools: Tools, directories: Sequence[Path], file: Path = FILE) -> None:
    """From finished campaigns."""
    digest = tools.design(DRIVE)["digest"]
    campaigns = [campaign_in(directory, digest) for directory in directories]
    file.write_text(
        json.dumps({"drive": DRIVE, "digest": digest, "campaigns": campaigns}, indent=1) + "\n",
        encoding="ascii",
    )


def campaign_in(directory: Path, digest: str) -> Dict[str, Any]:
    """Specification and results of a campaign."""
    try:
        about = json.loads((directory / "campaign.json").read_text(encoding="utf-8"))
        summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
    except OSError as error:
        raise ReportError(
            f"{directory}: is no finished campaign: {Path(error.filename).name} is missing"
        ) from error
    if about.get("drive_digest") != digest:
        raise ReportError(f"{directory}: is not a campaign of this {DRIVE}.toml")
    summary["worst"] = [
        {key: value for key, value in one.items() if key != "results"}
        for one in summary["worst"][:WORST]
    ]
    return {
        "name": about["name"],
        "method": about["method"],
        "variables": about["variables"],
        "summary": rounded(summary),
    }


def rounded(value: Any) -> Any:
    """A file that is small."""
    if isinstance(value, dict):
        return {key: rounded(one) for key, one in value.items()}
    if isinstance(value, list):
        return [rounded(one) for one in value]
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value
