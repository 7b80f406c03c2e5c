# SPDX-License-Identifier: MIT
"""Hook of mkdocs: the pages name each other as files of the repository ("docs/motors.md"); on the
site these are links."""

from __future__ import annotations

import re
from typing import Any

NAME = re.compile(r"(?<![\w/`(\[])(?:docs/)?([a-z_0-9]+\.md)\b(?![\]`)])")
CODE = re.compile(r"(^```.*?^```|^(?: {4}|\t).*?$|`[^`\n]*`|\[[^\]\n]*\]\([^)\n]*\))", re.M | re.S)


def on_page_markdown(markdown: str, page: Any, files: Any, **_: Any) -> str:
    """Everything but code and what is a link already."""
    known = {f.src_uri for f in files if f.src_uri.endswith(".md")}
    up = "../" * page.file.src_uri.count("/")

    def link(found: re.Match) -> str:
        name = found.group(1)
        return (
            f"[{name}]({up}{name})"
            if name in known and name != page.file.src_uri
            else found.group(0)
        )

    pieces = CODE.split(markdown)
    return "".join(piece if i % 2 else NAME.sub(link, piece) for i, piece in enumerate(pieces))
