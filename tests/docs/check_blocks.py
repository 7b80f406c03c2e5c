# SPDX-License-Identifier: MIT
"""Every block of code in the pages is run by a test, or says why not; blocks.py has the words.

check_blocks.py --list names the room of each."""

from __future__ import annotations

import sys
from collections import Counter

from blocks import (
    Block,
    all_blocks,
    blocks_of,
    output_complaint,
    recorded,
    with_output,
    wrong,
)

SEEDED = """Text.

<!-- block: needs luck -->

    sdre-gains report DRIVE.toml

<!-- block: needs minutes -->

No block follows.

    x' = a x

```toml
key = 1
```
"""


def kind_of(block: Block) -> str:
    """Where it is run, for the count."""
    reason = [f"not run, needs {reason}" for reason in block.marked("needs")]
    own = ["a test of its own"] if block.marked("in") else []
    text = ["no code"] if block.language == "text" else []
    return (text + reason + own + [str(block.room())])[0]


SHOWN = """    sdre-sil run x.toml

<!-- block: output{} -->

    dip [rad/s]   4.68
    ...
    peak [A]      2.96
"""
PRINTED = "dip [rad/s]   4.68 \nsettled 1\nsettled 2\npeak [A]      2.96\n"


def check_outputs() -> None:
    """A made up page is compared with what was printed."""

    def complains(kind: str, printed: str) -> bool:
        command, shown = with_output(list(blocks_of("made up", SHOWN.format(kind))))
        assert command.shown is shown and not wrong(shown), command
        return output_complaint(shown, printed) is not None

    other = PRINTED.replace("4.68 ", "-14.7e3").replace("2.96", "-")
    for kind in ("", " of any run"):
        assert not complains(kind, PRINTED)
        assert complains(kind, PRINTED.replace("dip", "drop"))
        assert complains(kind, PRINTED + "more\n") and complains(kind, "first\n" + PRINTED)
        assert complains(kind, other), "a figure that is none any more"
    assert complains("", PRINTED.replace("4.68", "4.69"))
    assert not complains(" of any run", PRINTED.replace("4.68", "-14.7e3"))
    page = SHOWN.format("")
    _, shown = with_output(list(blocks_of("made up", page)))
    assert recorded(shown, PRINTED.replace("4.68", "4.69"), page) == page.replace("4.68", "4.69")
    assert recorded(shown, "other words\n", page) == page


def main() -> int:
    """Exit code 1 when a comment is wrong."""
    check_outputs()
    seeded = list(blocks_of("made up", SEEDED))
    assert [b.language for b in seeded] == ["sh", "nothing", "text", "toml"], seeded
    assert [len(wrong(b)) for b in seeded] == [1, 1, 0, 0], [wrong(b) for b in seeded]
    assert [b.room() for b in seeded[2:]] == [None, "python"], seeded
    blocks = [block for page in all_blocks().values() for block in page]
    for block in blocks if "--list" in sys.argv else []:
        print(f"{block.where():32} {kind_of(block)}")
    for kind, count in sorted(Counter(map(kind_of, blocks)).items()):
        print(f"{count:4} {kind}")
    found = [line for block in blocks for line in wrong(block)]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
