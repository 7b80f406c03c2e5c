// SPDX-License-Identifier: MIT
// The serial line that parameters ask for, and power cuts while the virtual device stores them.
#include "parameters_client.hpp"

using namespace sdre;

namespace {

// The served drive waits so long for a tick before it tells of a reset.
constexpr double booted_s = 0.5;
// From the reset on: clock and converter, erasure, and the record's first word.
constexpr double written_s = 2.0095;

class ParametersLine : public ParametersClient {};

struct Line {
    std::uint32_t baud_Bd;
    std::uint16_t format;
    char          parity;
};

// Every rate and every format once or twice; the divider of 37.5 MHz / 8 by hand.
const Line lines[]{
    {9600, 0, 'E'}, {19200, 1, 'O'}, {38400, 2, 'N'}, {57600, 0, 'E'}, {115200, 1, 'O'}};
const unsigned dividers[]{488, 244, 122, 81, 41};

} // namespace

TEST_F(ParametersLine, AreStoredWhateverTheFlagOfTheWatchdogSays)
{
    served.set_reset_line(0.5e-3, 0.14); // a supervisor stretches every reset but power-on
    served.power_cycle();
    pass(0.5);
    ASSERT_TRUE(window(77));
    ASSERT_TRUE(store());
    pass(restart_s + 0.5);
    EXPECT_EQ(window(), 77);
    served.power_cycle();
    pass(0.5);
    EXPECT_EQ(window(), 77);
}

TEST_F(ParametersLine, AnotherLineIsNotUnderstood)
{
    served.line().set_far_end({57600.0, 'E'});
    EXPECT_EQ(window(), -1);
    served.line().set_far_end({115200.0, 'O'});
    EXPECT_EQ(window(), -1);
    served.line().set_far_end({115200.0, 'E'});
    EXPECT_EQ(window(), 50);
    EXPECT_EQ(served.line().direction().rises, 0) << "two pairs: the pin is left alone";
}

TEST_F(ParametersLine, APowerCutLeavesTheOldOrTheNewOnes)
{
    ASSERT_TRUE(window(77));
    ASSERT_TRUE(store());
    pass(restart_s);
    int before = 77;
    int kept   = 0;
    int taken  = 0;
    // While it is erased; then while head and record are written, in 7.3 ms, a word in 50 us.
    for (const double after_ms : {-1000.0, 0.0, 1.6, 3.2, 4.8, 6.4, 10.0, 15.0}) {
        const double after_s = written_s + 1e-3 * after_ms;
        const int    next    = before + 1;
        ASSERT_TRUE(window(static_cast<std::uint16_t>(next)));
        ASSERT_TRUE(store());
        const int resets = served.resets();
        while (served.resets() == resets) {
            served.period();
        }
        pass(after_s - booted_s);
        served.power_cycle();
        pass(0.5);
        const int now = window();
        EXPECT_TRUE(now == before || now == next) << now << " after " << after_s;
        EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_STATE), 1);
        (now == next ? taken : kept)++;
        before = now;
    }
    EXPECT_GE(kept, 3);
    EXPECT_GE(taken, 2);
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(ParametersLine, EveryLineAnswersAndTheDirectionPinFramesTheAnswer)
{
    for (std::size_t n = 0; n < std::size(lines); n++) {
        const Line &l = lines[n];
        ASSERT_TRUE(
            write(APP_REGISTERS_BAUD_RATE, {static_cast<std::uint16_t>(l.baud_Bd >> 16U),
                                            static_cast<std::uint16_t>(l.baud_Bd), l.format, 1}));
        ASSERT_TRUE(store());
        pass(restart_s);
        served.line().set_far_end({static_cast<double>(l.baud_Bd), l.parity});

        const Octets answer = ask({4, 0, 0, 0, 62}); // longer than the transmitter's FIFO
        ASSERT_EQ(answer.size(), 126U) << l.baud_Bd;
        const f28335::Direction &d       = served.line().direction();
        const double             tick_s  = 1.0 / f28335::tick_Hz;
        const double             octet_s = 11.0 * 8.0 * dividers[n] / 37.5e6;
        const double             bit_s   = octet_s / 11.0;
        EXPECT_EQ(d.rises, 1) << l.baud_Bd;
        EXPECT_EQ(d.cut_octets + d.deaf_octets, 0) << l.baud_Bd;
        EXPECT_GE(d.lead_ticks, 0);
        EXPECT_LT(static_cast<double>(d.lead_ticks) * tick_s, bit_s + 25e-6);
        EXPECT_GE(static_cast<double>(d.tail_ticks) * tick_s, bit_s - 1e-6);
        EXPECT_LT(static_cast<double>(d.tail_ticks) * tick_s, bit_s + 100e-6)
            << "two passes of the background";
        EXPECT_LT(static_cast<double>(d.longest_gap) * tick_s, 1.5 * octet_s) << l.baud_Bd;
        EXPECT_NEAR(octet_s * l.baud_Bd / 11.0, 1.0, 0.02);
    }
    EXPECT_TRUE(served.findings().empty());
}
