// SPDX-License-Identifier: MIT
/// Shipped scenarios with twenty noise seeds and any drive file.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/parallel.hpp"
#include "sil/eval/metrics.hpp"
#include "sil/run/simulation.hpp"

namespace sdre_test {

constexpr std::size_t seeds = 20;

/// Metrics of every seed, by measure.
using Runs = std::map<std::string, std::vector<sdre::Metrics>>;

inline sdre::Scenario shipped(const std::string &scenario, const std::string &drive)
{
    const std::filesystem::path root = SDRE_SOURCE_DIR;
    return sdre::read_scenario_file(root / "host_tools/sil/scenarios" / (scenario + ".toml"),
                                    root / "firmware/config/drives" / (drive + ".toml"));
}

inline void run(const sdre::Scenario &s, Runs &runs)
{
    const sdre::Controller                  controller = sdre::prepare_controller(s);
    std::vector<std::vector<sdre::Metrics>> found(seeds);
    EXPECT_TRUE(controller.uncertified.empty()) << s.drive.name;
    sdre::parallel_for(seeds, [&](std::size_t i) {
        sdre::Scenario seeded               = s;
        seeded.seed                         = i + 1;
        const sdre::SimulationResult result = sdre::simulate(seeded, controller);
        EXPECT_EQ(result.fault, DRIVE_FAULT_NONE) << s.drive.name;
        found[i] = sdre::measure(seeded, result.trace);
    });
    for (const std::vector<sdre::Metrics> &metrics : found) {
        for (const sdre::Metrics &m : metrics) {
            runs[m.name].push_back(m);
        }
    }
}

/// Every seed within a share of the expected value.
inline void expect_share(const Runs &runs, const char *measure, const char *metric, double expected,
                         double share)
{
    for (const sdre::Metrics &m : runs.at(measure)) {
        const auto values = sdre::metric_values(m);
        const auto value  = std::find_if(values.begin(), values.end(),
                                         [&](const auto &v) { return v.first == metric; });
        ASSERT_NE(value, values.end()) << measure << " " << metric;
        EXPECT_NEAR(value->second, expected, share * std::abs(expected))
            << measure << " " << metric;
    }
}

} // namespace sdre_test
