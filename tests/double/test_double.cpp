// SPDX-License-Identifier: MIT
// Single precision against double: the same core, the same numbers in its tables, the same simulated board. Compared are
// the true speed and the true currents of every instant.
//
// SDRE_DOUBLE=all runs every scenario of the boards with every drive that has tables, and prints a line for each.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "double_core.h"
#include "sil/run/simulation.hpp"

extern "C" {
#include "gain_tables.h"
#include "harmonic_tables.h"
#include "speed_tables.h"
}

namespace {

const std::string scenarios = SDRE_SOURCE_DIR "/host_tools/sil/scenarios/";

struct Drive {
    int                   tables;
    const char           *file;
    const drive_config_t *single;
};

const Drive drives[] = {
    {DOUBLE_SHIPPED, "ipmsm_390w", &gain_tables_drive},
    {DOUBLE_HARMONIC, "ipmsm_390w_noc_h", &harmonic_tables_drive},
    {DOUBLE_SPEED, "ipmsm_390w_speed", &speed_tables_drive},
    {DOUBLE_CONVENTIONAL, "ipmsm_390w_conventional", &conventional_tables_drive}};

class SingleCore {
public:
    explicit SingleCore(const Drive &d)
    {
        EXPECT_EQ(drive_init(&drive_, d.single), CTL_OK);
    }
    bridge_t tick(const drive_sample_t &s, const drive_command_t &command)
    {
        return drive_tick(&drive_, &s, &command);
    }

private:
    drive_t drive_{};
};

class DoubleCore {
public:
    explicit DoubleCore(const Drive &d)
    {
        EXPECT_TRUE(double_core_start(d.tables));
    }
    static bridge_t tick(const drive_sample_t &s, const drive_command_t &command)
    {
        const auto         wide = [](float x) { return static_cast<double>(x); };
        const double_in_t  in   = {wide(s.ia_A),
                                   wide(s.ib_A),
                                   wide(s.dc_link_V),
                                   wide(s.theta_e_rad),
                                   wide(s.omega_e_radps),
                                   wide(s.band_rad),
                                   wide(s.edge_gap_s),
                                   wide(s.edge_age_s),
                                   s.edge_of_pattern,
                                s.valid ? 1 : 0,
                                   wide(command.omega_e_radps)};
        const double_out_t out  = double_core_tick(&in);
        return {{static_cast<float>(out.duty[0]), static_cast<float>(out.duty[1]),
                 static_cast<float>(out.duty[2])},
                out.gate != 0};
    }
};

/// As sil/run/simulation.cpp has it.
template <typename Core> std::vector<sdre::PlantState> run(const sdre::Scenario &s, Core core)
{
    const double                  ts = sdre::control_period_s(s.drive);
    sdre::Board                   board(s);
    sdre::StepCursor              reference(s.speed_reference, s.initial_speed_e_radps);
    bridge_t                      in_force{{0.5F, 0.5F, 0.5F}, true};
    std::vector<sdre::PlantState> states;
    for (long k = 0; k < sdre::ticks_of(s); k++) {
        const double t = static_cast<double>(k) * ts;
        board.begin_tick(t);
        const drive_sample_t  sample  = board.sample();
        const drive_command_t command = {static_cast<float>(reference.at(t)), true, 0.0F, nullptr};
        const bridge_t        out     = core.tick(sample, command);
        states.push_back(board.plant_state());
        EXPECT_TRUE(out.gate_enable) << t;
        in_force.gate_enable = in_force.gate_enable && out.gate_enable;
        board.run_period(in_force);
        in_force = out;
    }
    return states;
}

struct Apart {
    double omega_e_radps = 0.0; ///< most at any instant
    double i_A           = 0.0;
    double last_e_radps  = 0.0; ///< mean over the last fifth of the run
};

Apart apart(const std::string &scenario, const Drive &d, bool ideal)
{
    sdre::Scenario s = sdre::read_scenario_file(
        scenario, SDRE_SOURCE_DIR "/firmware/config/drives/" + std::string(d.file) + ".toml");
    s.sensors.ideal = s.sensors.ideal || ideal;
    for (sdre::PlantChange &change : s.changes) {
        if (change.sensors) {
            change.sensors->ideal = change.sensors->ideal || ideal;
        }
    }
    const auto  single = run(s, SingleCore(d));
    const auto  wide   = run(s, DoubleCore(d));
    Apart       a;
    double      sum  = 0.0;
    std::size_t tail = single.size() - single.size() / 5;
    for (std::size_t k = 0; k < single.size(); k++) {
        const double w  = single[k].omega_e_radps - wide[k].omega_e_radps;
        a.omega_e_radps = std::max(a.omega_e_radps, std::abs(w));
        a.i_A           = std::max(a.i_A, std::hypot(single[k].current_A.d - wide[k].current_A.d,
                                                     single[k].current_A.q - wide[k].current_A.q));
        sum += k >= tail ? w : 0.0;
    }
    a.last_e_radps = std::abs(sum) / static_cast<double>(single.size() - tail);
    return a;
}

} // namespace

TEST(Double, TheLoopHereIsTheSimulations)
{
    const sdre::Scenario s =
        sdre::read_scenario_file(scenarios + "board_load_step.toml",
                                 SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml");
    const auto here  = run(s, SingleCore(drives[0]));
    const auto there = sdre::simulate(s).trace;
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t k = 0; k < here.size(); k++) {
        ASSERT_EQ(here[k].omega_e_radps, there[k].omega_e_radps) << k;
    }
}

/// Exact sensors: what is apart is rounding alone.
TEST(Double, SinglePrecisionIsEnough)
{
    for (const char *name : {"board_load_step", "board_speed_step"}) {
        const Apart a = apart(scenarios + name + ".toml", drives[0], true);
        EXPECT_GT(a.omega_e_radps, 0.0) << name;  // they are two cores
        EXPECT_LT(a.omega_e_radps, 3e-3) << name; // worst 7e-4
        EXPECT_LT(a.i_A, 2e-3) << name;           // worst 4e-4
    }
}

/// With those of the board a code or a count that comes out otherwise is a noise of its own from then on.
TEST(Double, SinglePrecisionIsEnoughOnTheBoard)
{
    for (const char *name : {"board_load_step", "board_speed_step"}) {
        const Apart a = apart(scenarios + name + ".toml", drives[0], false);
        EXPECT_LT(a.omega_e_radps, 0.2) << name; // worst 0.08
        EXPECT_LT(a.i_A, 0.2) << name;           // worst 0.087
        EXPECT_LT(a.last_e_radps, 1e-3) << name; // worst 1.7e-4
    }
}

TEST(Double, EveryScenario)
{
    const char *wanted = std::getenv("SDRE_DOUBLE");
    if (wanted == nullptr || std::string(wanted) != "all") {
        GTEST_SKIP() << "SDRE_DOUBLE=all runs them";
    }
    for (const auto &entry : std::filesystem::directory_iterator(scenarios)) {
        const std::string name = entry.path().stem();
        if (name.rfind("board_", 0) != 0 || name == "board_random_motors" ||
            name.find("varied") != std::string::npos || name.find("5A") != std::string::npos) {
            continue; // drives without tables
        }
        for (const Drive &d : drives) {
            const Apart exact = apart(entry.path(), d, true);
            const Apart board = apart(entry.path(), d, false);
            fmt::print("| {} | {} | {:.1g} | {:.1g} | {:.1g} | {:.1g} | {:.1g} |\n", name, d.file,
                       exact.omega_e_radps, exact.i_A, board.omega_e_radps, board.i_A,
                       board.last_e_radps);
        }
    }
}
