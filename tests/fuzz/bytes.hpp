// SPDX-License-Identifier: MIT
/// An input taken apart: what is missing at its end reads as zero.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace fuzz {

class Bytes {
public:
    Bytes(const std::uint8_t *data, std::size_t size) : at_(data), left_(size) {}

    bool any() const
    {
        return left_ > 0;
    }
    std::uint8_t octet()
    {
        if (left_ == 0) {
            return 0;
        }
        left_--;
        return *at_++;
    }
    std::uint32_t word()
    {
        std::uint32_t x = 0;
        for (int i = 0; i < 4; i++) {
            x = (x << 8) | octet();
        }
        return x;
    }
    /// Any bits at all.
    float number()
    {
        const std::uint32_t bits = word();
        float               x    = 0.0F;
        std::memcpy(&x, &bits, sizeof x);
        return x;
    }
    /// -1 .. 1
    float share()
    {
        return (static_cast<float>(octet()) - 127.5F) / 127.5F;
    }

private:
    const std::uint8_t *at_;
    std::size_t         left_;
};

} // namespace fuzz
