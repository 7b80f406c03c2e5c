# SPDX-License-Identifier: MIT
"""Reads TI linker command files as far as this project uses their language."""

import re
from dataclasses import dataclass, field


class Refused(Exception):
    """The file is not what the device needs, or not understood."""


@dataclass
class Range:
    name: str
    origin: int
    length: int

    @property
    def end(self):
        return self.origin + self.length


@dataclass
class Section:
    name: str
    load: str
    run: str
    type: str = ""
    inputs: list = field(default_factory=list)
    symbols: dict = field(default_factory=dict)  # name -> operator


def preprocess(text, defines):
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    kept, active = [], [True]
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["#ifdef"]:
            active.append(words[1] in defines)
        elif words[:1] == ["#endif"]:
            active.pop()
            if not active:
                raise Refused("#endif without #ifdef")
        elif line.lstrip().startswith("#"):
            raise Refused(f"directive not understood: {line.strip()}")
        elif all(active):
            kept.append(line)
    if len(active) != 1:
        raise Refused("#ifdef without #endif")
    return "\n".join(kept)


def _block(text, keyword):
    match = re.search(rf"\b{keyword}\s*\{{", text)
    if not match:
        raise Refused(f"no {keyword}")
    depth, start = 1, match.end()
    for position in range(start, len(text)):
        depth += {"{": 1, "}": -1}.get(text[position], 0)
        if depth == 0:
            return text[start:position], text[: match.start()] + text[position + 1 :]
    raise Refused(f"{keyword} is not closed")


def _memory(body):
    pattern = r"(\w+)\s*:\s*origin\s*=\s*(0x[0-9A-Fa-f]+)\s*,\s*length\s*=\s*(0x[0-9A-Fa-f]+)"
    ranges = {}
    for name, origin, length in re.findall(pattern, body):
        if name in ranges:
            raise Refused(f"range {name} twice")
        ranges[name] = Range(name, int(origin, 16), int(length, 16))
    if re.sub(pattern, "", body).strip():
        raise Refused(f"in MEMORY: {re.sub(pattern, '', body).strip()}")
    return ranges


def _section(name, body):
    section = Section(name, "", "")
    inputs = re.search(r"\{(.*?)\}", body, flags=re.S)
    if inputs:
        section.inputs = [line.strip() for line in inputs.group(1).splitlines() if line.strip()]
        body = body.replace(inputs.group(0), " ")
    operators = r"\b((?:LOAD|RUN)_(?:START|SIZE))\((\w+)\)"
    section.symbols = {symbol: operator for operator, symbol in re.findall(operators, body)}
    body = re.sub(operators, " ", body)
    for part in re.split(r",|\s(?=>|LOAD|RUN|TYPE)", body):
        part = part.strip()
        if match := re.fullmatch(r">\s*(\w+)", part):
            section.load = section.run = match.group(1)
        elif match := re.fullmatch(r"(LOAD|RUN|TYPE)\s*=\s*(\w+)", part):
            setattr(section, match.group(1).lower(), match.group(2))
        elif part and not re.fullmatch(r"ALIGN\(\d+\)", part):
            raise Refused(f"section {name}: {part}")
    if not section.load or not section.run:
        raise Refused(f"section {name} is not placed")
    return section


def _sections(body):
    flat = re.sub(r"\{.*?\}", lambda m: re.sub(r"[^\n]", "#", m.group(0)), body, flags=re.S)
    heads = list(re.finditer(r"(?:^|(?<=\s))([.\w][\w.:]*)\s*:(?=\s)", flat))
    if not heads or body[: heads[0].start()].strip():
        raise Refused("SECTIONS not understood")
    sections = {}
    for head, following in zip(heads, heads[1:] + [None]):
        end = following.start() if following else len(body)
        if head.group(1) in sections:
            raise Refused(f"section {head.group(1)} twice")
        sections[head.group(1)] = _section(head.group(1), body[head.end() : end])
    return sections


def parse(text, defines=()):
    """-> (ranges by name, sections by name)"""
    text = preprocess(text, defines)
    memory, text = _block(text, "MEMORY")
    sections, text = _block(text, "SECTIONS")
    if text.strip():
        raise Refused(f"outside MEMORY and SECTIONS: {text.strip()}")
    return _memory(memory), _sections(sections)


def parse_symbols(text):
    """-> {name: address} of a file with nothing but assignments"""
    text = preprocess(text, ())
    pattern = r"(\w+)\s*=\s*(0x[0-9A-Fa-f]+)\s*;"
    if re.sub(pattern, "", text).strip():
        raise Refused(f"not an assignment: {re.sub(pattern, '', text).strip()}")
    return {name: int(address, 16) for name, address in re.findall(pattern, text)}
