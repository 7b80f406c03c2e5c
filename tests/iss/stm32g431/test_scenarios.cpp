// SPDX-License-Identifier: MIT
// The scenarios of the 24 V drive with the image give the metrics of the application on board.h. The cycles of the control
// interrupt are printed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sil/eval/metrics.hpp"
#include "stm32g431/image_scenario.hpp"

using namespace iss::stm32g431;

namespace {

class IssScenario : public ::testing::TestWithParam<const char *> {};

INSTANTIATE_TEST_SUITE_P(Shipped, IssScenario,
                         ::testing::Values("m2310p_speed_step", "m2310p_load_step"),
                         [](const auto &i) { return std::string(i.param); });

} // namespace

TEST_P(IssScenario, AgreesWithTheApplicationOnTheHost)
{
    const sdre::Scenario s =
        sdre::read_scenario_file(std::string(ISS_SCENARIOS) + "/" + GetParam() + ".toml");
    const ImageResult       image = simulate_image(s, read_program(ISS_IMAGE));
    const sdre::BoardResult host  = sdre::simulate_on_board(s, sdre::BoardKind::api);

    EXPECT_EQ(image.board.findings, std::vector<std::string>{});
    EXPECT_EQ(image.board.result.fault, 0);
    EXPECT_EQ(image.board.modbus_errors, 0);
    EXPECT_GE(image.board.modbus_answers, 2);
    EXPECT_EQ(host.result.fault, 0);
    const auto of_image = sdre::measure(s, image.board.result.trace);
    const auto of_host  = sdre::measure(s, host.result.trace);
    ASSERT_EQ(of_image.size(), of_host.size());
    for (std::size_t n = 0; n < of_host.size(); n++) {
        ASSERT_TRUE(of_image[n].settling_time_s && of_host[n].settling_time_s) << n;
        std::printf("%s: settling %.2f and %.2f ms, overshoot %.2f and %.2f, ripple %.3f and "
                    "%.3f rad/s, peak %.2f and %.2f A\n",
                    s.measures[n].name.c_str(), 1e3 * *of_image[n].settling_time_s,
                    1e3 * *of_host[n].settling_time_s, of_image[n].overshoot_e_radps,
                    of_host[n].overshoot_e_radps, of_image[n].ripple_e_radps,
                    of_host[n].ripple_e_radps, of_image[n].peak_current_A,
                    of_host[n].peak_current_A);
        EXPECT_NEAR(*of_image[n].settling_time_s, *of_host[n].settling_time_s, 0.5e-3) << n;
        EXPECT_NEAR(of_image[n].peak_current_A, of_host[n].peak_current_A,
                    0.02 * s.drive.motor.max_current_A)
            << n;
        // The end of the first measure of the speed steps may see the next command, a tick early.
        const double ripple_e_radps = s.measures[n].name == "rated_speed" ? 1.5 : 0.2;
        EXPECT_NEAR(of_image[n].ripple_e_radps, of_host[n].ripple_e_radps, ripple_e_radps) << n;
    }
    std::printf("%s", cycles_text(image).c_str());
    EXPECT_GE(image.interrupts.size() + 2, image.board.result.trace.size());
}
