#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the blocks of README.md in a bare Debian, as printed.

    sudo tests/bare/bare_debian.py SUITE [--root DIR] [--keep] [--skip COMMAND]..

SUITE is bookworm or trixie. Needs root and debootstrap. The new root takes this machine's mirror,
certificates and settings of apt and pip, and a clone of this tree as committed. It shares the
machine's network. `./dev serve` stays up while the lines below it run. Lines that run until Ctrl-C
are interrupted; while `./dev drive run` runs, the speed that `status` reads must be the commanded
one.
"""

import argparse
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLONE = "/srv/sdre-drive"
SHEET = ROOT / "tests/data/facts/servo_60w.toml"  # the facts that README's own motor is read from
READY = b"Ctrl-C ends it"  # the last line of sdre-sil serve before it serves
KEPT = (
    "PIP_CERT",
    "PIP_INDEX_URL",
    "http_proxy",
    "https_proxy",
    "no_proxy",
)  # variables of this machine's network
PATIENCE_s = 3600  # chosen: nothing in README takes an hour
TURNING_s = (
    300  # chosen: from the call of `drive run` to its speed; the first call installs sdre-drive
)
SPEED_TOLERANCE_rpm = 10  # chosen: one per cent of the speed in README
UNTIL_INTERRUPTED = ("./dev drive run", "./dev drive move", "./dev drive ui")
INTERRUPTED_AFTER_s = 20


def blocks(text):
    """Lines of the indented blocks of a page, without their remarks."""
    for line in text.splitlines():
        if line.startswith("    ") and not line.startswith("     "):
            yield re.sub(r"\s+#.*", "", line.strip())


def mirror():
    """The first Debian archive in this machine's apt settings."""
    sources = [
        pathlib.Path("/etc/apt/sources.list"),
        *sorted(pathlib.Path("/etc/apt/sources.list.d").glob("*.*")),
    ]
    for path in sources:
        if path.suffix in (".list", ".sources") and path.exists():
            found = re.search(
                r"^(?:URIs:|deb(?: \[.*?\])?)\s+(\S+/debian/?)(?:\s|$)",
                path.read_text(),
                flags=re.M,
            )
            if found:
                return found[1]
    sys.exit("bare_debian: no Debian archive in /etc/apt")


def make_root(root, suite):
    subprocess.run(
        ["debootstrap", "--variant=minbase", suite, root, mirror()],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    for file in ("etc/resolv.conf", "etc/hosts", "etc/pip.conf"):
        if pathlib.Path("/", file).exists():
            shutil.copy(pathlib.Path("/", file), root / file)
    authorities = pathlib.Path(
        "/usr/local/share/ca-certificates"
    )  # the package ca-certificates of the root adds them
    if authorities.is_dir():
        shutil.copytree(authorities, root / authorities.relative_to("/"), dirs_exist_ok=True)
    settings = subprocess.run(
        ["apt-config", "dump", "Acquire"], check=True, capture_output=True, text=True
    ).stdout
    (root / "etc/apt/apt.conf.d/99host").write_text(settings)
    subprocess.run(["git", "clone", "-q", "--no-hardlinks", ROOT, root / CLONE[1:]], check=True)
    shutil.copy(SHEET, root / CLONE[1:] / "my_motor_facts.toml")


class Bare:
    """Commands in the new root."""

    def __init__(self, root):
        self.root = root

    def start(self, line, **options):
        kept = {k: v for k, v in os.environ.items() if k in KEPT}
        environment = {
            "HOME": "/root",
            "LANG": "C.UTF-8",
            "PATH": "/usr/sbin:/usr/bin:/sbin:/bin",
            "COLUMNS": "200",
            **kept,
        }
        return subprocess.Popen(
            ["chroot", self.root, "bash", "-c", f"cd {CLONE} && {line}"],
            env=environment,
            stdin=subprocess.DEVNULL,
            start_new_session=True,
            **options,
        )

    def read(self, line):
        return self.start(
            line, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        ).communicate()[0]


def end(process):
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGINT)
    return process.wait(60)


def serve(bare, line, log):
    """Starts the virtual drive; returns when it answers."""
    process = bare.start(line, stdout=log, stderr=subprocess.STDOUT)
    started = time.monotonic()
    while READY not in pathlib.Path(log.name).read_bytes():
        if process.poll() is not None or time.monotonic() - started > PATIENCE_s:
            sys.exit(f"{line}: did not come up\n{pathlib.Path(log.name).read_text()[-3000:]}")
        time.sleep(0.5)
    return process


def speed_of(bare):
    # The program itself: two at once would both install it.
    found = re.search(
        r"^\s*speed\s+(-?\d+) r/min", bare.read("build/venv/bin/sdre-drive status"), flags=re.M
    )
    return float(found[1]) if found else None


def turns(bare, line):
    """True when the motor has the speed of `./dev drive run SPEED`."""
    wanted, process = float(line.split()[-1]), bare.start(line, stdout=subprocess.DEVNULL)
    until = time.monotonic() + TURNING_s
    reached = False
    while not reached and process.poll() is None and time.monotonic() < until:
        speed = speed_of(bare)
        reached = speed is not None and abs(speed - wanted) < SPEED_TOLERANCE_rpm
        time.sleep(0.5)
    end(process)
    return reached


def run_line(bare, line):
    """True when the line did what README says of it."""
    if line.startswith("./dev drive run"):
        return turns(bare, line)
    process = bare.start(line, stdout=subprocess.DEVNULL)
    if line.startswith(UNTIL_INTERRUPTED):
        time.sleep(INTERRUPTED_AFTER_s)
        alive = process.poll() is None
        end(process)
        return alive
    return process.wait(PATIENCE_s) == 0


def run_blocks(bare, lines, skipped):
    server, failed = None, 0
    try:
        for line in lines:
            if line in skipped:
                print(f"{'skipped':>10}  {line}", flush=True)
                continue
            started, good = time.monotonic(), True
            if line == "./dev serve":
                with tempfile.NamedTemporaryFile() as log:
                    server = serve(bare, line, log)
            else:
                good = run_line(bare, line)
            failed += not good
            print(
                f"{time.monotonic() - started:8.0f} s  {line}{'' if good else '  FAILED'}",
                flush=True,
            )
    finally:
        if server:
            end(server)
    return failed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("suite", choices=("bookworm", "trixie"))
    parser.add_argument(
        "--root", type=pathlib.Path, help="a directory that is not there (default: a temporary one)"
    )
    parser.add_argument("--keep", action="store_true", help="keep the root")
    parser.add_argument(
        "--skip",
        action="append",
        default=[],
        metavar="COMMAND",
        help="a line of README to leave out",
    )
    arguments = parser.parse_args()
    if os.geteuid() != 0 or not shutil.which("debootstrap"):
        sys.exit("bare_debian: needs root and debootstrap (apt-get install debootstrap)")
    root = (arguments.root or pathlib.Path(tempfile.mkdtemp(prefix="bare-debian-"))).resolve()
    make_root(root, arguments.suite)
    proc = root / "proc"
    try:
        subprocess.run(["mount", "-t", "proc", "proc", proc], check=True)
        failed = run_blocks(
            Bare(root), list(blocks((ROOT / "README.md").read_text())), arguments.skip
        )
    finally:
        subprocess.run(["umount", proc], check=False)
        if not arguments.keep and not proc.is_mount():
            shutil.rmtree(root)
    print(f"{failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
