# SPDX-License-Identifier: MIT
"""The man page of sdre-drive: every command and option of the help, and its exit codes."""

from __future__ import annotations

import typer
from man_pages import python_pages, require_kept_page

from sdre_drive.cli import app


def test_kept_page_is_made_from_the_commands() -> None:
    require_kept_page("sdre-drive")


def test_page_has_every_command_and_option() -> None:
    page = (python_pages.DIRECTORY / "sdre-drive.1").read_text()
    commands = typer.main.get_command(app).commands  # type: ignore[attr-defined]
    assert len(commands) > 15
    for name, command in commands.items():
        heading = name.replace("-", "\\-")  # as roff has it
        section = page[page.index(f".SS {heading}\n") :]
        section = section[: section[3:].find(".SS ") % len(section) + 3]
        for option in (word for one in command.params for word in one.opts):
            if option.startswith("--"):
                assert option.replace("-", "\\-") in section, (name, option)
    assert ".SS params save" in page and "4: the drive has tripped" in page
