// SPDX-License-Identifier: MIT
// Loads that drive and loads that brake at the voltage limit: no trip, and the current stays what the drive may ask for.
// EQ-VOLTAGE-2's argument covers constant references; the grid covers what moves.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/parallel.hpp"
#include "seeded_runs.hpp"

namespace {

enum class Kind { step, ramp, sine };

struct Point {
    double speed_e_radps;
    double load_Nm;
    Kind   kind;
};

/// Standstill to 850 rad/s (rated 523) in both directions, up to the rated torque of 1.5 N m.
std::vector<Point> grid()
{
    std::vector<Point> all;
    for (const double speed : {0.0, 300.0, 600.0, 720.0, 850.0, -300.0, -600.0, -720.0, -850.0}) {
        for (const double load : {-1.5, -0.75, 0.75, 1.5}) {
            all.push_back({speed, load, Kind::step});
            all.push_back({speed, load, Kind::ramp});
        }
        all.push_back({speed, 0.75, Kind::sine});
        all.push_back({speed, 1.5, Kind::sine});
    }
    return all;
}

sdre::Scenario scenario_at(const sdre::Scenario &shipped, const Point &at)
{
    sdre::Scenario s        = shipped;
    s.initial_speed_e_radps = at.speed_e_radps;
    s.speed_reference       = {{0.0, at.speed_e_radps}};
    s.duration_s            = 0.7;
    s.load_torque           = {{0.0, 0.0}};
    s.load_ramps.clear();
    if (at.kind == Kind::step) {
        s.load_torque.push_back({0.2, at.load_Nm});
    } else if (at.kind == Kind::ramp) {
        s.load_ramps.push_back({0.1, 0.6, at.load_Nm});
    } else {
        s.load_sine = {at.load_Nm, 5.0, 0.1};
    }
    return s;
}

double peak_A(const sdre::SimulationResult &result)
{
    double peak_A = 0.0;
    for (const sdre::TraceRow &row : result.trace) {
        peak_A = std::max(peak_A, row.peak_current_A);
    }
    return peak_A;
}

/// Empty when no seed trips and no peak exceeds the current limit by more than 8 %. Measured at the worst point, -600 rad/s
/// with the speed form, over 300 seeds: median 2 %, 95 % of them 5 %, worst 7 %.
std::string complaint(sdre::Scenario s, const sdre::Controller &controller)
{
    for (s.seed = 1; s.seed <= 3; s.seed++) {
        const sdre::SimulationResult result = sdre::simulate(s, controller);
        const double                 share  = peak_A(result) / s.drive.motor.max_current_A;
        if (result.fault != 0 || share > 1.08) {
            return "seed " + std::to_string(s.seed) + ": fault " + std::to_string(result.fault) +
                   ", " + std::to_string(share) + " of the limit";
        }
    }
    return "";
}

class VoltageLimit : public ::testing::TestWithParam<const char *> {};

} // namespace

INSTANTIATE_TEST_SUITE_P(Drives, VoltageLimit,
                         ::testing::Values("ipmsm_390w", "ipmsm_390w_noc_h_edges",
                                           "ipmsm_390w_speed"),
                         [](const auto &c) { return std::string(c.param); });

TEST_P(VoltageLimit, HoldsAnyLoadAtAnySpeed)
{
    const sdre::Scenario     shipped    = sdre_test::shipped("board_overhauling_step", GetParam());
    const sdre::Controller   controller = sdre::prepare_controller(shipped);
    const std::vector<Point> points     = grid();
    std::vector<std::string> found(points.size());
    sdre::parallel_for(points.size(), [&](std::size_t i) {
        found[i] = complaint(scenario_at(shipped, points[i]), controller);
    });
    for (std::size_t i = 0; i < points.size(); i++) {
        EXPECT_EQ(found[i], "") << points[i].speed_e_radps << " rad/s, " << points[i].load_Nm
                                << " N m, kind " << static_cast<int>(points[i].kind);
    }
}
