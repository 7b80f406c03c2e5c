# SPDX-License-Identifier: MIT
"""Every link, picture and heading that README.md and docs/ name is there, and so is every page they mention; every page of docs/ is on the
site, and its block diagrams are as drawn."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
MENTION = re.compile(r"(?<![\w/])docs/([\w/]+\.(?:md|png|svg))\b")
CODE = re.compile(r"^```.*?^```|^(?: {4}|\t).*?$|`[^`\n]*`", re.M | re.S)


def anchors(text: str) -> set:
    """What headings are called in an address."""
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


def main() -> int:
    """Prints what is wrong."""
    pages = sorted((ROOT / "docs").rglob("*.md"))
    wrong = [line for page in [ROOT / "README.md", *pages] for line in wrong_links(page)]
    site = (ROOT / "host_tools/site/mkdocs.yml").read_text(encoding="utf-8")
    wrong += [f"{name} is not in host_tools/site/mkdocs.yml" for name in (p.relative_to(ROOT / "docs").as_posix() for p in pages)
              if not re.search(rf"[ :]{re.escape(name)}$", site, re.M)]  # fmt: skip
    print("\n".join(wrong), end="\n" if wrong else "", file=sys.stderr)
    drawn = 0
    if sys.version_info >= (3, 11):  # tomllib
        drawn = subprocess.run([sys.executable, "-B", str(ROOT / "host_tools/site/blocks.py"), "--check"], check=False).returncode
    return 1 if wrong or drawn else 0


if __name__ == "__main__":
    sys.exit(main())
