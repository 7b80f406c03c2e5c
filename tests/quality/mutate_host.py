# SPDX-License-Identifier: MIT
"""Changes one place of a host module at a time and looks whether its tests see it.

    mutate_host.py [COUNT] [MODULE..]     COUNT mutants of each module (default 20), drawn evenly,
                                          the same every time

Needs the objects of ./dev test in build/host. A mutant takes the place of its object when a test is
linked. One that no compiler accepts, or that makes the same object, is not counted. Survivors that
host_survivors.toml names with a reason are counted apart. Exit code 1 below 90 % of the others.
"""

import json
import random
import shlex
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import mutate
import tomllib
import unit_build as ub

BUILD = ub.ROOT / "build/host"
SECONDS = 60

# Modules with the tests that have to see their mutants.
MODULES = {
    "design/certificate.cpp": ["host_tools_design", "host_tools_verdict"],
    "design/verdict.cpp": ["host_tools_verdict", "host_tools_verdict_points"],
    "sil/eval/metrics.cpp": ["sil_metrics"],
    "sil/plant/plant.cpp": ["sil_plant", "sil_shaft", "sil_motor_effects", "sil_inverter"],
    "sil/sensors/adc.cpp": ["sil_adc"],
    "sil/sensors/encoder.cpp": [
        "sil_encoder_readings",
        "sil_encoder",
        "sil_encoder_edges",
        "sil_encoder_disc",
    ],
}

CHANGES = [
    *mutate.CHANGES,
    (r"\b0\.5\b", "0.6"),
    (r"\b1\.0\b", "1.1"),
    (r"\b2\.0\b", "2.2"),
    (r"\b0\.0\b", "0.1"),
    (r"\bstd::max\b", "std::min"),
    (r"\bstd::min\b", "std::max"),
    (r"\bstd::abs\b", ""),
    (r"\bcos\b", "sin"),
    (r"\bsin\b", "cos"),
]


def compiled_as(source):
    """The build's entry of a source, or of the file that includes it with its whole room."""
    entries = json.loads((BUILD / "compile_commands.json").read_text())
    for entry in entries:
        if entry["file"] == str(source):
            return entry
    return next(
        e for e in entries if "/Unity/" in e["file"] and str(source) in Path(e["file"]).read_text()
    )


def compile_command(entry):
    """The build's own command without its output and its file of dependencies."""
    words = shlex.split(entry["command"])
    words = words[words.index(next(w for w in words if w.endswith("c++"))) :]
    kept, skip = [], False
    for word in words:
        if skip or word in ("-MD", "-c", entry["file"]):
            skip = False
        elif word in ("-o", "-MT", "-MF"):
            skip = True
        else:
            kept.append(word)
    return kept


def link_command(test):
    """The words of a test's link command, and the place of the output's name."""
    told = ub.run(["ninja", "-t", "commands", f"tests/test_{test}"], cwd=BUILD).stdout
    words = shlex.split(told.strip().split("\n")[-1].removeprefix(": && ").removesuffix(" && :"))
    return words, words.index("-o") + 1


class Judge:
    def __init__(self, module):
        self.source = ub.ROOT / "host_tools" / module
        entry = compiled_as(self.source)
        self.compile = compile_command(entry)
        self.whole = Path(entry["file"])
        self.links = [link_command(test) for test in MODULES[module]]
        self.work = ub.ROOT / "build/mutate_host" / module
        self.work.mkdir(parents=True, exist_ok=True)
        self.plain = self.object_of(self.source.read_text(), "plain")
        if self.tried("plain") != "survived":
            sys.exit(f"{module}: its tests fail without a mutant")

    def object_of(self, text, name):
        """The object of a text, None when it does not compile."""
        # Names of the same length and place: nothing else differs in the object.
        room = self.work / f"{name:0>5}"
        room.mkdir(exist_ok=True)
        file, target = room / self.source.name, self.work / f"{name}.o"
        file.write_text(text)
        if self.whole != self.source:
            together = self.whole.read_text().replace(str(self.source), str(file))
            file = room / "whole.cpp"
            file.write_text(together)
        command = [*self.compile, "-w", f"-I{self.source.parent}", "-c", file, "-o", target]
        done = ub.run(command, cwd=BUILD)
        return target.read_bytes() if done.returncode == 0 else None

    def verdict(self, job):
        """'killed', 'survived', or '' of a mutant that is none."""
        index, number, changed = job
        lines = self.source.read_text().split("\n")
        lines[number] = changed
        made = self.object_of("\n".join(lines), index)
        if made is None or made == self.plain:
            return ""
        return self.tried(index)

    def tried(self, name):
        """The same of an object."""
        program = self.work / f"{name}.test"
        for words, output in self.links:
            mine = [*words[:output], program, self.work / f"{name}.o", *words[output + 1 :]]
            if ub.run(mine, cwd=BUILD).returncode != 0:
                return ""
            if not ub.passes(program, SECONDS):
                return "killed"
        return "survived"


def main():
    arguments = sys.argv[1:]
    count = int(arguments.pop(0)) if arguments and arguments[0].isdigit() else 20
    listed = tomllib.loads((ub.ROOT / "tests/quality/host_survivors.toml").read_text())
    known = {(s["module"], s["changed"]) for s in listed.get("survivor", [])}
    enough = True
    for module in arguments or MODULES:
        judge = Judge(module)
        everything = list(mutate.mutants(judge.source, CHANGES))
        drawn = random.Random(1).sample(everything, min(count, len(everything)))
        with ThreadPoolExecutor(ub.JOBS) as pool:
            verdicts = list(pool.map(judge.verdict, [(i, *m) for i, m in enumerate(drawn)]))
        survived = [m for m, verdict in zip(drawn, verdicts) if verdict == "survived"]
        new = [m for m in survived if (module, m[1].strip()) not in known]
        for number, line in new:
            print(f"{module}:{number + 1}: {line.strip()}")
        killed = verdicts.count("killed")
        share = 100.0 * killed / max(killed + len(new), 1)
        enough = enough and share >= mutate.WANTED
        print(
            f"{module}: {killed} of {killed + len(new)} mutants killed, {share:.0f} %, "
            f"{len(survived) - len(new)} listed ({len(everything)} possible)",
            flush=True,
        )
    return 0 if enough else 1


if __name__ == "__main__":
    sys.exit(main())
