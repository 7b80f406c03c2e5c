# SPDX-License-Identifier: MIT
"""The campaigns' page: made of finished directories, of this drive alone, with every number in its
place."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any, Dict

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "host_tools/report")]

from sdre_report.campaign import section, stored  # noqa: E402
from sdre_report.tools import ReportError  # noqa: E402

DIGEST = "fnv1a64:0123456789abcdef"
VARIABLES = [
    {"name": name, "distribution": "uniform", "low": 0.5, "high": 2.0}
    for name in ("inertia", "flux")
]
WORST = {
    "case": 7,
    "seed": 8,
    "failed": True,
    "margin": -0.25,
    "fault": "none",
    "values": {"inertia": 0.51, "flux": 1.2},
    "places": {"inertia": 0.0066667, "flux": 0.47},
    "results": {"load_step.dip_e_radps": 3.0},
}
PLAIN = {
    "cases": 1000,
    "failures": 2,
    "failure_probability": 0.002,
    "interval_95": [0.00024, 0.0072],
    "negative_margins": 3,
    "negative_margin_interval_95": [0.0006, 0.0087],
    "margin": {"mean": 0.1, "deviation": 0.1, "least": -0.25},
    "histograms": {
        "edges": [-0.5, 0.0, 0.5, 1.0],
        "least": [3, 990, 7],
        "speed": [0, 40, 960],
        "current": [3, 950, 47],
    },
    "first_order": {"inertia": 0.6, "flux": 0.123456789},
    "worst": [WORST] * 20,
}
LEVEL = {"threshold": 0.4, "share": 0.1, "gamma": 0.0, "coefficient_of_variation": 0.1}
LAST = {
    "threshold": 0.0,
    "share": 0.2,
    "gamma": 2.0,
    "coefficient_of_variation": 0.11,
    "taken": 0.4,
}
RARE = {
    "method": "subset",
    "margin": "speed",
    "cases": 3800,
    "limit": 0.0,
    "reached": True,
    "below_limit": {"probability": 0.0021, "interval_95": [0.001, 0.0042]},
    "failed": {"probability": 1.5e-4, "interval_95": [1e-5, 1e-3]},
    "runs": [{"levels": [LEVEL, LAST]}, {"levels": [LEVEL, LEVEL | {"taken": 0.5}, LAST]}],
    "curve": {
        "margin": [-0.5, 0.0, 0.5],
        "probability": [0.0, 0.002, 1.0],
        "least": [0, 1e-3, 1.0],
        "most": [1e-4, 4e-3, 1.0],
    },
    "worst": [WORST],
}


class OneDesign:
    """In place of the tools."""

    def design(self, _: str) -> Dict[str, Any]:
        return {"digest": DIGEST}


def finished(path: Path, method: str, summary: Dict[str, Any], digest: str = DIGEST) -> Path:
    """A directory as a campaign leaves it."""
    path.mkdir()
    about = {"name": path.name, "method": method, "variables": VARIABLES, "drive_digest": digest}
    (path / "campaign.json").write_text(json.dumps(about))
    (path / "summary.json").write_text(json.dumps(summary))
    return path


def test_what_is_kept_and_shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stored, "FILE", tmp_path / "campaign.json")
    stored.write(
        OneDesign(),
        [
            finished(tmp_path / "motors", "random", PLAIN),
            finished(tmp_path / "rare", "subset", RARE),
        ],
        stored.FILE,
    )
    found = stored.read(OneDesign())
    assert (
        "results" not in stored.FILE.read_text()
        and len(found[0]["summary"]["worst"]) == stored.WORST
    )
    assert found[0]["summary"]["first_order"]["flux"] == 0.123457

    parts = {part.ident: part for part in section.section(found).parts}
    assert list(parts) == [
        "C-probability",
        "C-margin1",
        "C-worst1",
        "C-subset1",
        "C-subset1-levels",
        "C-rare1",
    ]
    assert parts["C-probability"].rows == [
        ["motors", "1000", "0.003", "0.0006 .. 0.0087", "0.002", "0.00024 .. 0.0072", "-0.250"],
        ["rare", "3800", "0.0021", "0.001 .. 0.0042", "0.00015", "1e-05 .. 0.001", "-0.250"],
    ]
    assert [row[:4] for row in parts["C-subset1-levels"].rows] == [
        ["level 0", "2", "0.400", "0.100"],
        ["level 1", "2", "0.200", "0.150"],
        ["level 2", "1", "0", "0.200"],
    ]
    assert parts["C-rare1"].rows[0] == [
        "case 7, seed 8",
        "-0.250",
        "failed",
        "0.510",
        "1.20",
        "inertia: lowest 0.67 %",
    ]
    marks = {
        "C-margin1": ("inertia", "margin"),
        "C-subset1": ("subset simulation", "motors", "speed margin", "probability of less"),
    }
    for ident, words in marks.items():
        assert all(f">{word}<" in parts[ident].svg for word in words), ident


def test_curve_is_of_the_margin_that_led() -> None:
    at, share = section.counted(PLAIN, "speed")
    assert at.tolist() == [0.5, 1.0] and share.tolist() == [0.04, 1.0]


def test_what_was_not_reached_is_a_bound() -> None:
    rare = {**RARE, "reached": False, "below_limit": {"less_than": 3e-9}}
    rows = section.probabilities(
        [{"name": "rare", "method": "subset", "variables": VARIABLES, "summary": rare}]
    ).rows
    assert rows[0][2:4] == ["0", "0 .. 3e-09"]


def test_odd_is_what_lies_at_an_end() -> None:
    assert section.odd({"a": 0.999, "b": 0.5, "c": 0.04}) == "a: highest 0.1 %; c: lowest 4 %"
    assert section.odd({"a": 0.3}) == "nothing: each value is a usual one"


def test_another_drive_and_an_unfinished_campaign_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "campaign.json"
    with pytest.raises(ReportError, match="is not a campaign of this"):
        stored.write(
            OneDesign(), [finished(tmp_path / "other", "random", PLAIN, "fnv1a64:0")], file
        )
    with pytest.raises(ReportError, match="is no finished campaign: campaign.json is missing"):
        stored.write(OneDesign(), [tmp_path / "nowhere"], file)
    assert not file.exists()
    file.write_text(json.dumps({"drive": stored.DRIVE, "digest": "fnv1a64:0", "campaigns": []}))
    monkeypatch.setattr(stored, "FILE", file)
    with pytest.raises(ReportError, match="is not of this"):
        stored.read(OneDesign())
