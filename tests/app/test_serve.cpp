// SPDX-License-Identifier: MIT
// The served drive with a Modbus client of others: libmodbus, on a pseudo-terminal and over TCP.
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "../support/libmodbus_client.hpp"
#include "../support/temp_dir.hpp"
#include "common/errors.hpp"
#include "sil/serve/boot_rom.hpp"
#include "sil/serve/endpoints.hpp"
#include "sil/serve/server.hpp"
#include "sil/served/rtu_frame.hpp"
#include "sil/served/served_f28335.hpp"

extern "C" {
#include "app_modes.h"
#include "app_registers.h"
}

using namespace sdre;
using support::Client;

namespace {

constexpr double longest_s = 30.0; // simulated; the tests end it sooner

Drive shipped()
{
    return read_drive_file(SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml");
}

/// A server in a thread of its own, and its end.
class Served {
public:
    explicit Served(ServeOptions options)
        : server_(shipped(), 1, options), thread_([this] { server_.run(); })
    {
    }
    ~Served()
    {
        server_.stop();
        thread_.join();
    }
    const Server &server() const
    {
        return server_;
    }

private:
    Server      server_;
    std::thread thread_;
};

bool is_ready(int mode)
{
    return mode == APP_MODE_READY;
}

bool is_running(int mode)
{
    return mode == APP_MODE_RUN;
}

bool near_300(int tenths)
{
    return std::abs(tenths - 3000) < 30;
}

/// From power-up through an alignment to 300 rad/s and back.
void spin(Client &c)
{
    ASSERT_TRUE(c.reaches(APP_REGISTERS_MODE, is_ready));
    EXPECT_EQ(c.try_write_both(APP_REGISTERS_SPEED, 3000), 2);
    c.write(APP_REGISTERS_CONTROLWORD, APP_CONTROL_SHUT_DOWN);
    c.write(APP_REGISTERS_CONTROLWORD, APP_CONTROL_ENABLE_OPERATION);
    ASSERT_TRUE(c.reaches(APP_REGISTERS_MODE, is_running));
    EXPECT_TRUE(c.reaches(APP_REGISTERS_SPEED_NOW + 1, near_300));
    EXPECT_EQ(c.try_write_both(APP_REGISTERS_SPEED, 30000), -1); // beyond the largest command
    EXPECT_EQ(errno, EMBXILVAL);
    c.write(APP_REGISTERS_CONTROLWORD, APP_CONTROL_DISABLE_VOLTAGE);
    EXPECT_TRUE(c.reaches(APP_REGISTERS_MODE, is_ready));
}

} // namespace

TEST(Serve, SpinsForAClientOnAPseudoTerminal)
{
    const std::string path =
        (std::filesystem::temp_directory_path() /
         ("sdre-serve-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "-" +
          std::to_string(getpid())))
            .string();
    ServeOptions o;
    o.pty   = path;
    o.end_s = longest_s;
    {
        Served served(o);
        Client c(modbus_new_rtu(path.c_str(), 115200, 'N', 8, 1));
        spin(c);
    }
    EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(path)));
}

TEST(Serve, SpinsForAClientOverTcpWhileAnotherReads)
{
    ServeOptions o;
    o.tcp   = 0;
    o.end_s = longest_s;
    Served            served(o);
    const int         port = served.server().tcp_port();
    std::atomic<bool> done{false};
    std::thread       other([&] {
        Client reader(modbus_new_tcp("127.0.0.1", port));
        while (!done) {
            reader.input(APP_REGISTERS_MODE);
        }
    });
    {
        Client c(modbus_new_tcp("127.0.0.1", port));
        spin(c);
    }
    done = true;
    other.join();
}

// Made, then left by a run that was killed.
std::string dead_link_at(const std::string &path)
{
    const std::string target = "/dev/pts/4000000"; // above any kernel's limit
    std::filesystem::create_symlink(target, path);
    return target;
}

TEST(ServePath, LinkOfAKilledRunIsReplacedAndTheOwnOneRemoved)
{
    const support::TempDir dir;
    const std::string      path = dir / "drive";
    const std::string      dead = dead_link_at(path);
    {
        const PseudoTerminal p(path);
        EXPECT_NE(std::filesystem::read_symlink(path), dead);
    }
    EXPECT_FALSE(std::filesystem::is_symlink(path));
}

TEST(ServePath, AnothersLinkOrFileStays)
{
    const support::TempDir dir;
    const std::string      file   = dir.write("file", "text");
    const std::string      link   = dir / "link";
    const std::string      broken = dir / "broken";
    std::filesystem::create_symlink(file, link);
    std::filesystem::create_symlink(dir / "nothing", broken);
    for (const std::string &path : {file, link, broken}) {
        EXPECT_THROW(PseudoTerminal{path}, InputError) << path;
    }
    EXPECT_EQ(std::filesystem::read_symlink(link), file);
    EXPECT_TRUE(std::filesystem::is_symlink(broken));

    const std::string    live = dir / "live";
    const PseudoTerminal first(live);
    const auto           target = std::filesystem::read_symlink(live);
    EXPECT_THROW(PseudoTerminal{live}, InputError);
    EXPECT_EQ(std::filesystem::read_symlink(live), target);
}

TEST(ServePath, WhatHasTakenTheLinksPlaceStays)
{
    const support::TempDir dir;
    const std::string      path = dir / "drive";
    {
        const PseudoTerminal p(path);
        std::filesystem::remove(path);
        std::filesystem::create_symlink("/dev/null", path);
    }
    EXPECT_EQ(std::filesystem::read_symlink(path), "/dev/null");
}

TEST(ServePath, RunThatFailsLeavesTheLinkOfAKilledOne)
{
    const support::TempDir dir;
    ServeOptions           o;
    o.pty                   = dir / "drive";
    const std::string dead  = dead_link_at(o.pty);
    const Descriptor  taken = listen_on_loopback(0);
    o.tcp                   = port_of(taken);
    EXPECT_THROW(Server(shipped(), 1, o), InputError);
    EXPECT_EQ(std::filesystem::read_symlink(o.pty), dead);
}

TEST(ServeFrames, TcpRequestsComeInPieces)
{
    const Octets whole{0x12, 0x34, 0, 0, 0, 6, 1, 4, 0, 0, 0, 8};
    for (std::size_t cut = 0; cut < whole.size(); cut++) {
        bool   broken = false;
        Octets come(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut));
        EXPECT_FALSE(take_tcp_request(come, broken)) << cut;
        come.insert(come.end(), whole.begin() + static_cast<std::ptrdiff_t>(cut), whole.end());
        const auto request = take_tcp_request(come, broken);
        ASSERT_TRUE(request) << cut;
        EXPECT_FALSE(broken);
        EXPECT_EQ(request->transaction, 0x1234);
        EXPECT_EQ(request->unit_and_pdu, (Octets{1, 4, 0, 0, 0, 8}));
        EXPECT_TRUE(come.empty());
    }
}

TEST(ServeFrames, WhatIsNoTcpRequestIsBroken)
{
    for (Octets come :
         {Octets{0, 0, 0, 1, 0, 6}, Octets{0, 0, 0, 0, 0, 1}, Octets{0, 0, 0, 0, 1, 0}}) {
        bool broken = false;
        EXPECT_FALSE(take_tcp_request(come, broken));
        EXPECT_TRUE(broken);
    }
}

// The checksum of the protocol's own example: 01 04 00 00 00 08 F1 CC.
TEST(ServeFrames, ChecksumsAreMadeAndChecked)
{
    const Octets content{1, 4, 0, 0, 0, 8};
    Octets       frame = rtu_frame(content);
    EXPECT_EQ(frame[6], 0xF1);
    EXPECT_EQ(frame[7], 0xCC);
    EXPECT_EQ(rtu_content(frame), content);
    for (std::size_t n = 0; n < frame.size(); n++) {
        Octets wrong = frame;
        wrong[n] ^= 1U;
        EXPECT_FALSE(rtu_content(wrong)) << n;
    }
    EXPECT_FALSE(rtu_content({1, 4}));
    EXPECT_EQ(tcp_answer(0x1234, {1, 4, 0}), (Octets{0x12, 0x34, 0, 0, 0, 3, 1, 4, 0}));
}

namespace {

using Words = std::vector<std::uint16_t>;

/// The answers of the loader to "A" and to the octets of these words.
std::vector<int> answers(BootRom &rom, const Words &words)
{
    std::vector<int> all;
    const auto       tell = [&](std::uint8_t octet) {
        const auto answer = rom.answer(octet);
        all.push_back(answer ? *answer : -1);
    };
    tell('A');
    for (const std::uint16_t word : words) {
        tell(static_cast<std::uint8_t>(word & 0xFFU));
        tell(static_cast<std::uint8_t>(word >> 8U));
    }
    return all;
}

const Words header{0x08AA, 1, 2, 3, 4, 5, 6, 7, 8, 0x0000, 0x8001};

Words operator+(Words a, const Words &b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

} // namespace

TEST(BootRom, EveryOctetIsAnsweredAndTheBlocksArrive)
{
    BootRom     rom;
    const Words words =
        header + Words{2, 0, 0x8000, 0x56BF, 0x0006, 1, 0, 0x0001, 0xABCD, 1, 0, 0xFFFF, 7, 0};
    EXPECT_FALSE(rom.answer('B')); // the rate is not locked
    const std::vector<int> said = answers(rom, words);
    std::vector<int>       wanted{'A'};
    for (const std::uint16_t word : words) {
        wanted.push_back(word & 0xFF);
        wanted.push_back(word >> 8);
    }
    EXPECT_EQ(said, wanted);
    EXPECT_TRUE(rom.loaded());
    EXPECT_EQ(rom.entry(), 0x8001U);
    const std::map<std::uint32_t, std::uint16_t> memory{
        {0x8000, 0x56BF}, {0x8001, 0x0006}, {0x0001, 0xABCD}, {0xFFFF, 7}};
    EXPECT_EQ(rom.memory(), memory);
    EXPECT_EQ(rom.said(), "boot ROM: 4 words in RAM, entry 008001h");
    EXPECT_FALSE(rom.answer('A')); // the line is the program's
}

TEST(BootRom, TheStreamIsNotOverBeforeItsEnd)
{
    const Words words = header + Words{1, 0, 0x8001, 0, 0};
    for (std::size_t n = 0; n < words.size(); n++) {
        BootRom rom;
        answers(rom, Words(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(n)));
        EXPECT_FALSE(rom.over()) << n;
    }
}

TEST(BootRom, AnotherKeyStartsTheFlash)
{
    BootRom rom;
    answers(rom, {0x10AA, 0});
    EXPECT_TRUE(rom.over());
    EXPECT_FALSE(rom.loaded());
    EXPECT_NE(rom.said().find("another key"), std::string::npos);
}

TEST(BootRom, SaysWhatIsNoRamAndAnEmptyEntry)
{
    for (const std::uint16_t address : Words{0x0002, 0x004F, 0x0800, 0x7FFF}) {
        BootRom rom;
        answers(rom, header + Words{1, 0, address, 1, 0});
        EXPECT_NE(rom.said().find("1 words were for addresses that are no RAM"), std::string::npos);
        EXPECT_NE(rom.said().find("nothing was loaded at the entry"), std::string::npos);
    }
    BootRom rom;
    answers(rom, header + Words{2, 0, 0xFFFF, 1, 2, 0});
    EXPECT_NE(rom.said().find("1 words were"), std::string::npos);
    BootRom far;
    answers(far, header + Words{1, 1, 0x8001, 5, 0}); // 18001h
    EXPECT_TRUE(far.memory().empty());
    BootRom beyond;
    answers(beyond, {0x08AA, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0x8001, 1, 0, 0x8001, 5, 0});
    EXPECT_EQ(beyond.entry(), 0x18001U);
}
