// SPDX-License-Identifier: MIT
// The image as a served drive: a client of others runs it over Modbus/TCP, and the control port has its bench.
#include <cstdlib>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"
#include "libmodbus_client.hpp"
#include "modbus_pdu.hpp"
#include "sil/serve/server.hpp"
#include "sil/served/control.hpp"
#include "stm32g431/image_scenario.hpp"
#include "stm32g431/served_image.hpp"
#include "stm32g431/still_circuit.hpp"

extern "C" {
#include "app_modes.h"
#include "app_registers.h"
}

using namespace iss::stm32g431;
using sdre::Octets;

namespace {

constexpr double ready_s   = 0.35; // boot 50 ms, offsets of the sensors 256 ms
constexpr double longest_s = 30.0; // simulated; the test ends it sooner
constexpr int    home_bit  = 4;    // docs/modbus.md, INPUTS_USED

const Program &program()
{
    static const Program p = read_program(ISS_IMAGE);
    return p;
}

const sdre::Drive &drive()
{
    static const sdre::Drive d = sdre::read_drive_file(ISS_DRIVE);
    return d;
}

/// A served image without a server, and its control port.
class IssBench : public ::testing::Test {
protected:
    nlohmann::json ask(const std::string &line)
    {
        return nlohmann::json::parse(sdre::control_answer(line, served, record, server));
    }
    void pass(double time_s)
    {
        for (const double end_s = served.time_s() + time_s; served.time_s() < end_s;) {
            served.period();
            bus.step(served, [this](const sdre::BusRequest &, const Octets &a) {
                answer = sdre::rtu_content(a).value_or(Octets{0});
            });
        }
    }
    /// PDU of the answer; empty: none.
    Octets request(const Octets &pdu)
    {
        Octets frame{1};
        frame.insert(frame.end(), pdu.begin(), pdu.end());
        answer.clear();
        bus.push({0, 0, 1, sdre::rtu_frame(frame)});
        for (int n = 0; n < 100 && answer.empty(); n++) {
            pass(1e-3);
        }
        return answer.size() < 2 ? Octets{} : Octets(answer.begin() + 1, answer.end());
    }
    int input(unsigned number)
    {
        return support::value_of(request(support::read_pdu(4, number)));
    }

    ServedImage        served{drive(), drive(), 1, program()};
    sdre::MotorRecord  record;
    sdre::ServerReport server;
    sdre::SerialBus    bus;
    Octets             answer;
};

} // namespace

TEST(IssServe, AClientReadsWhatItIsRunsItAndStopsIt)
{
    sdre::ServeOptions o;
    o.tcp               = 0;
    o.end_s             = longest_s;
    auto         image  = std::make_unique<ServedImage>(drive(), drive(), 1, program());
    ServedImage &served = *image;
    const double from   = served.turns();
    sdre::Server server(std::move(image), o);
    std::thread  thread([&] { server.run(); });
    {
        support::Client c(modbus_new_tcp("127.0.0.1", server.tcp_port()));
        EXPECT_NE(c.identity(0x83).find("b_g431b_esc1"), std::string::npos);
        EXPECT_NE(c.identity(0x80).find("m2310p_24v"), std::string::npos);
        EXPECT_TRUE(c.reaches(APP_REGISTERS_MODE, [](int m) { return m == APP_MODE_READY; }));
        EXPECT_EQ(c.try_write_both(APP_REGISTERS_SPEED, 3000), 2); // tenths of a rad/s
        c.write(APP_REGISTERS_CONTROLWORD, APP_CONTROL_SHUT_DOWN);
        c.write(APP_REGISTERS_CONTROLWORD, APP_CONTROL_ENABLE_OPERATION);
        EXPECT_TRUE(c.reaches(APP_REGISTERS_MODE, [](int m) { return m == APP_MODE_RUN; }));
        EXPECT_TRUE(c.reaches(APP_REGISTERS_SPEED_NOW + 1,
                              [](int tenths) { return std::abs(tenths - 3000) < 30; }));
        c.write(APP_REGISTERS_CONTROLWORD, APP_CONTROL_DISABLE_VOLTAGE);
        EXPECT_TRUE(c.reaches(APP_REGISTERS_MODE, [](int m) { return m == APP_MODE_READY; }));
    }
    server.stop();
    thread.join();
    EXPECT_GT(served.turns() - from, 0.5) << "an alignment is an eighth of a turn at most";
    EXPECT_FALSE(served.bridge_on());
    EXPECT_EQ(served.findings(), std::vector<std::string>{});
}

TEST_F(IssBench, TheControlPortRefusesWhatTheBoardLacks)
{
    for (const char *line :
         {"switch negative -3", "switch positive 3", "holding_brake 1 0.1 0.1"}) {
        EXPECT_NE(ask(line).value("error", "").find("has none"), std::string::npos) << line;
    }
    EXPECT_FALSE(ask("state").contains("error"));
}

TEST_F(IssBench, TheHomeSwitchIsAPinOfTheImage)
{
    pass(ready_s);
    ASSERT_TRUE(
        support::is_written(request(support::write_pdu(APP_REGISTERS_INPUTS_USED, {home_bit}))));
    EXPECT_EQ(input(APP_REGISTERS_DIGITAL_INPUTS) & home_bit, home_bit) << "open: active";
    ask("switch home 100 101");
    EXPECT_EQ(input(APP_REGISTERS_DIGITAL_INPUTS) & home_bit, 0);
    ask("switch home -100 101");
    EXPECT_EQ(input(APP_REGISTERS_DIGITAL_INPUTS) & home_bit, home_bit);
}

TEST_F(IssBench, AFaultOfTheProcessorEndsWithTheReset)
{
    pass(ready_s);
    for (const char *kind : {"tick_hung", "trigger_lost", "interrupt_masked"}) {
        const int before = served.resets();
        EXPECT_FALSE(ask(std::string("fault kind = \"") + kind + "\"").contains("error"));
        EXPECT_EQ(served.broken().size(), 1U) << kind;
        pass(ready_s);
        EXPECT_EQ(served.resets(), before + 1) << kind;
        EXPECT_TRUE(served.broken().empty()) << kind;
        EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_READY) << kind;
    }
}

TEST_F(IssBench, AfterAPowerCycleItStartsAgain)
{
    pass(ready_s);
    const double before_s = served.time_s();
    ask("fault kind = \"trigger_lost\"");
    ask("power_cycle");
    EXPECT_TRUE(served.broken().empty());
    EXPECT_GT(served.time_s(), before_s);
    pass(ready_s);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_READY);
    EXPECT_EQ(served.resets(), 0);
    EXPECT_EQ(served.findings(), std::vector<std::string>{});
}

TEST(IssPower, ACycleKeepsTheFlashAndNotTheRam)
{
    constexpr std::uint32_t store   = 0x0801C000;
    constexpr std::uint32_t unused  = 0x20006000; // between variables and stack
    constexpr std::uint32_t pattern = 0x12345678;
    StillCircuit            circuit;
    Chip                    chip(program().image, circuit);
    chip.run_for(0.01);
    chip.core().set_word(store, pattern);
    chip.core().set_word(unused, pattern);
    chip.power_cycle();
    EXPECT_EQ(chip.core().word(store), pattern);
    EXPECT_NE(chip.core().word(unused), pattern);
}

TEST(IssServe, AnImageOfAnotherDriveIsRefused)
{
    sdre::Drive other = drive();
    other.motor.pole_pairs += 1;
    EXPECT_THROW(ServedImage(other, other, 1, program()), sdre::InputError);
}
