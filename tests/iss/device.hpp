// SPDX-License-Identifier: MIT
/// Registers in the address space of the core.
#pragma once

#include <cstdint>

namespace iss {

class Device {
public:
    Device()                          = default;
    Device(const Device &)            = delete;
    Device &operator=(const Device &) = delete;
    virtual ~Device()                 = default;

    virtual std::uint32_t read(std::uint32_t offset, unsigned octets)                       = 0;
    virtual void          write(std::uint32_t offset, std::uint32_t value, unsigned octets) = 0;
};

} // namespace iss
