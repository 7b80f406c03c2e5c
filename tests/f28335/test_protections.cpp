// SPDX-License-Identifier: MIT
// Faults of the board with the application and its drivers: time to an open bridge and peak
// current. docs/assurance.md has the table.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../support/temp_dir.hpp"
#include "sil/board/board_run.hpp"
#include "sil/board/board_runs.hpp"
#include "sil/run/faults.hpp"

extern "C" {
#include "app.h"
#include "sil/f28335/code_start.h"
}

using namespace sdre;

namespace {

constexpr double limit_A  = 4.0;
constexpr double when_s   = 0.05; // of the fault
constexpr double period_s = 200e-6;

/// The shipped drive in a steady state, then a fault.
Scenario broken(double speed_e_radps, double load_Nm, const std::string &fault)
{
    const support::TempDir dir;
    return read_scenario_file(
        dir.write("s.toml", fmt::format("drive = \"" SDRE_SOURCE_DIR
                                        "/firmware/config/drives/ipmsm_390w.toml\"\n"
                                        "duration_s = {2}\ninitial_speed_e_radps = {0}\n[sensors]\n"
                                        "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = {0}\n"
                                        "[[load_torque]]\ntime_s = 0.0\nvalue_Nm = {1}\n"
                                        "[[fault]]\ntime_s = {3}\n{4}",
                                        speed_e_radps, load_Nm, when_s + 0.1, when_s, fault)));
}

struct Outcome {
    int    fault  = 0;
    double open_s = 1.0; ///< from the fault until the bridge is found open at a tick
    double peak_A = 0.0;
};

Outcome outcome_of(const Scenario &s, BoardKind kind)
{
    const BoardResult r = simulate_on_board(s, kind);
    Outcome           o;
    o.fault = r.result.fault;
    for (std::size_t k = 0; k < r.ticks.size(); k++) {
        const TraceRow &row = r.result.trace[k];
        if (row.time_s > when_s - 0.5 * period_s) {
            o.peak_A = std::max(o.peak_A, row.peak_current_A);
            if (!r.ticks[k].bridge_on) {
                o.open_s = std::min(o.open_s, row.time_s - when_s);
            }
        }
    }
    return o;
}

class ProcessorFault : public ::testing::TestWithParam<const char *> {};

} // namespace

INSTANTIATE_TEST_SUITE_P(Protections, ProcessorFault,
                         ::testing::Values("tick_hung", "trigger_lost", "interrupt_masked"),
                         [](const auto &p) { return std::string(p.param); });

TEST(Stack, WhatReachesItsEndIsAFault)
{
    const Scenario   s = broken(300.0, 1.5, "kind = \"trigger_lost\"\n");
    const Controller c = prepare_controller(s);
    set_firmware(c.config, s.drive);
    for (const std::size_t word : {0x000U, 0x6F7U, 0x6F8U, 0x6FFU}) { // the last eight are watched
        F28335Run run(s, MotorBench::never, 3e-6);
        run.step();
        ASSERT_EQ(app_status_read().fault, APP_FAULT_NONE);
        codestart_stack[word] = 0;
        run.step();
        run.step();
        EXPECT_EQ(app_status_read().fault, word < 0x6F8U ? APP_FAULT_NONE : APP_FAULT_MEMORY)
            << word;
    }
}

// 32 words a pass: both parts take five passes.
TEST(Copies, EachWordOfTheCodeThatChangesIsAFault)
{
    const Scenario   s = broken(300.0, 1.5, "kind = \"trigger_lost\"\n");
    const Controller c = prepare_controller(s);
    set_firmware(c.config, s.drive);
    for (unsigned word = 0; word < CODE_START_WORDS; word++) {
        F28335Run run(s, MotorBench::never, 3e-6);
        run.step();
        ASSERT_EQ(app_status_read().fault, APP_FAULT_NONE);
        code_start_ram[word] = code_start_ram[word] ^ (1U << (word % 16U));
        for (int k = 0; k < 20; k++) {
            run.step();
        }
        EXPECT_EQ(app_status_read().fault, APP_FAULT_MEMORY) << word;
        code_start_ram[word] = code_start_flash[word];
    }
}

TEST_P(ProcessorFault, BridgeOpensWithinSixTenthsOfAMillisecond)
{
    const std::string fault = fmt::format("kind = \"{}\"\n", GetParam());
    for (const double speed : {0.0, 300.0, -523.0, 850.0}) {
        const double  load_Nm = speed > 600.0 ? 0.5 : 1.5;
        const Outcome o       = outcome_of(broken(speed, load_Nm, fault), BoardKind::f28335);
        EXPECT_LE(o.open_s, 0.6e-3 + 1e-9) << speed;
        EXPECT_LT(o.peak_A, 1.5 * limit_A) << speed;
        EXPECT_EQ(o.fault, device_reset_fault) << speed; // and the next start reports that cause
        RecordProperty(fmt::format("peak_mA_at_{}", speed), static_cast<int>(1e3 * o.peak_A));
    }
}
