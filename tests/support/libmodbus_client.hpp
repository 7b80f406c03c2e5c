// SPDX-License-Identifier: MIT
/// A Modbus client of others: libmodbus, with the checks of a test.
#pragma once

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <functional>
#include <string>

#include <gtest/gtest.h>
#include <modbus.h>
#include <poll.h>
#include <sys/socket.h>

namespace support {

class Client {
public:
    explicit Client(modbus_t *m) : m_(m)
    {
        modbus_set_slave(m_, 1);
        modbus_set_response_timeout(m_, 5, 0); // a sanitized build on a busy machine
        EXPECT_EQ(modbus_connect(m_), 0) << modbus_strerror(errno);
    }
    ~Client()
    {
        modbus_close(m_);
        modbus_free(m_);
    }
    Client(const Client &)            = delete;
    Client &operator=(const Client &) = delete;

    int input(int address)
    {
        std::uint16_t value = 0;
        EXPECT_EQ(modbus_read_input_registers(m_, address, 1, &value), 1) << modbus_strerror(errno);
        return value;
    }
    int try_write(int address, int value)
    {
        return modbus_write_register(m_, address, static_cast<std::uint16_t>(value));
    }
    void write(int address, int value)
    {
        EXPECT_EQ(try_write(address, value), 1) << modbus_strerror(errno);
    }
    /// 32 bits, the high word first.
    int try_write_both(int address, std::uint32_t value)
    {
        const std::array<std::uint16_t, 2> words{static_cast<std::uint16_t>(value >> 16U),
                                                 static_cast<std::uint16_t>(value & 0xFFFFU)};
        return modbus_write_registers(m_, address, 2, words.data());
    }
    /// An object of the device identification, over TCP: the whole answer as text. libmodbus does not have this function.
    std::string identity(std::uint8_t object)
    {
        const std::array<std::uint8_t, 11> request{0, 0, 0, 0, 0, 5, 1, 43, 14, 4, object};
        std::array<char, 300>              answer{};
        const int                          socket = modbus_get_socket(m_);
        EXPECT_EQ(send(socket, request.data(), request.size(), 0), 11);
        pollfd come{socket, POLLIN, 0};
        EXPECT_EQ(poll(&come, 1, 5000), 1);
        const ssize_t n = recv(socket, answer.data(), answer.size(), 0);
        return {answer.data(), static_cast<std::size_t>(std::max<ssize_t>(n, 0))};
    }
    /// Polls, which keeps the drive running, until the register has the value, or something has failed.
    bool reaches(int address, const std::function<bool(int)> &wanted)
    {
        for (int n = 0; n < 2000 && !::testing::Test::HasFailure(); n++) {
            if (wanted(input(address))) {
                return true;
            }
        }
        return false;
    }

private:
    modbus_t *m_;
};

} // namespace support
