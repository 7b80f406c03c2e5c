// SPDX-License-Identifier: MIT
/// Pins: output latches, directions, multiplexers of port A; inputs come from outside.
#pragma once

#include <cstdint>

namespace sdre::f28335 {

class Gpio {
public:
    Gpio();
    void sync();

    /// Level that the outside drives onto an input pin.
    void drive(int pin, bool high);
    /// Level of an output pin; a pin that is no output counts as low (the board pulls gates down).
    bool        output_high(int pin) const;
    static bool is_output(int pin);
    /// The pin belongs to the peripheral with this number (0: general purpose). Port A.
    static bool is_muxed(int pin, unsigned function);

private:
    std::uint32_t latch_[3]{};
    std::uint32_t presented_[3]{};
    std::uint32_t outside_[3]{};
};

} // namespace sdre::f28335
