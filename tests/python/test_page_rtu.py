# SPDX-License-Identifier: MIT
"""Modbus RTU of the page in a browser, in Node: frames against pymodbus, and a master on a bad
line."""

from __future__ import annotations

import json
import random
import shutil
import subprocess
from pathlib import Path
from typing import Any, Iterator, List

import pytest
from pymodbus.framer import FramerRTU
from pymodbus.pdu.decoders import DecodePDU
from pymodbus.pdu.mei_message import ReadDeviceInformationRequest, ReadDeviceInformationResponse
from pymodbus.pdu.register_message import (
    ReadHoldingRegistersRequest,
    ReadInputRegistersRequest,
    ReadInputRegistersResponse,
    WriteMultipleRegistersRequest,
    WriteMultipleRegistersResponse,
    WriteSingleRegisterRequest,
)

SCRIPT = Path(__file__).with_name("rtu_frames.mjs")
pytestmark = pytest.mark.skipif(shutil.which("node") is None, reason="there is no Node")


class Page:
    """The page's modules in a process of their own."""

    def __init__(self) -> None:
        self.process = subprocess.Popen(
            ["node", SCRIPT], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1
        )

    def answer(self, call: str, **args: Any) -> Any:
        """Its answer, or its error."""
        assert self.process.stdin and self.process.stdout
        self.process.stdin.write(json.dumps({"call": call, **args}) + "\n")
        return json.loads(self.process.stdout.readline())

    def ask(self, call: str, **args: Any) -> Any:
        """Its answer, which has to be no error."""
        return self.answer(call, **args)["told"]


@pytest.fixture(scope="module")
def page() -> Iterator[Page]:
    """One for all tests."""
    one = Page()
    yield one
    one.process.stdin.close()
    one.process.wait(10)


def framed(pdu: Any) -> List[int]:
    """A frame of unit 1 as pymodbus makes it."""
    pdu.dev_id = 1
    return list(FramerRTU(DecodePDU(False)).buildFrame(pdu))


def test_crc_is_that_of_pymodbus(page: Page) -> None:
    draw = random.Random(1)
    for length in range(1, 254):
        octets = [draw.randrange(256) for _ in range(length)]
        high_first = FramerRTU.compute_CRC(bytes(octets))  # pymodbus swaps its octets
        assert page.ask("crc", octets=octets) == (high_first >> 8 | (high_first & 0xFF) << 8)


def test_requests_are_those_of_pymodbus(page: Page) -> None:
    draw = random.Random(2)
    for count in range(1, 126):
        first = draw.randrange(0x10000 - count)
        for code, kind in ((3, ReadHoldingRegistersRequest), (4, ReadInputRegistersRequest)):
            mine = page.ask("read", code=code, first=first, count=count)
            assert mine == framed(kind(address=first, count=count))
    for count in range(1, 124):
        values = [draw.randrange(0x10000) for _ in range(count)]
        single = WriteSingleRegisterRequest(address=count, registers=values)
        many = WriteMultipleRegistersRequest(address=count, registers=values)
        assert page.ask("write", first=count, values=values) == framed(
            single if count == 1 else many
        )
    for code, first in ((1, 0), (3, 0x80)):
        wanted = framed(ReadDeviceInformationRequest(read_code=code, object_id=first))
        assert page.ask("identify", code=code, first=first) == wanted


@pytest.mark.parametrize(
    "call, args",
    [
        ("read", {"code": 4, "first": 0, "count": 0}),
        ("read", {"code": 4, "first": 0, "count": 126}),
        ("read", {"code": 4, "first": 65535, "count": 2}),
        ("write", {"first": 0, "values": []}),
        ("write", {"first": 0, "values": [65536]}),
        ("write", {"first": 0, "values": [-1]}),
        ("write", {"first": 0, "values": [0.5]}),
    ],
)
def test_a_request_that_cannot_be_is_not_made(page: Page, call: str, args: Any) -> None:
    assert page.answer(call, **args)["kind"] == "RangeError"


def answers() -> List[Any]:
    """A request and its answer of each kind, and what the page reads in it."""
    values = [0, 1, 0x1234, 0xFFFF]
    told = ReadDeviceInformationResponse(
        read_code=1, information={0: "SDRE", 1: "drive", 2: "1.0.0"}
    )
    return [
        (
            "read_answer",
            framed(ReadInputRegistersRequest(address=5, count=4)),
            framed(ReadInputRegistersResponse(registers=values)),
            values,
        ),
        (
            "write_answer",
            framed(WriteMultipleRegistersRequest(address=7, registers=values)),
            framed(WriteMultipleRegistersResponse(address=7, count=4)),
            "taken",
        ),
        (
            "identify_answer",
            framed(ReadDeviceInformationRequest(read_code=1, object_id=0)),
            framed(told),
            {"objects": {"0": "SDRE", "1": "drive", "2": "1.0.0"}, "next": 0},
        ),
    ]


@pytest.mark.parametrize("call, request_, answer, wanted", answers(), ids=lambda x: str(x)[:20])
def test_answers_are_read_and_no_disturbed_one_is(
    page: Page, call: str, request_: List[int], answer: List[int], wanted: Any
) -> None:
    assert page.ask(call, request=request_, octets=answer) == wanted
    for length in range(len(answer)):
        assert not page.ask("whole", octets=answer[:length])
        assert page.answer(call, request=request_, octets=answer[:length])["kind"] == "NoAnswer"
    assert page.ask("whole", octets=answer)
    for bit in range(8 * len(answer)):
        other = list(answer)
        other[bit // 8] ^= 1 << bit % 8
        assert "error" in page.answer(call, request=request_, octets=other), bit


def test_an_answer_to_something_else_is_none(page: Page) -> None:
    other = {
        "read_answer": ReadInputRegistersResponse(registers=[1, 2, 3]),
        "write_answer": WriteMultipleRegistersResponse(address=8, count=4),
        "identify_answer": ReadInputRegistersResponse(registers=[1, 2, 3]),
    }
    for call, request, _, _ in answers():
        told = page.answer(call, request=request, octets=framed(other[call]))
        assert told["kind"] == "NoAnswer"


def test_an_exception_is_told_in_words(page: Page) -> None:
    request = framed(ReadInputRegistersRequest(address=5, count=4))
    octets = [1, 0x84, 2]
    crc = page.ask("crc", octets=octets)
    octets += [crc & 0xFF, crc >> 8]
    told = page.answer("read_answer", request=request, octets=octets)
    assert told == {"error": "the drive does not have this register", "kind": "Refused"}


def test_the_master_asks_again_once_and_stops_first(page: Page) -> None:
    _, ask, answer, values = answers()[0]
    broken = [*answer[:-1], answer[-1] ^ 1]
    read = ["input", 5, 4]
    in_pieces = [answer[:1], answer[1:6], answer[6:]]
    for lines in ([in_pieces], [[broken], in_pieces], [[], in_pieces]):
        told = page.ask("master", answers=lines, calls=[read])
        assert told == {"told": [values], "sent": [ask] * len(lines)}
    told = page.ask("master", answers=[[], [broken], [answer]], calls=[read])
    assert told["sent"] == [ask, ask] and told["told"][0].startswith("no answer from a line")
    stop = page.ask("write", first=0, values=[0])
    told = page.ask(
        "master", answers=[[answer], [stop], [answer]], calls=[read, read, ["writeAtOnce", 0, [0]]]
    )
    assert told == {"told": [values, values, "taken"], "sent": [ask, stop, ask]}
