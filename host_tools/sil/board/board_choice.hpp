// SPDX-License-Identifier: MIT
/// Which board stands behind board.h: the drivers of board/f28335 on a virtual device, or the fake.
#pragma once

namespace sdre::f28335 {

class FakeBoard;

/// For as long as it lives the application runs on this fake; otherwise on the drivers.
class FakeBoardChoice {
public:
    explicit FakeBoardChoice(FakeBoard &fake);
    ~FakeBoardChoice();
    FakeBoardChoice(const FakeBoardChoice &)            = delete;
    FakeBoardChoice &operator=(const FakeBoardChoice &) = delete;
};

/// From the next sample on, or no more, a tick on the drivers does not end.
void hang_ticks(bool hang);

} // namespace sdre::f28335
