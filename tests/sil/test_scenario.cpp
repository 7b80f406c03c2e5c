// SPDX-License-Identifier: MIT
#include "sil/setup/scenario.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "scenario_text.hpp"
#include "temp_dir.hpp"

namespace {

using support::replaced;
using support::scenario_text;
using support::TempDir;

const std::filesystem::path scenarios =
    std::filesystem::path(SDRE_SOURCE_DIR) / "host_tools/sil/scenarios";

sdre::Scenario read(const std::string &text)
{
    const TempDir dir;
    return sdre::read_scenario_file(dir.write("case.toml", text));
}

/// Checks that a text is refused in one line about the file with these pieces.
void expect_complaint(const std::string &text, const std::vector<std::string> &pieces)
{
    const TempDir     dir;
    const std::string file = dir.write("case.toml", text);
    try {
        sdre::read_scenario_file(file);
        ADD_FAILURE() << "accepted:\n" << text;
    } catch (const sdre::InputError &error) {
        const std::string what = error.what();
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        EXPECT_EQ(what.rfind(file + ":", 0), 0U) << what;
        for (const std::string &piece : pieces) {
            EXPECT_NE(what.find(piece), std::string::npos) << "'" << piece << "' not in: " << what;
        }
    }
}

/// The scenario text with one place changed.
std::string with(const std::string &from, const std::string &to)
{
    return replaced(scenario_text(), from, to);
}

} // namespace

TEST(Scenario, ReadsEveryValue)
{
    std::string text = with("[controller_scale]\n", "[controller_scale]\ninertia_kgm2 = 2.0\n");
    text             = replaced(text, "[plant_scale]\n", "[plant_scale]\npm_flux_Wb = 0.9\n");
    text += "paper = { settling_time_s = 0.1, id_A = -3 }\n"
            "[[measure]]\nname = \"b\"\ntime_s = 0.01\nband_e_radps = 1\n"
            "[[load_torque]]\ntime_s = 0.015\nvalue_Nm = -0.25\n"
            "[inverter]\ndc_link_V = 200\n"
            "[controller]\nnosc_order = 1\nnodo_order = 0\n"
            "[[change]]\ntime_s = 0.005\nset = { plant_scale = { stator_resistance_Ohm = 1.5 } }\n";

    const sdre::Scenario s = read(text);

    EXPECT_EQ(s.name, "case");
    EXPECT_EQ(s.drive.name, "ipmsm_390w_speed");
    EXPECT_EQ(s.duration_s, 0.02);
    EXPECT_EQ(s.initial_speed_e_radps, 100.0);
    EXPECT_EQ(s.controller_scale, (sdre::MotorScale{{"inertia_kgm2", 2.0}}));
    EXPECT_EQ(s.plant_scale, (sdre::MotorScale{{"pm_flux_Wb", 0.9}}));
    EXPECT_EQ(s.nosc_order, 1);
    EXPECT_EQ(s.nodo_order, 0);
    ASSERT_EQ(s.speed_reference.size(), 1U);
    EXPECT_EQ(s.speed_reference[0].value, 100.0);
    ASSERT_EQ(s.load_torque.size(), 2U);
    EXPECT_EQ(s.load_torque[1].time_s, 0.015);
    EXPECT_EQ(s.load_torque[1].value, -0.25);
    ASSERT_EQ(s.changes.size(), 1U);
    EXPECT_EQ(s.changes[0].time_s, 0.005);
    EXPECT_EQ(s.changes[0].plant_scale, (sdre::MotorScale{{"stator_resistance_Ohm", 1.5}}));
    ASSERT_EQ(s.measures.size(), 2U);
    EXPECT_EQ(s.measures[0].name, "whole");
    EXPECT_EQ(s.measures[0].band_e_radps, 3.0);
    EXPECT_EQ(s.measures[0].paper,
              (std::map<std::string, double>{{"settling_time_s", 0.1}, {"id_A", -3.0}}));
    EXPECT_EQ(s.measures[1].time_s, 0.01);
    EXPECT_TRUE(s.measures[1].paper.empty());
    EXPECT_EQ(s.dc_link_V, 200.0);
}

TEST(Scenario, DefaultsAreThoseOfTheDrive)
{
    const TempDir        dir;
    const std::string    first = scenario_text().substr(0, scenario_text().find('\n') + 1);
    const sdre::Scenario s     = read(first + "duration_s = 1.0\n");

    EXPECT_EQ(s.initial_speed_e_radps, 0.0);
    EXPECT_EQ(s.dc_link_V, 295.0);
    EXPECT_FALSE(s.nosc_order.has_value());
    EXPECT_FALSE(s.nodo_order.has_value());
    EXPECT_TRUE(s.speed_reference.empty());
    EXPECT_TRUE(s.load_torque.empty());
    EXPECT_TRUE(s.changes.empty());
    EXPECT_TRUE(s.measures.empty());
    EXPECT_TRUE(s.controller_scale.empty());
    EXPECT_TRUE(s.plant_scale.empty());
}

TEST(Scenario, ShippedScenariosAreRead)
{
    int count = 0;
    for (const auto &entry : std::filesystem::recursive_directory_iterator(scenarios)) {
        if (entry.is_directory()) {
            continue;
        }
        const sdre::Scenario s = sdre::read_scenario_file(entry.path());
        EXPECT_EQ(s.name, entry.path().stem());
        const bool fault     = entry.path().parent_path().stem() == "faults";
        const bool board     = s.name.rfind("board_", 0) == 0 || fault;
        const bool servo     = s.name.rfind("servo_", 0) == 0;
        const bool m2310p    = s.name.rfind("m2310p_", 0) == 0;
        const bool harmonics = s.name.rfind("harmonics_", 0) == 0;
        EXPECT_EQ(s.drive.name, servo       ? "servo_200w_cdobc"
                                : m2310p    ? "m2310p_24v"
                                : harmonics ? "ipmsm_390w_noc_h_edges"
                                : board     ? "ipmsm_390w"
                                            : "ipmsm_390w_speed")
            << s.name;
        EXPECT_EQ(s.sensors.ideal, !board && !servo && !harmonics && !m2310p) << s.name;
        EXPECT_FALSE(s.measures.empty());
        count++;
    }
    // Fig. 4 with four orders, Fig. 5 to 8; eighteen on the realistic board. Two each of paper B, noc_h and 24 V; faults
    EXPECT_EQ(count, 32 + 20);
    EXPECT_EQ(sdre::read_scenario_file(scenarios / "fig4_parameter_steps_nd3.toml").nodo_order, 3);
    EXPECT_EQ(sdre::read_scenario_file(scenarios / "fig8_flux_weakening.toml").dc_link_V, 173.2);
}

TEST(Scenario, DrivePathIsRelativeToTheScenario)
{
    const TempDir dir;
    std::filesystem::create_directories(dir / "here");
    std::filesystem::create_directories(dir / "drives");
    std::filesystem::copy(scenarios / "../../../firmware/config/drives/servo_200w.toml",
                          dir / "drives" / "motor.toml");
    const auto file =
        dir.write("here/case.toml", "drive = \"../drives/motor.toml\"\nduration_s = 1.0\n");

    EXPECT_EQ(sdre::read_scenario_file(file).drive.name, "servo_200w");
}

TEST(Scenario, DrivePathFallsBackToTheWorkingDirectory)
{
    const TempDir dir;
    const auto    before = std::filesystem::current_path();
    std::filesystem::create_directories(dir / "here");
    std::filesystem::copy(scenarios / "../../../firmware/config/drives/servo_200w.toml",
                          dir / "motor.toml");
    dir.write("here/case.toml", "drive = \"motor.toml\"\nduration_s = 1.0\n");

    std::filesystem::current_path(dir.path());
    const std::string name = sdre::read_scenario_file("here/case.toml").drive.name;
    std::filesystem::current_path(before);

    EXPECT_EQ(name, "servo_200w");
}

TEST(Scenario, AngleComesFromWhatTheDriveMeasures)
{
    const TempDir dir;
    const auto    drives = std::filesystem::path(SDRE_SOURCE_DIR) / "firmware/config/drives";
    const auto    plain  = dir.write("a.toml", with("law = \"noc\"\n", ""));
    const auto    counts =
        dir.write("b.toml", with("ideal = true", "ideal = false\nencoder_edge_time = false"));
    const std::filesystem::path edges = drives / "ipmsm_390w_noc_h_edges.toml";

    EXPECT_FALSE(sdre::read_scenario_file(plain).sensors.encoder_edge_time);
    EXPECT_TRUE(sdre::read_scenario_file(plain, edges).sensors.encoder_edge_time);
    EXPECT_FALSE(sdre::read_scenario_file(counts).sensors.encoder_edge_time);
}

TEST(Scenario, MissingOrBrokenDriveIsNamed)
{
    for (const std::string drive : {"none.toml", ".", ""}) {
        const TempDir dir;
        const auto file = dir.write("case.toml", "drive = \"" + drive + "\"\nduration_s = 1.0\n");
        try {
            sdre::read_scenario_file(file);
            ADD_FAILURE() << drive;
        } catch (const sdre::InputError &error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            EXPECT_NE(std::string(error.what()).find(drive), std::string::npos);
        }
    }
}

TEST(Scenario, MissingAndUnknownKeysAreNamed)
{
    expect_complaint("duration_s = 1.0\n", {" drive is missing"});
    expect_complaint(with("duration_s = 0.02\n", ""), {" duration_s is missing"});
    expect_complaint(with("\nlaw", "\nlawn"),
                     {" lawn is not a known key", "initial_speed_e_radps"});
    expect_complaint(with("value_e_radps = 100.0", ""),
                     {"[[speed_reference]] number 1: value_e_radps is missing"});
    expect_complaint(with("value_Nm", "value_mNm"), {"[[load_torque]] number 1: value_Nm"});
    expect_complaint(scenario_text() + "colour = 1\n", {"[[measure]] number 1: colour"});
    expect_complaint(with("value_Nm = 0.5\n", "value_Nm = 0.5\nx = 1\n"),
                     {"[[load_torque]]", " x "});
    expect_complaint(with("band_e_radps = 3.0\n", ""), {"band_e_radps is missing"});
    expect_complaint(with("name = \"whole\"\n", ""), {"name is missing"});
    expect_complaint(with("ideal = true", "noise = 1"), {"[sensors] noise is not a known key"});
    expect_complaint(scenario_text() + "[inverter]\nlink = 1\n", {"[inverter] link"});
    expect_complaint(scenario_text() + "[controller]\norder = 1\n", {"[controller] order"});
    expect_complaint(scenario_text() + "[[change]]\ntime_s = 0.0\n", {"[[change]] number 1: set"});
    expect_complaint(scenario_text() + "[[change]]\ntime_s = 0.0\nset = { load = 1 }\n",
                     {"plant_scale is missing"});
    expect_complaint(scenario_text() +
                         "[[change]]\ntime_s = 0.0\nset = { plant_scale = { }, load = 1 }\n",
                     {"load is not a known key"});
    expect_complaint(scenario_text() +
                         "[[change]]\ntime_s = 0.0\nx = 1\nset = { plant_scale = { } }\n",
                     {"x is not a known key"});
}

TEST(Scenario, WrongTypesAndRangesAreNamed)
{
    expect_complaint(with("duration_s = 0.02", "duration_s = \"x\""),
                     {" duration_s = ", "must be a number", "0.001 .. 10000"});
    for (const std::string value : {"0.0", "-1.0", "1e5", "nan", "inf"}) {
        expect_complaint(with("duration_s = 0.02", "duration_s = " + value),
                         {" duration_s = ", "0.001 .. 10000"});
    }
    expect_complaint(with("speed_e_radps = 100.0", "speed_e_radps = 2e5"),
                     {" initial_speed_e_radps = 200000", "-100000 .. 100000"});
    expect_complaint(with("value_e_radps = 100.0", "value_e_radps = -2e5"),
                     {"value_e_radps", "100000"});
    expect_complaint(with("value_Nm = 0.5", "value_Nm = nan"), {"value_Nm = nan"});
    expect_complaint(with("time_s = 0.0", "time_s = -0.1"), {"time_s = -0.1", "0 .. 10000"});
    expect_complaint(with("band_e_radps = 3.0", "band_e_radps = 0.0"), {"band_e_radps = 0"});
    expect_complaint(with("name = \"whole\"", "name = 3"), {"name must be a string"});
    expect_complaint(with("law = \"noc\"", "law = \"foc\""), {" law is not allowed", "\"noc\""});
    expect_complaint(with("law = \"noc\"", "law = 1"), {" law must be a string"});
    expect_complaint(with("ideal = true", "ideal = 1"), {"ideal must be true or false"});
    expect_complaint(scenario_text() + "[inverter]\ndc_link_V = 0.5\n",
                     {"dc_link_V = 0.5", "10000"});
    expect_complaint(scenario_text() + "[controller]\nnodo_order = 9\n",
                     {"nodo_order = 9", "0 .. 8"});
    expect_complaint(scenario_text() + "[controller]\nnosc_order = 1.0\n", {"nosc_order", "whole"});
    expect_complaint(with("[sensors]\nideal = true\n", "sensors = 1\n"),
                     {" sensors must be a table"});
    expect_complaint("load_torque = 1\n" +
                         with("[[load_torque]]\ntime_s = 0.0\nvalue_Nm = 0.5\n", ""),
                     {" load_torque must be an array of tables"});
    expect_complaint("load_torque = [1]\n" +
                         with("[[load_torque]]\ntime_s = 0.0\nvalue_Nm = 0.5\n", ""),
                     {" load_torque must be an array of tables"});
}

TEST(Scenario, ScaleTakesFactorsOfMotorKeysOnly)
{
    for (const std::string table : {"controller_scale", "plant_scale"}) {
        const std::string head = "[" + table + "]\n";
        expect_complaint(with(head, head + "colour = 1.0\n"),
                         {"[" + table + "] colour is not a motor key that can be scaled"});
        expect_complaint(with(head, head + "pole_pairs = 2.0\n"),
                         {"pole_pairs is not a motor key"});
        expect_complaint(with(head, head + "inertia_kgm2 = 0.0\n"),
                         {"[" + table + "] inertia_kgm2 = 0 ", "0.01 .. 100"});
        expect_complaint(with(head, head + "inertia_kgm2 = 101.0\n"), {"0.01 .. 100"});
        expect_complaint(with(head, head + "inertia_kgm2 = \"2\"\n"), {"must be a number"});
        EXPECT_NO_THROW(read(with(head, head + "inertia_kgm2 = 0.01\npm_flux_Wb = 100.0\n")));
    }
    expect_complaint(scenario_text() +
                         "[[change]]\ntime_s = 0.0\nset = { plant_scale = { gain = 1.0 } }\n",
                     {"gain is not a motor key"});
}

TEST(Scenario, TimesMustGrow)
{
    const std::string again = "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = 5.0\n";
    expect_complaint(scenario_text() + again,
                     {" speed_reference number 2: time_s = 0 must be later than the one before"});
    expect_complaint(scenario_text() + "[[load_torque]]\ntime_s = 0.01\nvalue_Nm = 0.1\n"
                                       "[[load_torque]]\ntime_s = 0.005\nvalue_Nm = 0.1\n",
                     {" load_torque number 3: time_s = 0.005"});
    expect_complaint(scenario_text() +
                         "[[measure]]\nname = \"b\"\ntime_s = 0.0\nband_e_radps = 1.0\n",
                     {" measure number 2"});
    const std::string change = "set = { plant_scale = { pm_flux_Wb = 1.0 } }\n";
    expect_complaint(scenario_text() + "[[change]]\ntime_s = 0.01\n" + change +
                         "[[change]]\ntime_s = 0.01\n" + change,
                     {" change number 2"});
}

TEST(Scenario, MeasuresHaveNamesOfTheirOwnWithinTheRun)
{
    expect_complaint(scenario_text() +
                         "[[measure]]\nname = \"whole\"\ntime_s = 0.01\nband_e_radps = 1.0\n",
                     {"[[measure]] number 2: name = \"whole\" is used twice"});
    for (const std::string time : {"0.02", "0.5"}) { // at the end, after it
        expect_complaint(scenario_text() + "[[measure]]\nname = \"b\"\ntime_s = " + time +
                             "\nband_e_radps = 1.0\n",
                         {"measure \"b\": time_s must be before duration_s = 0.02"});
    }
}

TEST(Scenario, PublishedValuesAreThoseOfMetrics)
{
    expect_complaint(scenario_text() + "paper = { rise_time_s = 1 }\n",
                     {"rise_time_s is not the name of a metric"});
    expect_complaint(scenario_text() + "paper = { id_A = 1e10 }\n", {"id_A = 1e+10"});
    expect_complaint(scenario_text() + "paper = 1\n", {"paper must be a table"});
    EXPECT_NO_THROW(read(scenario_text() +
                         "paper = { settling_time_s = 1, dip_e_radps = 1, "
                         "overshoot_e_radps = 1, steady_state_error_e_radps = 1, "
                         "ripple_e_radps = 1, peak_current_A = 1, d_omega_hat = 1, "
                         "d_q_hat = 1, d_d_hat = 1, iq_A = 1, id_A = 1 }\n"));
}

TEST(Scenario, MissingFileAndBadTomlAreOneLine)
{
    EXPECT_THROW(sdre::read_scenario_file("/none/case.toml"), sdre::InputError);
    expect_complaint("drive = \"x\n", {"not valid TOML"});
}

TEST(Scenario, ScaledMultipliesWhatIsNamed)
{
    sdre::Motor m;
    m.inertia_kgm2 = 3.0;
    m.pm_flux_Wb   = 0.5;
    m.pole_pairs   = 2;

    const sdre::Motor twice = sdre::scaled(m, {{"inertia_kgm2", 2.0}, {"pm_flux_Wb", 0.1}});

    EXPECT_EQ(twice.inertia_kgm2, 6.0);
    EXPECT_EQ(twice.pm_flux_Wb, 0.05);
    EXPECT_EQ(twice.pole_pairs, 2);
    EXPECT_THROW(sdre::scaled(m, {{"x", 1.0}}), sdre::InputError);
}

TEST(Scenario, ValueAtHoldsFromItsTimeOn)
{
    const std::vector<sdre::Step> steps{{0.1, 5.0}, {0.3, -2.0}};

    EXPECT_EQ(sdre::value_at(steps, 0.0, 9.0), 9.0);
    EXPECT_EQ(sdre::value_at(steps, 0.0999, 9.0), 9.0);
    EXPECT_EQ(sdre::value_at(steps, 0.1, 9.0), 5.0);
    EXPECT_EQ(sdre::value_at(steps, 0.1 - 1e-13, 9.0), 5.0); // k Ts may fall short by rounding
    EXPECT_EQ(sdre::value_at(steps, 0.2, 9.0), 5.0);
    EXPECT_EQ(sdre::value_at(steps, 0.3, 9.0), -2.0);
    EXPECT_EQ(sdre::value_at(steps, 1e3, 9.0), -2.0);
    EXPECT_EQ(sdre::value_at({}, 1.0, 9.0), 9.0);
}
