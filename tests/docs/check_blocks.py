# SPDX-License-Identifier: MIT
"""Every block of code in the pages is run by a test, or says why not; blocks.py has the words.

check_blocks.py --list names the room of each."""

from __future__ import annotations

import sys
from collections import Counter

from blocks import Block, all_blocks, blocks_of, wrong

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


def main() -> int:
    """Exit code 1 when a comment is wrong."""
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
