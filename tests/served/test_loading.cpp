// SPDX-License-Identifier: MIT
// A drive's constants over Modbus into the flash, with power cuts; simulated time only.
#include <cstring>
#include <functional>

#include <gtest/gtest.h>

#include "design/board/identity.hpp"
#include "loading_client.hpp"
#include "sweep.hpp"

using namespace sdre;

namespace {

constexpr std::size_t first_fact_word = 42; // drive_image.h

/// The words of an image whose board has another fact; the constants are this board's.
Words with_fact(const Words &words, std::size_t fact, float value)
{
    Words         out  = words;
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    const std::size_t at = first_fact_word + 2 * fact;
    out.at(at)           = static_cast<std::uint16_t>(bits >> 16U);
    out.at(at + 1)       = static_cast<std::uint16_t>(bits);
    return out;
}

class Loading : public LoadingClient {
protected:
    /// Loads an image that is refused with this field, in a loader that runs.
    void refused(const Words &words, unsigned field)
    {
        ASSERT_TRUE(work(APP_LOADER_BEGIN, {0, static_cast<std::uint16_t>(words.size())},
                         APP_LOADER_WRITING));
        ASSERT_TRUE(put(words));
        ASSERT_TRUE(commit(words, APP_LOADER_IMAGE));
        EXPECT_EQ(loader(APP_LOADER_REASON), DRIVE_IMAGE_OTHER_BOARD);
        EXPECT_EQ(loader(APP_LOADER_FIELD), static_cast<int>(field));
        EXPECT_EQ(field_name(), board_field_name(static_cast<std::uint16_t>(field)));
    }
};

} // namespace

TEST_F(Loading, AnImageIsInForceAfterTheRestartAndTheMotorRunsWithIt)
{
    pass(0.5);
    EXPECT_EQ(loader(APP_LOADER_NUMBER_LO), 0);
    load(image(first_image_e_radps, "ab"));

    EXPECT_EQ(loader(APP_LOADER_NUMBER_LO), 1);
    EXPECT_EQ(name(), "ab");
    EXPECT_FALSE(write(APP_REGISTERS_SPEED,
                       {0, static_cast<std::uint16_t>(10.0 * first_image_e_radps + 500.0)}))
        << "the image allows less";
    ASSERT_TRUE(write(APP_REGISTERS_SPEED, {0, 2000}));
    ASSERT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_SHUT_DOWN}));
    pass(0.01); // a command each
    ASSERT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_ENABLE_OPERATION}));
    for (int n = 0; n < 20; n++) { // it aligns first; who does not ask is taken for gone
        pass(0.2);
        input(APP_REGISTERS_MODE);
    }
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN)
        << input(APP_REGISTERS_FAULT) << ' ' << input(APP_REGISTERS_DRIVE_FAULT);
    EXPECT_NEAR(served.plant_state().omega_e_radps, 200.0, 1.0);
    double       sum      = 0.0; // the disc of the encoder makes one reading uncertain
    const double readings = 16.0;
    for (double n = 0.0; n < readings; n++) {
        sum += input(APP_REGISTERS_SPEED_NOW + 1);
    }
    EXPECT_NEAR(sum / readings, 2000.0, 30.0);
    EXPECT_FALSE(command(APP_LOADER_ENTER)) << "the bridge is on";
    EXPECT_EQ(served.resets(), 2);
    EXPECT_TRUE(served.findings().empty());
}

// Every fact of the board file, each alone, and the name.
TEST_F(Loading, AnImageOfAnotherBoardIsRefusedByTheNameOfTheField)
{
    pass(0.5);
    const Words            own   = image(first_image_e_radps, "ab");
    const board_identity_t board = board_identity_of(shipped_drive());
    enter();
    for (unsigned fact = 0; fact < BOARD_FACT_COUNT; fact += support::swept(1U, 5U)) {
        const float other = 2.0F * board.fact[fact] + 0.5F;
        refused(with_fact(own, fact, other), fact + 1);
        EXPECT_EQ(loader_float(APP_LOADER_IMAGE_HI), other);
        EXPECT_EQ(loader_float(APP_LOADER_BOARD_HI), board.fact[fact]);
    }
    Words renamed = own;
    renamed.at(30) ^= 1U;
    refused(renamed, BOARD_FIELD_NAME);
    ASSERT_TRUE(command(APP_LOADER_LEAVE));
    pass(0.5);
    EXPECT_EQ(loader(APP_LOADER_NUMBER_LO), 0);
    load(own);
    EXPECT_EQ(loader(APP_LOADER_NUMBER_LO), 1);
    EXPECT_EQ(loader(APP_LOADER_FIELD), BOARD_FIELD_NONE);
    EXPECT_TRUE(served.findings().empty());
}

// A drive that was changed after it was read, as an own tool could do: its image says that it is for this board.
TEST_F(Loading, AShortDeadTimeAndAnotherRangeAreRefused)
{
    pass(0.5);
    enter();
    const Words own      = image(first_image_e_radps, "ab");
    const auto  words_of = [&own](const std::function<void(Drive &)> &change) {
        Drive drive = shipped_drive();
        change(drive);
        drive.board.file->facts[BOARD_FACT_DEAD_TIME_MIN_s] = 0.0;
        drive.board.file->facts[BOARD_FACT_CURRENT_RANGE_A] = drive.current_sensors.range_A;
        drive.board.file->facts[BOARD_FACT_RATED_CURRENT_A] = drive.motor.max_current_A;
        Words words = image_words(design_drive(drive, Precision::quick));
        std::copy_n(own.begin() + 30, BOARD_IDENTITY_WORDS, words.begin() + 30);
        return words;
    };
    const BoardFile &facts      = *served.drive().board.file;
    const double     counter_Hz = facts[BOARD_FACT_PWM_CLOCK_Hz];
    const double     range_A    = facts[BOARD_FACT_CURRENT_RANGE_A];
    refused(words_of([](Drive &d) { d.inverter.dead_time_s = 5e-8; }),
            BOARD_FACT_DEAD_TIME_MIN_s + 1);
    EXPECT_NEAR(loader_float(APP_LOADER_IMAGE_HI), std::ceil(5e-8 * counter_Hz) / counter_Hz,
                1e-12);
    refused(words_of([&](Drive &d) {
                d.motor.max_current_A     = 0.2 * range_A;
                d.current_sensors.range_A = 0.5 * range_A;
            }),
            BOARD_FACT_CURRENT_RANGE_A + 1);
    EXPECT_NEAR(loader_float(APP_LOADER_IMAGE_HI), 0.5 * range_A, 1e-6 * range_A);
    EXPECT_NEAR(loader_float(APP_LOADER_BOARD_HI), range_A, 1e-6 * range_A);
    refused(words_of([&](Drive &d) {
                d.motor.max_current_A = 1.02 * facts[BOARD_FACT_RATED_CURRENT_A];
            }),
            BOARD_FACT_RATED_CURRENT_A + 1);
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(Loading, APowerCutLeavesTheOldImageOrTheNewOne)
{
    pass(0.5);
    load(image(first_image_e_radps, "ab"));
    const Words next = image(second_image_e_radps, "cd");

    // while it is erased, between words, while a request's words are written, before the end
    for (int when = 0; when < 4; when++) {
        enter();
        const Words count{0, static_cast<std::uint16_t>(next.size())};
        if (when == 0) {
            ASSERT_TRUE(command(APP_LOADER_BEGIN, count));
            pass(erasing_s);
        } else {
            ASSERT_TRUE(work(APP_LOADER_BEGIN, count, APP_LOADER_WRITING));
            const auto part = static_cast<std::ptrdiff_t>(when == 1 ? 300 : next.size());
            ASSERT_TRUE(put({next.begin(), next.begin() + part}));
        }
        if (when == 2) {
            EXPECT_FALSE(write(APP_LOADER_FIRST + APP_LOADER_OFFSET_HI, {0, 3, 1, 2}, 0.001));
        }
        served.power_cycle();
        pass(0.5);
        EXPECT_EQ(loader(APP_LOADER_STATE), APP_LOADER_AWAY);
        EXPECT_EQ(loader(APP_LOADER_NUMBER_LO), 1) << when;
        EXPECT_EQ(name(), "ab") << when;
    }
    load(next);
    EXPECT_EQ(loader(APP_LOADER_NUMBER_LO), 2);
    EXPECT_EQ(name(), "cd");
    served.power_cycle();
    pass(0.5);
    EXPECT_EQ(name(), "cd");
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(Loading, ALostImageDoesNotRunUntilWhatIsLeftIsAccepted)
{
    pass(0.5);
    load(image(first_image_e_radps, "ab"));
    load(image(second_image_e_radps, "cd"));
    flip_stored_bit(served, 1, 100);
    served.power_cycle();
    pass(0.5);
    EXPECT_EQ(name(), "ab");
    EXPECT_EQ(input(APP_REGISTERS_CONDITIONS) & 0x1C00, APP_REGISTERS_IMAGE_LOST);
    const auto start = [this] {
        EXPECT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_SHUT_DOWN}));
        pass(0.01);
        EXPECT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_ENABLE_OPERATION}));
        pass(0.2);
        return input(APP_REGISTERS_MODE);
    };
    EXPECT_EQ(start(), APP_MODE_READY);
    ASSERT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_DISABLE_VOLTAGE}));
    pass(0.01);

    EXPECT_FALSE(write(APP_REGISTERS_ACCEPT_FALLBACK, {0x656B, 0x6175}));
    ASSERT_TRUE(write(APP_REGISTERS_ACCEPT_FALLBACK, {0x656B, 0x6174}));
    pass(erased_s + 0.5);
    EXPECT_EQ(input(APP_REGISTERS_CONDITIONS) & 0x1C00, 0);
    EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_DONE), 1);
    EXPECT_EQ(name(), "ab");
    EXPECT_EQ(loader(APP_LOADER_NUMBER_LO), 2);
    EXPECT_FALSE(write(APP_REGISTERS_ACCEPT_FALLBACK, {0x656B, 0x6174})) << "nothing is lost";
    EXPECT_EQ(start(), APP_MODE_ALIGN);
    EXPECT_TRUE(served.findings().empty());
}
