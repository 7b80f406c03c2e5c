# SPDX-License-Identifier: MIT
"""The words of `sdre-drive commission` when it gives up, and its first step."""

from __future__ import annotations

import re
import threading
from pathlib import Path

import pytest
from conftest import ROOT, Served
from support import command, until

from sdre_drive import commission, register_map
from sdre_drive.connection import Drive
from sdre_drive.registers import Mode


def reasons_of_the_firmware() -> int:
    """How many commission_reason_t has."""
    text = (ROOT / "firmware/commission/commission.h").read_text(encoding="utf-8")
    return len(set(re.findall(r"\bCOMMISSION_REASON_[A-Z_]+\b(?= = 0|,|\s*/\*\*|\s*\n?\})", text)))


def test_each_reason_has_a_cause() -> None:
    assert sorted(commission.REASONS) == list(range(reasons_of_the_firmware()))
    assert all(r.cause for number, r in commission.REASONS.items() if number > 0)


def test_a_reason_says_the_next_values() -> None:
    said = commission.give_up(10, 1.0, 1200.0, 4.0)
    assert "the inductance (" in said and said.endswith("next: --current 1.5 --speed 1200")
    assert commission.give_up(4, 1.0, 1200.0, 4.0).endswith("--current 1 --speed 840")
    assert commission.give_up(12, 3.0, 1200.0, 4.0).endswith("--current 4 --speed 1200")
    assert commission.give_up(12, 4.0, 1200.0, 4.0).endswith("the same again")


FOUND = {
    "FOUND_COUPLING": 2.0,
    "FOUND_SEARCHED": 600.0,
    "FOUND_RESONANCE": 219.7,
    "FOUND_DAMPING": 0.031,
    "FOUND_LOAD_SHARE": 0.42,
}


def test_the_stages_are_those_of_the_firmware() -> None:
    text = (ROOT / "firmware/commission/commission.h").read_text(encoding="utf-8")
    body = text[text.index("COMMISSION_IDLE") : text.index("} commission_stage_t")]
    names = re.findall(r"COMMISSION_([A-Z]+)", body)
    assert [n.lower() for n in names] == list(commission.STAGES)


def test_the_couplings_are_those_of_the_firmware() -> None:
    text = (ROOT / "firmware/commission/commission_types.h").read_text(encoding="utf-8")
    names = re.findall(r"COMMISSION_COUPLING_([A-Z]+)", text)
    assert [n.lower() for n in names[1:]] == list(commission.COUPLINGS[1:])
    assert f"COMMISSION_RING_FROM_Hz {commission.FROM_HZ:.1f}f" in text


def mapped(share: float) -> dict[str, float]:
    values = {"FOUND_MAP_STEP": 0.68, "FOUND_MAP_BIAS": 1.088, "FOUND_LD": 0.07, "FOUND_LQ": 0.1}
    for _, register, _ in commission.MAP_ROWS:
        values.update({f"{register}_{k}": share for k in range(1, commission.BINS + 1)})
    return values


def test_the_inductances_are_a_table_of_the_file() -> None:
    lines = commission.map_lines({**mapped(1.0), "FOUND_LQ_BESIDE_2_4": 0.75})
    assert lines[0].startswith("[inductances]")
    assert "ld_negative_id_H = [7.0000e-02, 7.0000e-02, 7.0000e-02, 7.0000e-02]" in lines
    assert lines[-1] == "lq_beside_2_H = [1.0000e-01, 1.0000e-01, 1.0000e-01, 7.5000e-02]"


def test_inductances_that_were_not_measured_are_not_written() -> None:
    assert commission.map_lines({**mapped(1.0), "FOUND_MAP_STEP": 0.0}) == []
    assert commission.map_lines({**mapped(1.0), "FOUND_LD_POSITIVE_3": 0.0}) == []


def test_each_coupling_has_its_words() -> None:
    assert commission.shaft_words(FOUND) == (
        "the shaft has a resonance at 219.7 Hz, damping ratio 0.031, "
        "0.42 of the inertia behind the coupling"
    )
    said = [commission.shaft_words({**FOUND, "FOUND_COUPLING": float(k)}) for k in (0, 1, 3, 4)]
    assert said == [
        "the shaft was not searched for a resonance",
        "the shaft is rigid: no resonance found between 40 and 600 Hz",
        "the shaft has a resonance below 40 Hz",
        "the shaft has a resonance above 600 Hz",
    ]


def test_the_file_says_the_coupling() -> None:
    values = dict.fromkeys((r.name for r in (*register_map.COMMISSIONING, *register_map.MAP)), 1.0)
    text = commission.text({**values, **FOUND})
    assert 'coupling = "elastic"' in text and "searched_Hz = 600.0" in text
    assert "resonance_Hz = { value = 2.19700e+02" in text
    rigid = commission.text({**values, **FOUND, "FOUND_COUPLING": 1.0})
    assert 'coupling = "rigid"' in rigid and "resonance_Hz" not in rigid
    assert "coupling" not in commission.text({**values, **FOUND, "FOUND_COUPLING": 0.0})


def test_a_current_beyond_the_drive_names_the_limit(served: Served, tmp_path: Path) -> None:
    words = ["--current", "9", "--speed", "1200", "--out", str(tmp_path / "x")]
    told = command("commission", *words, *served.options())
    assert told.returncode == 1 and "at most 4 A" in told.stderr, told


def test_a_shaft_that_coasts_is_braked_first(served: Served, drive: Drive) -> None:
    until(drive, lambda r: r.mode == Mode.READY)
    assert command("run", "900", "--for", "3", *served.options()).returncode == 0  # angle known
    served.bench().ask("load -0.5 active")
    until(drive, lambda r: r.speed_e_radps > 200.0)
    served.bench().ask("load 0")
    said = []
    commission.bring_to_rest(drive, threading.Event(), lambda words, _share: said.append(words))
    assert "brakes the shaft" in said
    assert abs(served.bench().ask("state")["speed_e_radps"]) < 10.0


def test_a_shaft_whose_angle_is_unknown_is_waited_for(
    served: Served, drive: Drive, monkeypatch: pytest.MonkeyPatch
) -> None:
    until(drive, lambda r: r.mode == Mode.READY)
    served.bench().ask("load -0.5 active")
    until(drive, lambda r: r.speed_e_radps > 100.0)
    monkeypatch.setattr(commission, "REST_WAIT_S", 0.5)
    with pytest.raises(Exception, match="brake it by hand"):
        commission.bring_to_rest(drive, threading.Event(), lambda *_: None)
    served.bench().ask("load 2")
    commission.bring_to_rest(drive, threading.Event(), lambda *_: None)
