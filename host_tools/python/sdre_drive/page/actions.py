# SPDX-License-Identifier: MIT
"""The actions of a viewer. STOP needs no arm switch; whatever writes to drive or bench does."""

from __future__ import annotations

import threading
from typing import Any, Callable, Dict, NamedTuple

from sdre_drive import move, session
from sdre_drive.connection import DriveError
from sdre_drive.page import settings
from sdre_drive.page.checked import choice, flag, number, text
from sdre_drive.page.state import Watcher
from sdre_drive.scope import Setup

Args = Dict[str, Any]
TAKES_TURN_S = 5.0  # chosen: the longest start takes less
LARGEST_TURNS = 400_000.0  # chosen: 2^31 counts of the finest encoder are more
LOAD_Nm, DC_LINK_V = 1e5, 1e4  # as the bench's own bounds


class Action(NamedTuple):
    """How it is done, and whether it needs the arm switch and a turn at the drive."""

    do: Callable[[Watcher, Args], str]
    armed: bool = True
    drive: bool = True


def _run(w: Watcher, args: Args) -> str:
    speed = number(args, "speed_e_radps", -1e6, 1e6)
    w.jobs.require_none()
    w.require_motor()
    session.require_speed(w.drive, speed)
    w.begin_run()
    session.start(w.drive, speed)
    return f"runs to {w.words_of_speed(speed)}"


def _move(w: Watcher, args: Args) -> str:
    turns = number(args, "turns", -LARGEST_TURNS, LARGEST_TURNS)
    speed = number(args, "speed_e_radps", 1e-3, 1e6)
    relative, far = flag(args, "relative"), flag(args, "far")
    w.jobs.require_none()
    units = round(turns * w.require_motor().turn_units)
    w.begin_run()
    try:
        move.begin(w.drive, move.Wanted(units, relative, speed, far))
    except move.Far as e:
        raise DriveError(f"{str(e).partition(';')[0]}: allow more than ten turns first") from e
    return f"moves {'by' if relative else 'to'} {turns:g} turns, and holds the shaft there"


def _stop(w: Watcher, _args: Args) -> str:
    return w.stop_motor()


def _reset(w: Watcher, _args: Args) -> str:
    w.jobs.require_none()
    session.reset(w.drive)
    return "the fault is reset"


def _load(w: Watcher, args: Args) -> str:
    kind = choice(args, "kind", ("brake", "active"))
    w.bench.load(number(args, "load_Nm", -LOAD_Nm, LOAD_Nm), kind)
    return ""


def _dc_link(w: Watcher, args: Args) -> str:
    voltage = number(args, "dc_link_V", 1.0, DC_LINK_V)
    w.bench.tell(f"dc_link {voltage:g}")
    return f"the supply has {voltage:g} V"


def _break(w: Watcher, args: Args) -> str:
    words = text(args, "fault")
    note = w.bench.break_part(words)
    return f"broken: {words}" + (f"; {note}" if note else "")


def _mend(w: Watcher, _args: Args) -> str:
    w.bench.mend()
    return "all is whole, without load"


def _power_cycle(w: Watcher, _args: Args) -> str:
    w.bench.tell("power_cycle")
    return "power off and on"


def _scope(w: Watcher, args: Args) -> str:
    names = args.get("signals")
    if not isinstance(names, list) or not all(isinstance(n, str) for n in names):
        raise DriveError("signals: has to be a list of names")
    w.arm_scope(
        Setup(
            names,
            int(number(args, "decimation", 1, 65535)),
            choice(args, "trigger", ("now", "rising", "falling")),
            int(number(args, "channel", 1, 4)),
            number(args, "level", -2e6, 2e6),
            int(number(args, "before", 0, 511)),
        )
    )
    return ""


def _parameters(w: Watcher, _args: Args) -> str:
    w.ask_parameters()
    return ""


ACTIONS: Dict[str, Action] = {
    "stop": Action(_stop, armed=False, drive=False),
    "run": Action(_run),
    "move": Action(_move),
    "reset": Action(_reset),
    "load": Action(_load, drive=False),
    "dc_link": Action(_dc_link, drive=False),
    "break": Action(_break, drive=False),
    "mend": Action(_mend, drive=False),
    "power_cycle": Action(_power_cycle, drive=False),
    "scope": Action(_scope),
    "parameters": Action(_parameters, armed=False, drive=False),
    "write": Action(settings.write),
    "save": Action(settings.save),
    "defaults": Action(settings.restore),
    "commission": Action(settings.commission),
    "image": Action(settings.load_image),
    "forget_image": Action(settings.forget_image),
}


class Actor:
    """Carries actions out, those on the drive one after the other."""

    def __init__(self, watcher: Watcher) -> None:
        self.watcher = watcher
        self._turn = threading.Lock()

    def do(self, viewer: str, name: str, args: Args) -> str:
        """Words for what was done; DriveError says why it was not."""
        if name == "arm":
            self.watcher.viewers.arm(viewer, flag(args, "take_over"))
            return ""
        if name == "disarm":
            if self.watcher.viewers.disarm(viewer):
                self.watcher.release()
            return ""
        if name not in ACTIONS:
            raise DriveError(f'"{name}" is nothing that this page can do')
        action = ACTIONS[name]
        if action.armed:
            self.watcher.viewers.require_armed(viewer)
        if not action.drive:
            return action.do(self.watcher, args)
        if not self._turn.acquire(timeout=TAKES_TURN_S):
            raise DriveError("the drive is busy with what was asked before")
        try:
            with self.watcher.drive.action():
                return action.do(self.watcher, args)
        finally:
            self._turn.release()
