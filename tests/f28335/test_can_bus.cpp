// SPDX-License-Identifier: MIT
// The CAN bus by itself: bits of frames, arbitration, time, errors.
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "sil/f28335/can_bus.hpp"
#include "sil/f28335/clock.hpp"

namespace {

using namespace sdre::f28335;

constexpr double       rate_Hz   = 500e3;
constexpr std::int64_t bit_ticks = 300;

CanFrame frame(std::uint32_t id, bool extended = false, bool remote = false,
               std::uint8_t length = 0)
{
    CanFrame f;
    f.id       = id;
    f.extended = extended;
    f.remote   = remote;
    f.length   = length;
    return f;
}

std::vector<bool> bits_of(const std::string &text)
{
    std::vector<bool> bits;
    for (const char c : text) {
        for (unsigned n = 8; n > 0; n--) {
            bits.push_back(((static_cast<unsigned char>(c) >> (n - 1U)) & 1U) != 0U);
        }
    }
    return bits;
}

CanFrame random_frame(std::mt19937 &r)
{
    CanFrame f;
    f.extended       = r() % 2U == 0U;
    f.remote         = r() % 4U == 0U;
    f.id             = static_cast<std::uint32_t>(r()) & (f.extended ? 0x1FFFFFFFU : 0x7FFU);
    f.length         = static_cast<std::uint8_t>(r() % 9U);
    const bool plain = r() % 2U == 0U; // runs of equal bits
    for (std::uint8_t &octet : f.data) {
        octet = static_cast<std::uint8_t>(plain ? (r() % 2U) * 255U : r());
    }
    return f;
}

/// Length on the wire by another way: the text of the bits, with stuff bits put in.
int length_by_text(const CanFrame &f)
{
    std::string text;
    for (const bool bit : can_frame_bits(f)) {
        text += bit ? '1' : '0';
        const std::size_t n = text.size();
        if (n >= 5 &&
            (text.compare(n - 5, 5, "00000") == 0 || text.compare(n - 5, 5, "11111") == 0)) {
            text += text.back() == '1' ? '0' : '1';
        }
    }
    return static_cast<int>(text.size()) + 1 + 2 + 7;
}

TEST(CanFrame, CrcIsThatOfTheStandard)
{
    EXPECT_EQ(can_crc(bits_of("123456789")), 0x059E); // check value of CRC-15/CAN
    EXPECT_EQ(can_crc({true}), 0x4599);
}

TEST(CanFrame, LengthIsWithinThePublishedBounds)
{
    std::mt19937 r(1);
    int          most = 0;
    for (int n = 0; n < 20000; n++) {
        const CanFrame f       = random_frame(r);
        const int      octets  = f.remote ? 0 : f.length;
        const int      stuffed = (f.extended ? 54 : 34) + 8 * octets;
        const int      length  = can_frame_length_bits(f);
        EXPECT_GE(length, stuffed + 10);
        EXPECT_LE(length, stuffed + 10 + (stuffed - 1) / 4);
        EXPECT_EQ(length, length_by_text(f));
        most = std::max(most, length - stuffed);
    }
    EXPECT_GT(most, 10 + 12);
    EXPECT_EQ(can_frame_bits(frame(0x555)).size(), 34U);
    EXPECT_EQ(can_frame_length_bits(frame(0)),
              34 + 10 + 6); // a remainder of 0: 34 dominant bits but for the stuff bits
}

class CanBusTest : public ::testing::Test {
protected:
    CanBusTest()
    {
        bus.far_end().close();
        for (CanNode *&node : nodes) {
            node = &bus.join();
            node->open(rate_Hz);
        }
    }
    void pass_bits(std::int64_t bits)
    {
        const std::int64_t end = now + bits * bit_ticks;
        while (now < end) {
            const std::int64_t event = bus.ticks_to_event(now);
            now += event < 0 ? end - now : std::min(std::max<std::int64_t>(event, 1), end - now);
            bus.pass(now);
        }
    }
    std::vector<std::uint32_t> taken(CanNode &node)
    {
        std::vector<std::uint32_t> ids;
        while (const std::optional<CanFrame> f = node.take()) {
            ids.push_back(f->id);
        }
        return ids;
    }

    CanBus       bus;
    CanNode     *nodes[4]{};
    std::int64_t now = 0;
};

TEST_F(CanBusTest, TheLowestIdentifierWins)
{
    nodes[0]->send(frame(0x200));
    nodes[1]->send(frame(0x100, false, true));
    nodes[2]->send(frame(0x100U << 18U, true));
    nodes[3]->send(frame(0x0FF));
    nodes[3]->send(frame(0x100));
    nodes[0]->send(frame(0x001)); // behind 0x200
    pass_bits(800);
    EXPECT_EQ(taken(*nodes[1]),
              (std::vector<std::uint32_t>{0x0FF, 0x100, 0x100U << 18U, 0x200, 0x001}));
    EXPECT_EQ(taken(*nodes[0]), (std::vector<std::uint32_t>{0x0FF, 0x100, 0x100, 0x100U << 18U}));
}

TEST_F(CanBusTest, FramesFollowEachOtherAfterTheIntermission)
{
    const CanFrame one = frame(0x123, false, false, 8);
    nodes[0]->send(one);
    nodes[0]->send(one);
    const int length = can_frame_length_bits(one);
    pass_bits(length + 1);
    EXPECT_EQ(taken(*nodes[1]).size(), 1U);
    pass_bits(length);
    EXPECT_EQ(taken(*nodes[1]).size(), 0U);
    pass_bits(4);
    EXPECT_EQ(taken(*nodes[1]).size(), 1U);
}

TEST_F(CanBusTest, EveryFrameReachesAllOthersOnceAndInOrder)
{
    std::mt19937          r(2);
    std::vector<CanFrame> sent[4];
    for (std::uint32_t n = 0; n < 400; n++) {
        const std::size_t by = r() % 4U;
        CanFrame          f  = random_frame(r);
        f.id                 = f.extended ? (f.id & 0x1FFFFFFCU) | static_cast<std::uint32_t>(by)
                                          : (f.id & 0x7FCU) | static_cast<std::uint32_t>(by);
        ASSERT_TRUE(nodes[by]->send(f));
        sent[by].push_back(f);
    }
    pass_bits(400 * 165);
    for (std::size_t to = 0; to < 4; to++) {
        std::size_t seen[4]{};
        while (const std::optional<CanFrame> f = nodes[to]->take()) {
            const std::size_t by = f->id % 4U;
            ASSERT_LT(seen[by], sent[by].size());
            EXPECT_TRUE(*f == sent[by][seen[by]]);
            seen[by]++;
        }
        for (std::size_t by = 0; by < 4; by++) {
            EXPECT_EQ(seen[by], by == to ? 0U : sent[by].size());
        }
    }
}

TEST_F(CanBusTest, LoadIsTheBusyShare)
{
    const CanFrame one    = frame(0x123, false, false, 8);
    const int      length = can_frame_length_bits(one) + 3;
    for (int n = 0; n < 300; n++) { // 0.3 s
        nodes[0]->send(one);
        pass_bits(500);
    }
    pass_bits(1);
    EXPECT_NEAR(bus.load(), length / 500.0, 0.01);
    pass_bits(110'000);
    EXPECT_EQ(bus.load(), 0.0);
}

TEST_F(CanBusTest, OneIdentifierWithTwoContentsNeverPasses)
{
    CanFrame other = frame(0x123, false, false, 2);
    nodes[0]->send(other);
    other.data[1] = 1;
    nodes[1]->send(other);
    pass_bits(40 * 140);
    EXPECT_TRUE(nodes[0]->errors().bus_off() && nodes[1]->errors().bus_off());
    EXPECT_TRUE(taken(*nodes[2]).empty());
    nodes[2]->send(frame(0x300));
    pass_bits(100);
    EXPECT_EQ(taken(*nodes[3]).size(), 1U); // the others go on
}

TEST_F(CanBusTest, ASenderAtAnotherRateGoesBusOff)
{
    nodes[0]->open(125e3);
    nodes[0]->send(frame(0x10));
    pass_bits(40 * 4 * 60);
    EXPECT_TRUE(nodes[0]->errors().bus_off());
    EXPECT_FALSE(nodes[0]->send(frame(0x10)));
    EXPECT_TRUE(taken(*nodes[1]).empty());
    EXPECT_GT(nodes[1]->errors().receive(), 0);
    nodes[1]->send(frame(0x11)); // one that is off disturbs nobody
    pass_bits(100);
    EXPECT_EQ(taken(*nodes[2]).size(), 1U);
    EXPECT_TRUE(taken(*nodes[0]).empty());
}

TEST_F(CanBusTest, AListenerDoesNotAcknowledgeAndDoesNotDisturb)
{
    nodes[2]->close();
    nodes[3]->close();
    nodes[1]->open(rate_Hz, true);
    EXPECT_FALSE(nodes[1]->send(frame(0x10)));
    nodes[0]->send(frame(0x10));
    pass_bits(3000);
    EXPECT_EQ(nodes[0]->errors().transmit(), 128);
    EXPECT_TRUE(taken(*nodes[1]).empty());
    nodes[2]->open(rate_Hz);
    nodes[3]->open(125e3, true); // at a wrong rate, but only listening
    pass_bits(200);
    EXPECT_EQ(taken(*nodes[1]).size(), 1U);
    EXPECT_EQ(taken(*nodes[2]).size(), 1U);
    EXPECT_TRUE(taken(*nodes[3]).empty());
}

TEST_F(CanBusTest, AnErrorPassiveSenderLetsOthersGoFirst)
{
    nodes[0]->send(frame(0x10));
    nodes[0]->send(frame(0x11));
    bus.set_fault(CanFault::shorted);
    while (nodes[0]->errors().transmit() < 160) {
        pass_bits(1);
    }
    nodes[1]->send(frame(0x700));
    nodes[1]->send(frame(0x701));
    bus.set_fault(CanFault::none);
    pass_bits(600);
    // Behind its own frame it waits for 8 bits more.
    EXPECT_EQ(taken(*nodes[2]), (std::vector<std::uint32_t>{0x700, 0x10, 0x701, 0x11}));
}

TEST_F(CanBusTest, AQueueHasAnEnd)
{
    int accepted = 0;
    while (nodes[0]->send(frame(0x10)) && accepted < 5000) {
        accepted++;
    }
    EXPECT_EQ(accepted, 1024);
    bus.leave(*nodes[0]);
    pass_bits(100);
    EXPECT_TRUE(taken(*nodes[1]).empty());
}

} // namespace
