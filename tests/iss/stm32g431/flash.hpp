// SPDX-License-Identifier: MIT
/// The flash and its interface: 64 bits with their code are written once, pages of 2 KB are erased.
#pragma once

#include <random>
#include <set>
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
    /// Bits beyond correction are an NMI, and read as anything.
    void before_read(std::uint32_t address) override;

    /// The power fails at this cycle. Each 64 bits that are erased or written then have what was there, what was to come, or
    /// bits beyond correction.
    void        cut_power(std::uint64_t cycle);
    std::size_t torn() const ///< 64 bits beyond correction
    {
        return torn_.size();
    }
    int writes() const ///< of 64 bits, begun since the start
    {
        return writes_;
    }
    int torn_reads() const ///< since the start
    {
        return torn_reads_;
    }

protected:
    void on_write(std::uint32_t offset, std::uint32_t value) override;

private:
    void erase(std::uint32_t page);
    void begin(std::uint32_t address, const std::vector<std::uint8_t> &before,
               std::uint64_t cycles);
    void fail(std::uint32_t error, const char *why);

    std::uint32_t             keys_    = 0;
    std::uint32_t             half_at_ = 0; // of 64 bits that are half written
    std::uint32_t             work_at_ = 0; // what was erased or written last
    std::vector<std::uint8_t> before_;      // its octets
    std::uint64_t             ends_ = 0;    // at this cycle
    std::set<std::uint32_t>   torn_;
    int                       writes_     = 0;
    int                       torn_reads_ = 0;
    std::mt19937              random_;
};

} // namespace iss::stm32g431
