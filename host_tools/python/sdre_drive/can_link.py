# SPDX-License-Identifier: MIT
"""A drive on a CAN bus: its registers by SDO, and a heartbeat whose end stops the motor. The
objects are those of docs/canopen.md; python-can has the bus, canopen the protocol."""

from __future__ import annotations

import logging
import time
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, TypeVar

import can
import canopen
from canopen.sdo import SdoAbortedError
from canopen.sdo.exceptions import SdoError

from sdre_drive import register_map
from sdre_drive.can_aborts import TORN, refusal
from sdre_drive.can_share import Others
from sdre_drive.link import (
    BOARD_OBJECT,
    DIGEST_OBJECT,
    MAP_OBJECT,
    NAME_OBJECT,
    VERSION_OBJECT,
    DriveError,
    Link,
    Refused,
    Target,
)
from sdre_drive.registers import WORDS

T = TypeVar("T")

HOLDING, INPUT = 0x2000, 0x2800  # object of the first register
NAME, SOFTWARE, WATCHED = 0x1008, 0x100A, 0x1016
BLOCK, SELECTION, INPUTS, HOLDINGS = 0x5F00, 1, 2, 3
BLOCK_MOST = 64  # registers in a transfer
IDENTITY = 0x5F01
TEXTS = {1: NAME_OBJECT, 2: DIGEST_OBJECT, 3: MAP_OBJECT, 4: BOARD_OBJECT}  # by sub-index
NAME_OF_DRIVES = "sdre-drive"

CONTROLWORD = register_map.BY_NAME["CONTROLWORD"].address
ENABLES = 1 << 3  # of the control word: enable operation
START_NODE = 1  # NMT command
SILENCE_MS = 500  # as MODBUS_TIMEOUT: without a request for longer LOST_OPTION acts
BEAT_S = 0.05  # at most so often with the requests
OPERATIONAL = 5
ANSWER_S = 0.3  # canopen's own time; shorter than SILENCE_MS, as a heartbeat goes before each try
# Another client is in between, or a virtual drive behind a socket is busy: its time stands still.
PATIENCE_S = 2.0
NOTICE_S = 0.05  # longest wait for the reader's end
SCAN_S = 0.5  # chosen: 127 requests take 35 ms at 500 kbit/s
NODES = 127

REQUESTS, HEARTBEATS = 0x600, 0x700  # identifiers, plus the node
# Words of each register that has an object of its own.
WIDTHS = {
    base + r.address: WORDS[r.type]
    for base, rows in ((HOLDING, register_map.HOLDING), (INPUT, register_map.INPUT))
    for r in rows
}


def _octets(words: Sequence[int]) -> bytes:
    """Words of a block, low octet first."""
    return b"".join(word.to_bytes(2, "little") for word in words)


def _words(octets: bytes) -> List[int]:
    return [int.from_bytes(octets[n : n + 2], "little") for n in range(0, len(octets), 2)]


class _Ear(can.Listener):
    """Takes the adapter's errors, which python-can would print."""

    def on_message_received(self, msg: object) -> None:
        """canopen has a listener of its own."""

    def on_error(self, exc: Exception) -> None:
        logging.getLogger(__name__).info("CAN adapter: %s", exc)
        time.sleep(NOTICE_S)  # it comes again and again until the bus is closed


class CanLink(Link):
    """SDO of one node. The first control word that enables lets the drive watch this master. A
    heartbeat goes with the requests then, and a master that asks no more stops the motor."""

    def __init__(self, target: Target, tries: int) -> None:
        """`tries`: how often a question without an answer is asked."""
        for name in ("can", "canopen"):
            logging.getLogger(name).setLevel(logging.CRITICAL)  # what is wrong is raised
        self._target = target
        self._tries = tries
        self._network: Any = None
        self._node: Any = None
        self._watched: Optional[bytes] = None  # 1016h:1 before it named this master
        self._enabled = False  # by the last control word
        self._beat_s = 0.0
        self._others = Others()

    @property
    def _master(self) -> int:
        """Node number of this master: the last one, that the drive does not have."""
        return NODES - 1 if self._target.node == NODES else NODES

    def open(self) -> None:
        self._connect()
        self._require_alone(self._target.words)
        where = f"{self._target.words}, {self._target.can_rate} bit/s"
        try:
            name = self._text(NAME, 0)
        except Refused:
            name = ""
        except DriveError as e:
            self.close()
            raise DriveError(
                f"nothing answers as {where}: check the drive's power, the bus and its two "
                "terminators, --can-rate and --node; `sdre-drive --can .. find` tries all nodes"
            ) from e
        if name != NAME_OF_DRIVES:
            self.close()
            raise DriveError(f'{where} is another device: its name (1008h) is "{name}"')

    def close(self) -> None:
        """An enabled drive stops by itself 500 ms later. Any other one watches again what it
        watched before."""
        if self._network is None:
            return
        try:
            if self._watched is not None and not self._enabled:
                self._node.sdo.download(WATCHED, 1, self._watched)
        except (SdoError, can.CanError, OSError):
            pass  # the drive has gone, and has forgotten it
        self._watched = None
        self._drop()

    def _drop(self) -> None:
        network, self._network, self._node = self._network, None, None
        try:
            network.disconnect()
        except Exception as e:  # of any adapter's driver, which may be gone
            logging.getLogger(__name__).info("%s: %s", self._target.words, e)

    def _connect(self) -> None:
        """DriveError with the words of the adapter's driver."""
        if self._network is not None:
            return
        t = self._target
        options = {"sleep_after_open": 0.0} if _is_socket(t) else {}
        network = canopen.Network()
        network.NOTIFIER_CYCLE = NOTICE_S
        network.listeners.append(_Ear())
        try:
            network.connect(interface=t.can_interface, channel=t.can, bitrate=t.can_rate, **options)
        except (can.CanError, OSError, ValueError, ImportError, AttributeError, TypeError) as e:
            raise DriveError(
                f"no CAN adapter {t.can} ({t.can_interface}): {_line(e)}; check the channel and "
                "--can-interface"
            ) from e
        self._network = network
        self.turn_to(t.node)

    def turn_to(self, node: int) -> None:
        """Requests go to this node from now on."""
        self._node = self._network.add_node(node, canopen.ObjectDictionary())
        self._node.sdo.RESPONSE_TIMEOUT = ANSWER_S
        self._network.subscribe(REQUESTS + node, self._others.hear)

    def _require_alone(self, where: str) -> None:
        """DriveError while another client asks."""
        if self._others.are_there():
            self._drop()
            raise DriveError(
                f"another client talks to {where}, and CAN has room for one at a time: end it, or "
                "use --port or --tcp beside it"
            )

    def nodes(self) -> List[int]:
        """Numbers of all nodes that answer on the bus."""
        self._connect()
        for node in range(1, NODES + 1):
            self._network.subscribe(REQUESTS + node, self._others.hear)
        self._require_alone(f"a node on CAN {self._target.can}")
        try:
            self._network.scanner.search(NODES)
            time.sleep(SCAN_S)
        except (can.CanError, OSError) as e:
            raise DriveError(f"CAN {self._target.can}: {_line(e)}") from e
        return sorted(self._network.scanner.nodes)

    def read_input(self, first: int, count: int) -> List[int]:
        return self._read(INPUT, INPUTS, first, count)

    def read_holding(self, first: int, count: int) -> List[int]:
        return self._read(HOLDING, HOLDINGS, first, count)

    def write(self, first: int, words: Sequence[int]) -> None:
        self._tried(lambda: self._write(first, words))

    def identify(self) -> Dict[int, str]:
        """Objects 5F01h; nothing from a firmware that does not have them."""
        try:
            return {number: self._text(IDENTITY, sub) for sub, number in TEXTS.items()}
        except Refused:
            return {}

    def identify_basic(self) -> Dict[int, str]:
        return {VERSION_OBJECT: self._text(SOFTWARE, 0)}

    def _text(self, index: int, sub: int) -> str:
        octets = self._tried(lambda: self._node.sdo.upload(index, sub))
        return bytes(octets).decode("ascii", "replace")

    def _read(self, base: int, sub: int, first: int, count: int) -> List[int]:
        if WIDTHS.get(base + first) == count:
            octets = self._tried(lambda: self._node.sdo.upload(base + first, 0))
            return _words(octets)[::-1]  # of a value the high word comes first
        words: List[int] = []
        while len(words) < count:
            part = (first + len(words), min(count - len(words), BLOCK_MOST))
            words += self._tried(lambda p=part: self._read_block(sub, *p))  # type: ignore[misc]
        return words

    def _select(self, first: int, count: int) -> None:
        self._node.sdo.download(BLOCK, SELECTION, _octets((first, count)))

    def _read_block(self, sub: int, first: int, count: int) -> List[int]:
        self._select(first, count)
        return _words(self._node.sdo.upload(BLOCK, sub))

    def _write(self, first: int, words: Sequence[int]) -> None:
        enables = first == CONTROLWORD and bool(words[0] & ENABLES)
        if enables:
            self._let_watch()
        if WIDTHS.get(HOLDING + first) == len(words):
            self._node.sdo.download(HOLDING + first, 0, _octets(words[::-1]))
        else:
            self._select(first, len(words))
            self._node.sdo.download(BLOCK, HOLDINGS, _octets(words))
        if first == CONTROLWORD:
            self._enabled = enables

    def _let_watch(self) -> None:
        """The drive watches this master and is operational, before anything moves."""
        mine = _octets((SILENCE_MS, self._master))
        found = self._node.sdo.upload(WATCHED, 1)
        if self._watched is None:
            self._watched = bytes(found)
        if found != mine:
            self._node.sdo.download(WATCHED, 1, mine)
        self._beat()
        self._node.nmt.send_command(START_NODE)

    def _beat(self) -> None:
        """With a request, so that a master that hangs is silent too."""
        self._network.send_message(HEARTBEATS + self._master, [OPERATIONAL])
        self._beat_s = time.monotonic()

    def _tried(self, request: Callable[[], T]) -> T:
        """Once more after a lost answer: to ask or write the same twice does nothing else."""
        why: Optional[Exception] = None
        end_s = time.monotonic() + PATIENCE_S
        tries, patient = 0, _is_socket(self._target)
        while tries < self._tries or (patient and time.monotonic() < end_s):
            tries += 1
            self._connect()
            self._others.let_end()
            before = self._others.requests
            try:
                if self._watched is not None and time.monotonic() - self._beat_s > BEAT_S:
                    self._beat()
                answer = request()
                if self._others.requests == before:
                    return answer
            except SdoAbortedError as e:
                if self._others.requests == before and e.code not in TORN:
                    raise Refused(refusal(e.code)) from e
                why = e
            except SdoError as e:
                why = e
                if self._network.notifier.exception:  # the adapter has gone, and may be back
                    self._drop()
            except (can.CanError, OSError) as e:
                self._drop()
                why = e
            if self._others.requests != before:
                patient = True
                self._others.step_aside()
        raise DriveError(f"no answer from {self._target.words}") from why


def _is_socket(target: Target) -> bool:
    """A virtual drive's bus, or an adapter behind a network."""
    return target.can_interface == "slcan" and "://" in (target.can or "")


def _line(e: Exception) -> str:
    """The first line of another package's words."""
    words: Tuple[str, ...] = tuple(str(e).strip().splitlines())
    return words[0] if words else type(e).__name__
