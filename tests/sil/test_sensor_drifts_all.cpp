// SPDX-License-Identifier: MIT
// The drifts of docs/assurance.md, with its table.
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sensor_drifts.hpp"

using namespace sdre;

namespace {

struct Row {
    int    runs = 0, beyond = 0, silent = 0, other = 0;
    double peak_A = 0.0, latest_s = 0.0;
};

} // namespace

TEST(SensorDriftsAll, PeaksAreThoseOfTheDocuments)
{
    const drifts::Sweep   sweep{{100.0, -100.0, 125.0, -125.0, 150.0, -150.0, 220.0, -220.0, 300.0,
                                 -300.0, 523.0, -523.0, 850.0, -850.0},
                              {-1.2, -0.6, 0.0, 0.6, 1.2},
                              {20.0, 50.0, 100.0, 200.0, 400.0, 1000.0},
                              {2.0, 3.0, 4.0, 6.0}};
    std::map<double, Row> rows; // by speed
    for (const drifts::Drift &d : drifts::run(sweep)) {
        Row &row = rows[std::abs(d.speed_e_radps)];
        row.runs++;
        row.beyond += d.peak_A > 6.0 ? 1 : 0;
        row.silent += d.fault == 0 ? 1 : 0;
        row.other +=
            d.fault != 0 && d.fault != static_cast<int>(DRIVE_FAULT_CURRENT_SENSOR) ? 1 : 0;
        row.peak_A   = std::max(row.peak_A, d.peak_A);
        row.latest_s = std::max(row.latest_s, d.fault == 0 ? 0.0 : d.fault_time_s);
    }
    for (const auto &[speed, row] : rows) {
        fmt::print("{:4.0f} rad/s: {} runs, {} beyond 6 A, {} without a trip, {} with another "
                   "name, {:.2f} A, latest {:.3f} s\n",
                   speed, row.runs, row.beyond, row.silent, row.other, row.peak_A, row.latest_s);
        // Over three more sets of seeds 7 of 5,760 runs at 125 and 150 rad/s exceed 6 A, and 26 have another name.
        EXPECT_LE(row.peak_A, speed >= 220.0 ? 6.0 : speed >= 125.0 ? 7.8 : 8.3) << speed;
        EXPECT_TRUE(speed < 125.0 || row.silent == 0) << speed;
        EXPECT_LE(row.other, speed >= 220.0   ? 0
                             : speed >= 125.0 ? row.runs / 100
                                              : row.runs)
            << speed;
        EXPECT_LE(row.beyond, speed >= 220.0 ? 0 : row.runs / 100) << speed;
    }
}
