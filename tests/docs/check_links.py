# SPDX-License-Identifier: MIT
"""Checks every link, picture, page and heading that README.md and docs/ name. It also checks those
that a source names. Every page of docs/ is on the site, and its block diagrams are as drawn."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
QUESTIONS = 15  # at least, in the table of architecture.md
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
MENTION = re.compile(r"(?<![\w/])docs/([\w/]+\.(?:md|png|svg))\b")
HEADING = re.compile(r"(docs/[\w/]+\.md|README\.md), \"([^\"]+)\"")
CODE = re.compile(r"^```.*?^```|^(?: {4}|\t).*?$|`[^`\n]*`", re.M | re.S)


def anchors(text: str) -> set:
    """Anchors of the headings."""
    heads = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M)
    return {re.sub(r"[\s-]+", "-", re.sub(r"[^\w\s-]", "", h.lower()).strip()) for h in heads}


def wrong_links(page: Path) -> list:
    """One line for each."""
    text = CODE.sub("", page.read_text(encoding="utf-8"))
    found = []
    for target in LINK.findall(text):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, anchor = target.partition("#")
        path = (page.parent / file).resolve() if file else page
        if not path.exists():
            found.append(f"{page.relative_to(ROOT)}: {target} is not there")
        elif anchor and anchor not in anchors(path.read_text(encoding="utf-8")):
            found.append(f"{page.relative_to(ROOT)}: {target}: there is no such heading")
    for name in MENTION.findall(text):
        if not (ROOT / "docs" / name).exists():
            found.append(f"{page.relative_to(ROOT)}: docs/{name} is not there")
    return found


def wrong_headings(files: list) -> list:
    """One line for each heading that a text names and its page does not have; a comment may break
    the line."""
    found = []
    for file in files:
        try:
            text = re.sub(r"\s+(?:[*#]|//+)?\s*", " ", (ROOT / file).read_text(encoding="utf-8"))
        except (UnicodeDecodeError, FileNotFoundError):
            continue
        for page, heading in HEADING.findall(text):
            path = ROOT / page
            heads = (
                re.findall(r"^#+ (.*)$", path.read_text(encoding="utf-8"), re.M)
                if path.exists()
                else []
            )
            if not any(heading.lower() in head.lower() for head in heads):
                found.append(f'{file}: {page} has no heading "{heading}"')
    return found


def wrong_places(page: Path) -> list:
    """One line for each answer of the table "Where is ...?" that is not in the tree. A function has
    to be in a file of its row."""
    text = page.read_text(encoding="utf-8")
    rows = re.findall(r"^\| (Where .*\?) \| (.*) \|$", text, re.M)
    found = [] if len(rows) >= QUESTIONS else [f"{page.name}: {len(rows)} of {QUESTIONS} questions"]
    for question, answer in rows:
        files = []
        for name in re.findall(r"[\w/]*\w\.(?:cpp|c|hpp|h|py|toml)\b", answer):
            bases = [ROOT, ROOT / "host_tools", *(file.parent for file in files)]
            places = [base / name for base in bases if (base / name).is_file()]
            files += places[:1]
            found += [] if places else [f"{question} {name} is not there"]
        content = "".join(file.read_text(encoding="utf-8") for file in files)
        found += [
            f"{question} {function}() is in none of its files"
            for function in re.findall(r"`(\w+)\(\)`", answer)
            if f"{function}(" not in content
        ]
        found += [] if files else [f"{question} no file answers"]
    return found


def sources() -> list:
    """Tracked files; in an export without git, those of the rooms that name pages."""
    done = subprocess.run(
        ["git", "-C", str(ROOT), "ls-files"], capture_output=True, text=True, check=False
    )
    if done.returncode == 0:
        return done.stdout.splitlines()
    rooms = ("docs", "firmware", "host_tools", "tests", "linker", "cmake")
    return [
        p.relative_to(ROOT).as_posix()
        for room in rooms
        for p in sorted((ROOT / room).rglob("*"))
        if p.is_file()
    ]


def main() -> int:
    """Prints what is wrong."""
    pages = sorted((ROOT / "docs").rglob("*.md"))
    wrong = [line for page in [ROOT / "README.md", *pages] for line in wrong_links(page)]
    wrong += wrong_headings(sources())
    wrong += wrong_places(ROOT / "docs/architecture.md")
    site = (ROOT / "host_tools/site/mkdocs.yml").read_text(encoding="utf-8")
    wrong += [
        f"{name} is not in host_tools/site/mkdocs.yml"
        for name in (p.relative_to(ROOT / "docs").as_posix() for p in pages)
        if not re.search(rf"[ :]{re.escape(name)}$", site, re.M)
    ]
    print("\n".join(wrong), end="\n" if wrong else "", file=sys.stderr)
    drawn = 0
    if sys.version_info >= (3, 11):  # tomllib
        drawn = subprocess.run(
            [sys.executable, "-B", str(ROOT / "host_tools/site/blocks.py"), "--check"], check=False
        ).returncode
    return 1 if wrong or drawn else 0


if __name__ == "__main__":
    sys.exit(main())
