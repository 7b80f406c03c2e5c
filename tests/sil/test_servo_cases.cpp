// SPDX-License-Identifier: MIT
// Paper B's four laws in its Cases I to IV: every one of twenty noise seeds, in r/min and ms. Plant and loads are those of
// the shipped scenarios.
#include <algorithm>
#include <cmath>
#include <string>

#include "seeded_runs.hpp"

namespace {

using sdre_test::expect_share;
using sdre_test::Runs;

Runs all_cases(const std::string &law)
{
    Runs runs;
    sdre_test::run(sdre_test::shipped("servo_case_1_2", "servo_200w_" + law), runs);
    sdre_test::run(sdre_test::shipped("servo_case_3_4", "servo_200w_" + law), runs);
    return runs;
}

void expect_no_offset(const Runs &runs)
{
    for (const auto &[name, metrics] : runs) {
        for (const sdre::Metrics &m : metrics) {
            EXPECT_LE(std::abs(m.offset_rpm), 0.1) << name;
        }
    }
}

double worst_fluctuation(const Runs &runs, const char *measure)
{
    double worst = 0.0;
    for (const sdre::Metrics &m : runs.at(measure)) {
        worst = std::max(worst, m.fluctuation_rpm);
    }
    return worst;
}

double least_fluctuation(const Runs &runs, const char *measure)
{
    double least = INFINITY;
    for (const sdre::Metrics &m : runs.at(measure)) {
        least = std::min(least, m.fluctuation_rpm);
    }
    return least;
}

void expect_quick_recovery(const Runs &runs)
{
    for (const sdre::Metrics &m : runs.at("case_3")) {
        EXPECT_LE(m.within_5_percent_s.value_or(INFINITY), 0.0025);
        EXPECT_GE(m.decrease_rpm, 34.5); // the best that 200 V can do, one period after the step
    }
}

} // namespace

TEST(ServoCases, Cdobc)
{
    const Runs r = all_cases("cdobc");

    expect_no_offset(r);
    expect_share(r, "case_1", "fluctuation_rpm", 1.0, 0.25);       // measured 1.08 .. 1.15
    expect_share(r, "case_2", "fluctuation_rpm", 3.5, 0.25);       // measured 3.49
    expect_share(r, "case_1", "within_5_percent_s", 8.2e-3, 0.15); // measured 8.3 ms
    expect_share(r, "case_1", "within_2_percent_s", 9.4e-3, 0.15); // measured 9.2 ms
    expect_share(r, "case_3", "decrease_rpm", 55.0, 0.10);         // measured 55.8
    expect_share(r, "case_4", "fluctuation_rpm", 2.6, 0.20);       // measured 2.58
    expect_quick_recovery(r);
    for (const sdre::Metrics &m : r.at("case_1")) {
        EXPECT_LE(m.overshoot_percent, 2.0); // measured 0.61
    }
}

TEST(ServoCases, Gpiobc)
{
    const Runs r = all_cases("gpiobc");

    expect_no_offset(r);
    expect_share(r, "case_1", "fluctuation_rpm", 5.3, 0.20); // measured 5.1
    expect_share(r, "case_2", "fluctuation_rpm", 7.9, 0.25); // measured 7.1
    expect_share(r, "case_1", "within_5_percent_s", 8.3e-3, 0.15);
    expect_share(r, "case_1", "within_2_percent_s", 9.4e-3, 0.15);
    expect_share(r, "case_3", "decrease_rpm", 51.0, 0.10);   // measured 54.6
    expect_share(r, "case_4", "fluctuation_rpm", 8.7, 0.20); // measured 8.7
    expect_quick_recovery(r);
}

/// No integral action: the offsets are part of it.
TEST(ServoCases, Hdobc)
{
    const Runs r = all_cases("hdobc");

    expect_share(r, "case_1", "offset_rpm", -25.0, 0.20);      // measured -27.8
    expect_share(r, "case_2", "offset_rpm", -14.6, 0.20);      // measured -17.2
    expect_share(r, "case_3", "offset_rpm", -200.6, 0.20);     // measured -203.7
    expect_share(r, "case_1", "fluctuation_rpm", 8.22, 0.20);  // measured 9.2
    expect_share(r, "case_2", "fluctuation_rpm", 29.5, 0.25);  // measured 27.3
    expect_share(r, "case_3", "decrease_rpm", 213.7, 0.10);    // measured 216.9
    expect_share(r, "case_4", "fluctuation_rpm", 119.7, 0.20); // measured 119.4
}

TEST(ServoCases, Pid)
{
    const Runs r = all_cases("pid");

    expect_no_offset(r);
    expect_share(r, "case_1", "overshoot_percent", 7.7, 0.15);      // measured 6.9
    expect_share(r, "case_1", "within_5_percent_s", 21.3e-3, 0.15); // measured 20.9 ms
    expect_share(r, "case_1", "fluctuation_rpm", 5.3, 0.15);        // measured 5.4
    expect_share(r, "case_2", "fluctuation_rpm", 14.6, 0.15);       // measured 13.5
    expect_share(r, "case_3", "decrease_rpm", 85.0, 0.15);          // measured 81.0
    expect_share(r, "case_4", "fluctuation_rpm", 59.0, 0.15);       // measured 59.5
}

TEST(ServoCases, SensorErrorsAreRejectedInThisOrder)
{
    const double cdobc        = worst_fluctuation(all_cases("cdobc"), "case_2");
    const Runs   gpiobc       = all_cases("gpiobc");
    const double least_gpiobc = least_fluctuation(gpiobc, "case_2");
    const double least_pid    = least_fluctuation(all_cases("pid"), "case_2");

    EXPECT_LT(cdobc, least_gpiobc);
    EXPECT_LT(worst_fluctuation(gpiobc, "case_2"), least_pid);
}

/// Counts instead of edge times: one count per period is 60 r/min, and the loop swings on it.
TEST(ServoCases, CountsPerPeriodAreNoSpeedForThisLaw)
{
    sdre::Scenario s            = sdre_test::shipped("servo_case_1_2", "servo_200w_cdobc");
    s.sensors.encoder_edge_time = false;
    for (sdre::PlantChange &change : s.changes) {
        change.sensors->encoder_edge_time = false;
    }

    const auto metrics = sdre::measure(s, sdre::simulate(s).trace);

    EXPECT_GT(metrics.at(0).fluctuation_rpm, 20.0);
}
