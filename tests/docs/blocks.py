# SPDX-License-Identifier: MIT
"""Blocks of code in the pages, and where each of them is run.

A comment before a block says what differs from the usual; a reader of the page does not see it:

    <!-- block: WORDS; WORDS; .. -->

    needs REASON        is not run; REASON is one of NEEDS
    in FILE             is run by this test, which has more to say about it
    long                is run by the long tests only
    with NAME = FILE    NAME is there, a copy of FILE
    as NAME             TOML: is written to NAME
    changes FILE        TOML: these keys are replaced in a copy of FILE
    exit N              shell: ends with this code
    omit COMMAND        shell: the lines that begin so are not run: minutes, or after a fault only

All blocks of one page are run in one directory, from its first line to its last. This directory
looks like the project's."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path
from typing import Dict, Iterator, List, NamedTuple, Optional, Tuple

ROOT = Path(__file__).resolve().parents[2]
NEEDS = ("TI's compiler", "TI's headers", "a real port", "minutes", "a cluster")
ROOMS = ("tools", "long", "drive", "python")
MARK = re.compile(r"<!-- block: (.*?) -->")
COMMAND = re.compile(
    r"(?:\./dev|sdre-\w+|build/\S+|cmake|python3|cc|mbpoll|hex2000|drive=\S+|\(cd \S+)(?= |$)"
)
SHELL, OWN = ("", "sh"), ("toml", "python")


class Block(NamedTuple):
    """One block, with what its comment says."""

    page: str
    line: int
    language: str  # sh, toml, python, or text, which is not run
    text: str
    marks: Tuple[str, ...]

    def where(self) -> str:
        """For a message."""
        return f"{self.page}:{self.line}"

    def marked(self, word: str) -> List[str]:
        """The rest of the comment after this word."""
        return [m[len(word) :].strip() for m in self.marks if m.split()[0] == word]

    def commands(self) -> str:
        """Those of a shell that are run."""
        omitted = tuple(self.marked("omit"))
        return "\n".join(
            t for t in self.text.splitlines() if not omitted or not t.startswith(omitted)
        )

    def room(self) -> Optional[str]:
        """The tests that run it; None: it is not run, or by a test of its own."""
        if self.language == "text" or self.marked("needs") or self.marked("in"):
            return None
        if self.language in OWN or "sdre-campaign" in self.text:
            return "python"
        if re.search(r"sdre-drive|\./dev (?:drive|serve)|sdre-sil serve", self.text):
            return "drive"
        return "long" if "long" in self.marks else "tools"


def language_of(named: str, text: str) -> str:
    """A block without a name is a shell's when one of its lines begins with a command."""
    if named in SHELL:
        return "sh" if named or any(COMMAND.match(t) for t in text.splitlines()) else "text"
    return named


def blocks_of(page: str, text: str) -> Iterator[Block]:
    """Fenced ones, and those that four spaces begin."""
    lines = [*text.split("\n"), ""]
    marks: Tuple[str, ...] = ()
    at = 0
    while at < len(lines):
        line, end = lines[at], at + 1
        said = MARK.fullmatch(line)
        if said:
            marks = tuple(word.strip() for word in said.group(1).split(";"))
        elif line.startswith("```"):
            while not lines[end].startswith("```"):
                end += 1
            body = "\n".join(lines[at + 1 : end])
            yield Block(page, at + 1, language_of(line[3:], body), body, marks)
            marks, end = (), end + 1
        elif line.startswith("    ") and not (at and lines[at - 1].strip()):
            while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
                end += 1
            body = "\n".join(t[4:] for t in lines[at:end]).rstrip()
            yield Block(page, at + 1, language_of("", body), body, marks)
            marks = ()
        elif line.strip():
            if marks:
                yield Block(page, at + 1, "nothing", "", marks)
            marks = ()
        at = end


def pages() -> List[str]:
    """README.md, its neighbours and docs/."""
    told = subprocess.run(
        ["git", "ls-files", "*.md"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return [p for p in told.stdout.split() if p.startswith("docs/") or "/" not in p]


def all_blocks() -> Dict[str, List[Block]]:
    """Those of each page that has any."""
    found = {p: list(blocks_of(p, (ROOT / p).read_text(encoding="utf-8"))) for p in pages()}
    return {page: blocks for page, blocks in found.items() if blocks}


def wrong(block: Block) -> List[str]:
    """One line for each mistake in a comment, or for a block that nothing can run."""
    found = []
    if block.language not in (*OWN, "sh", "text"):
        found.append(f"{block.language} is not sh, toml, python or text")
    if block.marks and block.language == "text":
        found.append("a comment before a block that is not run anyway")
    for mark in block.marks:
        word, _, rest = mark.partition(" ")
        ok = {
            "needs": rest in NEEDS,
            "in": (ROOT / rest).is_file() and block.page in (ROOT / rest).read_text("utf-8"),
            "long": not rest and block.room() == "long",
            "with": bool(re.fullmatch(r"\S+ = \S+", rest)) and (ROOT / rest.split()[-1]).is_file(),
            "as": block.language == "toml" and bool(rest),
            "changes": block.language == "toml" and (ROOT / rest).is_file(),
            "exit": block.language == "sh" and rest.isdigit(),
            "omit": any(t.startswith(rest + " ") for t in block.text.splitlines()),
        }.get(word, False)
        found += [] if ok else [f'"{mark}" is not one of the words of tests/docs/blocks.py']
    return [f"{block.where()}: {text}" for text in found]
