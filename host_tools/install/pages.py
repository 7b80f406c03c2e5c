# SPDX-License-Identifier: MIT
"""Man page and shell completions of a program, made from its own --help.

    pages.py PROGRAM DIRECTORY

DIRECTORY gets man1/NAME.1, bash/NAME, zsh/_NAME and fish/NAME.fish. Same program, same bytes.
"""

import re
import subprocess
import sys
from pathlib import Path

ROW = re.compile(r"^  (\S.*?)(?:  +(\S.*))?$")


def help_of(program, *words):
    """Text and {section: [(name, explanation)]} of a help page."""
    text = subprocess.run(
        [program, *words, "--help"], capture_output=True, text=True, check=True
    ).stdout
    sections, rows = {}, None
    for line in text.splitlines():
        row = ROW.match(line)
        if re.match(r"\w+:$", line):
            rows = sections.setdefault(line[:-1], [])
        elif rows is not None and row:
            rows.append((row[1], row[2] or ""))
        elif rows and line.startswith("   "):
            name, explanation = rows[-1]
            rows[-1] = (name, f"{explanation} {line.strip()}".strip())
    return text, sections


def words_of(rows):
    """Options as they are typed: --drive of "--drive TEXT"."""
    return [word for name, _ in rows for word in name.split()[0].split(",") if word.startswith("-")]


def roff(text):
    """Plain text for a man page."""
    return re.sub(r"^([.'])", r"\\&\1", text.replace("\\", r"\e").replace("-", r"\-"), flags=re.M)


def man(name, version, text, sections, commands):
    lines = [
        f'.TH {name.upper()} 1 "" "sdre-drive {version}"',
        ".SH NAME",
        f"{name} \\- {roff(text.splitlines()[0])}",
        ".SH SYNOPSIS",
        f".B {roff(name)}",
        "[OPTIONS] COMMAND ...",
        ".SH OPTIONS",
    ]
    for option, explanation in sections.get("Options", []):
        lines += [".TP", f".B {roff(option)}", roff(explanation)]
    lines.append(".SH COMMANDS")
    for command, explanation in sections.get("Subcommands", []):
        lines += [f".SS {roff(command)}", roff(explanation)]
        for kind in ("Positionals", "Options"):
            for option, what in commands[command].get(kind, []):
                lines += [".TP", f".B {roff(option)}", roff(what)]
        for example, more in commands[command].get("Example", []):
            lines += [".PP", "Example:", f".B {roff(f'{example} {more}'.strip())}"]
    lines += [
        ".SH EXIT STATUS",
        "0: all is good. 1: bad input. 2: no acceptable design. 3: tables do not match the drive "
        "file. "
        "4: a simulated drive tripped or is not good.",
    ]
    return "\n".join(lines) + "\n"


def bash(name, sections, commands):
    function = "_" + name.replace("-", "_")
    cases = "".join(
        f"        {c}) words='{' '.join(words_of(s.get('Options', [])))}' ;;\n"
        for c, s in commands.items()
    )
    return (
        f"{function}()\n{{\n    local words='{' '.join(commands)} "
        f"{' '.join(words_of(sections.get('Options', [])))}'\n"
        f"    ((COMP_CWORD < 2)) || case ${{COMP_WORDS[1]}} in\n{cases}    esac\n"
        '    mapfile -t COMPREPLY < <(compgen -W "$words" -- "${COMP_WORDS[COMP_CWORD]}")\n}\n'
        f"complete -o default -F {function} {name}\n"
    )


def zsh(name, sections, commands):
    def escaped(text):
        return re.sub(r"(['\[\]:])", r"\\\1", text).replace("\\'", "'\\''")

    rows = " \\\n        ".join(
        f"'{c}:{escaped(dict(sections['Subcommands'])[c])}'" for c in commands
    )
    cases = "".join(
        f"    {c}) _arguments '*:file:_files' {' '.join(words_of(s.get('Options', [])))} ;;\n"
        for c, s in commands.items()
    )
    return (
        f"#compdef {name}\nlocal -a commands\ncommands=({rows})\nif ((CURRENT == 2)); then\n    "
        f"_describe command commands\n"
        f"    return\nfi\ncase $words[2] in\n{cases}esac\n"
    )


def fish(name, sections, commands):
    def quoted(text):
        return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"

    explained = dict(sections["Subcommands"])
    lines = [
        f"complete -c {name} -n __fish_use_subcommand -f -a {c} -d {quoted(explained[c])}"
        for c in commands
    ]
    for command, page in commands.items():
        for option, what in page.get("Options", []):
            for word in words_of([(option, what)]):
                kind = f"-l {word[2:]}" if word.startswith("--") else f"-s {word[1:]}"
                lines.append(
                    f"complete -c {name} -n '__fish_seen_subcommand_from {command}' {kind} -d "
                    f"{quoted(what)}"
                )
    return "\n".join(lines) + "\n"


def main(program, directory):
    name, out = Path(program).name, Path(directory)
    text, sections = help_of(program)
    version = subprocess.run(
        [program, "--version"], capture_output=True, text=True, check=True
    ).stdout.split()[-1]
    commands = {command: help_of(program, command)[1] for command, _ in sections["Subcommands"]}
    pages = {
        out / "man1" / f"{name}.1": man(name, version, text, sections, commands),
        out / "bash" / name: bash(name, sections, commands),
        out / "zsh" / f"_{name}": zsh(name, sections, commands),
        out / "fish" / f"{name}.fish": fish(name, sections, commands),
    }
    for path, page in pages.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(page)


if __name__ == "__main__":
    main(*sys.argv[1:])
