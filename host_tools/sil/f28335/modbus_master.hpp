// SPDX-License-Identifier: MIT
/// A Modbus RTU master at the other end of the serial line. Its CRC is independent of the
/// firmware's.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sil/f28335/octet_line.hpp"

namespace sdre::f28335 {

std::uint16_t modbus_crc(const std::vector<std::uint8_t> &octets);

class ModbusMaster {
public:
    ModbusMaster(OctetLine &line, std::uint8_t server) : line_(line), server_(server) {}

    /// Function 6. One request at a time: see busy().
    void write(std::uint16_t address, std::uint16_t value);
    /// Function 16.
    void write(std::uint16_t first, const std::vector<std::uint16_t> &values);
    /// Function 4.
    void read_input(std::uint16_t address, std::uint16_t count);
    /// Takes the received octets; call it repeatedly.
    void poll();
    bool busy() const
    {
        return expected_ != 0;
    }
    /// Values of the last read; empty until its answer has come.
    const std::vector<std::uint16_t> &values() const
    {
        return values_;
    }
    int answers() const
    {
        return answers_;
    }
    /// Number of bad answers: CRC, exception, wrong length.
    int errors() const
    {
        return errors_;
    }

private:
    void send(std::vector<std::uint8_t> frame, std::size_t expected);
    void end_request()
    {
        expected_ = 0;
        got_.clear();
    }
    void take_answer();

    OctetLine                 &line_;
    std::uint8_t               server_;
    std::size_t                expected_ = 0; ///< octets of the answer; 0: no request is open
    std::vector<std::uint8_t>  request_;
    std::vector<std::uint8_t>  got_;
    std::vector<std::uint16_t> values_;
    int                        answers_ = 0;
    int                        errors_  = 0;
};

} // namespace sdre::f28335
