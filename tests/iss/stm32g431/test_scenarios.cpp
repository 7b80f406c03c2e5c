// SPDX-License-Identifier: MIT
// A scenario with the image gives the metrics of the application on board.h. The cycles of the control interrupt are printed.
// The 390 W motor has an image of its own, for an imagined stage of 300 V.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sil/eval/metrics.hpp"
#include "sil/eval/random_motors.hpp"
#include "stm32g431/image_scenario.hpp"

using namespace iss::stm32g431;

namespace {

class IssScenario : public ::testing::TestWithParam<const char *> {
protected:
    static std::string file()
    {
        return std::string(ISS_SCENARIOS) + "/" + GetParam() + ".toml";
    }
};
class IssStage : public IssScenario {};

/// A scenario whose controller has constants of its own.
struct Own {
    const char *scenario;
    const char *drive; ///< of the motor
    const char *image; ///< with the controller's constants
};
class IssOwn : public ::testing::TestWithParam<Own> {};

constexpr auto name_of = [](const auto &i) { return std::string(i.param); };

INSTANTIATE_TEST_SUITE_P(Shipped, IssScenario,
                         ::testing::Values("m2310p_speed_step", "m2310p_load_step"), name_of);
INSTANTIATE_TEST_SUITE_P(Short, IssStage,
                         ::testing::Values("board_load_step", "board_regeneration"), name_of);
INSTANTIATE_TEST_SUITE_P(More, IssStage,
                         ::testing::Values("board_flux_weakening", "board_hold", "board_load_sine",
                                           "board_overhauling_ramp", "board_overhauling_step",
                                           "board_reversal", "board_speed_step",
                                           "board_voltage_dip", "board_weakening_load"),
                         name_of);

/// A motor of the scenario's ranges, which the controller does not know.
class IssRandomMotor : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Own, IssRandomMotor, ::testing::Range(1, 5));

constexpr const char *stage_5A     = ISS_STAGE "_5A";
constexpr const char *stage_varied = ISS_STAGE "_varied";
INSTANTIATE_TEST_SUITE_P(Own, IssOwn,
                         ::testing::Values(Own{"board_flux_weakening_5A", stage_5A, stage_5A},
                                           Own{"board_speed_step_5A", stage_5A, stage_5A},
                                           Own{"board_load_step_varied", ISS_STAGE, stage_varied},
                                           Own{"board_speed_step_varied", ISS_STAGE, stage_varied}),
                         [](const auto &i) { return std::string(i.param.scenario); });

constexpr double never_s = 99.0;

/// Each measure settles, but for that of a dc link too low for the speed.
double settled_s(const sdre::Metrics &m, const std::string &name)
{
    EXPECT_TRUE(m.settling_time_s || name == "dip") << name;
    return m.settling_time_s.value_or(never_s);
}

/// A metric lies there with each of the seeds.
struct Range {
    double least = 1e30;
    double most  = -1e30;

    void add(double x)
    {
        least = std::min(least, x);
        most  = std::max(most, x);
    }
    void expect(double x, double margin) const
    {
        EXPECT_GE(x, least - margin);
        EXPECT_LE(x, most + margin);
    }
};

void expect_as_on_the_host(sdre::Scenario s, const char *elf)
{
    const ImageResult image = simulate_image(s, read_program(elf));
    EXPECT_EQ(image.board.findings, std::vector<std::string>{});
    EXPECT_EQ(image.board.result.fault, 0);
    EXPECT_EQ(image.board.modbus_errors, 0);
    EXPECT_GE(image.board.modbus_answers, 2);
    const auto         of_image = sdre::measure(s, image.board.result.trace);
    std::vector<Range> settling_s(of_image.size());
    std::vector<Range> peak_A(of_image.size());
    std::vector<Range> ripple_e_radps(of_image.size());
    for (s.seed = 1; s.seed <= 8; s.seed++) {
        const sdre::BoardResult host = sdre::simulate_on_board(s, sdre::BoardKind::api);
        ASSERT_EQ(host.result.fault, 0);
        const auto of_host = sdre::measure(s, host.result.trace);
        for (std::size_t n = 0; n < of_host.size(); n++) {
            settling_s[n].add(settled_s(of_host[n], s.measures[n].name));
            peak_A[n].add(of_host[n].peak_current_A);
            ripple_e_radps[n].add(of_host[n].ripple_e_radps);
        }
    }
    for (std::size_t n = 0; n < of_image.size(); n++) {
        const double image_s = settled_s(of_image[n], s.measures[n].name);
        std::printf("%s: settling %.2f of %.2f to %.2f ms, ripple %.3f of %.3f to %.3f rad/s, peak "
                    "%.2f of %.2f to %.2f A\n",
                    s.measures[n].name.c_str(), 1e3 * image_s, 1e3 * settling_s[n].least,
                    1e3 * settling_s[n].most, of_image[n].ripple_e_radps, ripple_e_radps[n].least,
                    ripple_e_radps[n].most, of_image[n].peak_current_A, peak_A[n].least,
                    peak_A[n].most);
        settling_s[n].expect(image_s, 0.3e-3);
        peak_A[n].expect(of_image[n].peak_current_A, 0.02 * s.drive.motor.max_current_A);
        // The end of the first measure of the speed steps may see the next command, a tick early.
        ripple_e_radps[n].expect(of_image[n].ripple_e_radps,
                                 s.measures[n].name == "rated_speed" ? 1.5 : 0.2);
    }
    std::printf("%s", cycles_text(image).c_str());
    EXPECT_GE(image.interrupts.size() + 2, image.board.result.trace.size());
}

} // namespace

TEST_P(IssScenario, IsAsTheApplicationOnTheHostWithSeveralSeeds)
{
    expect_as_on_the_host(sdre::read_scenario_file(file()), ISS_IMAGE);
}

TEST_P(IssStage, IsAsTheApplicationOnTheHostWithSeveralSeeds)
{
    expect_as_on_the_host(sdre::read_scenario_file(file(), ISS_STAGE "/ipmsm_390w.toml"),
                          ISS_STAGE "/sdre_stm32g431.elf");
}

TEST_P(IssOwn, IsAsTheApplicationOnTheHostWithSeveralSeeds)
{
    const auto [scenario, drive, image] = GetParam();
    expect_as_on_the_host(
        sdre::read_scenario_file(std::string(ISS_SCENARIOS) + "/" + scenario + ".toml",
                                 std::string(drive) + "/ipmsm_390w.toml"),
        (std::string(image) + "/sdre_stm32g431.elf").c_str());
}

TEST_P(IssRandomMotor, IsAsTheApplicationOnTheHostWithSeveralSeeds)
{
    sdre::Scenario s = sdre::read_scenario_file(ISS_SCENARIOS "/board_random_motors.toml",
                                                ISS_STAGE "/ipmsm_390w.toml");
    s.plant_scale    = sdre::draw_motor(*s.motor_ranges, s.seed, GetParam());
    expect_as_on_the_host(s, ISS_STAGE "/sdre_stm32g431.elf");
}
