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
    output              text: what the block before it prints, all of it; "..." stands for any lines
    output of any run   the same, with other figures and another width of the columns

All blocks of one page are run in one directory, from its first line to its last. This directory
looks like the project's."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path
from typing import Dict, Iterator, List, NamedTuple, Optional, Tuple

ROOT = Path(__file__).resolve().parents[2]
NEEDS = ("TI's compiler", "TI's headers", "a real port", "minutes", "a cluster", "python-can")
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
    shown: Optional[Block] = None  # the block after it, with what this one prints

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


def with_output(blocks: List[Block]) -> List[Block]:
    """A block and its output are one."""
    found: List[Block] = []
    for block in blocks:
        if block.marked("output") and found and found[-1].language == "sh":
            found[-1] = found[-1]._replace(shown=block)
        found.append(block)
    return found


FIGURE = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
ANY_LINES = "..."


def line_pattern(line: str, any_run: bool) -> str:
    """A regular expression for this line of an output."""
    if line == ANY_LINES:
        return r"((?:.*\n)*?)"
    if not any_run:
        return f"({re.escape(line)} *\n)"
    words = [r"-?\S*\d\S*" if FIGURE.search(w) else re.escape(w) for w in line.split()]
    return f"( *{' +'.join(words)} *\n)"


def output_match(shown: Block, printed: str, any_run: bool) -> Optional[re.Match]:
    """A group for each line of the page, when that is what was printed."""
    pattern = "".join(line_pattern(t.rstrip(), any_run) for t in shown.text.splitlines())
    return re.fullmatch(pattern, printed.rstrip() + "\n")


def output_complaint(shown: Block, printed: str) -> Optional[str]:
    """Words for a page that does not show what was printed."""
    if output_match(shown, printed, shown.marked("output") == ["of any run"]):
        return None
    renew = (
        "other figures: tests/docs/run_blocks.py ROOM BIN --record writes them"
        if output_match(shown, printed, True)
        else "other words"
    )
    return f"{shown.where()}: the page shows what is not printed: {renew}\n{printed}"


def recorded(shown: Block, printed: str, page: str) -> str:
    """The page with these figures, when they are all that differs."""
    match = output_match(shown, printed, True)
    if not match or shown.marked("output") != [""]:
        return page
    lines = page.split("\n")
    for k, line in enumerate(shown.text.splitlines()):
        if line and line != ANY_LINES:
            lines[shown.line - 1 + k] = "    " + match.group(k + 1).rstrip()
    return "\n".join(lines)


def pages() -> List[str]:
    """README.md, its neighbours and docs/."""
    told = subprocess.run(
        ["git", "ls-files", "*.md"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return [p for p in told.stdout.split() if p.startswith("docs/") or "/" not in p]


def all_blocks() -> Dict[str, List[Block]]:
    """Those of each page that has any."""
    found = {
        p: with_output(list(blocks_of(p, (ROOT / p).read_text(encoding="utf-8")))) for p in pages()
    }
    return {page: blocks for page, blocks in found.items() if blocks}


def wrong(block: Block) -> List[str]:
    """One line for each mistake in a comment, or for a block that nothing can run."""
    found = []
    if block.language not in (*OWN, "sh", "text"):
        found.append(f"{block.language} is not sh, toml, python or text")
    if block.marks and block.language == "text" and not block.marked("output"):
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
            "output": block.language == "text" and rest in ("", "of any run"),
            "omit": any(t.startswith(rest + " ") for t in block.text.splitlines()),
        }.get(word, False)
        found += [] if ok else [f'"{mark}" is not one of the words of tests/docs/blocks.py']
    return [f"{block.where()}: {text}" for text in found]
