// SPDX-License-Identifier: MIT
// slcan: every command, what is malformed, and lines in pieces.
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "sil/f28335/clock.hpp"
#include "sil/served/slcan.hpp"

namespace {

using namespace sdre;
using f28335::CanBus;
using f28335::CanFrame;

class Slcan : public ::testing::Test {
protected:
    Slcan()
    {
        bus.far_end().close();
    }
    /// Returns the answer to these characters.
    std::string say(SlcanChannel &channel, const std::string &text)
    {
        Octets go;
        channel.take(Octets(text.begin(), text.end()), go);
        return {go.begin(), go.end()};
    }
    std::string say(const std::string &text)
    {
        return say(one, text);
    }
    /// Returns the lines that have come after 2 ms.
    std::string hear(SlcanChannel &channel, double time_s = 0.0)
    {
        for (int n = 0; n < 200; n++) {
            now += 1500; // 10 us
            bus.pass(now);
        }
        Octets go;
        channel.collect(time_s, go);
        return {go.begin(), go.end()};
    }

    CanBus       bus;
    SlcanChannel one{bus};
    SlcanChannel two{bus};
    std::int64_t now = 0;
};

TEST_F(Slcan, LinesAndFramesAreTheSame)
{
    const char *lines[] = {"t0000",
                           "t7FF8FFFFFFFFFFFFFFFF",
                           "t12320A0B",
                           "T1FFFFFFF1AB",
                           "r1234",
                           "R0000000A0",
                           "T000000002C0DE",
                           "t1230",
                           "rFFF0",
                           "t8000",
                           "t1239000000000000000000"};
    int         frames  = 0;
    for (const char *line : lines) {
        if (const std::optional<CanFrame> f = slcan_frame(line)) {
            EXPECT_EQ(slcan_line(*f), std::string(line) + "\r");
            frames++;
        }
    }
    EXPECT_EQ(frames, 8); // beyond 7FF, or nine octets
    const std::optional<CanFrame> lower = slcan_frame("T1abcdef02c0de");
    ASSERT_TRUE(lower);
    EXPECT_EQ(lower->id, 0x1ABCDEF0U);
    EXPECT_EQ(lower->data[1], 0xDE);
}

TEST_F(Slcan, EveryMalformedLineIsRefused)
{
    EXPECT_EQ(say("O\r"), "\r");
    for (const char *line : {"t",
                             "t1",
                             "t123",
                             "t12g0",
                             "t123g",
                             "t1231",
                             "t1231A",
                             "t1231AG",
                             "t1230A",
                             "t12321122"
                             "3",
                             "T1230",
                             "T200000000",
                             "T0000000",
                             "r12311A",
                             "R123",
                             "x",
                             "t 120",
                             "t-120",
                             "OO",
                             "C1",
                             "S",
                             "S9",
                             "S10",
                             "Z",
                             "Z2",
                             "M123",
                             "mFFFFFFF",
                             "FF",
                             "V1",
                             "s0014",
                             "A",
                             "t12+0",
                             "\x80"}) {
        EXPECT_EQ(say(std::string(line) + "\r"), "\a") << line;
    }
    EXPECT_EQ(hear(two), "");
}

TEST_F(Slcan, CommandsDependOnBeingOpen)
{
    for (const char *line : {"t1230", "T000001230", "r1230", "R000001230", "F", "C"}) {
        EXPECT_EQ(say(std::string(line) + "\r"), "\a") << line;
    }
    for (const char *line : {"S0", "S1", "S2", "S3", "S4", "S5", "S6", "S7", "S8", "Z1", "Z0",
                             "M00000000", "mFFFFFFFF", ""}) {
        EXPECT_EQ(say(std::string(line) + "\r"), "\r") << line;
    }
    EXPECT_EQ(say("m00000000\r"), "\a"); // a filter
    EXPECT_EQ(say("V\rv\rN\r"), "V1013\rv0101\rNSDRE\r");
    EXPECT_EQ(say("O\r"), "\r");
    for (const char *line : {"S6", "Z1", "M00000000", "mFFFFFFFF", "O", "L"}) {
        EXPECT_EQ(say(std::string(line) + "\r"), "\a") << line;
    }
    EXPECT_EQ(say("F\r"), "F00\r");
    EXPECT_EQ(say("C\rC\rL\r"), "\r\a\r");
    EXPECT_EQ(say("t1230\r"), "\a"); // it listens only
}

TEST_F(Slcan, FramesPassToTheOthersAndNotBack)
{
    SlcanChannel three(bus);
    EXPECT_EQ(say(one, "O\r") + say(two, "O\r") + say(three, "L\r"), "\r\r\r");
    EXPECT_EQ(say(one, "t1232A1b2\rT1234567F3010203\rr7FF4\r"), "z\rZ\rz\r");
    const std::string come = "t1232A1B2\rT1234567F3010203\rr7FF4\r";
    EXPECT_EQ(hear(two), come);
    EXPECT_EQ(hear(three), come);
    EXPECT_EQ(hear(one), "");
}

TEST_F(Slcan, AnotherRateDoesNotPass)
{
    EXPECT_EQ(say(one, "S6\rO\r") + say(two, "S5\rO\r"), "\r\r\r\r");
    EXPECT_EQ(say(one, "t1230\r"), "z\r");
    EXPECT_EQ(hear(two), "");
    for (int n = 0; n < 10; n++) {
        hear(two);
    }
    EXPECT_EQ(say(one, "F\rt1230\r"), "FA4\r\a"); // bus-off
    EXPECT_EQ(say(one, "C\rO\r") + say(two, "C\rS6\rO\r"), "\r\r\r\r\r");
    EXPECT_EQ(say(one, "F\rt1230\r"), "F00\rz\r");
    EXPECT_EQ(hear(two), "t1230\r");
}

TEST_F(Slcan, TimeStampsWrapAfterAMinute)
{
    EXPECT_EQ(say(one, "O\r") + say(two, "Z1\rO\r"), "\r\r\r");
    say(one, "t1231AA\r");
    EXPECT_EQ(hear(two, 61.5), "t1231AA05DC\r");
}

TEST_F(Slcan, LinesComeInAnyPieces)
{
    const std::string text =
        "\r\rC\rS6\rO\rt1232A1B2\r\nT000001232A1B2\nt12\r" + std::string(500, 't') + "\rV\r";
    const std::string want = say(text);
    EXPECT_EQ(want, "\r\r\a\r\rz\r\a\aV1013\r"); // a line feed belongs to no line
    std::mt19937 r(1);
    for (int run = 0; run < 50; run++) {
        say("C\r");
        std::string got;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t n = 1 + r() % 9U;
            got += say(text.substr(at, n));
            at += n;
        }
        EXPECT_EQ(got, want);
    }
}

TEST_F(Slcan, AnOverrunIsSaidOnce)
{
    EXPECT_EQ(say(one, "S8\rO\r") + say(two, "S8\rO\r"), "\r\r\r\r");
    for (int n = 0; n < 5000; n++) {
        ASSERT_EQ(say(one, "t1230\r"), "z\r");
        for (int passes = 0; passes < 12; passes++) {
            now += 1500;
            bus.pass(now);
        }
    }
    EXPECT_EQ(say(two, "F\rF\r"), "F08\rF00\r");
}

TEST_F(Slcan, NonsenseIsSurvived)
{
    std::mt19937 r(2);
    for (int n = 0; n < 3000; n++) {
        std::string text;
        for (unsigned left = static_cast<unsigned>(r() % 40U); left > 0U; left--) {
            text.push_back("tTrRSOLCVvNFZMm0123456789ABCDEFabcdef\r\n\a "[r() % 41U]);
        }
        say(text);
        hear(one);
    }
    say("\rC\r");
    EXPECT_EQ(say("V\r"), "V1013\r");
}

} // namespace
