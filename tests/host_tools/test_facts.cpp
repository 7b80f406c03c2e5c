// SPDX-License-Identifier: MIT
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>
#include <unistd.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "common/toml_reader.hpp"
#include "design/design.hpp"
#include "facts/commissioned_text.hpp"
#include "facts/cross_checks.hpp"
#include "facts/found_file.hpp"
#include "facts/new_drive_text.hpp"

namespace {

const double pi = std::acos(-1.0);

std::string sheet_path(const std::string &name)
{
    return std::string(SDRE_TEST_DATA_DIR) + "/facts/" + name + ".toml";
}

struct Read {
    sdre::Machine  machine;
    sdre::Findings findings;
};

/// A sheet with some facts replaced or added, and some left out.
Read read(const std::string &sheet, const std::string &more = "",
          const std::vector<std::string> &without = {})
{
    toml::table table = sdre::parse_toml_file(sheet_path(sheet));
    for (const std::string &key : without) {
        table.erase(key);
    }
    const toml::table added = toml::parse(more);
    for (const auto &[key, value] : added) {
        table.insert_or_assign(key.str(), *value.value<double>());
    }
    Read              r;
    const sdre::Facts facts = sdre::parse_facts(sheet, table);
    r.machine               = sdre::machine_of(facts, sheet, r.findings);
    sdre::check_ratings(facts, r.machine, r.findings);
    sdre::check_machine(r.machine, r.findings);
    return r;
}

std::string all(const std::vector<std::string> &lines)
{
    std::string s;
    for (const std::string &line : lines) {
        s += line + "\n";
    }
    return s;
}

double value_of(const std::string &key, double value)
{
    return sdre::parse_fact("here", key, value).si;
}

std::string refusal(const std::string &key, double value = 1.0)
{
    try {
        sdre::parse_fact("here", key, value);
    } catch (const sdre::InputError &e) {
        return e.what();
    }
    return "";
}

} // namespace

// Computed by hand from the definitions of the units.
TEST(Facts, UnitsInEveryUsualSpelling)
{
    const double rpm = pi / 30.0;
    EXPECT_DOUBLE_EQ(value_of("line_to_line_resistance_mOhm", 18), 0.018);
    EXPECT_DOUBLE_EQ(value_of("phase_inductance_uH", 30), 30e-6);
    EXPECT_DOUBLE_EQ(value_of("Ld_mH", 0.37), 0.37e-3);
    EXPECT_DOUBLE_EQ(value_of("inertia_kgcm2", 0.83), 0.83e-4);
    EXPECT_DOUBLE_EQ(value_of("rotor_inertia_g_cm2", 24), 24e-7);
    EXPECT_NEAR(value_of("moment_of_inertia_oz_in_s2", 1), 7.0615518e-3, 1e-9);
    EXPECT_NEAR(value_of("inertia_lb_in2", 1), 2.926397e-4, 1e-9);
    EXPECT_DOUBLE_EQ(value_of("rated_speed_r_min", 3000), 3000 * rpm);
    EXPECT_DOUBLE_EQ(value_of("nominal_speed_krpm", 3), 3000 * rpm);
    EXPECT_DOUBLE_EQ(value_of("speed_max_rad_per_s", 100), 100);
    EXPECT_NEAR(value_of("rated_torque_ozin", 100), 0.70615518, 1e-7);
    EXPECT_NEAR(value_of("continuous_torque_lb_ft", 1), 1.3558179, 1e-6);
    EXPECT_DOUBLE_EQ(value_of("rated_torque_Ncm", 20), 0.2);
    EXPECT_NEAR(value_of("rated_power_hp", 1), 745.69987, 1e-4);
    EXPECT_DOUBLE_EQ(value_of("kv_rpm_per_V", 330), 330 * rpm);
    EXPECT_NEAR(value_of("ke_line_to_line_rms_V_per_krpm", 31.6), 31.6 / (1000 * rpm), 1e-12);
    EXPECT_DOUBLE_EQ(value_of("torque_constant_mNm_per_A_rms", 70), 0.070);
    EXPECT_DOUBLE_EQ(value_of("pwm_kHz", 8), 8000);
    EXPECT_DOUBLE_EQ(value_of("dead_time_ns", 500), 5e-7);
    EXPECT_DOUBLE_EQ(value_of("viscous_friction_mNm_per_krpm", 1), 1e-3 / (1000 * rpm));
}

TEST(Facts, HowAValueIsMeant)
{
    const sdre::Fact a = sdre::parse_fact("here", "rated_current_A_rms", 3);
    EXPECT_EQ(a.amplitude, sdre::Amplitude::rms);
    EXPECT_NEAR(sdre::peak_A(a), 4.2426407, 1e-6);
    const sdre::Fact b = sdre::parse_fact("here", "peak_current_Arms", 3);
    EXPECT_EQ(b.quantity, "max_current");
    EXPECT_EQ(b.amplitude, sdre::Amplitude::rms);
    const sdre::Fact c = sdre::parse_fact("here", "terminal_resistance_Ohm", 3);
    EXPECT_EQ(c.connection, sdre::Connection::line_to_line);
    EXPECT_EQ(sdre::parse_fact("here", "current_limit_A_peak", 3).quantity, "max_current");
}

TEST(Facts, WhatIsNotUnderstoodIsRefused)
{
    EXPECT_NE(refusal("rated_torque_furlongs").find("rated_torque ends with one of nm, mnm"),
              std::string::npos);
    EXPECT_NE(refusal("colour").find("colour is not understood"), std::string::npos);
    EXPECT_NE(refusal("resistance").find("is not understood"), std::string::npos);
    EXPECT_NE(refusal("rated_torque_Nm", -1).find("must be above 0"), std::string::npos);
    EXPECT_NE(refusal("pole_pairs", 1.5).find("whole number"), std::string::npos);
    EXPECT_NE(refusal("rated_torque_Nm", NAN).find("must be"), std::string::npos);
}

// Flux from each constant of the same made-up motor: 4 pole pairs, 0.0616 Wb.
TEST(Facts, MagnetFromEveryConstant)
{
    const double flux = 0.0616;
    const double pp   = 4;
    const auto   of   = [&](const std::string &key, double value) {
        return sdre::flux_of(sdre::parse_fact("here", key, value), pp);
    };
    const double krpm = 1000 * pi / 30;
    EXPECT_NEAR(of("ke_line_to_line_rms_V_per_krpm", flux * pp * krpm * std::sqrt(1.5)), flux,
                1e-9);
    EXPECT_NEAR(of("ke_phase_peak_V_per_radps", flux * pp), flux, 1e-9);
    EXPECT_NEAR(of("kt_Nm_per_A_peak", 1.5 * pp * flux), flux, 1e-9);
    EXPECT_NEAR(of("kt_Nm_per_A_rms", 1.5 * pp * flux * std::sqrt(2.0)), flux, 1e-9);
    EXPECT_NEAR(of("kv_rpm_per_V", 30 / pi / (flux * pp * std::sqrt(3.0))), flux, 1e-9);
    EXPECT_NEAR(of("pm_flux_peak_mWb", 61.6), flux, 1e-9);
}

TEST(Facts, SheetsInSiUnits)
{
    const sdre::Machine s = read("servo_600w_surface").machine;
    EXPECT_EQ(s.pole_pairs.si, 4);
    EXPECT_DOUBLE_EQ(s.resistance_Ohm.si, 1.86);
    EXPECT_DOUBLE_EQ(s.ld_H.si, 3.715e-3);
    EXPECT_DOUBLE_EQ(s.lq_H.si, 3.715e-3);
    EXPECT_NEAR(s.flux_Wb.si, 31.6 * std::sqrt(2.0 / 3.0) / (4 * 1000 * pi / 30), 1e-12);
    EXPECT_DOUBLE_EQ(s.inertia_kgm2.si, 8.3e-5);
    EXPECT_NEAR(s.rated_speed_radps.si, 120 * pi, 1e-9);
    const sdre::Machine m = read("spm_1500w").machine;
    EXPECT_NEAR(m.max_current_A.si, 9 * std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(m.flux_Wb.si, 0.189, 2e-3);
    EXPECT_DOUBLE_EQ(m.dead_time_s.si, 1.5e-6);
    EXPECT_EQ(read("servo_60w").machine.lines.si, 1000);
}

TEST(Facts, GoodSheetsHaveNoContradiction)
{
    for (const char *name : {"servo_2k2", "servo_600w_surface", "outrunner_24v", "ev_100kw",
                             "syrm_6k7", "pump_256", "spm_1500w", "servo_60w", "torque_motor"}) {
        EXPECT_EQ(all(read(name).findings.contradictions), "") << name;
    }
}

struct Slip {
    const char              *sheet;
    const char              *more;
    std::vector<std::string> without;
    const char              *found; ///< a piece of one contradiction
};

/// The classic mistakes, each made in a sheet that was right; the line names both values.
TEST(Facts, ClassicMistakesAreFound)
{
    const std::vector<Slip> slips{
        {"servo_600w_surface", "pole_pairs = 8", {}, "poles = 8 and pole_pairs = 8 disagree"},
        {"servo_2k2", "pole_pairs = 6", {}, "rated_speed_rpm = 1500 with pole_pairs = 6"},
        {"spm_1500w",
         "torque_constant_Nm_per_A_peak = 1.6",
         {"torque_constant_Nm_per_Arms"},
         "1.41: rms and peak?"},
        {"spm_1500w", "rated_current_A_peak = 3.0", {"rated_current_A_rms"}, "rms and peak?"},
        {"spm_1500w",
         "back_emf_V_phase_rms_per_krpm = 97",
         {"back_emf_Vrms_line_to_line_per_krpm"},
         "of a phase and line to line?"},
        {"spm_1500w", "rated_speed_rad_per_s = 3000", {"rated_speed_r_min"}, "r/min and rad/s?"},
        {"servo_600w_surface", "rated_speed_rpm = 377", {}, "needs"},
        {"servo_60w", "rotor_inertia_kgm2 = 24", {"rotor_inertia_gcm2"}, "gcm2, kgcm2 and kgm2"},
        {"servo_600w_surface",
         "inertia_kgm2 = 0.83",
         {"inertia_kgcm2"},
         "takes 156 s to 3600 r/min"},
        {"servo_2k2",
         "line_to_line_resistance_Ohm = 3.6",
         {},
         "line_to_line_resistance_Ohm = 3.6 and phase_resistance_Ohm = 3.6 disagree"},
        {"spm_1500w", "rated_power_kW = 15", {}, "rated_power_kW = 15 against 1499 W"},
        {"servo_2k2", "rated_torque_Nm = 70", {}, "against"},
        {"servo_2k2", "electrical_time_constant_ms = 50", {}, "electrical_time_constant_ms = 50"},
        {"servo_2k2", "rated_current_A_peak = 12", {}, "is above max_current_peak_A = 9.12"},
        {"ev_100kw", "max_speed_rpm = 2000", {}, "is below base_speed_rpm = 3000"},
        {"outrunner_24v", "phase_inductance_nH = 30", {"phase_inductance_uH"}, "not understood"},
        {"servo_2k2", "phase_resistance_mOhm = 3.6", {"phase_resistance_Ohm"}, "mOhm and Ohm?"},
        {"servo_2k2", "encoder_lines = 16", {}, "a count is 0.29 rad electrical"},
        {"servo_2k2", "dead_time_us = 30", {}, "more than a tenth of the period"}};
    for (const Slip &slip : slips) {
        std::string said;
        try {
            said = all(read(slip.sheet, slip.more, slip.without).findings.contradictions);
        } catch (const sdre::InputError &e) {
            said = e.what();
        }
        EXPECT_NE(said.find(slip.found), std::string::npos)
            << slip.sheet << " with " << slip.more << ": " << said;
    }
}

TEST(Facts, WhatIsAssumedIsSaid)
{
    // 1.5 * 3 * 0.545 = 2.45 N m per ampere of peak, 3.47 of rms.
    const Read rms = read("servo_2k2", "kt_Nm_per_A = 3.47", {"pm_flux_peak_Vs"});
    EXPECT_NEAR(rms.machine.flux_Wb.si, 0.545, 1e-3);
    EXPECT_NE(all(rms.findings.notes).find("kt_Nm_per_A = 3.47: taken as rms"), std::string::npos);
    const Read peak = read("servo_2k2", "kt_Nm_per_A = 2.45");
    EXPECT_EQ(all(peak.findings.contradictions), "");
    EXPECT_NE(all(peak.findings.notes).find("taken as peak, as pm_flux_peak_Vs = 0.545 says"),
              std::string::npos);
    const Read bare = read("servo_2k2", "resistance_Ohm = 3.6", {"phase_resistance_Ohm"});
    EXPECT_NE(all(bare.findings.notes).find("taken as of one phase"), std::string::npos);
}

// Averages over 60 degrees of commutation, by hand: the dc current I flows through two phases while the line's EMF is at
// its peak. The sine of the same heat has the peak 2 / sqrt 3 I, and 1.5 p flux times it is the same torque.
TEST(Facts, SheetsOfBlockCommutationAreConverted)
{
    const double                   pairs = 4.0;
    const double                   flux  = 0.0616;
    const double                   kt    = std::sqrt(3.0) * pairs * flux;
    const double                   kv    = 30.0 / pi / kt;
    const std::vector<std::string> without{"ke_line_to_line_rms_V_per_krpm"};
    const std::string both = fmt::format("kt_Nm_per_A = {:.3g}\nkv_rpm_per_V = {:.3g}\n", kt, kv);
    const Read        r    = read("servo_600w_surface", both + "rated_current_A = 4.7", without);
    EXPECT_EQ(all(r.findings.contradictions), "");
    EXPECT_NEAR(r.machine.flux_Wb.si, flux, 0.01 * flux);
    EXPECT_NE(all(r.findings.notes).find("of block commutation, since kt x kv = 1"),
              std::string::npos);
    EXPECT_NE(all(r.findings.notes).find("5.427 A peak of a sine"), std::string::npos);
    const double by_block_Nm = kt * 4.7;
    EXPECT_NEAR(1.5 * pairs * r.machine.flux_Wb.si * 5.427, by_block_Nm, 0.01 * by_block_Nm);
    // A constant that says what it is stays what it says.
    const std::string peak =
        fmt::format("kt_Nm_per_A_peak = {:.4g}\nkv_rpm_per_V = {:.3g}\n", kt, kv);
    EXPECT_NE(all(read("servo_600w_surface", peak, without).findings.contradictions), "");
    // The torque follows from the rated current; the largest current bounds it.
    const Read derived = read("servo_600w_surface", both + "rated_current_A = 11.0",
                              {"ke_line_to_line_rms_V_per_krpm", "rated_torque_Nm"});
    EXPECT_EQ(all(derived.findings.contradictions), "");
    EXPECT_NEAR(derived.machine.rated_torque_Nm.si, 1.5 * pairs * flux * 12.0, 0.02);
}

TEST(Facts, EncodersThatTheDriveCannotReadAreRefused)
{
    const auto said = [](const std::string &more, bool lines) {
        try {
            read("servo_2k2", more,
                 lines ? std::vector<std::string>{} : std::vector<std::string>{"encoder_lines"});
        } catch (const sdre::InputError &e) {
            return std::string(e.what());
        }
        return std::string();
    };
    EXPECT_NE(said("encoder_bits = 14", false).find("is of an absolute encoder"),
              std::string::npos);
    EXPECT_EQ(said("encoder_bits = 14", true), "");
    EXPECT_NE(
        said("encoder_cpr = 4000", false).find("write encoder_lines = 4000 or encoder_counts"),
        std::string::npos);
    EXPECT_NE(said("", false).find("encoder_lines is missing"), std::string::npos);
}

TEST(Facts, ATextThatReadsAndIsCertified)
{
    for (const char *name : {"outrunner_24v", "torque_motor"}) {
        const std::string text  = sdre::new_drive_text(read(name).machine);
        const sdre::Drive drive = sdre::read_drive_text(text, name);
        EXPECT_TRUE(sdre::design_drive(drive).certificate.passed()) << text;
        EXPECT_NE(text.find("# encoder_lines = "), std::string::npos);
    }
}

// -- what a commissioning found --

namespace {

const char *const found_text = R"(direction = -1
pole_pairs = 3
counts_per_turn = 8000
reluctance = false
stator_resistance_Ohm = { value = 2.51, uncertainty = 0.01 }
inverter_loss_V = { value = 1.2, uncertainty = 0.1 }
d_axis_inductance_H = { value = 0.0097, uncertainty = 1e-4 }
q_axis_inductance_H = { value = 0.0145, uncertainty = 1e-4 }
pm_flux_Wb = { value = 0.12, uncertainty = 1e-3 }
inertia_kgm2 = { value = 3.3e-4, uncertainty = 1e-5 }
viscous_friction_Nms = { value = 1e-4, uncertainty = 1e-5 }
coulomb_friction_Nm = { value = 0.01, uncertainty = 1e-3 }
d_axis_angle_e_rad = { value = 1.0, uncertainty = 0.01 }
)";

sdre::Found found_of(const std::string &text)
{
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / fmt::format("sdre_found_{}.toml", getpid());
    sdre::write_files({{file, text}});
    try {
        const sdre::Found found = sdre::read_found_file(file);
        std::filesystem::remove(file);
        return found;
    } catch (...) {
        std::filesystem::remove(file);
        throw;
    }
}

std::string with(const std::string &text, const std::string &from, const std::string &to)
{
    std::string out = text;
    return out.replace(out.find(from), from.size(), to);
}

} // namespace

TEST(Found, GoesIntoTheDriveFileAndLeavesTheRest)
{
    const std::string drive =
        sdre::read_text_file(SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml");
    const sdre::Drive before = sdre::read_drive_text(drive, "before");
    const sdre::Drive after  = sdre::read_drive_text(
         sdre::commissioned_text(drive, found_of(found_text), 4.0, "here"), "after");

    EXPECT_EQ(after.motor.pole_pairs, 3);
    EXPECT_EQ(after.encoder.lines, 2000);
    EXPECT_NEAR(after.motor.stator_resistance_Ohm, 2.51, 1e-6);
    EXPECT_NEAR(after.motor.d_axis_inductance_H, 0.0097, 1e-8);
    EXPECT_NEAR(after.motor.q_axis_inductance_H, 0.0145, 1e-8);
    EXPECT_NEAR(after.motor.pm_flux_Wb, 0.12, 1e-7);
    EXPECT_NEAR(after.motor.inertia_kgm2, 3.3e-4, 1e-9);
    EXPECT_EQ(after.motor.max_current_A, before.motor.max_current_A);
    EXPECT_EQ(after.nosc.Q, before.nosc.Q);
}

namespace {

const std::string elastic_text = std::string(found_text) + R"(coupling = "elastic"
searched_Hz = 600.0
resonance_Hz = { value = 219.7, uncertainty = 0.1 }
damping = { value = 0.031, uncertainty = 0.001 }
load_inertia_share = { value = 0.42, uncertainty = 0.01 }
)";

std::string drive_with(const std::string &found)
{
    const std::string drive =
        sdre::read_text_file(SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w_elastic.toml");
    return sdre::commissioned_text(drive, found_of(found), 4.0, "here");
}

} // namespace

TEST(Found, AResonanceReplacesTheCouplingOfTheDriveFile)
{
    const std::string     text = drive_with(elastic_text);
    const sdre::Mechanics m    = sdre::read_drive_text(text, "after").mechanics;
    EXPECT_EQ(m.coupling, sdre::Coupling::known);
    EXPECT_NEAR(m.resonance_Hz, 219.7, 1e-4);
    EXPECT_NEAR(m.least_damping, 0.031, 1e-7);
    EXPECT_NEAR(m.load_inertia_share, 0.42, 1e-6);
    EXPECT_EQ(text.find("[mechanics]"), text.rfind("[mechanics]")) << text;
    EXPECT_EQ(sdre::coupling_words(found_of(elastic_text).values),
              "elastic: resonance 219.7 Hz, damping ratio 0.031, 0.42 of the inertia behind the "
              "coupling");
}

TEST(Found, WithoutAResonanceTheWordsStandInTheDriveFile)
{
    const std::pair<const char *, const char *> all[] = {
        {"rigid", "rigid: no resonance found between 40 and 571 Hz"},
        {"below", "elastic: the resonance is below 40 Hz"},
        {"above", "elastic: the resonance is above 571 Hz"}};
    for (const auto &[name, words] : all) {
        const std::string text =
            drive_with(fmt::format("{}coupling = \"{}\"\nsearched_Hz = 571.0\n", found_text, name));
        EXPECT_EQ(sdre::read_drive_text(text, "after").mechanics.coupling, sdre::Coupling::rigid);
        EXPECT_NE(text.find(words), std::string::npos) << text;
    }
    EXPECT_EQ(sdre::read_drive_text(drive_with(found_text), "after").mechanics.coupling,
              sdre::Coupling::elastic)
        << "nobody has searched: the file keeps what it says";
}

TEST(Found, ACouplingIsChecked)
{
    const std::string rigid = std::string(found_text) + "coupling = \"rigid\"\nsearched_Hz = 600\n";
    EXPECT_EQ(found_of(rigid).values.coupling, COMMISSION_COUPLING_RIGID);
    EXPECT_THROW(found_of(with(rigid, "rigid", "soft")), sdre::InputError);
    EXPECT_THROW(found_of(with(rigid, "searched_Hz = 600\n", "")), sdre::InputError);
    EXPECT_THROW(found_of(with(rigid, "rigid", "elastic")), sdre::InputError);
    EXPECT_THROW(found_of(with(elastic_text, "value = 0.031", "value = 0.9")), sdre::InputError);
    EXPECT_THROW(found_of(with(elastic_text, "value = 219.7", "value = 0.1")), sdre::InputError);
    EXPECT_THROW(found_of(with(elastic_text, "value = 0.42", "value = 1.0")), sdre::InputError);
}

namespace {

const char *const inductances_text = R"([inductances]
step_A = 0.7
bias_A = 1.1
ld_positive_id_H = [0.0096, 0.0095, 0.0094, 0.0093]
ld_negative_id_H = [0.0097, 0.0098, 0.0099, 0.0100]
lq_beside_0_H = [0.0145, 0.0140, 0.0130, 0.0115]
lq_beside_1_H = [0.0148, 0.0143, 0.0134, 0.0120]
lq_beside_2_H = [0.0150, 0.0146, 0.0138, 0.0125]
)";

} // namespace

TEST(Found, InductancesThatChangeBecomeTheMapOfTheDriveFile)
{
    const std::string all  = std::string(found_text) + inductances_text;
    const std::string text = drive_with(all);
    const auto        map  = sdre::read_drive_text(text, "after").saturation;
    ASSERT_TRUE(map != nullptr) << text;
    EXPECT_NEAR(map->magnet_Wb(), 0.12, 1e-5);
    // Incremental inductances in the middle of bins. Beside 2.2 A the vector of 2.8 A has less q current.
    const double narrow = std::sqrt(2.8 * 2.8 - 2.2 * 2.2) / 4.0;
    EXPECT_NEAR(map->at(0.0, 1.75).qq_H, 0.0130, 0.02 * 0.0130);
    EXPECT_NEAR(map->at(-2.2, 2.5 * narrow).qq_H, 0.0138, 0.02 * 0.0138);
    EXPECT_NEAR(map->at(-1.75, 0.0).dd_H, 0.0099, 0.02 * 0.0099);
    EXPECT_EQ(sdre::iron_words(found_of(all), 4.0),
              "inductances change by 30 % with the current: the map is in [saturation]; law "
              "noc_iron has it in the firmware");
    EXPECT_EQ(drive_with(all), text) << "the same bytes";
}

TEST(Found, AMapIsReplacedAndNeedsEnoughCurrent)
{
    const std::string drive =
        sdre::read_text_file(SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w_iron.toml");
    const sdre::Found found = found_of(std::string(found_text) + inductances_text);
    const std::string text  = sdre::commissioned_text(drive, found, 4.0, "here");
    EXPECT_EQ(text.find("\n[saturation]"), text.rfind("\n[saturation]")) << text;
    EXPECT_NEAR(sdre::read_drive_text(text, "after").saturation->at(0.0, 1.75).qq_H, 0.0130, 3e-4);

    EXPECT_EQ(sdre::commissioned_text(drive_with(found_text), found, 6.0, "here").find("\n[satur"),
              std::string::npos)
        << "too little current for the limit";
    EXPECT_NE(sdre::iron_words(found, 6.0).find("next: 1.23 times the bound"), std::string::npos)
        << sdre::iron_words(found, 6.0);
}

TEST(Found, InductancesThatHardlyChangeAreConstants)
{
    std::string all = std::string(found_text) + inductances_text;
    for (const char *row : {"[0.0145, 0.0140, 0.0130, 0.0115]", "[0.0148, 0.0143, 0.0134, 0.0120]",
                            "[0.0150, 0.0146, 0.0138, 0.0125]"}) {
        all = with(all, row, "[0.0145, 0.0146, 0.0144, 0.0145]");
    }
    EXPECT_EQ(drive_with(all).find("[saturation]"), std::string::npos);
    EXPECT_EQ(sdre::iron_words(found_of(all), 4.0),
              "inductances change by 8 % with the current: constants will do");
    EXPECT_EQ(sdre::iron_words(found_of(found_text), 4.0), "") << "not measured";
    EXPECT_THROW(found_of(with(all, "bias_A = 1.1\n", "")), sdre::InputError);
    EXPECT_THROW(found_of(with(all, "0.0093]", "0.0093, 0.0092]")), sdre::InputError);
    EXPECT_THROW(found_of(with(all, "0.0093", "-0.0093")), sdre::InputError);
}

TEST(Found, EveryKeyIsNeededAndChecked)
{
    std::istringstream lines(found_text);
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("reluctance", 0) != 0) { // false when it is not there
            EXPECT_THROW(found_of(with(found_text, line + "\n", "")), sdre::InputError) << line;
        }
    }
    EXPECT_THROW(found_of(with(found_text, "direction = -1", "direction = 0")), sdre::InputError);
    EXPECT_THROW(found_of(with(found_text, "value = 2.51", "value = -2.51")), sdre::InputError);
    EXPECT_THROW(found_of(with(found_text, "value = 2.51", "value = nan")), sdre::InputError);
    EXPECT_THROW(found_of(with(found_text, ", uncertainty = 0.01 }", " }")), sdre::InputError);
    EXPECT_THROW(found_of(std::string(found_text) + "more = 1\n"), sdre::InputError);
}
