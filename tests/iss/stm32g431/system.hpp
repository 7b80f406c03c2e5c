// SPDX-License-Identifier: MIT
/// Clock, power, pins, watchdog.
#pragma once

#include "stm32g431/registers.hpp"

namespace iss::stm32g431 {

class Rcc : public Registers {
public:
    explicit Rcc(Core &core);
    bool is_on(ClockGate gate) const;
    /// The crystal never starts.
    void break_crystal();
    /// The crystal stops. True if the clock watch is on, which tells.
    bool stop_crystal();
    void reset() override;
    void note_reset(std::uint32_t cause); ///< bit of CSR
    void lose_power();                    ///< which forgets the causes

protected:
    void on_write(std::uint32_t offset, std::uint32_t value) override;

private:
    bool          broken_ = false;
    std::uint32_t causes_ = 0; // outlive a reset
};

class Gpio : public Registers {
public:
    Gpio(Core &core, const std::string &name);
    void reset() override;
    /// Level from outside; pins without one are high.
    void drive(unsigned pin, bool high);
    bool output(unsigned pin) const;
    bool is_function(unsigned pin, unsigned function) const;

protected:
    std::uint32_t on_read(std::uint32_t offset) override;
    void          on_write(std::uint32_t offset, std::uint32_t value) override;

private:
    std::uint32_t outside_ = 0xFFFF;
};

/// CCM SRAM by its own address. SYSCFG_SWPR protects pages of 1 KB against writing, until the next reset.
class CcmMemory : public MemoryGuard {
public:
    CcmMemory(Core &core, const Registers &syscfg) : core_(core), syscfg_(syscfg) {}
    void before_write(std::uint32_t address, unsigned octets, std::uint32_t value) override;
    std::uint32_t protected_pages() const ///< one bit for each
    {
        return syscfg_.at(0x20);
    }

private:
    Core            &core_;
    const Registers &syscfg_;
};

constexpr std::uint32_t ccm_base   = 0x10000000;
constexpr std::uint32_t ccm_octets = 0x3000; // 10 KB, and what makes it a multiple of 4 KB

class Watchdog : public Registers {
public:
    explicit Watchdog(Core &core);
    void          reset() override; // the option bytes leave it to the program
    bool          is_out() const;
    std::uint64_t due() const; ///< cycle of its reset

protected:
    void on_write(std::uint32_t offset, std::uint32_t value) override;

private:
    bool          runs_     = false;
    bool          unlocked_ = false;
    std::uint64_t served_   = 0;
};

} // namespace iss::stm32g431
