// SPDX-License-Identifier: MIT
// A drive's constants over CAN into the flash of the drive, beside the SYNC of a master; simulated time only.
#include "can_client.hpp"
#include "loaded_image.hpp"

extern "C" {
#include "app_canopen_block.h"
#include "app_loader.h"
#include "crc32.h"
}

namespace {

using namespace sdre;

constexpr double      sync_s      = 5e-3;
constexpr std::size_t per_request = 62; // words, and two of their place
constexpr unsigned    segment     = 7;  // octets
constexpr unsigned    holdings    = 3;  // sub-index
constexpr unsigned    inputs      = 2;
constexpr unsigned    selection   = 1;

class LoadingCan : public CanClient {
protected:
    void after_period() override
    {
        if (served.time_s() >= next_sync_s) {
            next_sync_s = served.time_s() + sync_s;
            send(0x80, {});
        }
        CanClient::after_period();
    }
    void select(unsigned first, std::size_t count)
    {
        ASSERT_EQ(put(APP_CANOPEN_BLOCK, selection,
                      first | (static_cast<std::uint32_t>(count) << 16U), 4),
                  no_abort);
    }
    /// Holding registers of the loader in segments; the abort code, or no_abort.
    std::uint32_t write_block(unsigned first, const Words &words)
    {
        select(APP_LOADER_FIRST + first, words.size());
        const std::size_t octets = 2 * words.size();
        Data              a = request({0x21, static_cast<std::uint8_t>(APP_CANOPEN_BLOCK & 0xFFU),
                                       static_cast<std::uint8_t>(APP_CANOPEN_BLOCK >> 8U), holdings,
                                       static_cast<std::uint8_t>(octets), 0, 0, 0});
        for (std::size_t at = 0; at < octets && !a.empty() && a[0] != 0x80; at += segment) {
            const std::size_t here = std::min<std::size_t>(segment, octets - at);
            Data              part{static_cast<std::uint8_t>(((at / segment) & 1U) << 4U |
                                                (segment - here) << 1U |
                                                (at + here == octets ? 1U : 0U))};
            for (std::size_t k = at; k < at + segment; k++) {
                const unsigned word = k < octets ? words[k / 2] : 0U;
                part.push_back(static_cast<std::uint8_t>(word >> (8U * (k & 1U))));
            }
            a = request(part);
        }
        return a.size() != 8 ? 1 : a[0] == 0x80 ? number(a) : no_abort;
    }
    /// An input register of the loader; -1: no answer.
    int loader(unsigned which)
    {
        select(APP_LOADER_FIRST + which, 1);
        const std::optional<std::uint32_t> value = get(APP_CANOPEN_BLOCK, inputs);
        return value ? static_cast<int>(*value & 0xFFFFU) : -1;
    }
    void command(unsigned what, const Words &behind = {})
    {
        Words words{static_cast<std::uint16_t>(what)};
        words.insert(words.end(), behind.begin(), behind.end());
        ASSERT_EQ(write_block(APP_LOADER_COMMAND, words), no_abort);
    }
    void enter()
    {
        command(APP_LOADER_ENTER);
        pass(0.1);
        ASSERT_EQ(loader(APP_LOADER_STATE), APP_LOADER_IDLE);
    }
    void write_image(const Words &words)
    {
        const auto          count = static_cast<std::uint32_t>(words.size());
        const std::uint32_t crc   = crc32_words(CRC32_START, words.data(), count);

        command(APP_LOADER_BEGIN, {0, static_cast<std::uint16_t>(count)});
        pass(erased_s);
        ASSERT_EQ(loader(APP_LOADER_STATE), APP_LOADER_WRITING);
        for (std::size_t at = 0; at < words.size(); at += per_request) {
            Words             part{0, static_cast<std::uint16_t>(at)};
            const std::size_t end = std::min(at + per_request, words.size());
            part.insert(part.end(), words.begin() + static_cast<std::ptrdiff_t>(at),
                        words.begin() + static_cast<std::ptrdiff_t>(end));
            ASSERT_EQ(write_block(APP_LOADER_OFFSET_HI, part), no_abort);
        }
        command(APP_LOADER_COMMIT,
                {0, static_cast<std::uint16_t>(count), static_cast<std::uint16_t>(crc >> 16U),
                 static_cast<std::uint16_t>(crc)});
        pass(erased_s);
        ASSERT_EQ(loader(APP_LOADER_STATE), APP_LOADER_STORED);
    }

    double next_sync_s = 0.0;
};

TEST_F(LoadingCan, AnImageIsInForceAfterTheRestart)
{
    pass(0.5);
    EXPECT_EQ(loader(APP_LOADER_NUMBER_LO), 0);
    enter();
    write_image(image(first_image_e_radps, "ab"));
    command(APP_LOADER_LEAVE);
    pass(0.5);
    EXPECT_EQ(loader(APP_LOADER_STATE), APP_LOADER_AWAY);
    EXPECT_EQ(loader(APP_LOADER_NUMBER_LO), 1);
    EXPECT_EQ(get(0x5F01, 1), 0x6261U) << "ab";
    EXPECT_NE(put(0x60FF, 0, 14400, 4), no_abort) << "the image allows 1432 r/min";
    EXPECT_EQ(put(0x60FF, 0, 14200, 4), no_abort);
    EXPECT_EQ(served.resets(), 2);
    expect_no_findings();
}

TEST_F(LoadingCan, AMasterWhoResetsTheNodeEndsTheLoader)
{
    pass(0.5);
    enter();
    EXPECT_NE(write_block(APP_LOADER_COMMAND, {APP_LOADER_ENTER}), no_abort) << "it is there";
    send(0, {129, 1});
    pass(0.5);
    EXPECT_EQ(loader(APP_LOADER_STATE), APP_LOADER_AWAY);
    EXPECT_EQ(served.resets(), 2);
    expect_no_findings();
}

TEST_F(LoadingCan, WordsComeOnceAndInTheirOrder)
{
    pass(0.5);
    enter();
    const Words words = image(first_image_e_radps, "ab");
    command(APP_LOADER_BEGIN, {0, static_cast<std::uint16_t>(words.size())});
    pass(erased_s);
    EXPECT_EQ(write_block(APP_LOADER_OFFSET_HI, {0, 0, words[0], words[1]}), no_abort);
    EXPECT_NE(write_block(APP_LOADER_OFFSET_HI, {0, 0, words[0], words[1]}), no_abort);
    EXPECT_NE(write_block(APP_LOADER_OFFSET_HI, {0, 3, words[3]}), no_abort);
    EXPECT_EQ(loader(APP_LOADER_PUT_LO), 2);
    command(APP_LOADER_LEAVE);
    pass(0.5);
    EXPECT_EQ(loader(APP_LOADER_NUMBER_LO), 0);
    expect_no_findings();
}

// Modbus and CAN are both there, with one loader.
TEST_F(LoadingCan, OneBusEntersAndTheOtherLeaves)
{
    pass(0.5);
    enter();
    EXPECT_EQ(input(APP_LOADER_FIRST + APP_LOADER_STATE), APP_LOADER_IDLE);
    EXPECT_TRUE(write(APP_LOADER_FIRST, {APP_LOADER_LEAVE}));
    pass(0.5);
    EXPECT_EQ(loader(APP_LOADER_STATE), APP_LOADER_AWAY);
    expect_no_findings();
}

} // namespace
