// SPDX-License-Identifier: MIT
#include "drive/drive_file.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "drive_text.hpp"
#include "temp_dir.hpp"

namespace {

using support::DriveText;
using support::TempDir;

/// The limits as a user meets them, written down a second time on purpose.
struct Key {
    std::string section;
    std::string name;
    double      lo;
    double      hi;
    bool        whole;
    std::string allowed; ///< as messages print it
};

const std::vector<Key> scalar_keys{
    {"motor", "pole_pairs", 1, 100, true, "1 .. 100"},
    {"motor", "stator_resistance_Ohm", 1e-5, 1e3, false, "1e-05 .. 1000"},
    {"motor", "d_axis_inductance_H", 1e-7, 10, false, "1e-07 .. 10"},
    {"motor", "q_axis_inductance_H", 1e-7, 10, false, "1e-07 .. 10"},
    {"motor", "pm_flux_Wb", 0, 10, false, "0 .. 10"},
    {"motor", "inertia_kgm2", 1e-9, 1e3, false, "1e-09 .. 1000"},
    {"motor", "viscous_friction_Nms", 0, 100, false, "0 .. 100"},
    {"motor", "rated_speed_e_radps", 1, 1e5, false, "1 .. 100000"},
    {"motor", "rated_torque_Nm", 1e-5, 1e5, false, "1e-05 .. 100000"},
    {"motor", "max_current_A", 1e-3, 1e4, false, "0.001 .. 10000"},
    {"inverter", "dc_link_V", 1, 1e4, false, "1 .. 10000"},
    {"inverter", "dead_time_s", 0, 2e-5, false, "0 .. 2e-05"},
    {"inverter", "updates_per_period", 1, 2, true, "1 .. 2"},
    {"encoder", "lines", 1, 1e6, true, "1 .. 1e+06"},
    {"nosc", "order", 0, 8, true, "0 .. 8"},
    {"nodo", "order", 0, 8, true, "0 .. 8"}};

struct ArrayKey {
    std::string section;
    std::string name;
    int         length;
    double      lo;
    double      hi;
    std::string allowed;
    std::string lengths;
};

const std::vector<ArrayKey> array_keys{
    {"nosc", "Q", 3, 0.0, 1e15, "0 .. 1e+15", "array of 3 numbers"},
    {"nosc", "T", 2, 1e-18, 1e12, "1e-18 .. 1e+12", "array of 2 numbers"},
    {"nodo", "Q", 6, 0.0, 1e15, "0 .. 1e+15", "array of 6 numbers"},
    {"nodo", "T", 3, 1e-18, 1e12, "1e-18 .. 1e+12", "array of 6 or 3 numbers"}};

std::string number(double x, bool whole)
{
    return whole ? fmt::format("{}", static_cast<long long>(x)) : fmt::format("{:.17e}", x);
}

/// "[1, 1, x, 1]" with x at `at`.
std::string array_with(int length, int at, const std::string &x)
{
    std::string text = "[";
    for (int i = 0; i < length; i++) {
        text += fmt::format("{}{}", i == 0 ? "" : ", ", i == at ? x : "1.0");
    }
    return text + "]";
}

sdre::Drive read(const std::string &text)
{
    const TempDir dir;
    return sdre::read_drive_file(dir.write("drive.toml", text));
}

/// The complaint about a text, without the file's path in front; checks that it is one line about
/// this file.
std::string complaint(const std::string &text)
{
    const TempDir dir;
    const auto    file = dir.write("drive.toml", text);
    try {
        sdre::read_drive_file(file);
    } catch (const sdre::InputError &error) {
        const std::string what = error.what();
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        EXPECT_EQ(what.rfind(file.string() + ":", 0), 0U) << what;
        return what.substr(file.string().size() + 1);
    }
    return "accepted";
}

std::string complaint(const DriveText &text)
{
    return complaint(text.str());
}

void expect_complaint(const DriveText &text, const std::vector<std::string> &pieces)
{
    const std::string what = complaint(text);
    for (const std::string &piece : pieces) {
        EXPECT_NE(what.find(piece), std::string::npos) << "'" << piece << "' not in: " << what;
    }
}

/// The same drive with an observer that measures the angle.
DriveText encoder_text()
{
    return DriveText()
        .set("nodo", "form", "\"encoder\"")
        .set("nodo", "Q", "[1.0e8, 1.1e8, 1.2e8, 85.0, 86.0, 90.0, 0.0]");
}

/// The same with harmonics: eight pairs, as many as the firmware holds.
DriveText harmonic_text()
{
    return encoder_text()
        .set("", "law", "\"noc_h\"")
        .set("motor", "slots", "24")
        .add_section("harmonics")
        .set("harmonics", "sensor", "[1, 2]")
        .set("harmonics", "voltage", "[6]")
        .set("harmonics", "cogging", "[1, 2]")
        .set("harmonics", "sensor_weight", "0.1")
        .set("harmonics", "voltage_weight", "3e4")
        .set("harmonics", "cogging_weight", "1e6")
        .set("harmonics", "cogging_voltage_weight", "2e4")
        .set("harmonics", "slope_weight", "1e9")
        .set("harmonics", "weight_speed_e_radps", "300.0")
        .set("harmonics", "leak_1ps", "0.2");
}

/// Other keys moved so that an end of one key's range meets no rule about two keys.
DriveText room_for(const Key &key, double value)
{
    DriveText text;
    if (key.name == "d_axis_inductance_H") {
        text.set("motor", "q_axis_inductance_H", "10.0");
    } else if (key.name == "q_axis_inductance_H") {
        text.set("motor", "d_axis_inductance_H", "1e-7");
    }
    return text.set(key.section, key.name, number(value, key.whole));
}

} // namespace

TEST(DriveFile, ReadsEveryValueToItsPlace)
{
    const sdre::Drive drive = read(DriveText().set("inverter", "updates_per_period", "2").str());

    EXPECT_EQ(drive.name, "bench");
    EXPECT_EQ(drive.motor.pole_pairs, 2);
    EXPECT_EQ(drive.motor.stator_resistance_Ohm, 2.48);
    EXPECT_EQ(drive.motor.d_axis_inductance_H, 0.07498);
    EXPECT_EQ(drive.motor.q_axis_inductance_H, 0.11391);
    EXPECT_EQ(drive.motor.pm_flux_Wb, 0.193);
    EXPECT_EQ(drive.motor.inertia_kgm2, 0.00042);
    EXPECT_EQ(drive.motor.viscous_friction_Nms, 0.0001);
    EXPECT_EQ(drive.motor.rated_speed_e_radps, 523.0);
    EXPECT_EQ(drive.motor.rated_torque_Nm, 1.5);
    EXPECT_EQ(drive.motor.max_current_A, 4.0);
    EXPECT_EQ(drive.inverter.dc_link_V, 295.0);
    EXPECT_EQ(drive.inverter.pwm_frequency_Hz, 5000.0);
    EXPECT_EQ(drive.inverter.pwm_wanted_Hz, 5000.0);
    EXPECT_EQ(drive.inverter.dead_time_s, 3e-6);
    EXPECT_EQ(drive.inverter.updates_per_period, 2);
    EXPECT_EQ(drive.encoder.lines, 2500);
    EXPECT_EQ(drive.nosc.order, 2);
    EXPECT_EQ(drive.nosc.Q, (std::array<double, 3>{2.0, 8.0, 8.5}));
    EXPECT_EQ(drive.nosc.T, (std::array<double, 2>{1e-3, 1.25e-3}));
    EXPECT_EQ(drive.nodo.form, sdre::NodoForm::speed);
    EXPECT_EQ(drive.nodo.order, 1);
    EXPECT_EQ(drive.nodo.Q, (std::vector<double>{1.0e8, 1.1e8, 1.2e8, 85.0, 86.0, 90.0}));
    EXPECT_EQ(drive.nodo.T, (std::array<double, 3>{1e-4, 1.5e-4, 2e-4}));
}

TEST(DriveFile, ShippedDrivesAreRead)
{
    const std::filesystem::path drives =
        std::filesystem::path(SDRE_SOURCE_DIR) / "firmware/config/drives";

    const sdre::Drive ipmsm = sdre::read_drive_file(drives / "ipmsm_390w_speed.toml");
    const sdre::Drive paper = sdre::read_drive_file(drives / "ipmsm_390w_paper.toml");
    const sdre::Drive servo = sdre::read_drive_file(drives / "servo_200w.toml");
    const sdre::Drive board = sdre::read_drive_file(drives / "ipmsm_390w.toml");

    EXPECT_EQ(ipmsm.name, "ipmsm_390w_speed");
    EXPECT_EQ(paper.name, "ipmsm_390w_paper");
    EXPECT_EQ(servo.name, "servo_200w");
    EXPECT_EQ(ipmsm.motor.pole_pairs, 2);
    EXPECT_EQ(ipmsm.motor.q_axis_inductance_H, 0.11391);
    EXPECT_EQ(ipmsm.motor.max_current_A, 4.0);
    EXPECT_EQ(paper.nodo.Q, (std::vector<double>{0.3, 5.0, 5.0, 85.0, 85.0, 90.0}));
    EXPECT_EQ(paper.nodo.form, sdre::NodoForm::speed);
    EXPECT_EQ(servo.motor.pole_pairs, 4);
    EXPECT_EQ(servo.motor.d_axis_inductance_H, servo.motor.q_axis_inductance_H);
    EXPECT_EQ(board.name, "ipmsm_390w");
    EXPECT_EQ(board.nodo.form, sdre::NodoForm::encoder);
    EXPECT_EQ(board.nodo.Q.size(), 7U);
    EXPECT_EQ(board.motor.inertia_kgm2, ipmsm.motor.inertia_kgm2); // the same motor
}

TEST(DriveFile, MissingKeyIsNamed)
{
    for (const Key &key : scalar_keys) {
        if (key.name != "updates_per_period") {
            expect_complaint(DriveText().erase(key.section, key.name),
                             {fmt::format("[{}] {} is missing", key.section, key.name)});
        }
    }
    for (const ArrayKey &key : array_keys) {
        expect_complaint(DriveText().erase(key.section, key.name),
                         {fmt::format("[{}] {} is missing", key.section, key.name)});
    }
    expect_complaint(DriveText().erase("inverter", "pwm_frequency_Hz"),
                     {"[inverter] pwm_frequency_Hz is missing: must be a number"});
    expect_complaint(DriveText().erase("", "name"), {" name is missing"});
    expect_complaint(DriveText().erase("", "schema"), {" schema is missing"});
}

TEST(DriveFile, MissingTableIsNamed)
{
    for (const std::string section : {"motor", "inverter", "encoder", "nosc", "nodo"}) {
        expect_complaint(DriveText().erase_section(section), {" " + section + " is missing"});

        DriveText as_number = DriveText().erase_section(section);
        as_number.set("", section, "1");
        expect_complaint(as_number, {" " + section + " must be a table"});
    }
}

TEST(DriveFile, UpdatesPerPeriodDefaultsToOne)
{
    EXPECT_EQ(
        read(DriveText().erase("inverter", "updates_per_period").str()).inverter.updates_per_period,
        1);
}

TEST(DriveFile, UnknownKeyIsNamedWithTheKnownOnes)
{
    for (const std::string section : {"motor", "inverter", "encoder", "nosc", "nodo"}) {
        expect_complaint(DriveText().set(section, "colour", "1"),
                         {"[" + section + "] colour is not a known key; allowed: "});
    }
    expect_complaint(DriveText().set("", "colour", "1"),
                     {" colour is not a known key", "motor", "schema", "nodo"});
    expect_complaint(DriveText().set("encoder", "Lines", "1"),
                     {"allowed: disc, edge_times, index_angle_e_rad, lines"});
    expect_complaint(DriveText().set("inverter", "dead_time_us", "3"),
                     {"dead_time_us", "dead_time_s", "updates_per_period"});
}

TEST(DriveFile, WrongTypeIsNamedWithTheRange)
{
    for (const Key &key : scalar_keys) {
        for (const std::string value : {"\"1\"", "true", "[1.0]", "{ x = 1.0 }", "1979-05-27"}) {
            expect_complaint(DriveText().set(key.section, key.name, value),
                             {fmt::format("[{}] {} = ", key.section, key.name),
                              "is not allowed: must be a ", key.allowed});
        }
        if (key.whole) {
            expect_complaint(
                DriveText().set(key.section, key.name, "1.0"),
                {key.name + " = 1.0 is not allowed: must be a whole number", key.allowed});
        }
    }
    expect_complaint(DriveText().set("inverter", "pwm_frequency_Hz", "true"),
                     {"[inverter] pwm_frequency_Hz = true is not allowed: must be a number"});
    for (const char *value : {"nan", "inf", "-inf"}) {
        expect_complaint(DriveText().set("inverter", "pwm_frequency_Hz", value),
                         {"[inverter] pwm_frequency_Hz = ", value, "must be finite"});
    }
    expect_complaint(DriveText().set("", "name", "3"), {" name must be a string"});
    expect_complaint(DriveText().set("", "schema", "1.0"),
                     {" schema = 1.0 is not allowed: must be a whole number"});
}

TEST(DriveFile, NotFiniteIsRefusedWithTheRange)
{
    for (const Key &key : scalar_keys) {
        for (const std::string value : {"nan", "inf", "-inf", "+inf"}) {
            expect_complaint(DriveText().set(key.section, key.name, value),
                             {fmt::format("[{}] {} ", key.section, key.name), key.allowed});
        }
    }
    for (const ArrayKey &key : array_keys) {
        for (const std::string value : {"nan", "inf", "-inf"}) {
            expect_complaint(DriveText().set(key.section, key.name,
                                             array_with(key.length, key.length - 1, value)),
                             {fmt::format("[{}] {}[{}] = ", key.section, key.name, key.length - 1),
                              value, key.allowed});
        }
    }
}

TEST(DriveFile, EndsOfTheRangeAreAllowed)
{
    for (const Key &key : scalar_keys) {
        for (const double value : {key.lo, key.hi}) {
            EXPECT_EQ(complaint(room_for(key, value)), "accepted") << key.name << " " << value;
        }
    }
    for (const ArrayKey &key : array_keys) {
        for (const double value : {key.lo, key.hi}) {
            const std::string text = array_with(key.length, 0, number(value, false));
            EXPECT_EQ(complaint(DriveText().set(key.section, key.name, text)), "accepted") << text;
        }
    }
}

TEST(DriveFile, JustOutsideTheRangeIsRefusedWithValueAndRange)
{
    for (const Key &key : scalar_keys) {
        const double below = key.whole ? key.lo - 1 : std::nextafter(key.lo, -1e300);
        const double above = key.whole ? key.hi + 1 : std::nextafter(key.hi, 1e300);
        for (const double value : {below, above}) {
            expect_complaint(
                room_for(key, value),
                {fmt::format("[{}] {} = {:g} ", key.section, key.name, value), key.allowed});
        }
    }
    for (const ArrayKey &key : array_keys) {
        for (int at = 0; at < key.length; at++) {
            for (const double value :
                 {std::nextafter(key.lo, -1e300), std::nextafter(key.hi, 1e300)}) {
                expect_complaint(
                    DriveText().set(key.section, key.name,
                                    array_with(key.length, at, number(value, false))),
                    {fmt::format("[{}] {}[{}] = {:g} ", key.section, key.name, at, value),
                     key.allowed});
            }
        }
    }
}

TEST(DriveFile, HugeWholeNumberDoesNotWrapIntoRange)
{
    expect_complaint(DriveText().set("motor", "pole_pairs", "4294967298"), {"pole_pairs", "100"});
    expect_complaint(DriveText().set("encoder", "lines", "9223372036854775807"),
                     {"lines", "1e+06"});
}

TEST(DriveFile, NegativeInertiaIsRefused)
{
    expect_complaint(DriveText().set("motor", "inertia_kgm2", "-0.00042"),
                     {"[motor] inertia_kgm2 = -0.00042 is not allowed", "1e-09 .. 1000"});
}

TEST(DriveFile, SaliencyTheLawCannotUseIsRefused)
{
    expect_complaint(DriveText().set("motor", "d_axis_inductance_H", "0.12"),
                     {"[motor] d_axis_inductance_H = 0.12", "q_axis_inductance_H = 0.11391"});

    EXPECT_EQ(complaint(DriveText().set("motor", "d_axis_inductance_H", "0.11391")), "accepted");
}

TEST(DriveFile, DeadTimeOverATenthOfThePeriodIsRefused)
{
    DriveText text;
    text.set("inverter", "pwm_frequency_Hz", "20000.0");

    text.set("inverter", "dead_time_s", "4.9e-6");
    EXPECT_EQ(complaint(text), "accepted");
    text.set("inverter", "dead_time_s", "5.1e-6");
    expect_complaint(text, {"[inverter] dead_time_s", "tenth of the PWM period"});
}

TEST(DriveFile, ArrayOfAnotherLengthOrTypeIsRefused)
{
    for (const ArrayKey &key : array_keys) {
        for (const int length : {0, 1, 4, 5, 7}) {
            expect_complaint(
                DriveText().set(key.section, key.name, array_with(length, 0, "1.0")),
                {fmt::format("[{}] {} must be an ", key.section, key.name), key.lengths});
        }
        expect_complaint(DriveText().set(key.section, key.name, "1.0"), {key.lengths});
        expect_complaint(
            DriveText().set(key.section, key.name, array_with(key.length, 1, "\"x\"")),
            {fmt::format("[{}] {}[1] = ", key.section, key.name), "must be a number", key.allowed});
    }
    expect_complaint(DriveText().set("nosc", "Q", "[1.0, 1.0, 1.0, 1.0, 1.0, 1.0]"),
                     {"array of 3 numbers"});
    expect_complaint(DriveText().set("nodo", "Q", "[1.0, 1.0, 1.0]"), {"array of 6 numbers"});
}

TEST(DriveFile, SixObserverInputWeightsMeanTheLastThree)
{
    const sdre::Drive drive =
        read(DriveText().set("nodo", "T", "[9.0, 8.0, 7.0, 1e-4, 1.5e-4, 2e-4]").str());

    EXPECT_EQ(drive.nodo.T, (std::array<double, 3>{1e-4, 1.5e-4, 2e-4}));
    EXPECT_EQ(sdre::drive_digest(drive), sdre::drive_digest(read(DriveText().str())));
    expect_complaint(DriveText().set("nodo", "T", "[0.0, 8.0, 7.0, 1e-4, 1.5e-4, 2e-4]"),
                     {"[nodo] T[0] = 0 "});
}

TEST(DriveFile, OtherSchemaIsRefused)
{
    for (const std::string schema : {"0", "2", "10"}) {
        expect_complaint(DriveText().set("", "schema", schema), {"schema = " + schema, "schema 1"});
    }
    expect_complaint(DriveText().set("", "schema", "-1"), {"schema = -1"});
}

TEST(DriveFile, NameIsLimitedToHarmlessCharacters)
{
    EXPECT_EQ(complaint(DriveText().set("", "name", "\"Ab-1_2.z\"")), "accepted");
    for (const std::string name : {"", "two words", "a/b", "a\\\"b", "a\\nb", "a*/b", "\\u00e4"}) {
        expect_complaint(DriveText().set("", "name", "\"" + name + "\""),
                         {" name must be one or more of A-Z a-z 0-9 _ - ."});
    }
}

TEST(DriveFile, NotTomlNamesTheLine)
{
    const std::string what = complaint("schema = 1\nname = \"x\"\n[motor\npole_pairs = 2\n");

    EXPECT_EQ(what.rfind("3: not valid TOML: ", 0), 0U) << what;
    EXPECT_NE(complaint(DriveText().str() + "T = [1e-4, 1e-4, 1e-4]\n").find("not valid TOML"),
              std::string::npos); // a key given twice
    EXPECT_NE(complaint(std::string("schema = 1\n\0", 12)).find("not valid TOML"),
              std::string::npos);
}

// Dots, quoted or not, headers, inline tables, arrays, and strings that could hide them.
// A depth of 32 is left to the parser. A depth of 33 is refused before it.
TEST(DriveFile, DepthIsLimitedBeforeTheParserRecurses)
{
    const auto repeated = [](const std::string &piece, int times) {
        std::string s;
        for (int i = 0; i < times; i++) {
            s += piece;
        }
        return s;
    };
    const auto deep = [&](int depth) {
        const std::string key = "a" + repeated(".a", depth);
        return std::vector<std::string>{
            key + " = 1\n",
            "a" + repeated(" . 'a'", depth) + " = 1\n",
            "\"a\"" + repeated(".\"a\"", depth) + " = 1\n",
            "[a" + repeated(".a", depth - 1) + "]\nx = 1\n",
            "[[a" + repeated(".a", depth - 2) + "]]\nx = 1\n",
            "a = " + repeated("[", depth) + repeated("]", depth) + "\n",
            "a = " + repeated("{a=", depth) + "1" + repeated("}", depth) + "\n",
            "a = [\n" + repeated("[\n", depth - 1) + repeated("]\n", depth - 1) + "]\n",
            R"(s = """x\"""""")" + std::string("\n") + key + " = 1\n",
            R"(s = [ """x"""", { )" + std::string("a") + repeated(".a", depth - 2) + " = 1 }]\n",
            "s = '\\'\n" + key + " = 1 # '\n",
            "s = '''x'''''\n" + key + " = 1\n"};
    };
    for (const std::string &text : deep(32)) {
        EXPECT_EQ(complaint(text).find("nested deeper"), std::string::npos) << text;
    }
    for (const int depth : {33, 40000, 1000000}) {
        for (const std::string &text : deep(depth)) {
            const std::string what = complaint(text);
            EXPECT_NE(what.find(": nested deeper than 32 tables and arrays"), std::string::npos)
                << text.substr(0, 60) << what;
            EXPECT_EQ(what.find('\n'), std::string::npos);
        }
    }
    const std::string dots = repeated(".", 100); // in text and comments they are no depth
    EXPECT_EQ(complaint(DriveText().str() + "# [[[[" + dots + "\n"), "accepted");
    for (const std::string &text :
         {"\"" + dots + "\"", "'" + dots + "'", "\"\"\"\n" + dots + "\"\"\"",
          "'''\n" + dots + "\n'''", "\"\\\"" + dots + "\""}) {
        EXPECT_NE(complaint("name = " + text + "\n").find("schema is missing"), std::string::npos);
    }
    const std::string numbers = "x = [\n" + repeated("1.5, 2.5,\n", 100) + "]\n";
    EXPECT_EQ(complaint(numbers).find("nested"), std::string::npos);
}

TEST(DriveFile, MissingFileAndDirectoryAreRefused)
{
    const TempDir dir;
    for (const auto &file : {dir / "none.toml", dir.path()}) {
        try {
            sdre::read_drive_file(file);
            ADD_FAILURE() << "read " << file;
        } catch (const sdre::InputError &error) {
            EXPECT_EQ(std::string(error.what()), file.string() + ": no such file");
        }
    }
}

TEST(DriveFile, ControlPeriodCountsUpdates)
{
    sdre::Drive drive = read(DriveText().set("inverter", "pwm_frequency_Hz", "8000.0").str());

    EXPECT_DOUBLE_EQ(sdre::control_period_s(drive), 9376 / 75e6); // TBPRD 4688
    drive.inverter.updates_per_period = 2;
    EXPECT_DOUBLE_EQ(sdre::control_period_s(drive), 4688 / 75e6);
}

TEST(DriveFile, DigestIgnoresLayout)
{
    const std::string digest    = sdre::drive_digest(read(DriveText().str()));
    std::string       commented = "# a comment\n\n";
    for (const char c : DriveText().str()) {
        commented += (c == '\n') ? std::string("   # said\n\n") : std::string(1, c);
    }

    EXPECT_EQ(digest.rfind("fnv1a64:", 0), 0U);
    EXPECT_EQ(digest.size(), 24U);
    EXPECT_EQ(digest.find_first_not_of("0123456789abcdef", 8), std::string::npos);
    EXPECT_EQ(sdre::drive_digest(read(commented)), digest);
    EXPECT_EQ(sdre::drive_digest(read(DriveText().reverse().str())), digest);
    EXPECT_EQ(sdre::drive_digest(read(DriveText().set("motor", "pm_flux_Wb", "1.93e-1").str())),
              digest);
    EXPECT_EQ(sdre::drive_digest(read(DriveText().erase("inverter", "updates_per_period").str())),
              digest);
}

TEST(DriveFile, DigestSeesEveryValue)
{
    std::set<std::string> digests{sdre::drive_digest(read(DriveText().str()))};
    std::size_t           changes = 1;
    const auto            add     = [&](const DriveText &text) {
        digests.insert(sdre::drive_digest(read(text.str())));
        changes++;
        EXPECT_EQ(digests.size(), changes) << text.str();
    };

    for (const Key &key : scalar_keys) {
        DriveText    text;
        const double value = std::stod(text.value(key.section, key.name));
        add(text.set(key.section, key.name,
                     number(key.whole ? value + 1 : std::nextafter(value, 1e300), key.whole)));
    }
    for (const ArrayKey &key : array_keys) {
        for (int at = 0; at < key.length; at++) {
            add(DriveText().set(key.section, key.name, array_with(key.length, at, "1.5")));
        }
    }
    add(DriveText().set("inverter", "pwm_frequency_Hz", "5001.0"));
    add(DriveText().set("", "name", "\"bench2\""));
    add(DriveText().set("encoder", "edge_times", "true"));
}

TEST(DriveFile, EdgeTimesAreOffUnlessAskedFor)
{
    EXPECT_FALSE(read(DriveText().str()).encoder.edge_times);
    EXPECT_TRUE(read(DriveText().set("encoder", "edge_times", "true").str()).encoder.edge_times);
    EXPECT_EQ(sdre::drive_digest(read(DriveText().set("encoder", "edge_times", "false").str())),
              sdre::drive_digest(read(DriveText().str())));
    expect_complaint(DriveText().set("encoder", "edge_times", "1"),
                     {"edge_times", "must be true or false"});
}

namespace {

std::string with_disc(const std::string &keys)
{
    return DriveText().str() + "[encoder.disc]\n" + keys + "\n";
}

} // namespace

TEST(DriveFile, DiscIsAGoodOneUnlessTheFileSaysWhatItIs)
{
    const auto disc = [](const std::string &keys) { return read(with_disc(keys)).encoder.disc; };
    const sdre::DiscErrors plain = read(DriveText().str()).encoder.disc;
    EXPECT_EQ(plain.pattern_cnt, 0.14);
    EXPECT_EQ(plain.own_rms_cnt, 0.02);
    EXPECT_EQ(plain.turn_cnt, 0.0);
    EXPECT_EQ(disc("pattern_cnt = 0.0").pattern_cnt, 0.0);
    EXPECT_EQ(disc("own_rms_cnt = 0.1").own_rms_cnt, 0.1);
    EXPECT_EQ(disc("turn_cnt = 0.15").turn_cnt, 0.15);
    // A state between edges that are off by +- 0.25 counts at most is 90 +- 45 degrees wide.
    EXPECT_NEAR(std::sqrt(3.0) * disc("state_width_error_deg = 45.0").own_rms_cnt, 0.25, 1e-12);
    // No table depends on the disc.
    EXPECT_EQ(sdre::drive_digest(read(with_disc("own_rms_cnt = 0.1"))),
              sdre::drive_digest(read(DriveText().str())));
}

TEST(DriveFile, DiscThatCannotBeIsRefused)
{
    const std::vector<std::tuple<std::string, std::string>> cases{
        {"colour = 1", "[disc] colour is not a known key; allowed: own_rms_cnt"},
        {"own_rms_cnt = 0.3", "own_rms_cnt"},
        {"own_rms_cnt = -0.1", "own_rms_cnt"},
        {"own_rms_cnt = 0.1\nstate_width_error_deg = 20.0",
         "own_rms_cnt is not allowed beside state_width_error_deg"},
        {"pattern_cnt = 0.4\nown_rms_cnt = 0.1", "off by 0.573 counts, must be below 0.5"}};
    for (const auto &[keys, complaint] : cases) {
        try {
            read(with_disc(keys));
            ADD_FAILURE() << keys;
        } catch (const sdre::InputError &e) {
            EXPECT_NE(std::string(e.what()).find(complaint), std::string::npos) << e.what();
        }
    }
}

namespace {

std::string with_uncertainty(const std::string &keys)
{
    return DriveText().str() + "[uncertainty]\n" + keys + "\n";
}

} // namespace

TEST(DriveFile, UncertaintiesAreThoseOfADataSheetUnlessTheFileSaysMore)
{
    const sdre::Uncertainty plain = read(DriveText().str()).uncertainty;
    const sdre::Uncertainty given =
        read(with_uncertainty("inertia = 0.11\npm_flux = 0.12\ninductance = 0.13\n"
                              "resistance = 0.14\ndead_time = 0.15\nfriction = 0.016\n"
                              "angle_e_rad = 0.017\ndisc_own_cnt = 0.018"))
            .uncertainty;
    EXPECT_EQ(plain.inertia, 0.1);
    EXPECT_EQ(plain.resistance, 0.2);
    EXPECT_EQ(given.inertia, 0.11);
    EXPECT_EQ(given.pm_flux, 0.12);
    EXPECT_EQ(given.inductance, 0.13);
    EXPECT_EQ(given.resistance, 0.14);
    EXPECT_EQ(given.dead_time, 0.15);
    EXPECT_EQ(given.friction, 0.016);
    EXPECT_EQ(given.angle_e_rad, 0.017);
    EXPECT_EQ(given.disc_own_cnt, 0.018);
    // No table depends on them.
    EXPECT_EQ(sdre::drive_digest(read(with_uncertainty("inertia = 0.3"))),
              sdre::drive_digest(read(DriveText().str())));
}

TEST(DriveFile, UncertaintyThatLeavesNoMachineIsRefused)
{
    const std::vector<std::pair<std::string, std::string>> cases{
        {"colour = 1", "[uncertainty] colour is not a known key"},
        {"inertia = 0.5", "[uncertainty] inertia = 0.5 is not allowed: must be in 0.001 .. 0.4"},
        {"angle_e_rad = 0.0", "[uncertainty] angle_e_rad"},
        {"disc_own_cnt = -0.1", "[uncertainty] disc_own_cnt"}};
    for (const auto &[keys, complaint] : cases) {
        try {
            read(with_uncertainty(keys));
            ADD_FAILURE() << keys;
        } catch (const sdre::InputError &e) {
            EXPECT_NE(std::string(e.what()).find(complaint), std::string::npos) << e.what();
        }
    }
}

TEST(DriveFile, MotorValueReachesEveryScalableKey)
{
    std::set<double *> places;
    sdre::Motor        motor = read(DriveText().str()).motor;
    for (const Key &key : scalar_keys) {
        if (key.section == "motor" && key.name != "pole_pairs") {
            double &value = sdre::motor_value(motor, key.name);
            places.insert(&value);
            EXPECT_EQ(value, std::stod(DriveText().value("motor", key.name))) << key.name;
        }
    }

    EXPECT_EQ(places.size(), 9U);
    EXPECT_THROW(sdre::motor_value(motor, "pole_pairs"), sdre::InputError);
    EXPECT_THROW(sdre::motor_value(motor, ""), sdre::InputError);
}

TEST(DriveFile, EncoderFormReadsSevenAndThreeWeights)
{
    const sdre::Drive drive = read(encoder_text().str());

    EXPECT_EQ(drive.nodo.form, sdre::NodoForm::encoder);
    EXPECT_EQ(drive.nodo.Q, (std::vector<double>{1.0e8, 1.1e8, 1.2e8, 85.0, 86.0, 90.0, 0.0}));
    EXPECT_EQ(drive.nodo.T, (std::array<double, 3>{1e-4, 1.5e-4, 2e-4}));
}

TEST(DriveFile, FormIsSpeedUnlessSaidOtherwise)
{
    const sdre::Drive absent = read(DriveText().str());
    const sdre::Drive said   = read(DriveText().set("nodo", "form", "\"speed\"").str());

    EXPECT_EQ(absent.nodo.form, sdre::NodoForm::speed);
    EXPECT_EQ(said.nodo.form, sdre::NodoForm::speed);
    EXPECT_EQ(sdre::drive_digest(absent), sdre::drive_digest(said));
    EXPECT_NE(sdre::drive_digest(absent), sdre::drive_digest(read(encoder_text().str())));
}

TEST(DriveFile, OtherFormIsRefusedWithTheAllowedOnes)
{
    for (const std::string form : {"", "Encoder", "angle", "speed "}) {
        expect_complaint(DriveText().set("nodo", "form", "\"" + form + "\""),
                         {"[nodo] form", "\"speed\" or \"encoder\""});
    }
    for (const std::string value : {"1", "true", "[\"encoder\"]"}) {
        expect_complaint(DriveText().set("nodo", "form", value), {"[nodo] form"});
    }
}

TEST(DriveFile, WeightsOfTheOtherFormAreRefused)
{
    for (const int length : {0, 3, 6, 8}) {
        expect_complaint(encoder_text().set("nodo", "Q", array_with(length, 0, "1.0")),
                         {"[nodo] Q must be an array of 7 numbers"});
    }
    for (const int length : {0, 2, 4, 6, 7}) {
        expect_complaint(encoder_text().set("nodo", "T", array_with(length, 0, "1.0")),
                         {"[nodo] T must be an array of 3 numbers"});
    }
    expect_complaint(encoder_text().set("nodo", "form", "\"speed\""),
                     {"[nodo] Q must be an array of 6 numbers"});
    expect_complaint(encoder_text().erase("nodo", "form"),
                     {"[nodo] Q must be an array of 6 numbers"});
    expect_complaint(encoder_text().set("nodo", "Q", array_with(7, 6, "-1.0")),
                     {"[nodo] Q[6] = -1 ", "0 .. 1e+15"});
    expect_complaint(encoder_text().set("nodo", "T", array_with(3, 2, "0.0")),
                     {"[nodo] T[2] = 0 ", "1e-18 .. 1e+12"});
    expect_complaint(encoder_text().set("nodo", "Q", array_with(7, 3, "nan")), {"[nodo] Q[3] = "});
}

TEST(DriveFile, EncoderFormDigestSeesEveryWeight)
{
    std::set<std::string> digests{sdre::drive_digest(read(encoder_text().str()))};
    for (int at = 0; at < 7; at++) {
        digests.insert(sdre::drive_digest(
            read(encoder_text().set("nodo", "Q", array_with(7, at, "1.5")).str())));
    }
    EXPECT_EQ(digests.size(), 8U);
}

TEST(DriveFile, OvermodulationDefaultsToOff)
{
    const sdre::Drive absent = read(DriveText().str());
    const sdre::Drive on     = read(DriveText().set("inverter", "overmodulation", "true").str());

    EXPECT_FALSE(absent.inverter.overmodulation);
    EXPECT_TRUE(on.inverter.overmodulation);
    EXPECT_NE(sdre::drive_digest(absent), sdre::drive_digest(on));
    expect_complaint(DriveText().set("inverter", "overmodulation", "1"),
                     {"[inverter] overmodulation"});
}

TEST(DriveFile, RegenerationIsNoneUnlessTheFileSaysWhatTakesIt)
{
    const auto with = [](const char *sink) {
        return read(DriveText().set("inverter", "regeneration", sink).str());
    };
    EXPECT_EQ(read(DriveText().str()).inverter.regeneration, sdre::DcLinkSink::none);
    EXPECT_EQ(with("\"none\"").inverter.regeneration, sdre::DcLinkSink::none);
    EXPECT_EQ(with("\"brake_chopper\"").inverter.regeneration, sdre::DcLinkSink::brake_chopper);
    EXPECT_EQ(with("\"supply\"").inverter.regeneration, sdre::DcLinkSink::supply);
    EXPECT_NE(sdre::drive_digest(with("\"supply\"")),
              sdre::drive_digest(with("\"brake_chopper\"")));
    EXPECT_NE(sdre::drive_digest(with("\"supply\"")), sdre::drive_digest(with("\"none\"")));
    expect_complaint(DriveText().set("inverter", "regeneration", "\"sinks\""),
                     {"[inverter] regeneration", "sinks", "brake_chopper"});
    expect_complaint(DriveText().set("inverter", "regeneration", "true"),
                     {"[inverter] regeneration"});
}

TEST(DriveFile, DeadTimeCompensationDefaultsToOn)
{
    const sdre::Drive absent = read(DriveText().str());
    const sdre::Drive on =
        read(DriveText().set("inverter", "dead_time_compensation", "true").str());
    const sdre::Drive off =
        read(DriveText().set("inverter", "dead_time_compensation", "false").str());

    EXPECT_TRUE(absent.inverter.dead_time_compensation);
    EXPECT_TRUE(on.inverter.dead_time_compensation);
    EXPECT_FALSE(off.inverter.dead_time_compensation);
    EXPECT_EQ(sdre::drive_digest(absent), sdre::drive_digest(on));
    EXPECT_NE(sdre::drive_digest(absent), sdre::drive_digest(off));
    for (const std::string value : {"1", "\"true\"", "[true]"}) {
        expect_complaint(DriveText().set("inverter", "dead_time_compensation", value),
                         {"[inverter] dead_time_compensation"});
    }
}

TEST(DriveFile, HarmonicsAreReadAsTheyAreWritten)
{
    const sdre::Drive         drive = read(harmonic_text().str());
    const sdre::HarmonicSpec &h     = drive.harmonics;

    EXPECT_EQ(drive.law, sdre::Law::noc_h);
    EXPECT_EQ(drive.motor.slots, 24);
    EXPECT_EQ(h.sensor, (std::vector<double>{1, 2}));
    EXPECT_EQ(h.voltage, (std::vector<double>{6}));
    EXPECT_EQ(h.cogging, (std::vector<double>{1, 2}));
    EXPECT_EQ(h.sensor_weight, 0.1);
    EXPECT_EQ(h.voltage_weight, 3e4);
    EXPECT_EQ(h.cogging_weight, 1e6);
    EXPECT_EQ(h.cogging_voltage_weight, 2e4);
    EXPECT_EQ(h.slope_weight, 1e9);
    EXPECT_EQ(h.weight_speed_e_radps, 300.0);
    EXPECT_EQ(h.leak_1ps, 0.2);
}

/// One clear line for whatever is wrong with them.
TEST(DriveFile, WrongHarmonicsAreNamed)
{
    const auto with = [](const char *key, const char *value) {
        return harmonic_text().set("harmonics", key, value);
    };
    expect_complaint(harmonic_text().erase("motor", "slots"),
                     {"[harmonics] cogging", "needs [motor] slots"});
    expect_complaint(with("voltage", "[6, 12]"),
                     {"[harmonics] voltage", "10 pairs in all", "firmware holds 8", "takes two"});
    expect_complaint(with("sensor", "[3]"), {"[harmonics] sensor", "1 .. 2"});
    expect_complaint(with("sensor", "[0.5]"), {"[harmonics] sensor", "1 .. 2"});
    expect_complaint(with("voltage", "[1001]"), {"[harmonics] voltage", "1 .. 1000"});
    expect_complaint(with("cogging", "[4]"), {"[harmonics] cogging", "1 .. 3"});
    expect_complaint(with("cogging", "[1, 1, 1, 1]"), {"[harmonics] cogging", "array of 1"});
    expect_complaint(with("sensor", "1"), {"[harmonics] sensor", "array of 1"});
    for (const char *key :
         {"sensor_weight", "voltage_weight", "cogging_weight", "cogging_voltage_weight"}) {
        expect_complaint(with(key, "-1e-9"), {std::string("[harmonics] ") + key, "0 .. 1e+15"});
        expect_complaint(with(key, "2e15"), {std::string("[harmonics] ") + key, "0 .. 1e+15"});
    }
    expect_complaint(with("slope_weight", "2e20"), {"[harmonics] slope_weight", "0 .. 1e+20"});
    expect_complaint(with("weight_speed_e_radps", "0.5"),
                     {"[harmonics] weight_speed_e_radps", "1 .. 100000"});
    expect_complaint(with("leak_1ps", "0.0"), {"[harmonics] leak_1ps", "0.001 .. 100"});
    expect_complaint(with("extra", "1"), {"[harmonics]", "extra"});
    expect_complaint(harmonic_text().set("motor", "slots", "2"), {"[motor] slots", "3 .. 1000"});
    for (const char *key : {"sensor_weight", "voltage_weight", "cogging_weight",
                            "weight_speed_e_radps", "leak_1ps"}) {
        expect_complaint(harmonic_text().erase("harmonics", key), {"[harmonics]", key, "missing"});
    }
}

TEST(DriveFile, HarmonicsNeedTheEncoderFormAndTheirOwnLaw)
{
    expect_complaint(harmonic_text()
                         .set("nodo", "form", "\"speed\"")
                         .set("nodo", "Q", "[1.0e8, 1.1e8, 1.2e8, 85.0, 86.0, 90.0]"),
                     {"[nodo] form", "is not allowed", "noc_h needs \"encoder\""});
    expect_complaint(harmonic_text().set("", "law", "\"noc\""), {"harmonics"});
    expect_complaint(harmonic_text().erase_section("harmonics"), {"harmonics", "missing"});
}

TEST(DriveFile, AbsentHarmonicsNeedNoWeight)
{
    DriveText text = harmonic_text();
    for (const char *key : {"sensor", "voltage", "cogging", "sensor_weight", "voltage_weight",
                            "cogging_weight", "cogging_voltage_weight", "slope_weight"}) {
        text.erase("harmonics", key);
    }
    const sdre::Drive drive = read(text.erase("motor", "slots").str());
    EXPECT_TRUE(drive.harmonics.sensor.empty() && drive.harmonics.cogging.empty());
    EXPECT_EQ(drive.harmonics.slope_weight, 0.0);
}

TEST(DriveFile, DigestSeesEveryHarmonic)
{
    std::set<std::string> digests{sdre::drive_digest(read(harmonic_text().str()))};
    const std::vector<std::pair<std::string, std::string>> changes{
        {"sensor", "[1]"},
        {"voltage", "[7]"},
        {"cogging", "[1]"},
        {"sensor_weight", "0.2"},
        {"voltage_weight", "3.1e4"},
        {"cogging_weight", "1.1e6"},
        {"cogging_voltage_weight", "2.1e4"},
        {"slope_weight", "2e9"},
        {"weight_speed_e_radps", "301.0"},
        {"leak_1ps", "0.3"}};
    for (const auto &[key, value] : changes) {
        digests.insert(
            sdre::drive_digest(read(harmonic_text().set("harmonics", key, value).str())));
    }
    digests.insert(sdre::drive_digest(read(harmonic_text().set("motor", "slots", "30").str())));
    digests.insert(sdre::drive_digest(read(encoder_text().str())));
    EXPECT_EQ(digests.size(), changes.size() + 3);
}

// -- boards --

namespace {

const std::string shipped_boards_dir = SDRE_SOURCE_DIR "/firmware/config/boards";

std::string board_text()
{
    return support::read_file(shipped_boards_dir + "/board_390w.toml");
}

/// The line of a key with another value; "" takes the line away.
std::string with_line(const std::string &text, const std::string &key, const std::string &value)
{
    const std::size_t at  = text.find("\n" + key + " ") + 1;
    const std::size_t end = text.find('\n', at) + 1;
    return text.substr(0, at) + (value.empty() ? "" : key + " = " + value + "\n") +
           text.substr(end);
}

/// The complaint about a board file, beside the drive file; without the directory.
std::string board_complaint(const std::string &board)
{
    const TempDir dir;
    dir.write("own.toml", board);
    const auto file = dir.write(
        "drive.toml", DriveText().add_section("board").set("board", "name", "\"own\"").str());
    try {
        sdre::read_drive_file(file);
    } catch (const sdre::InputError &error) {
        const std::string what  = error.what();
        const std::string where = (dir / "own.toml").string() + ": ";
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        EXPECT_EQ(what.rfind(where, 0), 0U) << what;
        return what.substr(where.size());
    }
    return "accepted";
}

const std::string chopper_keys =
    "chopper_on_V = 385.0\nchopper_off_V = 375.0\nchopper_resistance_Ohm = 100.0\n"
    "chopper_power_W = 50.0\nchopper_time_constant_s = 20.0\n";

std::string own_text()
{
    return with_line(board_text(), "name", "\"own\"");
}

std::string fact_name(int fact)
{
    return board_field_name(static_cast<std::uint16_t>(fact + 1));
}

DriveText on_board()
{
    return DriveText().add_section("board").set("board", "name", "\"board_390w\"");
}

} // namespace

TEST(DriveFile, ABoardGivesWhatIsItsOwn)
{
    const sdre::Drive drive = read(on_board().set("motor", "max_current_A", "2.0").str());
    ASSERT_TRUE(drive.board.file);
    const sdre::BoardFile &board = *drive.board.file;
    EXPECT_EQ(board.name, "board_390w");
    EXPECT_EQ(drive.current_sensors.range_A, 10.0);
    EXPECT_EQ(drive.board.dc_link_range_V, 450.0);
    EXPECT_EQ(drive.board.inverter_current_A, 5.0);
    EXPECT_FALSE(read(DriveText().str()).board.file);
    EXPECT_EQ(read(DriveText().set("motor", "max_current_A", "2.0").str()).current_sensors.range_A,
              5.0); // for simulations
}

// Every key that a board owns too.
TEST(DriveFile, AKeyThatRepeatsTheBoardAgreesWithIt)
{
    const std::vector<std::tuple<std::string, std::string, board_fact_t>> keys{
        {"current_sensors", "range_A", BOARD_FACT_CURRENT_RANGE_A},
        {"current_sensors", "count", BOARD_FACT_CURRENT_SENSORS},
        {"board", "dc_link_range_V", BOARD_FACT_DC_LINK_RANGE_V},
        {"board", "ntc_resistance_Ohm", BOARD_FACT_NTC_RESISTANCE_Ohm},
        {"board", "ntc_beta_K", BOARD_FACT_NTC_BETA_K},
        {"board", "ntc_divider_Ohm", BOARD_FACT_NTC_DIVIDER_Ohm},
        {"board", "temperature_limit_degC", BOARD_FACT_TEMPERATURE_LIMIT_degC},
        {"board", "temperature_trip_degC", BOARD_FACT_TEMPERATURE_TRIP_degC},
        {"board", "inverter_current_A", BOARD_FACT_INVERTER_CURRENT_A},
        {"board", "inverter_time_constant_s", BOARD_FACT_INVERTER_TIME_CONSTANT_s},
        {"board", "precharge_s", BOARD_FACT_PRECHARGE_s},
        {"board", "duty_max", BOARD_FACT_DUTY_MAX},
        {"board", "pulse_min_s", BOARD_FACT_PULSE_MIN_s}};
    const sdre::BoardFile board = sdre::read_board_file(shipped_boards_dir + "/board_390w.toml");
    for (const auto &[section, key, fact] : keys) {
        const double own   = board[fact];
        const double other = fact == BOARD_FACT_PULSE_MIN_s ? 1e-6
                             : fact == BOARD_FACT_DUTY_MAX || fact == BOARD_FACT_PRECHARGE_s
                                 ? 0.5
                                 : 1.01 * own;
        const auto   with  = [&](double value) {
            DriveText text = on_board();
            if (section != "board") {
                text.add_section(section);
            }
            return text.set(section, key, fmt::format("{:.17g}", value));
        };
        EXPECT_EQ(complaint(with(own)), "accepted") << key;
        expect_complaint(with(other), {fmt::format("[{}] {} = ", section, key), "board_390w",
                                       fmt::format("has {:g}", own)});
    }
}

TEST(DriveFile, HasTwoCurrentSensorsOrThree)
{
    const auto with = [](const char *count) {
        DriveText text;
        return text.add_section("current_sensors").set("current_sensors", "count", count);
    };
    EXPECT_EQ(read(DriveText().str()).current_sensors.count, 2);
    EXPECT_EQ(read(with("3").str()).current_sensors.count, 3);
    for (const char *count : {"1", "4", "2.5"}) {
        expect_complaint(with(count), {"[current_sensors] count = "});
    }
}

TEST(DriveFile, LimitsBeyondTheBoardAreRefused)
{
    expect_complaint(on_board().set("inverter", "dead_time_s", "5e-8"),
                     {"[inverter] dead_time_s = 5e-08 is not allowed", "dead_time_min_s = 3e-06",
                      "\"board_390w\""});
    expect_complaint(on_board().set("motor", "max_current_A", "5.01"),
                     {"[motor] max_current_A = 5.01", "rated_current_A = 5"});
    expect_complaint(on_board().set("inverter", "dc_link_V", "451.0"),
                     {"[inverter] dc_link_V = 451", "rated_dc_link_V = 450"});
    expect_complaint(on_board().set("encoder", "lines", "15000"),
                     {"[encoder] lines = 15000 is not allowed", "edges a second at the trip speed",
                      "encoder_edges_Hz = 6.25e+06", "\"board_390w\""});
    expect_complaint(on_board().set("board", "name", "\"none\""),
                     {"[board] name = \"none\"", "b_g431b_esc1, board_200w, board_390w"});
    expect_complaint(on_board().set("board", "name", "\"../board_390w\""), {"[board] name must"});
}

// 295 V: the limit of regeneration ends at 368.75, the trip is at 398.25.
TEST(DriveFile, ChopperLevelsHaveToSuitTheDcLink)
{
    const TempDir dir;
    const auto    file      = dir.write("d.toml", on_board().str());
    const auto    complaint = [&](const char *key, const char *value) {
        dir.write("board_390w.toml", with_line(board_text() + chopper_keys, key, value));
        try {
            sdre::read_drive_file(file);
        } catch (const sdre::InputError &e) {
            return std::string(e.what());
        }
        return std::string("accepted");
    };
    EXPECT_EQ(complaint("chopper_on_V", "385.0"), "accepted");
    EXPECT_EQ(complaint("chopper_off_V", "324.6"), "accepted");
    for (const auto &[key, value, bound] : std::vector<std::array<const char *, 3>>{
             {"chopper_on_V", "398.3", "below 398.25, the trip"},
             {"chopper_off_V", "324.5", "above 324.5, what a supply may reach"}}) {
        const std::string what = complaint(key, value);
        EXPECT_NE(what.find(std::string(key) + " = " + value), std::string::npos) << what;
        EXPECT_NE(what.find("board_390w.toml"), std::string::npos) << what;
        EXPECT_NE(what.find(bound), std::string::npos) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
    dir.write("board_390w.toml",
              with_line(with_line(board_text() + chopper_keys, "chopper_off_V", "360.0"),
                        "chopper_on_V", "368.0"));
    EXPECT_THROW(sdre::read_drive_file(file), sdre::InputError);
}

TEST(BoardFile, EveryFactIsRequiredAndHasItsRange)
{
    EXPECT_EQ(board_complaint(own_text()), "accepted");
    const std::string text = own_text() + chopper_keys;
    EXPECT_EQ(board_complaint(text), "accepted");
    for (int fact = 0; fact < BOARD_FACT_COUNT; fact++) {
        const std::string key = fact_name(fact);
        if (fact != BOARD_FACT_CURRENT_SENSORS) {
            EXPECT_EQ(board_complaint(with_line(text, key, "")).rfind(key + " is missing", 0), 0U)
                << key;
        }
        for (const char *value : {"-1e3", "1e12", "nan", "inf", "\"1\"", "true"}) {
            EXPECT_EQ(board_complaint(with_line(text, key, value)).rfind(key + " ", 0), 0U)
                << key << value;
        }
    }
    EXPECT_NE(board_complaint(own_text() + "colour = 1\n").find("colour"), std::string::npos);
    EXPECT_EQ(board_complaint(board_text()).rfind("name = \"board_390w\"", 0), 0U);
    EXPECT_EQ(board_complaint(with_line(own_text(), "schema", "2")).rfind("schema = 2", 0), 0U);
}

TEST(BoardFile, NamesAProcessorThatThereIs)
{
    EXPECT_EQ(board_complaint(own_text() + "processor = \"f28335\"\n"), "accepted");
    const std::string what = board_complaint(own_text() + "processor = \"f28336\"\n");
    EXPECT_EQ(
        what.rfind("processor = \"f28336\" is not allowed: must be one of f28335, stm32g431", 0),
        0U)
        << what;
}

TEST(BoardFile, FactsOfItsProcessorAreThose)
{
    const std::string other = own_text() + "processor = \"stm32g431\"\n";
    EXPECT_EQ(board_complaint(other).rfind("pwm_clock_Hz = 7.5e+07 is not allowed", 0), 0U)
        << board_complaint(other);
    const std::string clocked = with_line(other, "pwm_clock_Hz", "170e6");
    EXPECT_EQ(board_complaint(clocked), "accepted");
    EXPECT_EQ(board_complaint(clocked + chopper_keys),
              "chopper_on_V is not allowed: stm32g431 has no pin for a brake chopper");
}

TEST(BoardFile, OffsetAndTimeToSettleMayBeLeftOut)
{
    const auto facts = [](const std::string &more) {
        const TempDir dir;
        return sdre::read_board_file(dir.write("own.toml", own_text() + more));
    };
    EXPECT_EQ(facts("").offset_max_cnt, 100.0);
    EXPECT_EQ(facts("").current_settle_s, 0.0);
    EXPECT_EQ(facts("current_offset_max_cnt = 600\n").offset_max_cnt, 600.0);
    EXPECT_EQ(facts("current_settle_s = 1.3e-6\n").current_settle_s, 1.3e-6);
    for (const char *line : {"current_offset_max_cnt = 0", "current_offset_max_cnt = 1001",
                             "current_settle_s = -1e-9", "current_settle_s = 2.1e-5"}) {
        const std::string text = line;
        EXPECT_EQ(
            board_complaint(own_text() + text + "\n").rfind(text.substr(0, text.find(' ')), 0), 0U)
            << line;
    }
}

TEST(DriveFile, UpdatesInAPeriodAreThoseOfTheProcessor)
{
    std::string text =
        support::read_file(SDRE_SOURCE_DIR "/firmware/config/drives/m2310p_24v.toml");
    EXPECT_EQ(read(text).inverter.updates_per_period, 1);
    text.replace(text.find("updates_per_period = 1"), 22, "updates_per_period = 2");
    try {
        read(text);
        ADD_FAILURE();
    } catch (const sdre::InputError &e) {
        EXPECT_NE(std::string(e.what()).find("[inverter] updates_per_period = 2 is not allowed: "
                                             "must be 1 on the processor stm32g431"),
                  std::string::npos)
            << e.what();
    }
}

TEST(BoardFile, RatingsAreInOrder)
{
    for (const auto &[key, value, bound] :
         std::vector<std::tuple<std::string, std::string, std::string>>{
             {"rated_current_A", "9.0", "trip_current_A = 9"},
             {"trip_current_A", "10.1", "current_range_A = 10"},
             {"rated_dc_link_V", "450.1", "dc_link_range_V = 450"},
             {"chopper_off_V", "385.0", "chopper_on_V = 385"},
             {"chopper_on_V", "450.0", "rated_dc_link_V = 450"},
             {"temperature_limit_degC", "90.0", "temperature_trip_degC = 90"}}) {
        const std::string what = board_complaint(with_line(own_text() + chopper_keys, key, value));
        EXPECT_EQ(what.rfind(key + " = ", 0), 0U) << what;
        EXPECT_NE(what.find(bound), std::string::npos) << what;
    }
    EXPECT_EQ(board_complaint(with_line(own_text(), "trip_current_A", "10.0")), "accepted");
}

// Beside the drive file first, then in ../boards, then the shipped ones, which are compiled in.
TEST(BoardFile, IsFoundBesideTheDriveFirst)
{
    const TempDir     dir;
    const std::string drive = on_board().str();
    std::filesystem::create_directories(dir / "drives");
    std::filesystem::create_directories(dir / "boards");
    const auto file    = dir.write("drives/d.toml", drive);
    const auto trip_of = [&] {
        return (*sdre::read_drive_file(file).board.file)[BOARD_FACT_TRIP_CURRENT_A];
    };
    EXPECT_EQ(trip_of(), 9.0);
    EXPECT_EQ((*sdre::read_drive_text(drive, "somewhere").board.file)[BOARD_FACT_TRIP_CURRENT_A],
              9.0);
    dir.write("boards/board_390w.toml", with_line(board_text(), "trip_current_A", "8.0"));
    EXPECT_EQ(trip_of(), 8.0);
    dir.write("drives/board_390w.toml", with_line(board_text(), "trip_current_A", "7.0"));
    EXPECT_EQ(trip_of(), 7.0);
    EXPECT_EQ(
        (*sdre::read_drive_text(drive, "d", file.string()).board.file)[BOARD_FACT_TRIP_CURRENT_A],
        7.0);
}
