// SPDX-License-Identifier: MIT
// The bench of a served drive: its control port, the machine on its shaft, its pace.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"
#include "sil/served/control.hpp"
#include "sil/served/node_number.hpp"
#include "sil/served/served_f28335.hpp"
#include "sil/served/slcan.hpp"

using namespace sdre;

namespace {

Drive shipped()
{
    return read_drive_file(SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml");
}

/// A drive on its bench without a server, and its control port.
class AtTheBench {
public:
    std::string say(const std::string &line)
    {
        return control_answer(line, drive, record, server);
    }
    nlohmann::json ask(const std::string &line)
    {
        return nlohmann::json::parse(say(line));
    }
    void pass(double seconds)
    {
        for (const double end_s = drive.time_s() + seconds; drive.time_s() < end_s;) {
            drive.period();
            record.note(drive);
        }
    }

    ServedF28335 drive{shipped(), 1};
    MotorRecord  record;
    ServerReport server;
};

} // namespace

TEST(ServeControl, AMotorWithoutFrictionGetsSomeOnTheBench)
{
    Drive own = shipped();
    EXPECT_EQ(bench_friction_Nm(own), 0.0) << "its file has some";
    EXPECT_EQ(bench_scenario(own, own, 1).motor_effects.coulomb_friction_Nm, 0.0);
    own.motor.viscous_friction_Nms = 0.0;
    EXPECT_DOUBLE_EQ(bench_scenario(own, own, 1).motor_effects.coulomb_friction_Nm,
                     0.02 * own.motor.rated_torque_Nm);
    const double rated_radps = own.motor.rated_speed_e_radps / own.motor.pole_pairs;
    EXPECT_LT(own.motor.inertia_kgm2 * rated_radps / bench_friction_Nm(own), 10.0)
        << "s until it stands";
}

TEST(ServeControl, AMachineCogsByItsSlotsAndHasDryFriction)
{
    Drive own       = shipped();
    own.motor.slots = 0;
    MotorEffects e  = bench_scenario(own, {own, 0.05}, 1).motor_effects;
    EXPECT_DOUBLE_EQ(e.cogging_amplitude_Nm, 0.05 * own.motor.rated_torque_Nm);
    EXPECT_EQ(e.cogging_order, 12.0 * own.motor.pole_pairs);
    EXPECT_DOUBLE_EQ(e.coulomb_friction_Nm, 0.02 * own.motor.rated_torque_Nm);
    own.motor.slots = 18;
    EXPECT_EQ(bench_scenario(own, {own, 0.05}, 1).motor_effects.cogging_order, 18.0);
    EXPECT_EQ(bench_scenario(own, own, 1).motor_effects.cogging_amplitude_Nm, 0.0);
}

TEST(ServeControl, AMeasuredResonanceIsOnTheBench)
{
    Drive own = shipped();
    EXPECT_EQ(bench_scenario(own, own, 1).motor_effects.shaft_stiffness_Nmprad, 0.0);
    own.mechanics.coupling           = Coupling::known;
    own.mechanics.resonance_Hz       = 120.0;
    own.mechanics.least_damping      = 0.03;
    own.mechanics.load_inertia_share = 0.4;
    const MotorEffects e             = bench_scenario(own, own, 1).motor_effects;
    // Two masses against each other: w^2 = k / J_r, with J_r = J_1 J_2 / (J_1 + J_2).
    const double reduced_kgm2 = 0.4 * 0.6 * own.motor.inertia_kgm2;
    const double w_radps      = 2.0 * 3.14159265358979 * 120.0;
    EXPECT_NEAR(e.shaft_stiffness_Nmprad / (w_radps * w_radps * reduced_kgm2), 1.0, 1e-9);
    EXPECT_NEAR(e.shaft_damping_Nms / (0.06 * w_radps * reduced_kgm2), 1.0, 1e-9);
    EXPECT_EQ(e.load_inertia_share, 0.4);
    EXPECT_EQ(e.coulomb_friction_Nm, 0.0);
}

TEST(ServeControl, LoadSupplyFaultsAndWhatTheyDo)
{
    AtTheBench at;
    EXPECT_EQ(at.ask("load 0.5 active").at("load_Nm"), 0.5);
    at.pass(0.5);
    EXPECT_LT(at.drive.plant_state().omega_e_radps, -100.0); // nothing holds the shaft
    EXPECT_NEAR(static_cast<double>(at.record.samples().size()), 500.0, 3.0);
    EXPECT_EQ(at.ask("dc_link 250").at("source_V"), 250.0);
    at.pass(0.02);
    EXPECT_NEAR(at.drive.plant_state().dc_link_V, 250.0, 1.0);
    EXPECT_EQ(at.ask("fault kind = \"tick_hung\"").at("resets"), 0);
    EXPECT_EQ(at.ask("state").at("broken"), nlohmann::json::array({"tick_hung"}));
    at.pass(0.02); // the watchdog ends it after 4.4 ms, and the drive starts again
    EXPECT_EQ(at.ask("state").at("resets"), 1);
    EXPECT_EQ(at.ask("state").at("broken"), nlohmann::json::array());
    EXPECT_NE(at.say("fault kind = \"nope\"").find("must be one of"), std::string::npos);
    EXPECT_NE(at.say("").find("is not a command"), std::string::npos);
    for (const char *line :
         {"fault kind = ", "load nan", "load 1 2", "load", "load active", "\xff\xfe"}) {
        EXPECT_NE(at.say(line).find("error"), std::string::npos) << line;
    }
    EXPECT_NE(at.say("load -1").find("\\\"load -1 active\\\" drives the shaft"), std::string::npos)
        << at.say("load -1");
    EXPECT_NE(at.say("trace 0.1").find("\"speed_e_radps\":["), std::string::npos);
}

TEST(ServeControl, TheCanCableHasFaultsAndIsMended)
{
    AtTheBench at;
    EXPECT_EQ(at.ask("state").at("can_fault"), "none");
    for (const char *fault : {"open", "shorted", "dominant"}) {
        EXPECT_EQ(at.ask(std::string("can ") + fault).at("can_fault"), fault);
    }
    EXPECT_EQ(at.ask("mend").at("can_fault"), "none");
    EXPECT_EQ(at.ask("can open").at("can_fault"), "open");
    EXPECT_EQ(at.ask("power_cycle").at("can_fault"), "open");
    EXPECT_EQ(at.ask("can none").at("can_fault"), "none");
    EXPECT_LE(at.ask("state").at("can_load"), 1.0);
    EXPECT_EQ(at.ask("can cut").at("error"),
              "can \"cut\" is not allowed: must be open, shorted, dominant or none");
}

TEST(ServeControl, ANodeNumberIsARegisterAndThenACommand)
{
    AtTheBench       at;
    NodeNumber       node(at.drive, 17);
    f28335::CanNode &other = at.drive.can_bus().join();
    other.open();
    EXPECT_EQ(node.request(), rtu_frame({1, 6, 1, 32, 0, 17}));
    EXPECT_THROW(node.answered({}), InputError);
    EXPECT_THROW(node.answered(rtu_frame({1, 0x86, 2})), InputError);
    node.answered(node.request());
    for (int n = 0; n < 100 && !node.done(); n++) {
        at.pass(at.drive.period_s());
        node.step();
    }
    EXPECT_TRUE(node.done());
    const std::optional<f28335::CanFrame> command = other.take();
    ASSERT_TRUE(command);
    EXPECT_EQ(slcan_line(*command), "t00028200\r");
}

// A brake takes no shaft anywhere; an active load of the same torque does.
TEST(ServeControl, ALoadIsABrakeThatHoldsAtRestAndStopsAShaftThatCoasts)
{
    AtTheBench at;
    at.ask("load 1");
    at.pass(1.0);
    EXPECT_EQ(at.drive.plant_state().omega_e_radps, 0.0);
    EXPECT_EQ(at.ask("state").at("load_kind"), "brake");
    at.ask("load -0.2 active");
    at.pass(0.5);
    const double fast = at.drive.plant_state().omega_e_radps;
    EXPECT_GT(fast, 200.0);
    at.ask("load 0.2 brake");
    at.pass(0.1);
    const Motor &m       = at.drive.drive().motor; // J dw/dt = -(T + B w)
    const double T_per_B = 0.2 / m.viscous_friction_Nms * m.pole_pairs;
    const double share   = std::exp(-0.1 * m.viscous_friction_Nms / m.inertia_kgm2);
    EXPECT_NEAR(at.drive.plant_state().omega_e_radps, (fast + T_per_B) * share - T_per_B, 1.0);
    at.pass(1.0);
    EXPECT_EQ(at.drive.plant_state().omega_e_radps, 0.0);
}

TEST(ServeControl, TheShaftIsCaughtAtTheSpeedThatTheBenchStands)
{
    AtTheBench   at;
    const double caught_at = 1.2 * trip_speed_e_radps(at.drive.drive());
    at.ask("load -4 active");
    double most = 0.0;
    for (int n = 0; n < 15; n++) {
        at.pass(0.1);
        for (const MotorRecord::Sample &x : at.record.samples()) {
            most = std::max(most, x.omega_e_radps);
        }
    }
    EXPECT_GT(most, 0.99 * caught_at);
    EXPECT_LT(most, 1.01 * caught_at);
    EXPECT_EQ(at.drive.plant_state().omega_e_radps, 0.0);
    const nlohmann::json after = at.ask("state");
    EXPECT_EQ(after.at("load_Nm"), 0.0);
    EXPECT_EQ(after.at("catches"), 1);
    EXPECT_NE(after.at("note").get<std::string>().find("caught the shaft at"), std::string::npos);
    EXPECT_EQ(at.ask("load 0.5").at("note"), "");
    const double most_Nm = after.at("load_most_Nm");
    EXPECT_NE(at.say(fmt::format("load {}", 1.01 * most_Nm)).find("must be a number in"),
              std::string::npos);
}

TEST(ServeControl, MendingTakesTheLoadAwayAndBringsTheShaftToRest)
{
    AtTheBench at;
    at.ask("load -0.3 active");
    at.ask("fault kind = \"phase_open\", phase = \"c\"");
    at.ask("fault kind = \"index_missing\"");
    EXPECT_EQ(at.ask("state").at("broken"),
              nlohmann::json::array({"phase_open c", "index_missing"}));
    at.pass(0.5);
    EXPECT_GT(at.drive.plant_state().omega_e_radps, 200.0);
    const nlohmann::json mended = at.ask("mend");
    EXPECT_EQ(mended.at("load_Nm"), 0.0);
    EXPECT_EQ(mended.at("broken"), nlohmann::json::array());
    at.pass(0.3);
    EXPECT_EQ(at.drive.plant_state().omega_e_radps, 0.0);
    at.ask("load 0.1 active"); // it is let go then
    at.pass(0.2);
    EXPECT_LT(at.drive.plant_state().omega_e_radps, -5.0);
}

TEST(ServeControl, AFaultSaysWhatItNeeds)
{
    AtTheBench at;
    for (const char *kind :
         {"phase_open\", phase = \"a", "current_zero\", phase = \"b", "index_missing"}) {
        EXPECT_EQ(at.ask(fmt::format("fault kind = \"{}\"", kind)).at("note"),
                  "it shows in a run: start the motor");
    }
    EXPECT_NE(at.say("fault kind = \"interrupt_masked\"").find("see the reset cause"),
              std::string::npos);
}

TEST(ServePace, TellsWhatItIsAndOnceThatItIsSlow)
{
    Pace pace(2.0);
    EXPECT_EQ(pace.real_time_factor(), 2.0);
    pace.note(10.0, 0.0);
    pace.note(10.5, 0.4);
    EXPECT_EQ(pace.real_time_factor(), 2.0); // not a second yet
    pace.note(11.0, 1.0);
    EXPECT_EQ(pace.real_time_factor(), 1.0);
    EXPECT_TRUE(pace.has_become_slow());
    EXPECT_FALSE(pace.has_become_slow());
    pace.note(12.0, 2.9); // 0.95 of what was asked for: neither quick nor news
    EXPECT_FALSE(pace.has_become_slow());
    pace.note(13.0, 4.9);
    EXPECT_FALSE(pace.has_become_slow());
    pace.note(14.0, 5.9);
    EXPECT_TRUE(pace.has_become_slow());
}
