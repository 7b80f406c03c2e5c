// SPDX-License-Identifier: MIT
// Parameters over power and over restarts, and the serial line that they ask for.
#include <gtest/gtest.h>

#include "served_client.hpp"

extern "C" {
#include "app_control.h"
#include "app_modes.h"
#include "app_registers.h"
}

using namespace sdre;

namespace {

constexpr double restart_s = 2.2; // erasure 2 s; it answers before its zeros are measured

// The served drive waits so long for a tick before it tells of a reset.
constexpr double booted_s = 0.5;
// From the reset on: clock and converter, erasure, and the record's first word.
constexpr double written_s = 2.0095;

class Parameters : public ServedClient {
protected:
    Parameters()
    {
        pass(0.5);
    }
    bool store()
    {
        return write(APP_REGISTERS_STORE_PARAMETERS, {0x6576, 0x6173});
    }
    bool window(std::uint16_t tenths)
    {
        return write(APP_REGISTERS_SPEED_WINDOW, {tenths});
    }
    int window()
    {
        return holding(APP_REGISTERS_SPEED_WINDOW);
    }
    void run_at(std::uint16_t tenths)
    {
        ASSERT_TRUE(write(APP_REGISTERS_SPEED, {0, tenths}));
        ASSERT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_SHUT_DOWN}));
        pass(0.01);
        ASSERT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_ENABLE_OPERATION}));
        for (int n = 0; n < 20; n++) { // it aligns first; who does not ask is taken for gone
            pass(0.2);
            input(APP_REGISTERS_MODE);
        }
        ASSERT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
    }
};

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

TEST_F(Parameters, AreStoredWhateverTheFlagOfTheWatchdogSays)
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

TEST_F(Parameters, AreThereAfterEveryStartAndAnotherLineIsNotUnderstood)
{
    served.line().set_far_end({57600.0, 'E'});
    EXPECT_EQ(window(), -1);
    served.line().set_far_end({115200.0, 'O'});
    EXPECT_EQ(window(), -1);
    served.line().set_far_end({115200.0, 'E'});
    EXPECT_EQ(window(), 50);
    EXPECT_EQ(served.line().direction().rises, 0) << "two pairs: the pin is left alone";

    EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_STATE), 0);
    ASSERT_TRUE(window(77));
    ASSERT_TRUE(write(APP_REGISTERS_MODBUS_ADDRESS, {9}));
    unit = 9;
    ASSERT_TRUE(store());
    pass(restart_s);
    EXPECT_EQ(served.resets(), 1);
    EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_DONE), 1);
    for (int power = 0; power < 2; power++) {
        EXPECT_EQ(window(), 77);
        EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_STATE), 1);
        EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_NUMBER + 1), 1);
        served.power_cycle();
        pass(0.5);
    }
    ASSERT_TRUE(window(78));
    ASSERT_TRUE(store());
    for (const int resets = served.resets(); served.resets() == resets;) {
        served.period();
    }
    served.power_cycle(); // while it is erased, and not the other sector
    EXPECT_EQ(window(), 77);
    ASSERT_TRUE(write(APP_REGISTERS_RESTORE_PARAMETERS, {0x6461, 0x6F6C}));
    pass(restart_s + 2.0); // two sectors
    unit = 1;
    EXPECT_EQ(window(), 50);
    EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_DONE), 1);
    EXPECT_TRUE(served.findings().empty()) << served.findings().front();
}

TEST_F(Parameters, APowerCutLeavesTheOldOrTheNewOnes)
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

TEST_F(Parameters, AMotorThatRunsOrCoastsStoresNothingAndKeepsItsLine)
{
    run_at(2000);
    EXPECT_FALSE(store());
    EXPECT_FALSE(write(APP_REGISTERS_BAUD_RATE, {0, 9600}));
    EXPECT_FALSE(write(APP_REGISTERS_DIRECTION_PIN, {1}));
    EXPECT_TRUE(window(60)) << "this one needs no stop";
    ASSERT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_DISABLE_VOLTAGE}));
    pass(0.002);
    EXPECT_FALSE(served.bridge_on());
    EXPECT_FALSE(store()) << "it coasts";
    for (int n = 0; n < 100 && !store(); n++) {
        pass(0.1);
    }
    pass(restart_s);
    EXPECT_EQ(served.resets(), 1);
    EXPECT_EQ(window(), 60);
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(Parameters, EveryLineAnswersAndTheDirectionPinFramesTheAnswer)
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
