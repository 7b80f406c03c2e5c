// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/board/board_constants.hpp"
#include "drive/core_types.hpp"
#include "drive/drive_file.hpp"
#include "drive/processor.hpp"
#include "drive/pwm_frequency.hpp"

using namespace sdre;

namespace {

const std::string source_dir = SDRE_SOURCE_DIR;
const std::string plain      = "ipmsm_390w_counts"; // law "noc" without positions
const Processor  &processor  = default_processor();

/// The background's longest pass takes 0.32 ms alone and may take 3 ms.
constexpr double background_share = 0.32 / 3.0;

Drive shipped(const std::string &name)
{
    return read_drive_file(source_dir + "/firmware/config/drives/" + name + ".toml");
}

/// A shipped drive with another frequency, read as its file would be.
Drive at(const std::string &name, double pwm_Hz, int updates)
{
    std::ifstream in(source_dir + "/firmware/config/drives/" + name + ".toml");
    std::string   text;
    for (std::string line; std::getline(in, line);) {
        if (line.rfind("updates_per_period", 0) == 0) {
            continue;
        }
        if (line.rfind("pwm_frequency_Hz", 0) == 0) {
            line =
                fmt::format("pwm_frequency_Hz = {:.17g}\nupdates_per_period = {}", pwm_Hz, updates);
        }
        text += line + "\n";
    }
    return read_drive_text(text, name);
}

std::string complaint(const std::string &name, double pwm_Hz, int updates)
{
    try {
        at(name, pwm_Hz, updates);
        return "";
    } catch (const InputError &e) {
        return e.what();
    }
}

/// Upper end of the whole period of a column of docs/budget.json; 0 where it has none.
double whole(const std::string &column)
{
    std::ifstream file(source_dir + "/docs/budget.json");
    std::string   all(std::istreambuf_iterator<char>(file), {});
    all                    = all.substr(all.find("\"whole_period\""));
    const std::string name = "\"" + column + "\": [";
    const std::size_t at   = all.find(name);
    return at < all.find('}') ? std::stod(all.substr(all.find(',', at + name.size()) + 1)) : 0.0;
}

double dearest(const std::string &column)
{
    return std::max(whole(column), whole(column + ", start"));
}

/// The encoder form's with one update, to a whole hertz below that of the shortest period.
double highest_Hz()
{
    return std::floor(counted_pwm_Hz(processor, pwm_full_cnt_range(shipped(plain)).least));
}

} // namespace

// 75 MHz / 16 kHz = 4687.5 and / 32 kHz = 2343.75: the nearest of both neighbours.
TEST(PwmFrequency, NearestCountIsTaken)
{
    const Inverter eight = at(plain, 8000.0, 1).inverter;
    EXPECT_DOUBLE_EQ(eight.pwm_frequency_Hz, 75e6 / (2 * 4688));
    EXPECT_EQ(eight.pwm_wanted_Hz, 8000.0);
    const Inverter sixteen = at(plain, 16000.0, 1).inverter;
    EXPECT_DOUBLE_EQ(sixteen.pwm_frequency_Hz, 75e6 / (2 * 2344));
    for (const double whole : {5000.0, 10000.0, 12500.0, 20000.0}) {
        EXPECT_EQ(at(plain, whole, 1).inverter.pwm_frequency_Hz, whole);
    }
}

TEST(PwmFrequency, BothNumbersAreSaidWhereTheyDiffer)
{
    const Inverter eight = at(plain, 8000.0, 1).inverter;
    EXPECT_EQ(pwm_words(eight), "7999.147 Hz, the nearest to 8000 Hz that the counter has");
    EXPECT_EQ(pwm_note(eight), "PWM at " + pwm_words(eight) + "\n");
    const Inverter five = at(plain, 5000.0, 1).inverter;
    EXPECT_EQ(pwm_words(five), "5000 Hz");
    EXPECT_EQ(pwm_note(five), "");
    EXPECT_EQ(pwm_note(at(plain, 7999.147, 1).inverter), ""); // as the report says it
}

// The tables' float is that of 2 TBPRD / 75 MHz at every count. Registers and frequency give the count again.
TEST(PwmFrequency, PeriodOfTheTablesIsThatOfTheCounter)
{
    Drive d = shipped(plain);
    d.board.file.reset(); // its gates need more dead time than the fast ones have
    for (int full = 500; full <= 16383; full++) {
        d.inverter.pwm_frequency_Hz = counted_pwm_Hz(processor, full);
        ASSERT_EQ(pwm_full_cnt(processor, d.inverter.pwm_frequency_Hz), full);
        for (const int updates : {1, 2}) {
            d.inverter.updates_per_period = updates;
            ASSERT_EQ(single(control_period_s(d)), single(2.0 * full / 75e6 / updates)) << full;
        }
        if (full % 61 == 0 || full > 16380) { // the whole board: one in 61
            d.inverter.dead_time_s = 0.05 * 2.0 * full / 75e6;
            d.inverter.dead_time_s = std::min(d.inverter.dead_time_s, 13e-6);
            const app_config_t c   = board_constants(d).config;
            ASSERT_EQ(c.pwm_period_s, single(2.0 * full / 75e6)) << full;
            ASSERT_EQ(c.board.duty_full_cnt, full);
            ASSERT_EQ(c.board.pwm_cycles, 4U * static_cast<unsigned>(full));
            ASSERT_GE(c.board.dead_time_cnt + 1e-3, d.inverter.dead_time_s * 75e6); // no less
            ASSERT_LT(c.board.dead_time_cnt - 1.0, d.inverter.dead_time_s * 75e6);
            ASSERT_LT(2U * c.board.dead_time_cnt, c.board.duty_full_cnt); // board.c
        }
    }
}

// From one end of the range to the other, between the counts too.
TEST(PwmFrequency, NoFrequencyIsOffByMoreThanATenthOfAPercent)
{
    for (double pwm_Hz = 2289.0; pwm_Hz < highest_Hz(); pwm_Hz *= 1.0037) {
        const Inverter i = at(plain, pwm_Hz, 1).inverter;
        EXPECT_LE(std::abs(i.pwm_frequency_Hz - pwm_Hz), 0.3e-3 * pwm_Hz); // hardware.md
        EXPECT_LE(std::abs(37.5e6 / i.pwm_frequency_Hz - 37.5e6 / pwm_Hz), 0.5 + 1e-9);
        EXPECT_EQ(i.pwm_wanted_Hz, pwm_Hz);
    }
}

// The digest is that of the period that runs. A report's frequency in the file changes nothing.
TEST(PwmFrequency, DigestIsOfTheFrequencyThatRuns)
{
    for (const double pwm_Hz : {2289.0, 3333.0, 8000.0, 16000.0, 20000.0, highest_Hz()}) {
        const Drive wanted = at(plain, pwm_Hz, 1);
        const Drive actual = at(plain, wanted.inverter.pwm_frequency_Hz, 1);
        EXPECT_EQ(actual.inverter.pwm_frequency_Hz, wanted.inverter.pwm_frequency_Hz);
        EXPECT_EQ(drive_digest(actual), drive_digest(wanted));
        const double next = counted_pwm_Hz(processor, pwm_full_cnt(processor, pwm_Hz) -
                                                          (pwm_Hz <= 20000.0 ? 1.0 : -1.0));
        EXPECT_NE(drive_digest(at(plain, next, 1)), drive_digest(wanted));
    }
}

TEST(PwmFrequency, OutsideTheRangeIsRefusedWithBothEnds)
{
    const double      most = highest_Hz(), half = std::floor(0.5 * most);
    const std::string ends  = fmt::format("must be 2289 .. {:.0f};", most);
    const std::string needs = fmt::format("law \"noc\" needs {:.0f} (",
                                          std::ceil(dearest("noc") / (1.0 - background_share)));
    for (const double refused : {2000.0, 2288.0, most + 40.0, 1e9, 0.0, -8000.0}) {
        const std::string what = complaint(plain, refused, 1);
        EXPECT_NE(what.find(fmt::format("[inverter] pwm_frequency_Hz = {:g} is not", refused)),
                  std::string::npos)
            << what;
        EXPECT_NE(what.find(ends), std::string::npos) << what;
        EXPECT_NE(what.find("65535 cycles"), std::string::npos) << what;
        EXPECT_NE(what.find(needs), std::string::npos) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
    EXPECT_NE(complaint(plain, 20000.0, 2).find("must be 2289 .. "), std::string::npos);
    for (const double accepted : {2289.0, 20000.0, most}) {
        EXPECT_EQ(complaint(plain, accepted, 1), "");
    }
    for (const double accepted : {2289.0, half - 40.0}) {
        EXPECT_EQ(complaint(plain, accepted, 2), "");
    }
    EXPECT_EQ(pwm_full_cnt_range(shipped("ipmsm_390w_noc_h")).most, 16383.0);
}

// A control period holds the upper end of its law's estimate beside the background's share, to a count.
TEST(PwmFrequency, UpperEndIsTheRecordedCycleBudget)
{
    const double position = whole("noc, position") - whole("noc");
    const auto   room     = [](const char *name) {
        const Drive d = shipped(name);
        return (1.0 - background_share) * 4.0 * pwm_full_cnt_range(d).least /
               d.inverter.updates_per_period;
    };
    ASSERT_GT(position, 100.0);
    EXPECT_NEAR(room("ipmsm_390w_speed"), dearest("noc_speed"), 4.0);
    EXPECT_NEAR(room("ipmsm_390w_counts"), dearest("noc"), 4.0);
    EXPECT_NEAR(room("ipmsm_390w"), dearest("noc") + position, 4.0);
    EXPECT_NEAR(room("ipmsm_390w_noc_h"), dearest("noc_h"), 4.0);
    EXPECT_NEAR(room("ipmsm_390w_noc_h_edges"), dearest("noc_h") + position, 4.0);
    EXPECT_NEAR(room("ipmsm_390w_pi_foc"), dearest("noc"), 4.0); // the table has the bare one
    EXPECT_NEAR(room("servo_200w_cdobc"), dearest("noc"), 4.0);
    EXPECT_NEAR(room("ipmsm_390w_conventional"), dearest("conventional"), 4.0);
}

// 170 MHz up and down: 4250 counts are 20 kHz. A period has at most 43690 cycles, 3891.05 Hz.
TEST(PwmFrequency, SecondProcessorHasItsOwnCounter)
{
    const Drive d = shipped("m2310p_24v");
    ASSERT_EQ(processor_of(d).name, "stm32g431");
    EXPECT_EQ(pwm_full_cnt(processor_of(d), 20e3), 4250.0);
    EXPECT_EQ(d.inverter.pwm_frequency_Hz, 20e3);
    EXPECT_EQ(pwm_full_cnt_range(d).most, 21845.0);
    EXPECT_EQ(pwm_refusal(d, 3892.0), "");
    const std::string slow = pwm_refusal(d, 3890.0);
    EXPECT_NE(slow.find("must be 3892 .. 170000"), std::string::npos) << slow;
    EXPECT_NE(slow.find("43690 cycles of 170 MHz"), std::string::npos) << slow;
    EXPECT_EQ(complaint("m2310p_24v", 19000.0, 1), "");
}

// The cycle budget is the F28335's: with it [position] at 20 kHz is refused.
TEST(PwmFrequency, NoBudgetOfAnotherProcessorIsApplied)
{
    Drive d = shipped("m2310p_24v");
    ASSERT_TRUE(d.position);
    EXPECT_EQ(pwm_refusal(d, 20e3), "");
    EXPECT_EQ(cycles_note(d), "cycles of a control period: nothing checked, none are recorded for "
                              "stm32g431; it has 8500\n");
    EXPECT_EQ(cycles_note(shipped("ipmsm_390w")), "");
    EXPECT_EQ(cycles_note(shipped("ipmsm_390w_10khz")), "");
    d.board.file->processor = find_processor("f28335");
    EXPECT_NE(pwm_refusal(d, 20e3).find("with [position] needs"), std::string::npos);
}
