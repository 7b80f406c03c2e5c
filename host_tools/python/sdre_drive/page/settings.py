# SPDX-License-Identifier: MIT
"""Parameters, commissioning and images of constants, asked for by a page."""

from __future__ import annotations

import base64
import binascii
import re
import tempfile
import threading
from pathlib import Path, PurePath
from typing import Any, Callable, Dict

from sdre_drive import commission as finder
from sdre_drive import load, params, session
from sdre_drive.connection import DriveError
from sdre_drive.page.checked import number, text
from sdre_drive.page.job import Progress, Result
from sdre_drive.page.state import Watcher

Args = Dict[str, Any]
FOUND_FILE = "found.toml"
BOUNDS = re.compile(r"--current (\S+) --speed (\S+)")  # the next ones, as options of a command
NEXT = f"next: sdre-gains from-commissioning {FOUND_FILE} --drive DRIVE.toml --out NEW.toml"


def write(w: Watcher, args: Args) -> str:
    """Those that are given; all are read again in any case."""
    wanted = args.get("values")
    if not isinstance(wanted, dict):
        raise DriveError("values: has to be names with numbers")
    known = {name: number(wanted, name, -1e12, 1e12) for name in wanted}
    largest = w.drive.constants().current_max_A
    if known.get("MAX_CURRENT", 0.0) > largest:
        raise DriveError(f"MAX_CURRENT: at most {largest:g} A, which this drive's file allows")
    try:
        params.write(w.drive, known)
    finally:
        w.ask_parameters()
    return f"{len(known)} written: they last until the drive restarts; save keeps them"


def _restart(w: Watcher, name: str, command: Callable[..., params.Stored]) -> str:
    def work(progress: Progress, _end: threading.Event) -> Result:
        progress("the drive restarts", 0.5)
        try:
            return Result(f"in force: {command(w.drive).words}")
        finally:
            w.ask_parameters()

    w.jobs.begin(name, work)
    return ""


def save(w: Watcher, _args: Args) -> str:
    """Into the flash; the drive restarts."""
    return _restart(w, "storing of the parameters", params.save)


def restore(w: Watcher, _args: Args) -> str:
    """Forgets what is stored; the drive restarts."""
    return _restart(w, "return to the defaults", params.restore)


def commission(w: Watcher, args: Args) -> str:
    """The drive finds its motor: the shaft turns both ways."""
    current_A = number(args, "current_A", 0.01, 1e4)
    speed_m_radps = number(args, "speed_m_radps", 0.01, 1e4)
    w.jobs.require_none()
    largest = w.drive.constants().current_max_A
    if current_A > largest:
        raise DriveError(f"current: at most {largest:g} A, the limit of this drive")
    if w.drive.read().mode in session.MOVING:
        raise DriveError("the motor runs: STOP it first")

    def work(progress: Progress, end: threading.Event) -> Result:
        try:
            with w.drive.action():
                found = finder.run(w.drive, current_A, speed_m_radps, end, progress)
        except DriveError as e:
            raise DriveError(BOUNDS.sub(r"current \1 A, speed \2 r/min", str(e))) from e
        w.started_here = False
        words = f"the motor is found; {finder.shaft_words(found)}; {NEXT}"
        return Result(words, FOUND_FILE, finder.text(found))

    w.begin_run()
    w.jobs.begin("commissioning", work)
    return ""


def load_image(w: Watcher, args: Args) -> str:
    """A file of `sdre-gains image`; the drive restarts with it."""
    name = PurePath(text(args, "name").replace("\\", "/")).name or "the image"
    try:
        octets = base64.b64decode(text(args, "octets"), validate=True)
    except (binascii.Error, ValueError) as e:
        raise DriveError(f"{name}: has not arrived whole") from e

    def work(progress: Progress, _end: threading.Event) -> Result:
        with tempfile.TemporaryDirectory() as directory:
            path = Path(directory) / "image"
            path.write_bytes(octets)
            try:
                found = load.load(w.drive, path, lambda share: progress("is written", share))
            except DriveError as e:
                raise DriveError(str(e).replace(str(path), name)) from e
        w.ask_parameters()
        return Result(f"in force: {found.words}")

    w.jobs.begin("loading of an image", work)
    return ""


def forget_image(w: Watcher, _args: Args) -> str:
    """Back to the constants that are compiled in."""

    def work(progress: Progress, _end: threading.Event) -> Result:
        progress("the drive restarts", 0.5)
        found = load.forget(w.drive)
        w.ask_parameters()
        return Result(f"in force: {found.words}")

    w.jobs.begin("return to the compiled-in constants", work)
    return ""
