# SPDX-License-Identifier: MIT
"""A map of the encoder disc: the learning against discs that are known, and the whole way on a
virtual drive."""

from __future__ import annotations

import math
import random
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Callable, List, Tuple

import pytest
from conftest import ROOT, SHIPPED, Served, serving
from support import GAINS, command

from sdre_drive import disc
from sdre_drive.connection import Drive, DriveError
from sdre_drive.registers import Constants

LINES = 250
POSITIONS = 4 * LINES
KNOWN = Constants(2, 2e-4, 600.0, 5.0, POSITIONS, float(POSITIONS), 0)
SAMPLES = 512
# Edges are off by 0.10 counts, within 4 % for 1,000 of them. With five edges in a period readings
# are beyond an edge by 0 to 0.2 of the way. They are off by 1 to 1.25 times as much.
OFF = (0.96 * 0.10, 1.04 * 1.25 * 0.10)


def offsets_of(seed: int, rms: float) -> List[float]:
    draw = random.Random(seed)
    return [draw.uniform(-1.0, 1.0) * rms * math.sqrt(3.0) for _ in range(POSITIONS)]


def shaft(step: float, begin: float, sway: float) -> Callable[[int], float]:
    """Places [counts] of a shaft with this speed per sample, and a slow sway of it."""
    return lambda k: begin + step * k + sway * math.sin(2.0 * math.pi * 15.0 * 2e-4 * k)


def signals(offsets: List[float], at: Callable[[int], float]) -> Tuple[List[float], List[float]]:
    """THETA and EDGE of a capture, as the firmware makes them. It takes the speed from the edge of
    the period before and this one, and knows of no errors."""
    thetas, edges = [], []
    before = 0
    for k in range(-1, SAMPLES):
        place = at(k)
        edge = math.floor(place) + 1
        while edge + offsets[edge % POSITIONS] > place:
            edge -= 1
        off = offsets[edge % POSITIONS]
        turned, before, off_before = edge - before, edge, offsets[before % POSITIONS]
        if k < 0:
            continue
        beyond = (place - (edge + off)) * turned / (turned + off - off_before)
        theta = (edge + beyond) * 2.0 * math.pi * KNOWN.pole_pairs / POSITIONS
        thetas.append(math.fmod(theta, 2.0 * math.pi))
        edges.append(float(edge % POSITIONS))
    return thetas, edges


def tracks_of(offsets: List[float], count: int, sway: float = 0.0) -> List[disc.Track]:
    draw = random.Random(7)
    return [
        disc.track_of(
            *signals(offsets, shaft(4.7 * speed, draw.uniform(0.0, POSITIONS), sway)), KNOWN
        )
        for speed in disc.SPEEDS
        for _ in range(count)
    ]


def error_rms(found: List[float], real: List[float]) -> float:
    mean = sum(r - f for r, f in zip(real, found)) / len(real)
    return math.sqrt(sum((r - f - mean) ** 2 for r, f in zip(real, found)) / len(real))


@pytest.mark.parametrize("rms", [0.1, 0.05, 0.02])
def test_a_known_disc_is_learned(rms: float) -> None:
    real = offsets_of(3, rms)
    found = disc.learn(tracks_of(real, 4, sway=2.0), POSITIONS)
    assert found.seen == 1.0
    assert abs(found.rms / rms - 1.0) < 0.06
    # Errors as slow as 14 orders of a turn stay, 28 of 1,000 numbers. Readings hardly see them.
    error = error_rms(found.offsets, real)
    assert error < 1.2 * math.sqrt(28.0 / POSITIONS) * rms, error
    left = [r - f for r, f in zip(real, found.offsets)]
    scatter = disc.scatter_cnt(tracks_of(left, 1))
    assert scatter < 0.06 * rms, scatter
    assert found.error_rms < 0.05 * rms
    disc.require_worth(found)


def test_the_weights_are_those_of_a_parabola() -> None:
    for window in (2, 7, 15):
        c = disc.weights(window)
        for power, wanted in ((0, 1.0), (1, 0.0), (2, 0.0), (3, 0.0)):
            got = sum(x * (k - window) ** power for k, x in enumerate(c))
            assert abs(got - wanted) < 1e-9


def test_errors_that_do_not_repeat_are_no_map() -> None:
    draw = random.Random(1)
    tracks = []
    for track in tracks_of([0.0] * POSITIONS, 4):
        noisy = [place + draw.gauss(0.0, 0.1) for place in track.places]
        tracks.append(replace(track, places=noisy))
    with pytest.raises(DriveError, match="do not repeat"):
        disc.require_worth(disc.learn(tracks, POSITIONS))


def test_too_few_readings_are_no_map() -> None:
    with pytest.raises(DriveError, match="--visits"):
        disc.require_worth(disc.learn(tracks_of(offsets_of(3, 0.1), 1)[:2], POSITIONS))


def test_a_capture_that_tells_nothing_is_refused() -> None:
    real = offsets_of(1, 0.1)
    thetas, edges = signals(real, shaft(4.7, 0.0, 0.0))
    assert len(disc.track_of(thetas, edges, KNOWN).edges) == SAMPLES
    with pytest.raises(disc.NotSteady, match="known place"):
        disc.track_of(thetas, [-1.0, *edges[1:]], KNOWN)
    shifted = [(e + (5 if k > 300 else 0)) % POSITIONS for k, e in enumerate(edges)]
    with pytest.raises(disc.NotSteady, match="counts were lost"):
        disc.track_of(thetas, shifted, KNOWN)
    ramp = signals(real, lambda k: 4.7 * k * (1.0 + 5.0e-5 * k))
    with pytest.raises(disc.NotSteady, match="not steady"):
        disc.track_of(*ramp, KNOWN)


def test_backward_and_over_the_end_of_the_turn_places_go_on() -> None:
    real = [0.0] * POSITIONS
    for step in (-4.7, 4.7, 47.7, -470.2, 470.2):
        track = disc.track_of(*signals(real, shaft(step, 0.5, 0.0)), KNOWN)
        for k in range(1, SAMPLES):
            assert abs(track.places[k] - track.places[0] - step * k) < 1e-6


def test_the_words_are_those_of_the_firmware() -> None:
    words = disc.words_of([0.0, 1 / 256, -1 / 256, 0.6, -0.6])
    assert words == [0xD15C, 5, 0x0100, 0x7FFF, 0x0080]


def test_scatter_is_that_of_the_edges() -> None:
    """With a share s of the speed's error a reading is off by (1 + s) o - s o before. The share is
    even, from 0 to one over the counts in a period. Neighbours' common edge adds 2 %."""
    of_counts = [1.0 / (4.7 * speed) for speed in disc.SPEEDS]
    s = sum(of_counts) / len(of_counts) / 2.0
    s_squared = sum(x * x for x in of_counts) / len(of_counts) / 3.0
    for rms in (0.1, 0.03):
        offsets = offsets_of(5, rms)
        real = math.sqrt(sum(o * o for o in offsets) / POSITIONS)
        wanted = 1.02 * real * math.sqrt(1.0 + 2.0 * s + 2.0 * s_squared)
        assert abs(disc.scatter_cnt(tracks_of(offsets, 2)) / wanted - 1.0) < 0.05


def test_speeds_without_an_edge_in_each_period_are_refused() -> None:
    for speed in (1.0, 590.0):
        with pytest.raises(DriveError, match="between"):
            disc.require_possible(KNOWN, speed)
    disc.require_possible(KNOWN, 300.0)


@pytest.fixture
def coarse(tmp_path: Path) -> Path:
    """The shipped motor with an encoder whose edges are off by 0.10 counts, each by itself."""
    text = SHIPPED.read_text().replace("lines = 2500", f"lines = {LINES}")
    text = text.replace(
        "edge_times = true",
        "edge_times = true\n\n[encoder.disc]\npattern_cnt = 0.0\nown_rms_cnt = 0.1",
    )
    boards = tmp_path.parent / "boards"
    boards.mkdir(exist_ok=True)
    board = ROOT / "firmware/config/boards/board_390w.toml"
    (boards / board.name).write_text(board.read_text())
    (tmp_path / board.name).write_text(board.read_text())
    file = tmp_path / "coarse.toml"
    file.write_text(text)
    return file


def image(drive_file: Path, out: Path, *options: str) -> subprocess.CompletedProcess:
    return subprocess.run(
        [str(GAINS), "image", str(drive_file), "--out", str(out), *options],
        capture_output=True,
        text=True,
    )


def words_after(text: str, before: str) -> float:
    return float(text.split(before)[1].split()[0].rstrip(";"))


def test_a_disc_is_learned_stored_and_known_again(tmp_path: Path, coarse: Path) -> None:
    """The whole way: scope, file, image, flash, the next start."""
    file, with_map = tmp_path / "disc.map", tmp_path / "with.image"
    flash = str(tmp_path / "flash")
    with serving(tmp_path, "--flash", flash, "--seed", "3", drive=coarse) as served:
        speed = ["--speed", "1500", *served.options()]
        before = command("disc-map", "check", *speed)
        assert before.returncode == 0 and "no map" in before.stdout, before
        assert OFF[0] < words_after(before.stdout, "off by ") < OFF[1]
        done = command("disc-map", "learn", "--out", str(file), *speed)
        assert done.returncode == 0 and f"{POSITIONS} edges" in done.stdout, done
        assert words_after(done.stdout, "repeat within ") < 0.01
        made = image(coarse, with_map, "--disc-map", str(file))
        assert made.returncode == 0, made
        assert command("load", str(with_map), *served.options()).returncode == 0
        after = command("disc-map", "check", *speed)
        assert after.returncode == 0 and "the map is in force" in after.stdout, after
        assert words_after(after.stdout, "off by ") < 0.01
        again = command("disc-map", "learn", "--out", str(file), *speed)
        assert again.returncode == 1 and "has a map already" in again.stderr, again
    with serving(tmp_path, "--flash", flash, "--seed", "4", drive=coarse) as served:
        other = command("disc-map", "check", "--speed", "1500", *served.options())  # another disc
        assert other.returncode == 1 and "that of another disc" in other.stdout, other
        assert OFF[0] < words_after(other.stdout, "off by ") < OFF[1]
        assert (
            command("load", str(image_without(tmp_path, coarse)), *served.options()).returncode == 0
        )
        with Drive(served.target()) as drive:
            assert disc.state(drive) == disc.NONE


def image_without(tmp_path: Path, drive_file: Path) -> Path:
    out = tmp_path / "without.image"
    assert image(drive_file, out).returncode == 0
    return out


def test_what_cannot_be_is_one_line(served: Served, tmp_path: Path, coarse: Path) -> None:
    where = served.options()
    slow = command("disc-map", "learn", "--out", str(tmp_path / "m"), "--speed", "1", *where)
    assert slow.returncode == 1 and "r/min: a period needs an edge" in slow.stderr, slow
    short = tmp_path / "short.map"
    short.write_bytes(b"\xd1\x5c\x03\xe8")
    refused = image(coarse, tmp_path / "i", "--disc-map", str(short))
    assert refused.returncode == 1 and "is no map of sdre-drive disc-map learn" in refused.stderr
    whole = tmp_path / "whole.map"
    disc.write(whole, [0.0] * POSITIONS)
    refused = image(SHIPPED, tmp_path / "i", "--disc-map", str(whole))
    assert refused.returncode == 1 and "has 10000" in refused.stderr, refused
    bare = tmp_path / "bare.image"
    assert image(SHIPPED, bare).returncode == 0
    wrong = tmp_path / "wrong.image"
    wrong.write_bytes(bare.read_bytes() + whole.read_bytes())
    refused = command("load", str(wrong), *where)
    assert refused.returncode == 1 and "for another encoder" in refused.stderr, refused
    assert "Traceback" not in refused.stderr
