// SPDX-License-Identifier: MIT
// Steady running with an edge in several periods up to some edges in one, on three discs.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "common/parallel.hpp"
#include "shipped_drive.hpp"
#include "sil/eval/metrics.hpp"
#include "sil/run/simulation.hpp"

namespace {

/// Largest ripple of the speed [rad/s], electrical, at 0.5 .. 20 rad/s in steps of 0.5.
double worst_ripple_e_radps(double jitter_rms_cnt, double quadrature_cnt, double duty_cnt)
{
    std::vector<double> ripple(40);
    sdre::parallel_for(ripple.size(), [&](std::size_t k) {
        const double   w = 0.5 * static_cast<double>(k + 1);
        sdre::Scenario s = sdre::read_scenario_file(
            SDRE_SOURCE_DIR "/host_tools/sil/scenarios/board_load_step.toml",
            support::shipped_drive("ipmsm_390w"));
        s.seed                  = k + 1;
        s.duration_s            = 2.0;
        s.initial_speed_e_radps = w;
        s.speed_reference       = {{0.0, w}};
        s.load_torque           = {{0.0, 0.75}};
        s.measures.resize(1);
        s.measures[0].time_s   = 1.0;
        s.sensors.encoder_disc = {quadrature_cnt, duty_cnt, jitter_rms_cnt};
        const auto run         = sdre::simulate(s);
        EXPECT_EQ(run.fault, 0) << w;
        ripple[k] = sdre::measure(s, run.trace).front().ripple_e_radps;
    });
    return *std::max_element(ripple.begin(), ripple.end());
}

} // namespace

/// Edges that repeat in each line are learned, so such a disc is nearly as good as one without errors.
TEST(SlowSpeed, RunsSmoothlyOnADiscWhosePatternIsLearned)
{
    const sdre::Scenario s =
        sdre::read_scenario_file(SDRE_SOURCE_DIR "/host_tools/sil/scenarios/board_load_step.toml",
                                 support::shipped_drive("ipmsm_390w"));
    const auto &disc = s.sensors.encoder_disc;
    EXPECT_LT(
        worst_ripple_e_radps(disc.jitter_rms_cnt, disc.quadrature_error_cnt, disc.duty_error_cnt),
        0.3);
    EXPECT_LT(worst_ripple_e_radps(0.02, 0.0, 0.0), 0.17);
}

/// Each edge has an error of its own.
TEST(SlowSpeed, IsBoundedOnADiscThatIsNotLearned)
{
    EXPECT_LT(worst_ripple_e_radps(0.10, 0.0, 0.0), 0.7);
}
