# SPDX-License-Identifier: MIT
"""Man pages of the programs in Python, made from the same commands as their --help.

    python_pages.py NAME..      # sdre-drive, sdre-campaign: writes man1/NAME.1 beside this file

An installation has no Python packages when it is built, so the pages are kept. Tests compare them
with the commands.
"""

import importlib
import inspect
import sys
from pathlib import Path

import typer
from pages import roff

DIRECTORY = Path(__file__).parent / "man1"
PROGRAMS = {
    "sdre-drive": (
        "sdre_drive.cli",
        "sdre_drive.register_map",
        "VERSION",
        "0: all is good. 1: bad input, or no answer. "
        "4: the drive has tripped, or is not as the drive file says.",
        "The Python package sdre-drive brings the program.",
    ),
    "sdre-campaign": (
        "sdre_campaign.cli",
        "sdre",
        "__version__",
        "0: all is good. 1: bad input. 2: no acceptable design. 4: a case failed. "
        "130: interrupted.",
        "The Python package sdre brings the program, with its extra campaign.",
    ),
}


def line(text):
    """One line of a help text."""
    return roff(" ".join(inspect.cleandoc(text or "").split()))


def parameters(command):
    """Arguments, then options, each with its explanation."""
    rows = []
    for one in command.params:
        if one.param_type_name == "argument":
            rows.append((one.metavar or one.name.upper(), getattr(one, "help", "")))
    for one in command.params:
        if one.param_type_name == "option" and not getattr(one, "hidden", False):
            words = ", ".join([*one.opts, *one.secondary_opts])
            value = "" if one.is_flag else f" {one.metavar or 'VALUE'}"
            rows.append((words + value, one.help))
    return [text for words, what in rows for text in (".TP", f".B {roff(words)}", line(what))]


def sections(name, command):
    """Every command below this one."""
    lines = []
    for word, one in getattr(command, "commands", {}).items():
        full = f"{name} {word}".strip()
        lines += [f".SS {roff(full)}", line(one.help), *parameters(one)]
        if one.epilog:
            lines += [".PP", line(one.epilog)]
        lines += sections(full, one)
    return lines


def page(name):
    """The text of man1/NAME.1."""
    module, versioned, constant, status, package = PROGRAMS[name]
    command = typer.main.get_command(importlib.import_module(module).app)
    version = getattr(importlib.import_module(versioned), constant)
    below = sections("", command)
    lines = [
        f'.TH {name.upper()} 1 "" "sdre-drive {version}"',
        ".SH NAME",
        f"{name} \\- {line(command.help)}",
        ".SH SYNOPSIS",
        f".B {roff(name)}",
        "[OPTIONS] COMMAND ..." if below else "[OPTIONS] SPEC",
        ".SH OPTIONS",
        *parameters(command),
        *([".PP", line(command.epilog)] if command.epilog else []),
        *([".SH COMMANDS", *below] if below else []),
        ".SH EXIT STATUS",
        status,
        ".SH NOTES",
        package,
    ]
    return "\n".join(text for text in lines if text) + "\n"


def main(*names):
    DIRECTORY.mkdir(exist_ok=True)
    for name in names:
        (DIRECTORY / f"{name}.1").write_text(page(name))


if __name__ == "__main__":
    main(*sys.argv[1:])
