# SPDX-License-Identifier: MIT
"""Do the stand-in headers offer only what TI's offer, with the same values?

usage: stand_in_names.py COMPILER STAND_INS TYPES TI_DIRECTORY..; TYPES is included ahead of TI's
headers."""

import re
import subprocess
import sys

INCLUDE = '#include "DSP28x_Project.h"\n'
KEYWORDS = ["-Dcregister=", "-Dinterrupt=", "-D__interrupt="]  # the C28x compiler's own
# Hooks of the model behind the keywords and behind the registers whose accesses count; places that
# nobody names.
OWN = re.compile(r"\w+_H|__\w+|asm|cregister|interrupt|\w+_(access|word)|rsvd\d*|char|const")
HOOK = re.compile(r"\w+ f28335_.*;|f28335_\w+")


def run(compiler, options, text):
    done = subprocess.run(
        [compiler, "-x", "c", "-std=gnu99", *options, "-"],
        input=text,
        text=True,
        check=False,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    if done.returncode != 0:
        sys.exit(done.stderr)
    return done.stdout


def macros(compiler, options):
    lines = run(compiler, [*options, "-E", "-dM"], INCLUDE).splitlines()
    return {
        m[1]: m[2].strip()
        for m in (re.match(r"#define (\w+)(?:\([^)]*\))?(.*)", line) for line in lines)
        if m
    }


def words(compiler, options):
    text = run(compiler, [*options, "-E", "-P"], INCLUDE)
    return set(re.findall(r"\b[A-Za-z_]\w*", re.sub(r'"[^"]*"', "", HOOK.sub("", text))))


def main():
    compiler, stand_ins, types, *directories = sys.argv[1:]
    ours = ["-I", stand_ins]
    theirs = [*KEYWORDS, "-include", types, *(word for d in directories for word in ("-I", d))]
    wrong = []
    have, real = macros(compiler, ours), macros(compiler, theirs)
    known = words(compiler, theirs) | set(real)
    for name in sorted((words(compiler, ours) | set(have)) - known):
        if not OWN.fullmatch(name):
            wrong.append(f"{name}: TI's headers do not have it")
    values = [
        (n, v)
        for n, v in have.items()
        if n in real and n[:2] != "__" and re.fullmatch(r"\(?(0x)?[0-9A-Fa-f]+[UL]*\)?", v)
    ]
    asserts = "".join(f'_Static_assert(({n}) == ({v}), "{n}");\n' for n, v in values)
    run(compiler, [*theirs, "-Dasm(x)=((void)0)", "-fsyntax-only"], INCLUDE + asserts)
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"stand-in headers: {len(values)} values and every name are TI's")


main()
