# SPDX-License-Identifier: MIT
"""Stands in for cl2000, ar2000 and hex2000: writes down how it was called and makes the files that
the build expects. It compiles nothing; what it shows is that the build asks for the right
things."""

import json
import os
import sys

VERSION = os.environ.get("STAND_IN_VERSION", "00000022.00000006.00000000")
IDENTITY = (
    f"INFO:compiler[TI] INFO:compiler_version[{VERSION}] INFO:arch[TMS320C28x] "
    "INFO:platform[] INFO:standard_default[90] INFO:extensions_default[ON]\n"
)
MAP = """MEMORY CONFIGURATION

         name            origin    length      used     unused   attr    fill
----------------------  --------  ---------  --------  --------  ----  --------
  FLASH                 00300000   00038000  00003800  00034800  RWIX
  RAML0123              00008000   00004000  00001800  00001800  RWIX
"""


def value(option, arguments):
    found = [a.split("=", 1)[1] for a in arguments if a.startswith(option + "=")]
    return found[-1] if found else None


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def main():
    tool, arguments = sys.argv[1], sys.argv[2:]
    if "STAND_IN_LOG" in os.environ:
        with open(os.environ["STAND_IN_LOG"], "a", encoding="utf-8") as log:
            log.write(json.dumps([tool, *arguments]) + "\n")
    if tool == "cl2000" and {"-h", "--version", "--help"} & set(arguments):
        print("Texas Instruments stand-in")
        return
    outputs = [
        value("--output_file", arguments),
        value("--outfile", arguments),
        value("--preproc_dependency", arguments),
    ]
    if tool == "cl2000" and not any(outputs):
        outputs = [
            os.path.splitext(os.path.basename(a))[0] + ".obj" for a in arguments if a.endswith(".c")
        ]
    if tool == "ar2000":
        outputs = [arguments[1]]
    for output in filter(None, outputs):
        text = "" if output == value("--preproc_dependency", arguments) else IDENTITY
        write(output, text)
    if value("--map_file", arguments):
        write(value("--map_file", arguments), MAP)


main()
