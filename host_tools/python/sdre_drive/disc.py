# SPDX-License-Identifier: MIT
"""A map of the encoder disc, learned from readings of the scope: docs/disc_map.md. The words of its
file are those of app_disc.h."""

from __future__ import annotations

import math
from dataclasses import dataclass
from operator import mul
from pathlib import Path
from typing import Callable, List, Sequence, Tuple

from sdre_drive import record, register_map, scope, session
from sdre_drive.connection import Drive, DriveError
from sdre_drive.registers import Constants
from sdre_drive.units import rpm_of

FORMAT = 0xD15C
STEPS = 256  # of a count
ABSENT, NONE, NO_INDEX, COMPARES, OTHER, IN_FORCE = range(6)  # of register DISC_MAP
STATES = (
    "this firmware cannot use a map of the disc: build it with SDRE_DISC_MAP=ON",
    "there is no map of the disc",
    "the map waits for the index: the shaft has to turn forward",
    "the map is being compared with the disc",
    "the map is that of another disc, and not in force: learn this disc",
    "the map is in force",
)
SIGNALS = ("THETA", "EDGE")

# Chosen by simulation (docs/disc_map.md): a parabola over so many samples on either side follows
# the shaft, and leaves the edges' own errors.
WINDOW = 7
# Chosen by simulation: the shaft follows the disc's errors a little, at each speed other edges'.
SPEEDS = (0.8, 0.9, 1.0, 1.13, 1.3)
PASSES = 3  # chosen: the third one changes a thousandth of a count
STEADY = 0.02  # chosen: a larger change of the speed within a capture is a ramp or a load step
BROKEN_CNT = 2.0  # chosen: no edge is off by so much; counts were lost
CAPTURES_LOST = 20  # chosen: in a row; a shaft that is not steady by then will not be
SEEN = 0.995  # chosen: of the edges; a Poisson number of mean 10 leaves one in 20,000
WORTH = 0.5  # chosen: an error of the map that is half of it leaves an eighth more noise than none
SETTLE_S = 1.0  # of the drive's time, at a new speed
SPEED_WITHIN = 0.01
LONGEST_S = 30.0


@dataclass(frozen=True)
class Track:
    """Readings of one capture: the edge that each rests on, and its place [counts] from the first
    edge on, as the drive takes it."""

    edges: List[int]
    places: List[float]
    turned: List[int]  # counts from the edge of the reading before
    angles: List[float]  # less those of the edges, [counts] of an electrical turn
    turn_cnt: float  # an electrical one


@dataclass(frozen=True)
class Learned:
    """Where the edges are, less their own number [counts], and what is known of that."""

    offsets: List[float]
    rms: float
    error_rms: float  # of the mean of its readings, by two halves
    seen: float  # share of the edges with a reading


class NotSteady(DriveError):
    """A capture that tells nothing of the disc."""


def weights(window: int) -> List[float]:
    """The sum of 2 window + 1 samples with these weights is their least squares parabola in the
    middle (EQ-DISC-5)."""
    w = window
    below = (2 * w - 1) * (2 * w + 1) * (2 * w + 3)
    return [(3 * (3 * w * w + 3 * w - 1) - 15 * j * j) / below for j in range(-w, w + 1)]


def track_of(thetas: Sequence[float], edges: Sequence[float], known: Constants) -> Track:
    """From the signals THETA and EDGE of a capture."""
    if min(edges) < 0.0:
        raise NotSteady("a reading without an edge of known place")
    positions = known.encoder_counts
    turn_cnt = positions / known.pole_pairs  # an electrical one
    per_cnt = 2.0 * math.pi / turn_cnt
    numbers = [round(edge) for edge in edges]
    places, turned = [float(numbers[0])], [0]
    for k in range(1, len(numbers)):
        whole = (numbers[k] - numbers[k - 1] + positions // 2) % positions - positions // 2
        rest = math.remainder((thetas[k] - thetas[k - 1]) / per_cnt - whole, turn_cnt)
        if abs(rest) > BROKEN_CNT:
            raise NotSteady("angle and edges contradict each other: counts were lost")
        places.append(places[-1] + whole + rest)
        turned.append(whole)
    quarter = len(places) // 4
    first, last = places[quarter] - places[0], places[-1] - places[-1 - quarter]
    if abs(last - first) > STEADY * abs(first):
        raise NotSteady(f"the speed is not steady: it changed by {abs(last / first - 1.0):.1%}")
    angles = [theta / per_cnt - edge for theta, edge in zip(thetas, numbers)]
    return Track(numbers, places, turned, angles, turn_cnt)


def shares_of(tracks: Sequence[Track]) -> List[List[float]]:
    """How far each reading is beyond its edge, over the way that the drive took its speed from. The
    angle of an edge itself is unknown and the same in all readings: an age is not negative, so it
    is the least one."""
    zero = tracks[0].angles[0]
    beyond = [[math.remainder(a - zero, t.turn_cnt) for a in t.angles] for t in tracks]
    least = min(map(min, beyond))
    return [
        [(b - least) / turned if turned else 0.0 for b, turned in zip(of_track, t.turned)]
        for of_track, t in zip(beyond, tracks)
    ]


def _residuals(
    track: Track, shares: Sequence[float], offsets: Sequence[float]
) -> List[Tuple[int, float]]:
    """(edge, by how much the shaft is beyond it), EQ-DISC-5."""
    c, n = weights(WINDOW), 2 * WINDOW + 1
    off = [offsets[edge] for edge in track.edges]
    before = [off[0], *off[:-1]]
    at = [
        place + o + share * (o - b) for place, o, b, share in zip(track.places, off, before, shares)
    ]
    return [
        (track.edges[k + WINDOW], sum(map(mul, c, at[k : k + n])) - at[k + WINDOW])
        for k in range(len(at) - n + 1)
    ]


def _fit(tracks: Sequence[Track], positions: int) -> Tuple[List[float], List[int]]:
    offsets = [0.0] * positions
    share = 1.0 - weights(WINDOW)[WINDOW]
    counts: List[int] = []
    all_shares = shares_of(tracks)
    for _ in range(PASSES):
        sums, counts = [0.0] * positions, [0] * positions
        for track, shares in zip(tracks, all_shares):
            for edge, beyond in _residuals(track, shares, offsets):
                sums[edge] += beyond
                counts[edge] += 1
        offsets = [o + s / (n or 1) / share for o, s, n in zip(offsets, sums, counts)]
        mean = sum(offsets) / positions
        offsets = [o - mean if n else 0.0 for o, n in zip(offsets, counts)]
    return offsets, counts


def _rms(values: Sequence[float]) -> float:
    return math.sqrt(sum(v * v for v in values) / max(len(values), 1))


def learn(tracks: Sequence[Track], positions: int) -> Learned:
    """Offsets of all edges (EQ-DISC-5), and their error from two halves of the captures."""
    offsets, counts = _fit(tracks, positions)
    halves = [_fit(tracks[k::2], positions) for k in range(2)]
    differences = [
        a - b for a, b, n, m in zip(halves[0][0], halves[1][0], *(h[1] for h in halves)) if n and m
    ]
    seen = sum(1 for n in counts if n) / positions
    return Learned(offsets, _rms(offsets), 0.5 * _rms(differences), seen)


def require_worth(found: Learned) -> None:
    """DriveError for a map that would not help."""
    if found.seen < SEEN:
        raise DriveError(
            f"only {found.seen:.1%} of the edges were seen: learn longer, with --visits"
        )
    if found.error_rms > WORTH * found.rms:
        raise DriveError(
            f"the disc shows {found.rms:.3f} counts rms, and {found.error_rms:.3f} of them do not "
            "repeat: it needs no map, or its index is at another edge in each turn"
        )


def scatter_cnt(tracks: Sequence[Track]) -> float:
    """How far readings are off a smooth shaft [counts rms], as the drive takes them now."""
    none = [0.0] * (1 + max(max(track.edges) for track in tracks))
    beyond = [
        value for track in tracks for _, value in _residuals(track, [0.0] * len(track.edges), none)
    ]
    return _rms(beyond) / math.sqrt(1.0 - weights(WINDOW)[WINDOW])


def words_of(offsets: Sequence[float]) -> List[int]:
    """EQ-DISC-1, as the firmware reads it."""
    octets = [max(-128, min(127, round(STEPS * o))) & 0xFF for o in offsets]
    pairs = zip(octets[0::2], [*octets[1::2], 0])
    return [FORMAT, len(octets), *[low | (high << 8) for low, high in pairs]]


def write(path: Path, offsets: Sequence[float]) -> None:
    """A file for `sdre-gains image --disc-map`."""
    record.write_bytes(path, b"".join(word.to_bytes(2, "big") for word in words_of(offsets)))


def state(drive: Drive) -> int:
    """Register DISC_MAP. DriveError when the firmware cannot use a map."""
    now = int(drive.values(register_map.POSITION)["DISC_MAP"])
    if now == ABSENT:
        raise DriveError(STATES[now])
    return now


def require_possible(known: Constants, speed_e_radps: float) -> None:
    """DriveError when an edge in each period, or the drive's range, does not allow this speed."""
    if known.encoder_counts < 16:
        raise DriveError("a map needs an encoder of 16 counts or more")
    least, most = (
        (2.0 * math.pi * known.pole_pairs / known.encoder_counts / known.period_s) * 1.5,
        (known.speed_max_e_radps),
    )
    least, most = least / min(SPEEDS), most / max(SPEEDS)
    if not least <= speed_e_radps <= most:
        low, high = (rpm_of(value, known.pole_pairs) for value in (least, most))
        raise DriveError(
            f"the disc is learned forward, between {low:.0f} and {high:.0f} r/min: a period needs "
            "an edge"
        )


def take(drive: Drive) -> Track:
    """One capture of a steady shaft; others are thrown away."""
    setup = scope.Setup(SIGNALS)
    why = ""
    for _ in range(CAPTURES_LOST):
        session.require_moving(drive.read())
        capture = scope.take(drive, setup, LONGEST_S)
        try:
            thetas, edges = capture.values
            return track_of(thetas, edges, drive.constants())
        except NotSteady as e:
            why = str(e)
    raise DriveError(f"no capture of {CAPTURES_LOST} is of use: {why}")


def captures(
    drive: Drive, speed_e_radps: float, visits: float, show: Callable[[float], None]
) -> List[Track]:
    """Runs the drive at the SPEEDS until each edge has so many visits, on average. It stops the
    drive in the end, whatever happens."""
    known = drive.constants()
    require_possible(known, speed_e_radps)
    wanted = visits * known.encoder_counts
    tracks: List[Track] = []
    readings = 0
    try:
        for k, share in enumerate(SPEEDS):
            session.run_steady(drive, share * speed_e_radps, SPEED_WITHIN, SETTLE_S, LONGEST_S)
            while readings < wanted * (k + 1) / len(SPEEDS) or len(tracks) < 2 * (k + 1):
                tracks.append(take(drive))
                readings += max(len(tracks[-1].edges) - 2 * WINDOW, 1)
                show(min(readings / wanted, 1.0))
    except DriveError:
        session.withdraw(drive)
        raise
    session.stop(drive)
    return tracks


def check(drive: Drive, speed_e_radps: float, count: int) -> Tuple[int, float]:
    """(register DISC_MAP, scatter of the readings) at this speed. It stops the drive in the end."""
    require_possible(drive.constants(), speed_e_radps)
    try:
        session.run_steady(drive, speed_e_radps, SPEED_WITHIN, SETTLE_S, LONGEST_S)
        session.wait_for(drive, lambda _: state(drive) not in (NO_INDEX, COMPARES), LONGEST_S)
        tracks = [take(drive) for _ in range(count)]
        found = state(drive)
    except DriveError:
        session.withdraw(drive)
        raise
    session.stop(drive)
    return found, scatter_cnt(tracks)
