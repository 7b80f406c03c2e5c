# SPDX-License-Identifier: MIT
"""The page: sections into HTML, HTML into PDF."""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import List, Optional, Sequence

import jinja2
import markdown
from markupsafe import Markup

from .tables import Figure, Section, Table
from .tools import ROOT, ReportError

BROWSERS = ("chromium", "chromium-browser", "google-chrome")


def from_docs(name: str, heading: str) -> str:
    """One chapter of a file in docs/, as HTML: what is written there is not written again here."""
    text = (ROOT / "docs" / name).read_text(encoding="utf-8")
    found = re.search(rf"^(#+) {re.escape(heading)}\n(.*?)(?=^#{{1,2}} |\Z)", text, re.M | re.S)
    if not found:
        raise ReportError(f"docs/{name} has no chapter {heading!r}")
    without_pictures = re.sub(r"!\[[^\]]*\]\([^)]*\)\n?", "", found.group(2))
    return Markup(markdown.markdown(without_pictures, extensions=["tables"]))


def render(sections: Sequence[Section]) -> str:
    """The whole page; a name that a template does not know is an error."""
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("sdre_report"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.tests["table"] = lambda part: isinstance(part, Table)
    environment.filters["svg"] = Markup
    figures = [p for s in sections for p in s.parts if isinstance(p, Figure)]
    return environment.get_template("page.html.jinja").render(sections=sections, figures=figures)


def browser() -> Optional[str]:
    """The Chromium of this machine, if there is one."""
    return next(filter(None, map(shutil.which, BROWSERS)), None)


def print_pdf(page: Path, pdf: Path) -> bool:
    """With headless Chromium, as the page looks; without one there is no PDF."""
    program = browser()
    if not program:
        return False
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        arguments: List[str] = [
            program,
            "--headless=new",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-dev-shm-usage",
            "--no-first-run",
            f"--user-data-dir={profile}",
            "--no-pdf-header-footer",
            f"--print-to-pdf={pdf}",
            page.resolve().as_uri(),
        ]
        done = subprocess.run(arguments, capture_output=True, text=True, timeout=180, check=False)
    if not pdf.exists():
        raise ReportError(f"{program} made no PDF: {done.stderr.strip().splitlines()[-1:]}")
    return True
