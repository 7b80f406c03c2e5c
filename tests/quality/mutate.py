# SPDX-License-Identifier: MIT
"""Changes one place of firmware/control or firmware/app at a time and looks whether a unit test
sees it.

    mutate.py [COUNT] [FILE..]     COUNT mutants (default 200), drawn evenly, the same every time;
                                   of these files only
    mutate.py aimed                the changes of aimed_mutants.toml, each by the test that it names

A mutant that no compiler accepts, or that makes the same object, is not counted. Each is tried by
the tests of its own module first, then by all others. Prints what survives and the share that is
killed; exit code 1 below 90 %. All aimed mutants have to be killed.
"""

import random
import re
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import tomllib
import unit_build as ub

WANTED = 90.0
SECONDS = 60

# Patterns in a line of code, and their replacements.
CHANGES = [
    (r"(?<![<>=!-])>(?![>=])", ">="),
    (r"(?<![<>=])<(?![<=])", "<="),
    (r">=", ">"),
    (r"<=", "<"),
    (r"==", "!="),
    (r"!=", "=="),
    (r"&&", "||"),
    (r"\|\|", "&&"),
    (r"(?<=\w |\) )\+(?= )", "-"),
    (r"(?<=\w |\) )-(?= )", "+"),
    (r"(?<=\w |\) )\*(?= [\w(])", "/"),
    (r"(?<= )/(?= )", "*"),
    (r"\+=", "-="),
    (r"-=", "+="),
    (r"\btrue\b", "false"),
    (r"\bfalse\b", "true"),
    (r"\b0\.5f\b", "0.6f"),
    (r"\b1\.0f\b", "1.1f"),
    (r"\b2\.0f\b", "2.2f"),
    (r"\b0\.0f\b", "0.1f"),
    (r"\b0U?\b", "1"),
    (r"\b1U\b", "2U"),
    (r"(?<=[=(,?:] )-(?=[\w(])", ""),
    (r"!(?=[\w(])", ""),
    (r"\bbase_min\b", "base_max"),
    (r"\bbase_max\b", "base_min"),
    (r"\.d\b", ".q"),
    (r"\.q\b", ".d"),
    (r"^(\s+)([\w>.\[\]-]+ [-+|&]?= .*;|\w+\(.*\);)$", r"\1;"),
]


def mutants(source, changes):
    """(line number, changed line) of every change that a file allows."""
    for number, line in enumerate(ub.code_lines(source.read_text())):
        if line.startswith("}") or not line.startswith(" "):
            continue  # declarations
        for pattern, to in changes:
            for match in re.finditer(pattern, line):
                changed = line[: match.start()] + match.expand(to) + line[match.end() :]
                if changed != line:
                    yield number, changed


def order_of(names, module):
    """The tests of a module, then those of what is named alike, then all others."""
    own = [n for n in names if n == f"test_{module}"]
    near = [n for n in names if n not in own and (module in n or n[5:] in module)]
    return own + near + [n for n in names if n not in own and n not in near]


class Judge:
    def __init__(self, build):
        self.build = build
        self.names = ub.tests()
        self.objects = {}

    def plain(self, source):
        """The object of the unchanged file, as bytes."""
        if source not in self.objects:
            self.objects[source] = self.build.object(source.stem).read_bytes()
        return self.objects[source]

    def verdict(self, job):
        """'killed', 'survived', or '' of a mutant that is none."""
        index, source, number, changed = job
        lines = source.read_text().split("\n")
        lines[number] = changed
        return self.tried(index, source, "\n".join(lines), order_of(self.names, source.stem))

    def aimed(self, job):
        """The same of a mutant of the list; 'stale' when its text is not there once."""
        index, mutant = job
        source = next(s for s in ub.sources() if s.name == mutant["file"])
        text = source.read_text()
        if text.count(mutant["old"]) != 1:
            return "stale"
        text = text.replace(mutant["old"], mutant["new"])
        return self.tried(index, source, text, [mutant["test"]]) or "stale"

    def tried(self, index, source, text, names):
        work = self.build.directory / f"mutant{index}"
        work.mkdir(exist_ok=True)
        file, target = work / source.name, work / "mutant.o"
        file.write_text(text)
        try:
            compiled = ub.run(
                ["gcc", *self.build.flags, f"-I{source.parent}", "-c", file, "-o", target], cwd=work
            )
            if compiled.returncode != 0 or target.read_bytes() == self.plain(source):
                return ""
            for name in names:
                program = work / "test"
                linked = self.build.link(name, program, {source.stem: target})
                if linked.returncode != 0:
                    return ""
                if not ub.passes(program, SECONDS):
                    return "killed"
            return "survived"
        finally:
            for path in work.iterdir():
                path.unlink()
            work.rmdir()


def aimed():
    file = Path(__file__).with_name("aimed_mutants.toml")
    mutants_of_list = tomllib.loads(file.read_text())["mutant"]
    judge = Judge(ub.Build(ub.ROOT / "build/mutate", ["-O1"]))
    with ThreadPoolExecutor(ub.JOBS) as pool:
        verdicts = list(pool.map(judge.aimed, enumerate(mutants_of_list)))
    for mutant, verdict in zip(mutants_of_list, verdicts):
        if verdict != "killed":
            print(f"{mutant['file']}: {verdict}: {mutant['old'].strip()}")
    print(f"{verdicts.count('killed')} of {len(verdicts)} aimed mutants killed")
    return 0 if verdicts.count("killed") == len(verdicts) else 1


def main():
    arguments = sys.argv[1:]
    if arguments == ["aimed"]:
        return aimed()
    count = int(arguments.pop(0)) if arguments and arguments[0].isdigit() else 200
    sources = [s for s in ub.sources() if not arguments or s.name in arguments]
    build = ub.Build(ub.ROOT / "build/mutate", ["-O1"])
    judge = Judge(build)
    everything = [(s, n, line) for s in sources for n, line in mutants(s, CHANGES)]
    drawn = random.Random(1).sample(everything, min(count, len(everything)))
    drawn = [(i, *m) for i, m in enumerate(drawn)]
    with ThreadPoolExecutor(ub.JOBS) as pool:
        verdicts = list(pool.map(judge.verdict, drawn))
    for (_, source, number, line), verdict in zip(drawn, verdicts):
        if verdict == "survived":
            print(f"{source.name}:{number + 1}: {line.strip()}")
    killed, survived = verdicts.count("killed"), verdicts.count("survived")
    share = 100.0 * killed / max(killed + survived, 1)
    print(
        f"{killed} of {killed + survived} mutants killed, {share:.1f} % ({len(everything)} "
        f"possible)"
    )
    return 0 if share >= WANTED else 1


if __name__ == "__main__":
    sys.exit(main())
