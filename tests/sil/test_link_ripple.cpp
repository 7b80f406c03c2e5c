// SPDX-License-Identifier: MIT
// A dc link that ripples (EQ-DC-LINK-3), in the core's runs and in those of the application.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "command.hpp"
#include "common/parallel.hpp"
#include "json.hpp"
#include "sil/eval/metrics.hpp"
#include "sil/run/simulation.hpp"
#include "sweep.hpp"
#include "temp_dir.hpp"

using namespace sdre;

namespace {

constexpr double most_Hz = 1e3; // of ripple_Hz

std::string scenario(const std::string &drive, double speed_e_radps, double load_Nm,
                     const std::string &inverter, double duration_s)
{
    return fmt::format("drive = \"" SDRE_SOURCE_DIR "/firmware/config/drives/{}.toml\"\n"
                       "duration_s = {}\ninitial_speed_e_radps = {}\n[sensors]\n[inverter]\n{}"
                       "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = {}\n"
                       "[[load_torque]]\ntime_s = 0.0\nvalue_Nm = {}\n"
                       "[[measure]]\nname = \"ripple\"\ntime_s = 0.0\nband_e_radps = 2.0\n"
                       "tail_s = {}\n",
                       drive, duration_s, speed_e_radps, inverter, speed_e_radps, load_Nm,
                       0.5 * duration_s);
}

Scenario read(const std::string &text)
{
    const support::TempDir dir;
    return read_scenario_file(dir.write("s.toml", text));
}

std::string rippling(double frequency_Hz)
{
    return fmt::format("ripple_V = 29.5\nripple_Hz = {}\n", frequency_Hz);
}

double sine_V(double mean_V, double ripple_V, double frequency_Hz, double time_s)
{
    return mean_V + ripple_V * std::sin(2.0 * std::acos(-1.0) * frequency_Hz * time_s);
}

/// Time and dc link of each row of a trace.
std::vector<std::pair<double, double>> links(const std::string &csv)
{
    std::istringstream                     lines(csv);
    std::string                            line;
    std::vector<std::pair<double, double>> found;
    std::ptrdiff_t                         column = -1;
    while (std::getline(lines, line)) {
        std::vector<std::string> cells;
        std::istringstream       row(line);
        for (std::string cell; std::getline(row, cell, ',');) {
            cells.push_back(cell);
        }
        if (column < 0) {
            column = std::find(cells.begin(), cells.end(), "dc_link_V") - cells.begin();
        } else {
            found.emplace_back(std::stod(cells.at(0)),
                               std::stod(cells.at(static_cast<std::size_t>(column))));
        }
    }
    EXPECT_GT(found.size(), 100U);
    return found;
}

} // namespace

/// The application on both boards has the link, and holds the speed below flux weakening.
TEST(LinkRipple, ReachesTheApplicationOnBothBoards)
{
    const support::TempDir dir;
    const auto             file =
        dir.write("s.toml", scenario("ipmsm_390w", 300.0, 0.3, rippling(300.0), 0.6)).string();
    for (const char *board : {"api", "f28335"}) {
        const auto run = support::run_command({SDRE_SIL_EXE, "run", file, "--board", board, "--csv",
                                               dir / "t.csv", "--json", dir / "m.json"});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const support::Json json = support::Json::read(dir / "m.json");
        EXPECT_LE(json["measures"]["ripple"]["steady_state_error_e_radps"].number(), 0.05) << board;
        for (const auto &[time_s, link_V] : links(support::read_file(dir / "t.csv"))) {
            EXPECT_NEAR(link_V, sine_V(295.0, 29.5, 300.0, time_s), 1e-5) << board << " " << time_s;
        }
    }
}

/// Flux weakening has the d current of the troughs (EQ-CURRENT-REF-10): worst of ten seeds 0.022.
TEST(LinkRipple, CostsNoMeanSpeedInFluxWeakening)
{
    for (const double load_Nm : {0.0, 0.1, 0.3, 0.5, 0.75}) {
        std::vector<double> off(support::swept<std::size_t>(10, 2));
        parallel_for(off.size(), [&](std::size_t i) {
            Scenario s = read(scenario("ipmsm_390w", 850.0, load_Nm, rippling(300.0), 0.8));
            s.seed     = static_cast<std::uint64_t>(i) + 1;
            off[i]     = measure(s, simulate(s, prepare_controller(s)).trace)
                         .at(0)
                         .steady_state_error_e_radps;
        });
        for (const double each : off) {
            EXPECT_LE(each, 0.04) << load_Nm;
        }
    }
}

TEST(LinkRipple, IsASineAboutTheSource)
{
    for (const double frequency_Hz : {50.0, 300.0, most_Hz}) {
        const Scenario         s      = read(scenario(
                         "ipmsm_390w", 850.0, 0.3,
                         fmt::format("dc_link_V = 290.0\nripple_V = 20.0\nripple_Hz = {}\n", frequency_Hz),
                         0.1));
        const SimulationResult result = simulate(s, prepare_controller(s));
        for (const TraceRow &row : result.trace) {
            EXPECT_NEAR(row.dc_link_V, sine_V(290.0, 20.0, frequency_Hz, row.time_s), 1e-6)
                << row.time_s;
        }
    }
}
