// SPDX-License-Identifier: MIT
// A drive's constants over Modbus into the flash of the virtual device, with power cuts; simulated time only.
#include <cstring>
#include <functional>

#include <gtest/gtest.h>

#include "design/board/identity.hpp"
#include "loaded_image.hpp"
#include "sweep.hpp"

extern "C" {
#include "app_control.h"
#include "app_loader.h"
#include "app_modes.h"
#include "app_registers.h"
#include "crc32.h"
#include "store.h"

const std::uint16_t *f28335_board_store(std::uint16_t slot);
}

using namespace sdre;

namespace {

constexpr double      erased_s        = 2.1; // a sector: 2 s
constexpr std::size_t first_fact_word = 42;  // drive_image.h

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

class Loading : public ServedClient {
protected:
    int loader(unsigned number)
    {
        return input(APP_LOADER_FIRST + number);
    }
    /// Object 80h of function 43/14.
    std::string name()
    {
        const Octets answer = ask({43, 14, 4, 0x80});
        return answer.size() > 9 ? std::string(answer.begin() + 9, answer.end()) : "";
    }
    bool command(unsigned what, const Words &behind = {})
    {
        Words words{static_cast<std::uint16_t>(what)};
        words.insert(words.end(), behind.begin(), behind.end());
        return write(APP_LOADER_FIRST, words);
    }
    /// A command and the end of its work.
    bool work(unsigned what, const Words &behind, int state)
    {
        if (!command(what, behind)) {
            return false;
        }
        pass(erased_s);
        return loader(APP_LOADER_STATE) == state;
    }
    void enter()
    {
        ASSERT_TRUE(command(APP_LOADER_ENTER));
        pass(0.1);
        ASSERT_EQ(loader(APP_LOADER_STATE), APP_LOADER_IDLE);
    }
    bool put(const Words &words)
    {
        for (std::size_t at = 0; at < words.size(); at += APP_LOADER_DATA) {
            Words part{0, static_cast<std::uint16_t>(at)};
            part.insert(part.end(), words.begin() + static_cast<std::ptrdiff_t>(at),
                        words.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(
                                            at + APP_LOADER_DATA, words.size())));
            if (!write(APP_LOADER_FIRST + APP_LOADER_OFFSET_HI, part)) {
                return false;
            }
        }
        return true;
    }
    bool commit(const Words &words, int state = APP_LOADER_STORED)
    {
        const auto          count = static_cast<std::uint32_t>(words.size());
        const std::uint32_t crc   = crc32_words(CRC32_START, words.data(), count);
        return work(APP_LOADER_COMMIT,
                    {0, static_cast<std::uint16_t>(count), static_cast<std::uint16_t>(crc >> 16U),
                     static_cast<std::uint16_t>(crc)},
                    state);
    }
    float loader_float(unsigned number)
    {
        const std::uint32_t bits = static_cast<std::uint32_t>(loader(number)) << 16U |
                                   static_cast<std::uint32_t>(loader(number + 1));
        float value = 0.0F;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }
    std::string field_name()
    {
        std::string s;
        for (unsigned n = 0; n < APP_LOADER_NAME_WORDS; n++) {
            const int word = loader(APP_LOADER_FIELD_NAME + n);
            s += static_cast<char>(word >> 8);
            s += static_cast<char>(word & 0xFF);
        }
        return s.c_str();
    }
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
    void load(const Words &words)
    {
        enter();
        ASSERT_TRUE(work(APP_LOADER_BEGIN, {0, static_cast<std::uint16_t>(words.size())},
                         APP_LOADER_WRITING));
        ASSERT_TRUE(put(words));
        ASSERT_TRUE(commit(words));
        ASSERT_TRUE(command(APP_LOADER_LEAVE));
        pass(0.5);
        ASSERT_EQ(loader(APP_LOADER_STATE), APP_LOADER_AWAY);
    }
};

} // namespace

TEST_F(Loading, AnImageIsInForceAfterTheRestartAndTheMotorRunsWithIt)
{
    pass(0.5);
    EXPECT_EQ(loader(APP_LOADER_NUMBER_LO), 0);
    load(image(300.0, "ab"));

    EXPECT_EQ(loader(APP_LOADER_NUMBER_LO), 1);
    EXPECT_EQ(name(), "ab");
    EXPECT_FALSE(write(APP_REGISTERS_SPEED, {0, 3500})) << "the image allows 300 rad/s";
    ASSERT_TRUE(write(APP_REGISTERS_SPEED, {0, 2000}));
    ASSERT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_SHUT_DOWN}));
    pass(0.01); // a command each
    ASSERT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_ENABLE_OPERATION}));
    for (int n = 0; n < 20; n++) { // it aligns first; who does not ask is taken for gone
        pass(0.2);
        input(APP_REGISTERS_MODE);
    }
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
    EXPECT_NEAR(input(APP_REGISTERS_SPEED_NOW + 1), 2000, 30);
    EXPECT_FALSE(command(APP_LOADER_ENTER)) << "the bridge is on";
    EXPECT_EQ(served.resets(), 2);
    EXPECT_TRUE(served.findings().empty());
}

// Every fact of the board file, each alone, and the name.
TEST_F(Loading, AnImageOfAnotherBoardIsRefusedByTheNameOfTheField)
{
    pass(0.5);
    const Words            own   = image(300.0, "ab");
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
    const Words own      = image(300.0, "ab");
    const auto  words_of = [&own](const std::function<void(Drive &)> &change) {
        Drive drive = shipped_drive();
        change(drive);
        drive.board.file.reset();
        Words words = image_words(design_drive(drive, Precision::quick));
        std::copy_n(own.begin() + 30, BOARD_IDENTITY_WORDS, words.begin() + 30);
        return words;
    };
    refused(words_of([](Drive &d) { d.inverter.dead_time_s = 5e-8; }),
            BOARD_FACT_DEAD_TIME_MIN_s + 1);
    EXPECT_NEAR(loader_float(APP_LOADER_IMAGE_HI), 4 / 75e6, 1e-12);
    refused(words_of([](Drive &d) {
                d.motor.max_current_A     = 2.0;
                d.current_sensors.range_A = 5.0;
            }),
            BOARD_FACT_CURRENT_RANGE_A + 1);
    EXPECT_NEAR(loader_float(APP_LOADER_IMAGE_HI), 5.0, 1e-6);
    EXPECT_NEAR(loader_float(APP_LOADER_BOARD_HI), 10.0, 1e-6);
    refused(words_of([](Drive &d) { d.motor.max_current_A = 5.5; }),
            BOARD_FACT_RATED_CURRENT_A + 1);
    EXPECT_TRUE(served.findings().empty());
}

// 4.4 ms for the PLL, 5 ms for the converter; the sums over two full slots, at 150 MHz, on top. At the speed before the PLL
// they would take 1.7 s.
TEST_F(Loading, PinsAreSafeAtOnceAndTheDriveIsReadySoon)
{
    EXPECT_GE(served.device().pins_safe_cycles(), 0);
    EXPECT_LE(served.device().pins_safe_cycles(), 100);
    EXPECT_LE(served.ready_s(), 10e-3);
    for (std::uint16_t slot = 0; slot < 2; slot++) {
        std::uint16_t *const  words = const_cast<std::uint16_t *>(f28335_board_store(slot));
        const store_content_t content{words + STORE_HEAD_WORDS, store_room(), slot + 1U, false};
        std::fill_n(words, BOARD_STORE_WORDS, std::uint16_t{0x1234});
        const std::uint32_t crc = store_crc(STORE_IMAGE, &content);
        const std::uint16_t head[]{STORE_MARK,
                                   STORE_IMAGE,
                                   0,
                                   static_cast<std::uint16_t>(content.count),
                                   0,
                                   static_cast<std::uint16_t>(slot + 1),
                                   static_cast<std::uint16_t>(crc >> 16U),
                                   static_cast<std::uint16_t>(crc)};
        std::copy(std::begin(head), std::end(head), words);
    }
    served.power_cycle();
    EXPECT_GE(served.device().pins_safe_cycles(), 0);
    EXPECT_LE(served.device().pins_safe_cycles(), 100);
    EXPECT_GE(served.ready_s(), 65520 * 100 / 150e6);
    EXPECT_LE(served.ready_s(), 0.1);
}

// Set after power-on without a supervisor; clear when a supervisor stretches the watchdog's pulse; both at once.
TEST_F(Loading, TheFlagOfTheWatchdogDecidesNothing)
{
    const double pulse_s = f28335::watchdog_pulse_s;
    for (const auto &[power_on_s, watchdog_s] :
         std::vector<std::pair<double, double>>{{0.5e-3, pulse_s}, {0.2, 0.14}, {0.5e-3, 0.14}}) {
        served.set_reset_line(power_on_s, watchdog_s);
        served.power_cycle();
        pass(0.5);
        EXPECT_EQ(loader(APP_LOADER_STATE), APP_LOADER_AWAY) << power_on_s;
        EXPECT_EQ(input(APP_REGISTERS_RESET_CAUSE), power_on_s < 1.109e-3 ? 1 : 0);
        enter();
        ASSERT_TRUE(command(APP_LOADER_LEAVE));
        pass(0.5);
        EXPECT_EQ(loader(APP_LOADER_STATE), APP_LOADER_AWAY) << watchdog_s;
        EXPECT_EQ(input(APP_REGISTERS_RESET_CAUSE), watchdog_s < 1.109e-3 ? 1 : 0);
    }
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(Loading, APowerCutLeavesTheOldImageOrTheNewOne)
{
    pass(0.5);
    load(image(300.0, "ab"));
    const Words next = image(400.0, "cd");

    // while it is erased, between words, while a request's words are written, before the end
    for (int when = 0; when < 4; when++) {
        enter();
        const Words count{0, static_cast<std::uint16_t>(next.size())};
        if (when == 0) {
            ASSERT_TRUE(command(APP_LOADER_BEGIN, count));
            pass(1.0);
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
    load(image(300.0, "ab"));
    load(image(400.0, "cd"));
    const_cast<std::uint16_t *>(f28335_board_store(1))[STORE_HEAD_WORDS + 100] ^= 0x10U;
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
