// SPDX-License-Identifier: MIT
// A disc whose edges repeat after four lines is learned while the drive runs (EQ-ENCODER-FORM-3, 4).
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "common/parallel.hpp"
#include "shipped_drive.hpp"
#include "sil/eval/metrics.hpp"
#include "sil/run/simulation.hpp"

namespace {

struct Worst {
    double vq_noise_V  = 0.0;
    double dip_e_radps = 0.0;
};

/// The board's load step at a speed, on discs with errors of 0.10 counts that repeat after some edges.
Worst worst_of_seeds(double omega_e_radps, int repeats)
{
    std::vector<Worst> found(10);
    sdre::parallel_for(found.size(), [&](std::size_t k) {
        sdre::Scenario s = sdre::read_scenario_file(
            SDRE_SOURCE_DIR "/host_tools/sil/scenarios/board_load_step.toml",
            support::shipped_drive("ipmsm_390w"));
        s.seed                  = 101 + k;
        s.initial_speed_e_radps = omega_e_radps;
        s.speed_reference       = {{0.0, omega_e_radps}};
        s.sensors.encoder_disc  = {0.0, 0.0, 0.10, repeats};
        const auto run          = sdre::simulate(s);
        EXPECT_EQ(run.fault, 0) << omega_e_radps;
        const auto step = sdre::measure(s, run.trace).back();
        found[k]        = {step.effort.vq_noise_V, step.dip_e_radps};
    });
    Worst worst;
    for (const Worst &w : found) {
        worst.vq_noise_V  = std::max(worst.vq_noise_V, w.vq_noise_V);
        worst.dip_e_radps = std::max(worst.dip_e_radps, w.dip_e_radps);
    }
    return worst;
}

} // namespace

/// Wanted: 10 V, and a dip of 5 % more than the 4.95 rad/s of the default disc.
TEST(PatternDisc, OfFourLinesIsQuiet)
{
    for (const double omega : {40.0, 150.0, 300.0, 317.0, 433.0}) {
        for (const int repeats : {8, 16}) {
            const Worst w = worst_of_seeds(omega, repeats);
            EXPECT_LT(w.vq_noise_V, 10.0) << omega << " " << repeats;
            EXPECT_LT(w.dip_e_radps, omega > 400.0 ? 5.8 : 5.2) << omega << " " << repeats;
        }
    }
}

/// Nothing repeats: as on a disc that is not learned.
TEST(PatternDisc, OfAWholeTurnIsNot)
{
    EXPECT_GT(worst_of_seeds(300.0, 0).vq_noise_V, 25.0);
}
