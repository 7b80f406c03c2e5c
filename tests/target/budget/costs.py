# SPDX-License-Identifier: MIT
"""Cycles of operations, from costs.toml."""

from pathlib import Path

import tomllib

from origin import FLASH


class Costs:
    def __init__(self):
        with open(Path(__file__).with_name("costs.toml"), "rb") as file:
            data = tomllib.load(file)
        self.clock_Hz, self.band, self.limits = data["clock_Hz"], data["band"], data["limits"]
        self.target_share = data["target_share"]
        self.background = data["background"]["pass_ms"] / data["background"]["most_ms"]
        self.board = set(data["board"])
        self.library = set(data["library"]) | self.board
        self.interrupt = sum(data["interrupt"].values())
        self.loops, self.loops_of, self.features = data["loops"], data["loops_of"], data["features"]
        self.flash = flash = data["flash"]
        own = data["cost"]
        waits = {
            name + FLASH: cost / flash["float" if name in flash["of_float"] else "other"]
            for name, cost in own.items()
        }
        self.of = {**own, **waits, **data["library"], **data["board"]}
        self.slow_division = data["without_fast_rts"]["fp_div"]

    def cycles(self, counts):
        return sum(n * self.of[name] for name, n in counts.items())

    def in_flash(self, counts):
        """Cycles of what comes from the flash."""
        return sum(n * self.of[name] for name, n in counts.items() if name.endswith(FLASH))

    def span(self, cycles):
        """Both ends of the band, in whole cycles."""
        return round((1 - self.band) * cycles), round((1 + self.band) * cycles)

    def slow(self, counts):
        """At most, with the plain library's division."""
        more = counts.get("fp_div", 0) * (self.slow_division - self.of["fp_div"])
        return round((1 + self.band) * (self.cycles(counts) + more))
