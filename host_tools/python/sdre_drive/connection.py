# SPDX-License-Identifier: MIT
"""A drive at the other end of a serial port or of a TCP connection."""

from __future__ import annotations

import inspect
import logging
import os
import threading
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Sequence, Tuple

from pymodbus.client import ModbusSerialClient, ModbusTcpClient
from pymodbus.exceptions import ModbusException
from serial.tools import list_ports

from sdre_drive import register_map, registers
from sdre_drive.register_map import Register
from sdre_drive.registers import BY_NAME, Constants, ControlWord, Reading

log = logging.getLogger(__name__)
MAP_OBJECT, VERSION_OBJECT = 0x82, 2  # of function 43/14
FORMATS = {
    "8E1": ("E", 1),
    "8O1": ("O", 1),
    "8N2": ("N", 2),
}  # parity and stop bits, in the order of LINE_FORMAT
# The drive withdraws run after 500 ms without a request: two tries have to fit. TCP loses nothing,
# and what answers there may be busy: a virtual drive's time then stands still with it.
SERIAL_TIMEOUT_S = 0.2
TCP_TIMEOUT_S = 2.0
# of a line so slow that the longest answer takes more than that; the drive's time-out has to be
# longer then
SLOW_OCTETS = 300
TRIES = 2

EXCEPTION_WORDS = {
    1: "does not know this function",
    2: "does not have this register",
    3: "refuses this value: it is out of the drive's range",
    4: "does not take or tell this now",
    11: "did not answer behind its gateway",
}


def other_map(firmware: str) -> str:
    """Says which side to update when the firmware has another register map."""

    def numbers(version: str) -> Tuple[int, ...]:
        return tuple(int(n) for n in version.split(".") if n.isdigit())

    here = register_map.VERSION
    what = (
        f"the drive's firmware {firmware or 'of no version'} has other registers than this "
        f"sdre-drive {here}"
    )
    if numbers(firmware) < numbers(here):
        return f"{what}: update the firmware, or use sdre-drive {firmware or 'of its build'}"
    if numbers(firmware) > numbers(here):
        return f"{what}: update sdre-drive"
    return f"{what}: take both from one build"


class DriveError(Exception):
    """One line for the user."""


class Refused(DriveError):
    """The drive has answered, with an exception."""


@dataclass(frozen=True)
class Target:
    """Where the drive is: a serial port, or host and port of Modbus/TCP."""

    serial_port: Optional[str] = None
    host: str = "127.0.0.1"
    tcp_port: int = 1502
    baud: int = 115200
    format: str = "8E1"
    unit: int = 1

    @property
    def words(self) -> str:
        """For messages."""
        return self.serial_port or f"{self.host}:{self.tcp_port}"

    @property
    def is_local(self) -> bool:
        """The drive is on this machine, as a virtual one is."""
        return self.serial_port is None and self.host in ("127.0.0.1", "localhost", "::1")


def _unit_word() -> str:
    """Name of the address in pymodbus: `slave` up to 3.9."""
    return (
        "device_id"
        if "device_id" in inspect.signature(ModbusTcpClient.write_register).parameters
        else "slave"
    )


# Windows has neither, and its serial ports need neither.
_NO_WAITING = getattr(os, "O_NOCTTY", 0) | getattr(os, "O_NONBLOCK", 0)


def is_pseudo_terminal(serial_port: str) -> bool:
    """A virtual drive's."""
    return os.path.realpath(serial_port).startswith("/dev/pts/")


def why_closed(serial_port: str) -> str:
    """The operating system's own words about a port that cannot be opened, and what to do."""
    try:
        os.close(os.open(serial_port, os.O_RDWR | _NO_WAITING))
    except FileNotFoundError as e:
        here = ", ".join(sorted(p.device for p in list_ports.comports())) or "none"
        return f"{serial_port}: {e.strerror}; serial ports here: {here}"
    except PermissionError as e:
        return f"{serial_port}: {e.strerror}: its group, mostly dialout, has to have you"
    except OSError as e:
        return f"{serial_port}: {e.strerror or e}"
    return f"{serial_port}: it opens, but is no serial port, or another program has it"


class Drive:
    """Blocking requests; one at a time, from any thread. All of them raise DriveError."""

    def __init__(self, target: Target, once: bool = False) -> None:
        """`once`: a question without an answer is not asked again."""
        logging.getLogger("pymodbus.logging").setLevel(logging.CRITICAL)  # what is wrong is raised
        self.target = target
        self._tries = 1 if once else TRIES
        self._lock = threading.Lock()
        self._constants: Optional[Constants] = None
        self._client = self._client_of(target)
        self._unit = {_unit_word(): target.unit} if target.unit != 1 else {}

    @staticmethod
    def _client_of(target: Target) -> Any:
        if not target.serial_port:
            return ModbusTcpClient(
                target.host, port=target.tcp_port, timeout=TCP_TIMEOUT_S, retries=0
            )
        virtual = is_pseudo_terminal(target.serial_port)  # it has no line and no parity
        parity, stop = ("N", 1) if virtual else FORMATS[target.format]
        slow_s = SLOW_OCTETS * 11 / target.baud
        return ModbusSerialClient(
            target.serial_port,
            baudrate=target.baud,
            parity=parity,
            stopbits=stop,
            timeout=TCP_TIMEOUT_S if virtual else max(SERIAL_TIMEOUT_S, slow_s),
            retries=0,
        )

    def move_to(self, target: Target) -> None:
        """The drive has another line or address from now on."""
        with self._lock:
            self._client.close()
            self.target = target
            self._client = self._client_of(target)
            self._unit = {_unit_word(): target.unit} if target.unit != 1 else {}

    def __enter__(self) -> Drive:
        self.open()
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def open(self) -> None:
        """Connects; a drive that is not there is known here."""
        try:
            connected = self._client.connect()
        except (OSError, ModbusException) as e:
            raise DriveError(f"{self.target.words}: {e}") from e
        if not connected:
            if self.target.serial_port:
                raise DriveError(why_closed(self.target.serial_port))
            raise DriveError(
                f"nothing answers at {self.target.words}: is the drive on, or `./dev serve` "
                f"running?"
            )

    def close(self) -> None:
        """The drive stops by itself 500 ms later."""
        self._client.close()

    def read(self) -> Reading:
        """The live registers of one tick."""
        period_s = self.constants().period_s
        return registers.decode(self._block(register_map.LIVE), period_s)

    def constants(self) -> Constants:
        """Constants of the drive, read once."""
        if self._constants is None:
            self._check_map()
            self._constants = registers.constants(self._block(register_map.CONSTANTS))
            log.info("%s: %s", self.target.words, self._constants)
        return self._constants

    def _check_map(self) -> None:
        """DriveError when firmware and tool are of different register maps: which side to
        update."""
        told = self.identify()
        if told.get(MAP_OBJECT) == register_map.DIGEST:
            return
        raise DriveError(other_map(self.identify_basic().get(VERSION_OBJECT, "")))

    def traces(self) -> Dict[str, float]:
        """How scope and record stand."""
        return self.values(register_map.TRACES)

    def values(self, wanted: Sequence[Register]) -> Dict[str, float]:
        """A block of input registers of one tick, by name in SI units."""
        return registers.values(wanted, self._block(wanted))

    def words(self, first: int, count: int) -> List[int]:
        """Input registers as they are."""
        values = list(self._asked("read_input_registers", first, count=count).registers)
        if len(values) != count:
            raise DriveError("the drive answered something else than it was asked")
        return values

    def holding(self, first: int, count: int) -> List[int]:
        """Holding registers as they are."""
        return list(self._asked("read_holding_registers", first, count=count).registers)

    def parameter(self, name: str) -> float:
        """A holding register, in its unit."""
        r = BY_NAME[name]
        return registers.value_of(r, self.holding(r.address, registers.WORDS[r.type]))

    def write(self, name: str, value: float) -> None:
        """A holding register, in its unit."""
        r = BY_NAME[name]
        log.info("%s: writes %s = %g %s", self.target.words, name, value, r.unit)
        try:
            words = registers.words_of(r, value)
        except ValueError as e:
            raise DriveError(str(e)) from e
        if len(words) == 1:
            self._asked("write_register", r.address, words[0])
        else:
            self._asked("write_registers", r.address, words)

    def _block(self, wanted: Sequence[Register]) -> List[int]:
        return self.words(*registers.block(wanted))

    def set_speed(self, speed_e_radps: float) -> None:
        """rad/s electrical; acts when the drive runs."""
        self.write("SPEED", speed_e_radps)

    def set_run(self, run: bool) -> None:
        """Enables the operation after a shut down, or stops any run."""
        for word in (
            (ControlWord.SHUT_DOWN, ControlWord.ENABLE) if run else (ControlWord.DISABLE_VOLTAGE,)
        ):
            self.write("CONTROLWORD", word)

    def reset(self) -> None:
        """Leaves FAULT when what caused it has gone."""
        for word in (
            ControlWord.DISABLE_VOLTAGE,
            ControlWord.FAULT_RESET,
            ControlWord.DISABLE_VOLTAGE,
        ):
            self.write("CONTROLWORD", word)

    def identify(self) -> Dict[int, str]:
        """Objects of function 43/14, from the drive's name on."""
        return self._identified(3, 0x80)

    def identify_basic(self) -> Dict[int, str]:
        """Vendor, product and firmware version."""
        return self._identified(1, 0)

    def _identified(self, read_code: int, first: int) -> Dict[int, str]:
        answer = self._asked("read_device_information", read_code=read_code, object_id=first)
        return {
            number: octets.decode("ascii", "replace")
            for number, octets in answer.information.items()
        }

    def write_words(self, first: int, values: List[int]) -> None:
        """Holding registers as they are."""
        self._asked("write_registers", first, values)

    def _asked(self, call: str, *args: Any, **kwargs: Any) -> Any:
        with self._lock:
            answer = self._tried(call, *args, **self._unit, **kwargs)
        if answer.isError():
            code = getattr(answer, "exception_code", None)
            words = EXCEPTION_WORDS.get(code) if isinstance(code, int) else None
            raise Refused(f"the drive {words or f'answers with exception {code}'}")
        return answer

    def _tried(self, call: str, *args: Any, **kwargs: Any) -> Any:
        """Once more after a lost answer: to ask or write the same twice does nothing else."""
        why: Optional[Exception] = None
        for _ in range(self._tries):
            try:
                if self._client.connect():
                    return getattr(self._client, call)(*args, **kwargs)
            except (ModbusException, OSError) as e:
                self._client.close()  # what comes late belongs to nothing
                why = e
        raise DriveError(f"no answer from {self.target.words}") from why
