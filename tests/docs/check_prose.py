# SPDX-License-Identifier: MIT
"""Counts what makes prose hard to read, in pages and comments, and compares the totals of each room
with prose_counts.txt.

A total may only fall, and a total that fell is recorded in the same commit: check_prose.py
--record. check_prose.py --list [PATH..] names every place; check_prose.py --files prints the counts
of every file."""

from __future__ import annotations

import io
import re
import subprocess
import sys
import tokenize
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RECORD = Path(__file__).with_name("prose_counts.txt")
ROOMS = (
    "README.md",
    "CONTRIBUTING.md",
    "RELEASING.md",
    "SECURITY.md",
    "docs",
    "firmware",
    "host_tools",
    "tests",
    "linker",
    "cmake",
)
KINDS = ("over_25_words", "over_40_words", "fragments", "cells_over_12_words", "history")
C_LIKE = {".c", ".h", ".cpp", ".hpp", ".js", ".mjs", ".cmd"}
HASHED = {".toml", ".sh", ".cmake", ".txt", ".yml"}
FRAGMENT = re.compile(r"(?:Of|What|Who|Whose|By|Nor)\b")
HISTORY = re.compile(
    r"\b(?:no longer|today|formerly|previously|originally|any ?more|until now|before the "
    r"change|used to be|in the past)\b",
    re.I,
)
SENTENCE_END = re.compile(r"(?<=[.!?])[\")*]*\s+(?=[\"(*`\[]*(?:[A-Z0-9`]|[a-z]\w*[_(.]))")
ABBREVIATION = re.compile(r"\b(e\.g|i\.e|cf|vs|etc|Fig|Eq|no)\.\s")


def words(text: str) -> int:
    """Tokens with a letter or a digit; code in back quotes is one."""
    text = re.sub(r"`[^`]*`", "code", re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text))
    return sum(1 for token in text.split() if re.search(r"\w", token))


def cell_words(text: str) -> int:
    """Those of at least two letters: symbols and numbers of a formula are none."""
    text = re.sub(r"`[^`]*`", "code", re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text))
    return sum(
        1
        for token in text.split()
        if re.fullmatch(r"[(\"*]*[A-Za-z][A-Za-z'/-]+[.,;:)\"*?]*", token)
    )


def judge(where: str, text: str) -> list:
    """(kind, where, sentence) of each finding in one paragraph."""
    found = []
    for sentence in SENTENCE_END.split(ABBREVIATION.sub(r"\1 ", text.strip())):
        count = words(sentence)
        if count > 25:
            found.append(("over_25_words", where, sentence))
        if count > 40:
            found.append(("over_40_words", where, sentence))
        if FRAGMENT.match(sentence.lstrip('"(*`')) and not sentence.endswith("?"):
            found.append(("fragments", where, sentence))
        if HISTORY.search(re.sub(r"`[^`]*`", "", sentence)):
            found.append(("history", where, sentence))
    return found


def page_paragraphs(text: str) -> list:
    """(line, kind, text) with kind "text" or "cell"; code blocks, comments and headings are left
    out."""
    text = re.sub(
        r"<!--.*?-->|^```.*?^```", lambda m: "\n" * m.group().count("\n"), text, flags=re.S | re.M
    )
    found, open_at, lines = [], 0, []

    def close() -> None:
        if lines:
            found.append((open_at, "text", " ".join(lines)))
            lines.clear()

    for number, line in enumerate(text.splitlines(), 1):
        bare = line.strip()
        if bare.startswith("|"):
            close()
            cells = re.split(r"(?<!\\)\|", bare.strip("|"))
            found += [
                (number, "cell", cell.strip())
                for cell in cells
                if not re.fullmatch(r"\s*:?-+:?\s*", cell)
            ]
        elif not bare or bare.startswith("#") or (re.match(r" {4}|\t", line) and not lines):
            close()
        else:
            item = re.match(r"(?:[-*] |\d+\. |> ?)", bare)
            if item and not (bare.startswith(">") and lines):
                close()
            if not lines:
                open_at = number
            lines.append(bare[item.end() :] if item else bare)
    close()
    return found


def joined(comments: list) -> list:
    """(line, text) of each paragraph of (line, text, alone) comment lines.

    An empty line, a tag or an item begins one; a comment behind code is one. Equations and columns
    are none."""
    found, last = [], -1
    for number, line, alone in comments:
        if re.search(r"\S {3,}\S|  EQ-[A-Z-]+\d+$", line):
            line = ""
        begins = re.match(r"[@\\]\w+|[-*] |\d+\. ", line)
        if line and alone and number == last + 1 and found and not begins:
            found[-1] = (found[-1][0], f"{found[-1][1]} {line}".strip())
        elif line:
            found.append(
                (number, re.sub(r"^[@\\](?:param(?:\[\w+\])?\s+\S+|\w+)\s*|^[-*] ", "", line))
            )
        last = number if line and alone else -1
    return found


def c_comments(text: str) -> list:
    """Comment lines of C and C++. A string that holds a comment's mark, and an annotation for the
    analyser, are none."""
    token = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|//[^\n]*|/\*.*?\*/', re.S)
    found = []
    for match in token.finditer(text):
        if match.group()[0] == "/" and match.group()[2:3] != "@":
            first = text.count("\n", 0, match.start()) + 1
            before = text[text.rfind("\n", 0, match.start()) + 1 : match.start()]
            alone = not before.strip() or "\n" in match.group()
            body = re.sub(r"\*/$", "", match.group())
            found += [
                (first + i, re.sub(r"^\s*(?:/\*+<?|//+!?<?|\*)?\s*", "", line).strip(), alone)
                for i, line in enumerate(body.splitlines())
            ]
    return [(n, "" if line.startswith("SPDX") else line, alone) for n, line, alone in found]


def python_comments(text: str) -> list:
    """Comment lines and docstrings."""
    found, before = [], tokenize.INDENT
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            found.append(
                (
                    token.start[0],
                    token.string.lstrip("#! ").strip(),
                    not token.line[: token.start[1]].strip(),
                )
            )
        elif token.type == tokenize.STRING and before in (
            tokenize.INDENT,
            tokenize.NEWLINE,
            tokenize.DEDENT,
        ):
            body = re.sub(r'^[rfb]*("""|\'\'\'|"|\')|("""|\'\'\'|"|\')$', "", token.string)
            found += [
                (token.start[0] + i, line.strip(), True) for i, line in enumerate(body.splitlines())
            ]
        if token.type not in (tokenize.COMMENT, tokenize.NL):
            before = token.type
    return [
        (n, "" if line.startswith(("SPDX", "fmt:", "type:", "noqa")) else line, alone)
        for n, line, alone in sorted(found)
    ]


def hash_comments(text: str) -> list:
    """Comment lines of TOML, shell and CMake."""
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        match = re.match(r"(?:[^#\"']|\"[^\"]*\"|'[^']*')*?(?:^|\s)#+!?\s?(.*)$", line)
        if match and not match.group(1).startswith(("SPDX", "/")):
            found.append((number, match.group(1).strip(), line.lstrip().startswith("#")))
    return found


def findings(file: str) -> list:
    """(kind, where, text) of one file."""
    text, suffix = (ROOT / file).read_text(encoding="utf-8"), Path(file).suffix
    if suffix == ".md":
        found = []
        for line, kind, paragraph in page_paragraphs(text):
            if kind == "text":
                found += judge(f"{file}:{line}", paragraph)
            elif cell_words(paragraph) > 12:
                found.append(("cells_over_12_words", f"{file}:{line}", paragraph))
        return found
    read = c_comments if suffix in C_LIKE else python_comments if suffix == ".py" else hash_comments
    return [
        one for line, paragraph in joined(read(text)) for one in judge(f"{file}:{line}", paragraph)
    ]


def files() -> list:
    """Tracked pages and sources; in an export without git, those of the rooms."""
    done = subprocess.run(
        ["git", "-C", str(ROOT), "ls-files"], capture_output=True, text=True, check=False
    )
    names = (
        done.stdout.splitlines()
        if done.returncode == 0
        else [p.relative_to(ROOT).as_posix() for p in sorted(ROOT.rglob("*")) if p.is_file()]
    )
    kept = C_LIKE | HASHED | {".md", ".py"}
    return [
        n
        for n in names
        if n.split("/")[0] in ROOMS
        and Path(n).suffix in kept
        and (ROOT / n).exists()
        and not n.startswith(("tests/data", "tests/fuzz/corpus"))
        and n != "tests/docs/prose_counts.txt"
    ]


def room(file: str) -> str:
    """Room of a file: docs for the pages of the root, or the first directory."""
    top = file.split("/")[0]
    return "docs" if top.endswith(".md") else top


def totals(found: dict) -> str:
    """The text of the record."""
    counts = Counter((room(file), kind) for file, all_ in found.items() for kind, _, _ in all_)
    rows = sorted({room(file) for file in found})
    return "".join(f"{r} {kind} {counts[r, kind]}\n" for r in rows for kind in KINDS)


def compare(now: str) -> int:
    """Prints each total that differs from the record."""
    kept = {
        tuple(line.split()[:2]): int(line.split()[2])
        for line in RECORD.read_text(encoding="utf-8").splitlines()
    }
    wrong = []
    for line in now.splitlines():
        where, kind, count = line.split()
        allowed = kept.get((where, kind), 0)
        if int(count) > allowed:
            wrong.append(
                f"{where}: {kind} is {count}, allowed {allowed}: tests/docs/check_prose.py --list "
                f"{where} names them"
            )
        elif int(count) < allowed:
            wrong.append(
                f"{where}: {kind} fell from {allowed} to {count}: tests/docs/check_prose.py "
                f"--record, and commit it"
            )
    print("\n".join(wrong), end="\n" if wrong else "", file=sys.stderr)
    return 1 if wrong else 0


def main(arguments: list) -> int:
    """Compares, records, or prints."""
    option = arguments[0] if arguments else ""
    chosen = [
        file for file in files() if not arguments[1:] or file.startswith(tuple(arguments[1:]))
    ]
    found = {file: findings(file) for file in chosen}
    if option == "--list":
        for kind, where, text in (one for file in found.values() for one in file):
            print(f"{where}: {kind}: {text}")
    elif option == "--files":
        for file, all_ in found.items():
            counts = Counter(kind for kind, _, _ in all_)
            if counts:
                print(file, *(f"{kind} {counts[kind]}" for kind in KINDS if counts[kind]), sep="  ")
        print(totals(found), end="")
    elif option == "--record":
        RECORD.write_text(totals(found), encoding="utf-8")
    else:
        return compare(totals(found))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
