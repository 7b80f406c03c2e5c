# SPDX-License-Identifier: MIT
"""A drive at the other end of a serial port or of a TCP connection: Modbus."""

from __future__ import annotations

import inspect
import logging
import os
from typing import Any, Dict, List, Optional, Sequence

from pymodbus.client import ModbusSerialClient, ModbusTcpClient
from pymodbus.exceptions import ModbusException
from serial.tools import list_ports

from sdre_drive.link import EXCEPTION_WORDS, DriveError, Link, Refused, Target

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


class ModbusLink(Link):
    """RTU on a serial port, or Modbus/TCP."""

    def __init__(self, target: Target, tries: int) -> None:
        """`tries`: how often a question without an answer is asked."""
        logging.getLogger("pymodbus.logging").setLevel(logging.CRITICAL)  # what is wrong is raised
        self._target = target
        self._tries = tries
        self.client = self._client_of(target)
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

    def open(self) -> None:
        try:
            connected = self.client.connect()
        except (OSError, ModbusException) as e:
            raise DriveError(f"{self._target.words}: {e}") from e
        if not connected:
            if self._target.serial_port:
                raise DriveError(why_closed(self._target.serial_port))
            raise DriveError(
                f"nothing answers at {self._target.words}: is the drive on, or `./dev serve` "
                f"running?"
            )

    def close(self) -> None:
        """The drive stops by itself 500 ms later."""
        self.client.close()

    def read_input(self, first: int, count: int) -> List[int]:
        return list(self._asked("read_input_registers", first, count=count).registers)

    def read_holding(self, first: int, count: int) -> List[int]:
        return list(self._asked("read_holding_registers", first, count=count).registers)

    def write(self, first: int, words: Sequence[int]) -> None:
        if len(words) == 1:
            self._asked("write_register", first, words[0])
        else:
            self._asked("write_registers", first, list(words))

    def identify(self) -> Dict[int, str]:
        """Objects of function 43/14, from the drive's name on."""
        return self._identified(3, 0x80)

    def identify_basic(self) -> Dict[int, str]:
        return self._identified(1, 0)

    def _identified(self, read_code: int, first: int) -> Dict[int, str]:
        answer = self._asked("read_device_information", read_code=read_code, object_id=first)
        return {
            number: octets.decode("ascii", "replace")
            for number, octets in answer.information.items()
        }

    def _asked(self, call: str, *args: Any, **kwargs: Any) -> Any:
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
                if self.client.connect():
                    return getattr(self.client, call)(*args, **kwargs)
            except (ModbusException, OSError) as e:
                self.client.close()  # what comes late belongs to nothing
                why = e
        raise DriveError(f"no answer from {self._target.words}") from why
