// SPDX-License-Identifier: MIT
/// Words of a peripheral that keep what is written, unless the peripheral says otherwise.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core.hpp"
#include "device.hpp"

namespace iss::stm32g431 {

class Rcc;

/// Bit `bit` of the clock-enable register at this offset of RCC. Without it each access is a finding.
struct ClockGate {
    std::uint32_t offset = 0;
    unsigned      bit    = 0;
};

class Registers : public Device {
public:
    Registers(Core &core, std::string name, std::uint32_t octets)
        : core_(core), name_(std::move(name)), words_(octets / 4U)
    {
    }
    void gate_by(const Rcc &rcc, ClockGate gate)
    {
        rcc_  = &rcc;
        gate_ = gate;
    }
    virtual void reset()
    {
        words_.assign(words_.size(), 0U);
    }
    std::uint32_t read(std::uint32_t offset, unsigned octets) final;
    void          write(std::uint32_t offset, std::uint32_t value, unsigned octets) final;

    std::uint32_t &at(std::uint32_t offset)
    {
        return words_.at(offset / 4U);
    }
    std::uint32_t at(std::uint32_t offset) const
    {
        return words_.at(offset / 4U);
    }

protected:
    virtual std::uint32_t on_read(std::uint32_t offset)
    {
        return at(offset);
    }
    virtual void on_write(std::uint32_t offset, std::uint32_t value)
    {
        at(offset) = value;
    }
    void find(const std::string &what)
    {
        core_.find(name_ + ": " + what);
    }
    Core &core() const
    {
        return core_;
    }

private:
    bool is_clocked() const;

    Core                      &core_;
    std::string                name_;
    std::vector<std::uint32_t> words_;
    const Rcc                 *rcc_ = nullptr;
    ClockGate                  gate_;
};

} // namespace iss::stm32g431
