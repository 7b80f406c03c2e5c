// SPDX-License-Identifier: MIT
// How soon the virtual device is safe and ready, and what its reset line does to the flag of the watchdog.
#include <gtest/gtest.h>

#include "loading_client.hpp"

using namespace sdre;

namespace {

class Start : public LoadingClient {};

} // namespace

// 4.4 ms for the PLL, 5 ms for the converter; the sums over two full slots, at 150 MHz, on top. At the speed before the PLL
// they would take 1.7 s.
TEST_F(Start, PinsAreSafeAtOnceAndTheDriveIsReadySoon)
{
    EXPECT_GE(served.device().pins_safe_cycles(), 0);
    EXPECT_LE(served.device().pins_safe_cycles(), 100);
    EXPECT_LE(served.ready_s(), 10e-3);
    for (std::uint16_t slot = 0; slot < 2; slot++) {
        std::uint16_t *const  words = const_cast<std::uint16_t *>(f28335_board_store(slot));
        const store_content_t content{words + STORE_HEAD_WORDS, store_room(), slot + 1U, false};
        std::fill_n(words, BOARD_STORE_WORDS, std::uint16_t{0x1234});
        const std::uint32_t crc = store_crc(STORE_IMAGE, &content);
        const std::uint16_t head[]{STORE_MARK,
                                   STORE_IMAGE,
                                   0,
                                   static_cast<std::uint16_t>(content.count),
                                   0,
                                   static_cast<std::uint16_t>(slot + 1),
                                   static_cast<std::uint16_t>(crc >> 16U),
                                   static_cast<std::uint16_t>(crc)};
        std::copy(std::begin(head), std::end(head), words);
    }
    served.power_cycle();
    EXPECT_GE(served.device().pins_safe_cycles(), 0);
    EXPECT_LE(served.device().pins_safe_cycles(), 100);
    EXPECT_GE(served.ready_s(), 65520 * 100 / 150e6);
    EXPECT_LE(served.ready_s(), 0.1);
}

// Set after power-on without a supervisor; clear when a supervisor stretches the watchdog's pulse; both at once.
TEST_F(Start, TheFlagOfTheWatchdogDecidesNothing)
{
    const double pulse_s = f28335::watchdog_pulse_s;
    for (const auto &[power_on_s, watchdog_s] :
         std::vector<std::pair<double, double>>{{0.5e-3, pulse_s}, {0.2, 0.14}, {0.5e-3, 0.14}}) {
        served.set_reset_line(power_on_s, watchdog_s);
        served.power_cycle();
        pass(0.5);
        EXPECT_EQ(loader(APP_LOADER_STATE), APP_LOADER_AWAY) << power_on_s;
        EXPECT_EQ(input(APP_REGISTERS_RESET_CAUSE), power_on_s < 1.109e-3 ? 1 : 0);
        enter();
        ASSERT_TRUE(command(APP_LOADER_LEAVE));
        pass(0.5);
        EXPECT_EQ(loader(APP_LOADER_STATE), APP_LOADER_AWAY) << watchdog_s;
        EXPECT_EQ(input(APP_REGISTERS_RESET_CAUSE), watchdog_s < 1.109e-3 ? 1 : 0);
    }
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(Start, ABitOfTheBusIsSampledAtThirteenFifteenths)
{
    EXPECT_NEAR(f28335::EcanUnit::sample_point(), 13.0 / 15.0, 1e-9);
}
