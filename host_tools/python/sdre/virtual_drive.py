# SPDX-License-Identifier: MIT
"""The firmware of a drive file on a virtual F28335 with a simulated motor, in real time:
`sdre-sil serve` and `sdre-drive` in one object.

    >>> with sdre.VirtualDrive("motor.toml") as drive:
    ...     drive.run(1000.0)
    ...     drive.speed_rpm
"""

from __future__ import annotations

import math
import os
import subprocess
import tempfile
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Dict, Optional, Union

from sdre._native import InputError
from sdre.drive import Drive
from sdre.toml_text import PathLike

if TYPE_CHECKING:
    from sdre_drive.registers import Reading

KEEP_PERIOD_S = 0.1  # the drive stops by itself after 0.5 s without a request
END_WAIT_S = 5.0  # chosen: the server ends within a second
RUN_WAIT_S = 20.0  # chosen: of the drive's time; alignment takes four seconds at most


def _server() -> str:
    """The program sdre-sil: of this wheel, or the one that SDRE_SIL names."""
    named = os.environ.get("SDRE_SIL")
    if named:
        return named
    import sdre_tools

    program = sdre_tools.ROOT / "bin" / "sdre-sil"
    if not program.exists():
        raise InputError("sdre-sil is not in this installation: name it in SDRE_SIL")
    return str(program)


class VirtualDrive:
    """A drive that can be run, loaded and read over its own Modbus server.

    Args:
        drive: a drive file, or a Drive; None is the shipped 390 W drive.

    Raises InputError in one line when the file is wrong, or when the package sdre-drive is missing.
    `connection` (sdre_drive.connection.Drive) has every register, `bench` (sdre_drive.bench.Bench)
    supply and faults. close() or the end of `with` ends the drive.
    """

    def __init__(self, drive: Union[PathLike, Drive, None] = None) -> None:
        try:
            from sdre_drive.bench import Bench
            from sdre_drive.connection import Drive as Connection
            from sdre_drive.connection import Target
        except ImportError as e:
            raise InputError(
                "VirtualDrive talks by the package sdre-drive: pip install sdre-drive"
            ) from e
        self._directory = tempfile.TemporaryDirectory(prefix="sdre-")
        self._process = self._serve(drive)
        self._end = threading.Event()
        try:
            ports = self._ports()
            self.connection = Connection(Target(tcp_port=ports["Modbus/TCP"]))
            self.bench = Bench(("127.0.0.1", ports["control"]))
            self._constants = self.connection.constants()
        except BaseException:
            self._end_process()
            raise
        self._keeper = threading.Thread(target=self._keep, daemon=True)
        self._keeper.start()

    def _serve(self, drive: Union[PathLike, Drive, None]) -> subprocess.Popen[str]:
        words = [_server(), "serve", "--tcp", "0", "--control", "0"]
        if isinstance(drive, Drive):
            file = Path(self._directory.name, f"{drive.name}.toml")
            file.write_text(drive.text, encoding="utf-8")
            words.append(str(file))
        elif drive is not None:
            words.append(str(drive))
        return subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def _ports(self) -> Dict[str, int]:
        """The ports that the server names. Raises InputError with its words when it ends."""
        from sdre_drive.bench import served_ports

        assert self._process.stdout and self._process.stderr
        ports = served_ports(self._process.stdout)
        if not ports:
            raise InputError(self._process.stderr.read().strip() or "sdre-sil serve has ended")
        return ports

    def _keep(self) -> None:
        """Reads now and then: a drive that nobody asks stops."""
        from sdre_drive.connection import DriveError

        while not self._end.wait(KEEP_PERIOD_S):
            try:
                self.connection.read()
            except DriveError:
                continue  # the next call of the user tells it

    def run(self, speed_rpm: float) -> Reading:
        """Starts the drive, or gives a running one this speed of the shaft in r/min; either sign.
        Returns when the drive runs: it has found its rotor position, and begins to accelerate.
        Raises sdre_drive.connection.DriveError when the drive refuses or trips."""
        from sdre_drive import session
        from sdre_drive.connection import DriveError
        from sdre_drive.registers import Mode

        session.start(self.connection, speed_rpm * self._constants.pole_pairs * math.pi / 30.0)
        reading = session.wait_for(
            self.connection, lambda r: r.mode not in (Mode.PRECHARGE, Mode.ALIGN), RUN_WAIT_S
        )
        if reading is None:
            raise DriveError("the drive does not come to run")
        session.require_moving(reading)
        return reading

    def stop(self) -> Reading:
        """Ends the run and waits until the bridge is off."""
        from sdre_drive import session

        return session.stop(self.connection)

    def read(self) -> Reading:
        """The live registers of one tick."""
        return self.connection.read()

    @property
    def speed_rpm(self) -> float:
        """Speed of the shaft now, r/min."""
        return self.read().speed_e_radps * 30.0 / math.pi / self._constants.pole_pairs

    def load(self, torque_Nm: float) -> None:
        """Sets the load of the bench, N m at the shaft."""
        self.bench.ask(f"load {torque_Nm!r}")

    def close(self) -> None:
        """Ends the drive; a second call does nothing."""
        self._end.set()
        self._keeper.join(END_WAIT_S)
        self.connection.close()
        self.bench.close()
        self._end_process()

    def _end_process(self) -> None:
        self._process.terminate()
        try:
            self._process.communicate(timeout=END_WAIT_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.communicate()
        self._directory.cleanup()

    def __enter__(self) -> VirtualDrive:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self) -> None:
        process: Optional[subprocess.Popen[str]] = getattr(self, "_process", None)
        if process is not None and process.poll() is None:
            process.kill()
