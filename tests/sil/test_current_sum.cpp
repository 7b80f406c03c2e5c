// SPDX-License-Identifier: MIT
// EQ-APP-SUM-1: a third current sensor, read by the application. SDRE_SENSORS=all prints the table of docs/assurance.md.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "sil/board/board_run.hpp"
#include "sweep.hpp"
#include "temp_dir.hpp"

extern "C" {
#include "app_status.h"
}

using namespace sdre;

namespace {

constexpr double when_s = 0.1; // of the fault and of the speed step
constexpr int    sum    = app_fault_base + static_cast<int>(APP_FAULT_CURRENT_SUM);
const char      *config = SDRE_SOURCE_DIR "/firmware/config/";

std::string text_of(const std::string &file)
{
    std::ifstream      in(config + file);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

/// A shipped drive on its board with three sensors.
Scenario scenario(const std::string &drive, const std::string &board, double from_e_radps,
                  double to_e_radps, double load_Nm, const std::string &fault)
{
    const support::TempDir dir;
    dir.write(board + ".toml", text_of("boards/" + board + ".toml") + "current_sensors = 3\n");
    dir.write("drive.toml", text_of("drives/" + drive + ".toml"));
    return read_scenario_file(
        dir.write("s.toml", fmt::format("drive = \"drive.toml\"\nduration_s = 0.3\n"
                                        "initial_speed_e_radps = {0}\n[sensors]\n"
                                        "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = {0}\n"
                                        "[[speed_reference]]\ntime_s = {1}\nvalue_e_radps = {2}\n"
                                        "[[load_torque]]\ntime_s = 0.0\nvalue_Nm = {3}\n{4}",
                                        from_e_radps, when_s, to_e_radps, load_Nm, fault)));
}

std::string fault(const std::string &kind, char phase, const std::string &more,
                  double at_s = when_s)
{
    return fmt::format("[[fault]]\ntime_s = {}\nkind = \"current_{}\"\nphase = \"{}\"\n{}", at_s,
                       kind, phase, more);
}

struct Kind {
    std::string name, text;
};

std::vector<Kind> kinds()
{
    std::vector<Kind> all;
    for (const char phase : {'a', 'b', 'c'}) {
        for (const char *gain : {"0.3", "0.5", "0.7", "1.5"}) {
            all.push_back({fmt::format("gain x{}", gain),
                           fault("gain", phase, fmt::format("gain = {}\n", gain))});
        }
        all.push_back({"reads nothing", fault("zero", phase, "")});
        all.push_back({"frozen", fault("frozen", phase, "")});
        for (const char *rate : {"-20.0", "200.0", "-1000.0"}) {
            all.push_back(
                {fmt::format("drift, {} A/s", rate + (*rate == '-' ? 1 : 0)),
                 fault("drift", phase, fmt::format("rate_Aps = {}\nuntil_A = 4.0\n", rate))});
        }
    }
    all.push_back({"both gains x0.5", fault("gain", 'a', "gain = 0.5\n") +
                                          fault("gain", 'b', "gain = 0.5\n", when_s + 2e-4)});
    return all;
}

struct Case {
    double from, to, load;
};

struct Row {
    int    runs = 0, found = 0, other = 0, beyond = 0;
    double peak_A = 0.0, latest_s = 0.0;
};

/// Runs every fault in every case and keeps a row for each kind.
std::map<std::string, Row> rows_of(const std::string &drive, const std::string &board,
                                   const std::vector<Case> &cases, int seeds, double limit_A)
{
    std::map<std::string, Row> rows;
    std::uint64_t              seed = 1;
    for (const Kind &kind : support::swept_each(kinds(), 7)) {
        for (const Case &c : cases) {
            for (int n = 0; n < seeds; n++) {
                Scenario s               = scenario(drive, board, c.from, c.to, c.load, kind.text);
                s.seed                   = seed++;
                const SimulationResult r = simulate_on_board(s, BoardKind::api).result;
                Row                   &row    = rows[kind.name];
                double                 peak_A = 0.0;
                for (const TraceRow &t : r.trace) {
                    peak_A = std::max(peak_A, t.time_s < when_s ? 0.0 : t.peak_current_A);
                }
                row.runs++;
                row.found += r.fault == sum ? 1 : 0;
                row.other += r.fault != sum && r.fault != 0 ? 1 : 0;
                row.beyond += peak_A > 1.5 * limit_A ? 1 : 0;
                row.peak_A   = std::max(row.peak_A, peak_A);
                row.latest_s = std::max(row.latest_s, r.fault == 0 ? 0.0 : r.fault_time_s - when_s);
            }
        }
    }
    return rows;
}

/// Two sensors that fail together can cancel in the sum: the second row of docs/assurance.md.
void expect_bounded(const std::map<std::string, Row> &rows)
{
    for (const auto &[name, r] : rows) {
        EXPECT_TRUE(r.beyond == 0 || name == "both gains x0.5") << name << ' ' << r.peak_A;
        EXPECT_GT(r.found, 0) << name;
    }
}

bool everything()
{
    return std::getenv("SDRE_SENSORS") != nullptr;
}

void print(const std::map<std::string, Row> &rows)
{
    for (const auto &[name, r] : rows) {
        fmt::print("{:18} {} runs: sum {}, other {}, none {}; {} beyond, {:.2f} A, {:.1f} ms\n",
                   name, r.runs, r.found, r.other, r.runs - r.found - r.other, r.beyond, r.peak_A,
                   1e3 * r.latest_s);
    }
}

} // namespace

/// Steps, rest and steady speeds of the shipped drive, with another rotor angle each time.
TEST(CurrentSum, NoSensorFaultExceedsTheLimitByHalf)
{
    const std::vector<Case> some{{0.0, 150.0, 0.0}, {150.0, -150.0, 0.6}};
    const std::vector<Case> all{{0.0, 150.0, 0.0},     {0.0, -150.0, 1.2},   {150.0, -150.0, 0.6},
                                {-150.0, 150.0, -1.2}, {150.0, 300.0, 1.2},  {0.0, 0.0, 1.2},
                                {20.0, 20.0, 1.2},     {100.0, 100.0, -1.2}, {300.0, 300.0, 1.2},
                                {-523.0, -523.0, 0.6}, {800.0, 800.0, 0.0}};
    const auto              rows =
        rows_of("ipmsm_390w", "board_390w", everything() ? all : some, everything() ? 5 : 1, 4.0);
    if (everything()) {
        print(rows);
    }
    expect_bounded(rows);
}

/// A law without a prediction has no other check of its sensors.
TEST(CurrentSum, ProtectsALawWithoutAPrediction)
{
    const std::vector<Case> some{{0.0, 150.0, 0.2}};
    const std::vector<Case> all{{0.0, 150.0, 0.0},     {0.0, -150.0, 0.5}, {150.0, -150.0, 0.25},
                                {-150.0, 150.0, -0.5}, {0.0, 0.0, 0.5},    {300.0, 300.0, 0.5},
                                {1000.0, 1000.0, 0.25}};
    const auto              rows =
        rows_of("servo_200w", "board_200w", everything() ? all : some, everything() ? 5 : 1, 5.0);
    if (everything()) {
        print(rows);
    }
    expect_bounded(rows);
}

TEST(CurrentSum, HealthySensorsDoNotTrip)
{
    for (const double load : {-1.2, 0.0, 1.2}) {
        Scenario s               = scenario("ipmsm_390w", "board_390w", 150.0, -300.0, load, "");
        s.sensors.adc_gain_a     = 1.027; // docs/hardware.md, "Analog scaling"
        s.sensors.adc_gain_b     = 0.973;
        s.sensors.adc_gain_c     = 1.027;
        s.sensors.adc_offset_a_A = 0.1; // calibrated
        s.sensors.adc_offset_c_A = -0.1;
        EXPECT_EQ(simulate_on_board(s, BoardKind::api).result.fault, 0) << load;
    }
    Scenario spike = scenario("ipmsm_390w", "board_390w", 300.0, 300.0, 1.2, "");
    spike.glitches = {{0.1, 2, 0, 20.0, 0.0}};
    EXPECT_NE(simulate_on_board(spike, BoardKind::api).result.fault, sum);
}

/// The drivers read the third channel as the other board does.
TEST(CurrentSum, IsThatOfTheVirtualDevice)
{
    for (const std::string &kind : {std::string(), fault("gain", 'c', "gain = 0.5\n")}) {
        const Scenario    s = scenario("ipmsm_390w_counts", "board_390w", 0.0, 150.0, 0.6, kind);
        const BoardResult device = simulate_on_board(s, BoardKind::f28335);
        const BoardResult api    = simulate_on_board(s, BoardKind::api);
        EXPECT_EQ(device.findings, std::vector<std::string>{});
        EXPECT_EQ(device.result.fault, kind.empty() ? 0 : sum);
        EXPECT_EQ(api.result.fault, device.result.fault);
        EXPECT_EQ(api.result.fault_time_s, device.result.fault_time_s);
    }
}

TEST(CurrentSum, AFaultInCNeedsASensorThere)
{
    const support::TempDir dir;
    const auto             text =
        dir.write("s.toml", fmt::format("drive = \"{}drives/ipmsm_390w.toml\"\nduration_s = 0.2\n"
                                        "[sensors]\n[[speed_reference]]\ntime_s = 0.0\n"
                                        "value_e_radps = 0.0\n{}",
                                        config, fault("zero", 'c', "")));
    EXPECT_THROW(read_scenario_file(text), InputError);
    const Scenario s = scenario("ipmsm_390w", "board_390w", 0.0, 0.0, 0.0, fault("zero", 'c', ""));
    EXPECT_THROW(simulate(s), InputError); // the core alone does not read it
}
