// SPDX-License-Identifier: MIT
// The brake chopper's firmware on the virtual device, with motor and dc link.
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../support/temp_dir.hpp"
#include "sil/board/board_run.hpp"
#include "sil/board/board_runs.hpp"
#include "sil/run/faults.hpp"

extern "C" {
#include "app.h"
}

using namespace sdre;

namespace {

const char      *config = SDRE_SOURCE_DIR "/firmware/config/";
constexpr double trip_V = 398.25; // 1.35 x 295 V
constexpr double on_V   = 372.0;
constexpr double off_V  = 362.0;
constexpr long   freed  = 1700; // tick; the application is READY after 1530

std::string text_of(const std::string &file)
{
    std::ifstream      in(config + file);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

std::string keys(double power_W)
{
    return fmt::format("chopper_on_V = {}\nchopper_off_V = {}\nchopper_resistance_Ohm = 100.0\n"
                       "chopper_power_W = {}\nchopper_time_constant_s = 20.0\n",
                       on_V, off_V, power_W);
}

/// A drive on a board with these keys more, behind a diode rectifier.
Scenario scenario(const std::string &drive, const std::string &chopper, double from_e_radps,
                  double to_e_radps, double capacitance_F)
{
    const support::TempDir dir;
    std::string            text = text_of("drives/" + drive + ".toml");
    text.replace(text.find("[inverter]\n"), 11, "[inverter]\nregeneration = \"brake_chopper\"\n");
    dir.write("board_390w.toml", text_of("boards/board_390w.toml") + chopper);
    dir.write("drive.toml", text);
    return read_scenario_file(
        dir.write("s.toml", fmt::format("drive = \"drive.toml\"\nduration_s = 1.0\n"
                                        "initial_speed_e_radps = {0}\n[sensors]\n[inverter]\n"
                                        "regeneration = \"blocks\"\ncapacitance_F = {2}\n"
                                        "source_resistance_Ohm = 1.0\n"
                                        "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = {0}\n"
                                        "[[speed_reference]]\ntime_s = 0.1\nvalue_e_radps = {1}\n",
                                        from_e_radps, to_e_radps, capacitance_F)));
}

struct Brake {
    int         fault       = 0;
    double      most_V      = 0.0;
    double      end_e_radps = 0.0;
    double      heat        = 0.0;
    int         state       = 0;
    std::size_t findings    = 0;
};

Brake brake(const Scenario &s, BoardKind kind)
{
    const BoardResult r = simulate_on_board(s, kind);
    Brake             b;
    for (const TraceRow &t : r.result.trace) {
        b.most_V = std::max(b.most_V, t.dc_link_V);
    }
    b.fault       = r.result.fault;
    b.end_e_radps = r.result.trace.back().omega_e_radps;
    b.heat        = static_cast<double>(app_status_read().chopper_heat);
    b.state       = app_status_read().chopper;
    b.findings    = r.findings.size();
    for (const std::string &f : r.findings) {
        ADD_FAILURE() << f;
    }
    return b;
}

/// Shaft at 1400 rad/s with an open bridge: 468 V of line EMF charge the link through the diodes.
class Coasting : public ::testing::Test {
protected:
    explicit Coasting(const std::string &chopper = keys(1000.0))
        : s_(scenario("ipmsm_390w", chopper, 1400.0, 1400.0, 2e-4)),
          controller_(prepare_controller(s_))
    {
        set_firmware(controller_.config, s_.drive);
    }
    static void step_to(BoardRun &run, long tick)
    {
        while (run.bench().tick() < tick) {
            ASSERT_TRUE(run.step());
        }
    }
    Scenario   s_;
    Controller controller_;
};

class WeakCoasting : public Coasting {
protected:
    WeakCoasting() : Coasting(keys(0.5)) {}
};

} // namespace

// 25 J of the rotor go to 0.3 mF, which hold 11 J more at the trip.
TEST(Chopper, HoldsTheLinkBelowTheTripWhenADriveBrakes)
{
    for (const char *drive : {"ipmsm_390w", "ipmsm_390w_pi_foc"}) {
        const Scenario s = scenario(drive, keys(100.0), 700.0, 50.0, 3e-4);
        for (const BoardKind kind : {BoardKind::api, BoardKind::f28335}) {
            const Brake b = brake(s, kind);
            EXPECT_EQ(b.fault, 0) << drive;
            EXPECT_LT(b.most_V, trip_V - 3.0) << drive;
            EXPECT_GT(b.most_V, on_V) << drive;
            EXPECT_NEAR(b.end_e_radps, 50.0, 5.0) << drive;
            EXPECT_GT(b.heat, 1e-3) << drive;
            EXPECT_EQ(b.state, APP_CHOPPER_OFF) << drive;
            RecordProperty(fmt::format("{}_most_mV", drive), static_cast<int>(1e3 * b.most_V));
        }
    }
}

// A law without a limit of its own.
TEST(Chopper, WithoutItTheSameBrakeTrips)
{
    const Brake b = brake(scenario("ipmsm_390w_pi_foc", "", 700.0, 50.0, 3e-4), BoardKind::f28335);
    EXPECT_EQ(b.fault, DRIVE_FAULT_DC_LINK);
    EXPECT_GT(b.most_V, trip_V);
    EXPECT_EQ(b.state, APP_CHOPPER_NONE);
}

// 0.3 W: 6 J to the rated heat. Then the limit of noc takes over, and other laws trip.
TEST(Chopper, AHotResistorIsOffAndTheLimitOfTheLawTakesOver)
{
    const Brake b = brake(scenario("ipmsm_390w", keys(0.3), 700.0, 50.0, 3e-4), BoardKind::f28335);
    EXPECT_EQ(b.fault, 0);
    EXPECT_LT(b.most_V, trip_V);
    EXPECT_EQ(b.state, APP_CHOPPER_HOT);
    EXPECT_GT(b.heat, 0.9);
    EXPECT_LT(b.heat, 1.4);
    const Brake pi =
        brake(scenario("ipmsm_390w_pi_foc", keys(0.3), 700.0, 50.0, 3e-4), BoardKind::f28335);
    EXPECT_EQ(pi.fault, DRIVE_FAULT_DC_LINK);
}

TEST_F(Coasting, TheLinkIsHeldWithAnOpenBridge)
{
    F28335Run run(s_, freed, 3e-6);
    double    most_V = 0.0;
    step_to(run, freed);
    EXPECT_EQ(app_status_read().mode, APP_MODE_READY);
    for (long tick = freed; tick < freed + 2500; tick++) {
        ASSERT_TRUE(run.step());
        most_V = std::max(most_V, run.bench().plant_state().dc_link_V);
    }
    EXPECT_GT(most_V, on_V);
    EXPECT_LT(most_V, on_V + 3.0);
    EXPECT_GT(run.bench().board()->chopper_J(), 15.0);
    EXPECT_EQ(app_status_read().mode, APP_MODE_READY);
    EXPECT_FALSE(run.bench().bridge_on());
    // 100 Ohm, 1000 W, 20 s.
    EXPECT_NEAR(static_cast<double>(app_status_read().chopper_heat),
                run.bench().board()->chopper_J() / 20e3, 2e-4);
    EXPECT_TRUE(run.findings().empty());
    RecordProperty("most_mV", static_cast<int>(1e3 * most_V));
}

TEST_F(WeakCoasting, TheHeatLimitIsReached)
{
    F28335Run run(s_, freed, 3e-6);
    step_to(run, freed + 2500);
    EXPECT_EQ(app_status_read().chopper, APP_CHOPPER_HOT);
    // 0.5 W for 20 s, and a turn of 1 ms with 1.4 kW.
    EXPECT_GT(run.bench().board()->chopper_J(), 9.9);
    EXPECT_LT(run.bench().board()->chopper_J(), 12.0);
    const double before = run.bench().board()->chopper_J();
    step_to(run, freed + 3500);
    EXPECT_EQ(run.bench().board()->chopper_J(), before);
}

// A tick that hangs and interrupts that are masked leave the pin to the unit: off 0.3 ms after the last command.
TEST_F(Coasting, AProcessorThatStopsEndsIt)
{
    for (const FaultKind kind :
         {FaultKind::trigger_lost, FaultKind::interrupt_masked, FaultKind::tick_hung}) {
        F28335Run run(s_, freed, 3e-6);
        step_to(run, freed);
        const auto &board  = *run.bench().board();
        double      before = 0.0;
        do { // until the resistor has been on for a whole period
            before = board.chopper_J();
            ASSERT_TRUE(run.step());
            ASSERT_LT(run.bench().tick(), freed + 1000);
        } while (board.chopper_J() < before + 0.25);
        run.inject(kind);
        for (int k = 0; k < 3 && run.step(); k++) {
        }
        const double stopped = board.chopper_J();
        for (int k = 0; k < 100 && run.step(); k++) {
        }
        EXPECT_EQ(board.chopper_J(), stopped);
        EXPECT_GT(board.plant_state().dc_link_V, off_V);
    }
}
