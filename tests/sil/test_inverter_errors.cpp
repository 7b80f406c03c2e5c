// SPDX-License-Identifier: MIT
// The shipped drive on an inverter that is not the one of its drive file.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "common/parallel.hpp"
#include "shipped_drive.hpp"
#include "sil/eval/metrics.hpp"
#include "sil/run/simulation.hpp"

namespace {

sdre::Scenario steady(double w_e_radps, double load_Nm, std::uint64_t seed)
{
    sdre::Scenario s =
        sdre::read_scenario_file(SDRE_SOURCE_DIR "/host_tools/sil/scenarios/board_load_step.toml",
                                 support::shipped_drive("ipmsm_390w"));
    s.seed                  = seed;
    s.duration_s            = 1.5;
    s.initial_speed_e_radps = w_e_radps;
    s.speed_reference       = {{0.0, w_e_radps}};
    s.load_torque           = {{0.0, load_Nm}};
    s.measures.resize(1);
    s.measures[0].time_s = 0.5;
    return s;
}

} // namespace

/// EQ-MOTION-WATCH-5: 7 us where the drive file says 3 us. The law learns it.
TEST(InverterErrors, DeadTimeThatIsFourMicrosecondsLongerIsLearned)
{
    const std::vector<double> loads_Nm{0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.75, 1.5};
    const std::vector<double> speeds_e_radps{0.5, 2.0, 5.0, 10.0, 20.0, -10.0};
    sdre::parallel_for(loads_Nm.size() * speeds_e_radps.size(), [&](std::size_t k) {
        const double   w        = speeds_e_radps[k % speeds_e_radps.size()];
        const double   load_Nm  = loads_Nm[k / speeds_e_radps.size()];
        sdre::Scenario s        = steady(w, load_Nm, k + 1);
        s.inverter.dead_time_s  = 7e-6;
        const auto          run = sdre::simulate(s);
        const sdre::Metrics is  = sdre::measure(s, run.trace).front();
        EXPECT_EQ(run.fault, 0) << w << ", " << load_Nm;
        EXPECT_LE(is.steady_state_error_e_radps, 0.1) << w << ", " << load_Nm;
        EXPECT_LE(is.ripple_e_radps, 0.3) << w << ", " << load_Nm; // 0.2 measured
    });
}
