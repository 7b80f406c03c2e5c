// SPDX-License-Identifier: MIT
/// The flash and its interface: 64 bits with their code are written once, pages of 2 KB are erased.
#pragma once

#include <vector>

#include "stm32g431/registers.hpp"

namespace iss::stm32g431 {

constexpr std::uint32_t flash_base   = 0x08000000;
constexpr std::uint32_t flash_octets = 0x20000;

class Flash : public Registers, public MemoryGuard {
public:
    explicit Flash(Core &core);
    void reset() override;
    void before_write(std::uint32_t address, unsigned octets, std::uint32_t value) override;

protected:
    void on_write(std::uint32_t offset, std::uint32_t value) override;

private:
    void erase(std::uint32_t page);
    void fail(std::uint32_t error, const char *why);

    std::uint32_t keys_    = 0;
    std::uint32_t half_at_ = 0; // of 64 bits that are half written
};

} // namespace iss::stm32g431
