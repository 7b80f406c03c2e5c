// SPDX-License-Identifier: MIT
/// The far end of the chip's serial line, for a Modbus client of the simulation.
#pragma once

#include "sil/f28335/octet_line.hpp"
#include "stm32g431/serial.hpp"

namespace iss::stm32g431 {

class SerialLine : public sdre::f28335::OctetLine {
public:
    explicit SerialLine(Serial &serial) : serial_(serial) {}

    void send(std::uint16_t octet) override
    {
        serial_.send(static_cast<std::uint8_t>(octet));
    }
    int take() override
    {
        return serial_.take();
    }

private:
    Serial &serial_;
};

} // namespace iss::stm32g431
