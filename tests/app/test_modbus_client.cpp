// SPDX-License-Identifier: MIT
/// The application, ticking beside a client that was written by others: libmodbus, over a pseudo-terminal.
#include <fcntl.h>
#include <modbus.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "fake_board.h"

extern "C" {
#include "app.h"
#include "board_config.h"
#include "gain_tables.h"
}

namespace {

using namespace std::chrono_literals;

constexpr int address = 1;

// Input and holding registers, from docs/modbus.md.
constexpr int input_statusword  = 0;
constexpr int input_error_code  = 2;
constexpr int input_mode        = 3;
constexpr int input_fault       = 4;
constexpr int input_drive_fault = 5;
constexpr int input_conditions  = 7;
constexpr int input_dc_link     = 26;
constexpr int input_first_fault = 45;
constexpr int input_count       = 62;
constexpr int holding_control   = 0;
constexpr int holding_speed     = 2;
constexpr int holding_rpm       = 6; // in one register

// Control words of CiA 402.
constexpr int shut_down   = 6;
constexpr int enable      = 15;
constexpr int fault_reset = 128;

constexpr int mode_ready = 2;
constexpr int mode_run   = 4;
constexpr int mode_fault = 5;

/// Both ends of a pseudo-terminal; the server's does not block.
class Terminal {
public:
    Terminal() : server_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK))
    {
        if (server_ < 0 || grantpt(server_) != 0 || unlockpt(server_) != 0) {
            throw std::runtime_error("no pseudo-terminal");
        }
        client_ = ptsname(server_);
    }
    ~Terminal()
    {
        close(server_);
    }
    Terminal(const Terminal &)            = delete;
    Terminal &operator=(const Terminal &) = delete;

    int server() const
    {
        return server_;
    }
    const char *client() const
    {
        return client_.c_str();
    }

private:
    int         server_;
    std::string client_;
};

/// Ticks and background by turns, as fast as one tick per 100 us, in a thread of their own. The board may be
/// changed through at(), between two ticks.
class Server {
public:
    explicit Server(int terminal) : terminal_(terminal)
    {
        fake_board_reset();
        if (app_init(&board_config, &gain_tables_drive) != CTL_OK) {
            throw std::runtime_error("the application refuses its constants");
        }
        for (int n = 0; n < 2000; n++) { // past the calibration
            pass();
        }
        fake_board.sample.index_seen = true;
        pass();
        fake_board.sample.index_seen = false;
        thread_                      = std::thread([this] { run(); });
    }
    ~Server()
    {
        stop_ = true;
        thread_.join();
    }
    Server(const Server &)            = delete;
    Server &operator=(const Server &) = delete;

    /// Runs `change` between two ticks and returns after a few more.
    void at(std::function<void()> change)
    {
        change_  = std::move(change);
        pending_ = true;
        while (pending_) {
            std::this_thread::sleep_for(1ms);
        }
        std::this_thread::sleep_for(5ms);
    }
    bool gate() const
    {
        return gate_;
    }

private:
    static void pass()
    {
        app_tick();
        app_background();
    }
    void exchange() const
    {
        std::array<unsigned char, 64> octets{};
        const ssize_t                 got = read(terminal_, octets.data(), octets.size());
        for (ssize_t i = 0; i < got; i++) {
            const int octet = octets.at(static_cast<std::size_t>(i));
            fake_board_receive(&octet, 1);
        }
        for (int octet = fake_board_sent(); octet >= 0; octet = fake_board_sent()) {
            const auto one = static_cast<unsigned char>(octet);
            while (write(terminal_, &one, 1) != 1 && !stop_) {
                std::this_thread::sleep_for(1ms);
            }
        }
    }
    void run()
    {
        while (!stop_) {
            if (pending_) {
                change_();
                pending_ = false;
            }
            exchange();
            pass();
            gate_ = fake_board.gate;
            std::this_thread::sleep_for(100us);
        }
    }

    int                   terminal_;
    std::function<void()> change_;
    std::atomic<bool>     pending_{false};
    std::atomic<bool>     stop_{false};
    std::atomic<bool>     gate_{false};
    std::thread           thread_;
};

class ModbusClient : public testing::Test {
protected:
    void SetUp() override
    {
        client_ = modbus_new_rtu(terminal_.client(), 115200, 'E', 8, 1);
        ASSERT_NE(client_, nullptr);
        ASSERT_EQ(modbus_set_slave(client_, address), 0);
        ASSERT_EQ(modbus_set_response_timeout(client_, 2, 0), 0); // a loaded machine
        ASSERT_EQ(modbus_connect(client_), 0) << modbus_strerror(errno);
    }
    void TearDown() override
    {
        if (client_ != nullptr) {
            modbus_close(client_);
            modbus_free(client_);
        }
    }
    int input(int number)
    {
        std::uint16_t value = 0;
        EXPECT_EQ(modbus_read_input_registers(client_, number, 1, &value), 1)
            << modbus_strerror(errno);
        return value;
    }
    int holding(int number)
    {
        std::uint16_t value = 0;
        EXPECT_EQ(modbus_read_registers(client_, number, 1, &value), 1) << modbus_strerror(errno);
        return value;
    }
    /// 0.1 rad/s; the answer of libmodbus.
    int write_speed(std::int32_t tenths)
    {
        const auto                         both  = static_cast<std::uint32_t>(tenths);
        const std::array<std::uint16_t, 2> words = {static_cast<std::uint16_t>(both >> 16U),
                                                    static_cast<std::uint16_t>(both & 0xFFFFU)};
        return modbus_write_registers(client_, holding_speed, 2, words.data());
    }
    std::int32_t speed()
    {
        std::array<std::uint16_t, 2> words{};
        EXPECT_EQ(modbus_read_registers(client_, holding_speed, 2, words.data()), 2)
            << modbus_strerror(errno);
        return static_cast<std::int32_t>((static_cast<std::uint32_t>(words[0]) << 16U) | words[1]);
    }
    void write(int number, std::uint16_t value)
    {
        EXPECT_EQ(modbus_write_register(client_, number, value), 1) << modbus_strerror(errno);
    }
    /// The background hands a command over and the next tick acts on it: soon, but after the answer.
    void expect_mode(int mode)
    {
        for (int n = 0; n < 50 && input(input_mode) != mode; n++) {
            std::this_thread::sleep_for(1ms);
        }
        EXPECT_EQ(input(input_mode), mode);
    }
    /// State, from the bits of the status word.
    void expect_state(int state)
    {
        for (int n = 0; n < 50 && (input(input_statusword) & 0x6F) != state; n++) {
            std::this_thread::sleep_for(1ms);
        }
        EXPECT_EQ(input(input_statusword) & 0x6F, state);
    }
    void start()
    {
        write(holding_control, shut_down);
        expect_state(0x21);
        write(holding_control, enable);
        expect_mode(mode_run);
        EXPECT_EQ(input(input_statusword) & 0x6F, 0x27);
    }
    void expect_exception(int result, int exception)
    {
        EXPECT_EQ(result, -1);
        EXPECT_EQ(errno, exception) << modbus_strerror(errno);
    }

    Terminal  terminal_;
    Server    server_{terminal_.server()};
    modbus_t *client_ = nullptr;
};

} // namespace

TEST_F(ModbusClient, ReadsAllInputRegistersAtOnce)
{
    std::array<std::uint16_t, input_count> values{};
    ASSERT_EQ(modbus_read_input_registers(client_, 0, input_count, values.data()), input_count)
        << modbus_strerror(errno);
    EXPECT_EQ(values[input_mode], mode_ready);
    EXPECT_EQ(values[input_fault], 0);
    EXPECT_NEAR(values[input_dc_link], 2950, 1);
    EXPECT_EQ(values[8], 2); // referenced by the index
}

TEST_F(ModbusClient, StartsAndStopsTheDrive)
{
    EXPECT_EQ(write_speed(-123), 2);
    EXPECT_EQ(speed(), -123);
    write(holding_rpm, static_cast<std::uint16_t>(-300)); // 62.83 rad/s electrical
    EXPECT_EQ(speed(), -628);
    write(holding_rpm,
          0); // the fake board's motor never turns and has no current: that is all it can do
    start();
    EXPECT_TRUE(server_.gate());
    write(holding_control, shut_down);
    expect_mode(mode_ready);
    expect_state(0x21);
    EXPECT_FALSE(server_.gate());
}

TEST_F(ModbusClient, WritesSeveralRegistersAtOnce)
{
    const auto block = [this](std::uint16_t control, std::uint16_t speed) {
        const std::array<std::uint16_t, 4> values = {control, 3, 0, speed};
        ASSERT_EQ(modbus_write_registers(client_, 0, 4, values.data()), 4)
            << modbus_strerror(errno);
        EXPECT_EQ(this->speed(), speed);
    };
    block(shut_down, 500);
    expect_state(0x21);
    block(enable, 0);
    expect_mode(mode_run);
}

TEST_F(ModbusClient, ExchangesInOneRequest)
{
    const std::array<std::uint16_t, 2> wanted{0, 250};
    std::array<std::uint16_t, 4>       got{};
    ASSERT_EQ(
        modbus_write_and_read_registers(client_, holding_speed, 2, wanted.data(), 0, 4, got.data()),
        4)
        << modbus_strerror(errno);
    EXPECT_EQ(got, (std::array<std::uint16_t, 4>{0, 3, 0, 250}));
}

TEST_F(ModbusClient, TellsTheFirstFaultAndLeavesItByReset)
{
    start();
    server_.at([] { fake_board.sample.dc_link_cnt = 4000; });
    EXPECT_FALSE(server_.gate());
    expect_mode(mode_fault);
    EXPECT_EQ(input(input_fault), 10);
    EXPECT_EQ(input(input_drive_fault), 3);
    EXPECT_EQ(input(input_first_fault + 6), 4000);
    server_.at([] { fake_board.sample.dc_link_cnt = 2685; });

    EXPECT_EQ(input(input_error_code), 0x3200);
    EXPECT_EQ(input(input_statusword) & 0x4F, 0x08);
    write(holding_control, enable);
    expect_mode(mode_fault);
    write(holding_control, fault_reset | enable);
    expect_mode(mode_ready);
    expect_state(0x40); // and no start by itself
    EXPECT_EQ(input(input_first_fault), 10);
}

TEST_F(ModbusClient, RefusesWithTheExceptionThatSaysWhy)
{
    std::array<std::uint16_t, 125> values{};
    std::array<std::uint8_t, 8>    bits{};
    expect_exception(modbus_read_input_registers(client_, input_count, 1, values.data()),
                     EMBXILADD);
    expect_exception(modbus_read_registers(client_, 22, 2, values.data()), EMBXILADD);
    expect_exception(modbus_write_register(client_, 23, 0), EMBXILADD);
    expect_exception(modbus_write_register(client_, 1, 2), EMBXILVAL);
    expect_exception(modbus_write_register(client_, holding_speed, 1), EMBXILADD); // a half
    expect_exception(write_speed(11914), EMBXILVAL);
    values = {enable, 3, 0, 20000};
    expect_exception(modbus_write_registers(client_, 0, 4, values.data()), EMBXILVAL);
    expect_exception(modbus_read_bits(client_, 0, 1, bits.data()), EMBXILFUN);
    EXPECT_EQ(holding(holding_control), 0);
}

TEST_F(ModbusClient, ObeysABroadcastWithoutAnswering)
{
    ASSERT_EQ(modbus_set_slave(client_, MODBUS_BROADCAST_ADDRESS), 0);
    ASSERT_EQ(modbus_set_response_timeout(client_, 0, 200000), 0);
    expect_exception(write_speed(77), ETIMEDOUT);

    ASSERT_EQ(modbus_set_slave(client_, address), 0);
    ASSERT_EQ(modbus_set_response_timeout(client_, 2, 0), 0);
    EXPECT_EQ(speed(), 77);
}

TEST_F(ModbusClient, DoesNotAnswerForAnotherAddress)
{
    ASSERT_EQ(modbus_set_slave(client_, address + 1), 0);
    ASSERT_EQ(modbus_set_response_timeout(client_, 0, 200000), 0);
    expect_exception(write_speed(77), ETIMEDOUT);
}

TEST_F(ModbusClient, SilenceOpensTheBridge)
{
    start();
    for (int n = 0; n < 500 && server_.gate(); n++) {
        std::this_thread::sleep_for(20ms); // 2500 ticks of 100 us and more
    }
    EXPECT_FALSE(server_.gate());
    expect_mode(mode_ready);
    EXPECT_EQ(input(input_conditions) & 2, 2);
}
