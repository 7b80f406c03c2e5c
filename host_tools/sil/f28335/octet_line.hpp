// SPDX-License-Identifier: MIT
/// The far end of a serial line.
#pragma once

#include <cstdint>

namespace sdre::f28335 {

class OctetLine {
public:
    OctetLine()                             = default;
    OctetLine(const OctetLine &)            = delete;
    OctetLine &operator=(const OctetLine &) = delete;
    virtual ~OctetLine()                    = default;

    /// Octets for the device, one after the other from now on.
    virtual void send(std::uint16_t octet) = 0;
    /// An octet that the device has sent; -1: none.
    virtual int take() = 0;
};

} // namespace sdre::f28335
