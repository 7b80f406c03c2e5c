#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the block diagrams of docs/theory from blocks.toml, as SVG files that lie beside the pages
and need nothing else.

Positions come from the file: the signal path runs from left to right, with the feedback below it.
A layout program would place the blocks by itself, and the site would need it.

Usage: blocks.py [--check]    --check: exit code 1 when a file is not what would be drawn
"""

from __future__ import annotations

import sys
from html import escape
from pathlib import Path
from typing import List

import tomllib

THEORY = Path(__file__).resolve().parents[2] / "docs/theory"
BOX_W, BOX_H, GAP, ROW = 136, 44, 34, 88
MARGIN, LINE_H = 14, 13


def box(x: float, y: float, text: str) -> List[str]:
    """A block with up to three lines; one that begins with ( is a signal and has no frame."""
    lines = text.strip("()").split("|") if text.startswith("(") else text.split("|")
    out = []
    if not text.startswith("("):
        out.append(
            f'<rect x="{x}" y="{y}" width="{BOX_W}" height="{BOX_H}" rx="3" fill="#fff" '
            f'stroke="#000"/>'
        )
    top = y + BOX_H / 2 - LINE_H * (len(lines) - 1) / 2 + 4
    for i, line in enumerate(lines):
        out.append(
            f'<text x="{x + BOX_W / 2}" y="{top + LINE_H * i}" '
            f'text-anchor="middle">{escape(line)}</text>'
        )
    return out


def arrow(points: List[tuple], label: str = "", dashed: bool = False) -> List[str]:
    """A line with corners and a head; its label stands over the middle of the longest part."""
    path = "M" + " L".join(f"{x:g} {y:g}" for x, y in points)
    style = ' stroke-dasharray="5 3"' if dashed else ""
    out = [f'<path d="{path}" fill="none" stroke="#000" marker-end="url(#head)"{style}/>']
    if label:
        (ax, ay), (bx, by) = max(
            zip(points, points[1:]), key=lambda p: abs(p[0][0] - p[1][0]) + abs(p[0][1] - p[1][1])
        )
        out.append(
            f'<text x="{(ax + bx) / 2:g}" y="{(ay + by) / 2 - 4:g}" text-anchor="middle" '
            f'class="s">{escape(label)}</text>'
        )
    return out


def draw(diagram: dict) -> str:
    """Rows of blocks, each from left to right or leftward, and links between rows."""
    rows = diagram["rows"]
    width = max(len(r) for r in rows) * (BOX_W + GAP) - GAP + 2 * MARGIN
    height = len(rows) * ROW - ROW + BOX_H + 2 * MARGIN
    out: List[str] = []
    place = {}
    for i, row in enumerate(rows):
        for k, text in enumerate(row):
            x, y = MARGIN + k * (BOX_W + GAP), MARGIN + i * ROW
            apart, text = text.startswith("!"), text.lstrip("!")
            if text:
                place[(i, k)] = (x, y)
                out += box(x, y, text)
            if text and k and row[k - 1] and not apart:
                ends = [(x - GAP, y + BOX_H / 2), (x - 2, y + BOX_H / 2)]
                out += arrow(
                    [(x, ends[0][1]), (x - GAP + 2, ends[0][1])]
                    if i in diagram.get("leftward", [])
                    else ends
                )
    for link in diagram.get("links", []):
        (i, k), (j, m) = link["from"], link["to"]
        ax, ay = place[(i, k)]
        bx, by = place[(j, m)]
        down = j > i
        start = (ax + BOX_W * link.get("leave", 0.5), ay + (BOX_H if down else 0))
        end = (bx + BOX_W * link.get("enter", 0.5), by + (-2 if down else BOX_H + 2))
        middle = (start[1] + end[1]) / 2
        out += arrow(
            [start, (start[0], middle), (end[0], middle), end]
            if start[0] != end[0]
            else [start, end],
            link.get("label", ""),
            link.get("dashed", False),
        )
    head = (
        '<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" '
        'markerHeight="7" orient="auto">'
        '<path d="M0 0 L8 4 L0 8 z"/></marker></defs><style>text{font:12px '
        "sans-serif}.s{font-size:11px}</style>"
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" role="img">'
        f'<title>{escape(diagram["title"])}</title><rect width="100%" height="100%" '
        f'fill="#fff"/>{head}\n' + "\n".join(out) + "\n</svg>\n"
    )


def main() -> int:
    """All of them."""
    with open(Path(__file__).with_name("blocks.toml"), "rb") as file:
        diagrams = tomllib.load(file)
    stale = []
    for name, diagram in diagrams.items():
        path, text = THEORY / f"{name}.svg", draw(diagram)
        if "--check" in sys.argv:
            if not path.exists() or path.read_text(encoding="utf-8") != text:
                stale.append(path.name)
        else:
            path.write_text(text, encoding="utf-8")
    if stale:
        print(f"blocks.py: not as drawn: {', '.join(stale)}", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
