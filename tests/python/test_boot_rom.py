# SPDX-License-Identifier: MIT
"""`sdre-drive load --boot-rom` against a model of the boot ROM's SCI loader on a
pseudo-terminal."""

from __future__ import annotations

import os
import pty
import re
import subprocess
import threading
import tty
from pathlib import Path
from typing import Dict, List, Optional, Tuple

import pytest
import serial
from support import command, until

from sdre_drive import boot_rom
from sdre_drive.connection import Drive, DriveError, Target
from sdre_drive.registers import Mode

Blocks = List[Tuple[int, List[int]]]
SIL = os.environ.get(
    "SDRE_SIL", str(Path(__file__).resolve().parents[2] / "build/host/bin/sdre-sil")
)
ENTRY = 0x8000
BLOCKS: Blocks = [
    (ENTRY, [0x56BF, 0x0006, 0xFFFF]),
    (0x000000, [0x0040, 0x8000]),
    (0xC000, list(range(300))),
]


def stream(blocks: Blocks = BLOCKS, entry: int = ENTRY, key: int = boot_rom.KEY) -> bytes:
    """The same as hex2000 makes: low octet first, 32-bit values high word first."""
    words = [key, *[0] * boot_rom.RESERVED_WORDS, entry >> 16, entry & 0xFFFF]
    for first, content in blocks:
        words += [len(content), first >> 16, first & 0xFFFF, *content]
    return b"".join(word.to_bytes(2, "little") for word in [*words, 0])


def write(path: Path, octets: bytes) -> Path:
    path.write_text("\x02$A000000,\n" + " ".join(f"{o:02X}" for o in octets) + "\n\x03")
    return path


class Rom(threading.Thread):
    """Locks on "A", answers each octet with itself, copies blocks into its memory, ends with the
    jump."""

    def __init__(
        self, wrong_at: Optional[int] = None, silent_at: Optional[int] = None, deaf: int = 0
    ) -> None:
        super().__init__(daemon=True)
        self.wrong_at, self.silent_at, self.deaf = wrong_at, silent_at, deaf
        self.memory: Dict[int, int] = {}
        self.entry: Optional[int] = None
        self.taken = 0
        self.line, other = pty.openpty()
        tty.setraw(other)
        self.port = os.ttyname(other)
        self.other = other

    def octet(self) -> int:
        value = os.read(self.line, 1)[0]
        if self.taken == self.silent_at:
            raise EOFError
        answer = value ^ 0x10 if self.taken == self.wrong_at else value
        self.taken += 1
        os.write(self.line, bytes([answer]))
        return value

    def word(self) -> int:
        low = self.octet()
        return low | (self.octet() << 8)

    def long(self) -> int:
        high = self.word()
        return (high << 16) | self.word()

    def run(self) -> None:
        try:
            while os.read(self.line, 1) != b"A" or self.deaf > 0:
                self.deaf -= 1
            os.write(self.line, b"A")
            if self.word() != 0x08AA:
                return
            for _ in range(8):
                self.word()
            entry = self.long()
            while (count := self.word()) != 0:
                first = self.long()
                for k in range(count):
                    self.memory[first + k] = self.word()
            self.entry = entry
        except (OSError, EOFError):
            pass


def load(rom: Rom, program: boot_rom.Program, longest_s: float = 5.0) -> List[float]:
    shares: List[float] = []
    rom.start()
    with serial.Serial(rom.port, 38400, timeout=0.2) as line:
        boot_rom.send(line, program, shares.append, longest_s)
    rom.join(5.0)
    return shares


def test_every_block_arrives_and_the_program_starts(tmp_path: Path) -> None:
    rom, program = Rom(), boot_rom.read_program(write(tmp_path / "p.a00", stream()))
    shares = load(rom, program)
    assert rom.entry == ENTRY
    assert rom.memory == {
        first + k: word for first, content in BLOCKS for k, word in enumerate(content)
    }
    assert shares == sorted(shares) and shares[-1] == 1.0
    assert program.words == 305


def test_command_loads_and_says_what(tmp_path: Path) -> None:
    rom = Rom()
    rom.start()
    done = command(
        "load", "--boot-rom", str(write(tmp_path / "p.a00", stream())), "--port", rom.port
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout == "305 words in RAM, started at 008000h\n"
    assert rom.entry == ENTRY


def test_virtual_device_loads_and_starts_its_firmware(tmp_path: Path) -> None:
    line = str(tmp_path / "drive")
    with subprocess.Popen(
        [SIL, "serve", "--boot-rom", "--pty", line, "--tcp", "0", "--control", "0", "--for", "60"],
        stdout=subprocess.PIPE,
        text=True,
    ) as device:
        try:
            assert device.stdout
            text = "".join(iter(device.stdout.readline, "Ctrl-C ends it\n"))
            tcp = re.search(r"Modbus/TCP +(127\.0\.0\.1:\d+)", text)
            assert tcp
            file = str(write(tmp_path / "p.a00", stream()))
            done = command("load", "--boot-rom", file, "--port", line)
            assert done.returncode == 0, done.stderr
            assert device.stdout.readline() == (
                "boot ROM: 305 words in RAM, entry 008000h; the firmware starts\n"
            )
            with Drive(Target(tcp_port=int(tcp[1].split(":")[1]))) as drive:
                until(drive, lambda r: r.mode == Mode.READY)
        finally:
            device.terminate()


def test_rom_that_locks_late_is_waited_for(tmp_path: Path) -> None:
    rom = Rom(deaf=2)
    load(rom, boot_rom.read_program(write(tmp_path / "p.a00", stream())))
    assert rom.entry == ENTRY


@pytest.mark.parametrize("at", [0, 1, 17, 22, 40, 650])
def test_wrong_echo_and_silence_end_the_load_at_once(tmp_path: Path, at: int) -> None:
    program = boot_rom.read_program(write(tmp_path / "p.a00", stream()))
    for rom, words in (
        (Rom(wrong_at=at), f"octet {at} arrived as"),
        (Rom(silent_at=at), f"silent at octet {at} "),
    ):
        with pytest.raises(DriveError, match=words):
            load(rom, program)
        assert rom.entry is None
        assert rom.taken <= at + 1


def test_nobody_there(tmp_path: Path) -> None:
    rom = Rom(deaf=1000)
    with pytest.raises(DriveError, match="boot mode SCI-A"):
        load(rom, boot_rom.read_program(write(tmp_path / "p.a00", stream())), longest_s=0.5)


@pytest.mark.parametrize(
    ("octets", "words"),
    [
        (stream(key=0x10AA), "begins with 10AAh"),
        (stream([(0x300000, [1])], entry=0x300000), "cannot write flash"),
        (stream([(0x0002, [1])], entry=0x0002), "not in RAM"),
        (stream([(0xFFFF, [1, 2])], entry=0xFFFF), "not in RAM"),
        (stream(entry=0x9000), "entry 009000h is in no block"),
        (stream()[:-5], "ends within a block"),
        (stream()[:30], "ends within a block"),
        (b"", "no ASCII-hex stream"),
    ],
)
def test_streams_that_are_none_are_refused(tmp_path: Path, octets: bytes, words: str) -> None:
    file = write(tmp_path / "p.a00", octets)
    with pytest.raises(DriveError, match=words):
        boot_rom.read_program(file)
    done = command("load", "--boot-rom", str(file), "--port", "/dev/null")
    assert done.returncode == 1 and done.stderr.count("\n") == 1, done.stderr


def test_a_port_is_needed_and_only_one_task(tmp_path: Path) -> None:
    file = str(write(tmp_path / "p.a00", stream()))
    assert "--port" in command("load", "--boot-rom", file).stderr
    assert (
        "give an image, --forget, --accept-fallback or --boot-rom"
        in command("load", "--boot-rom", file, "--forget").stderr
    )
    assert "No such file" in command("load", "--boot-rom", file + "x", "--port", "/dev/null").stderr
