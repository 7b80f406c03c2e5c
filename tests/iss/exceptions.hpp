// SPDX-License-Identifier: MIT
/// Exceptions of a Cortex-M4: which is pending, which is active, and which comes next. Registers of the system control
/// space with them (ARMv7-M, B3.2 and B3.4). Four bits of priority.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "device.hpp"

namespace iss {

constexpr int exception_nmi        = 2;
constexpr int exception_hard_fault = 3;
constexpr int exception_sv_call    = 11;
constexpr int first_interrupt      = 16;
constexpr int interrupts           = 112; // whole words of registers

/// PRIMASK, BASEPRI and FAULTMASK of the core.
struct Masks {
    bool          primask;
    bool          faultmask;
    std::uint32_t basepri;
};

class Exceptions : public Device { // at E000E000h
public:
    /// @param cycles The count of the core; it is read whenever the time is needed.
    explicit Exceptions(const std::uint64_t &cycles) : cycles_(cycles) {}

    void reset(std::uint32_t vectors);

    void pend(int exception);
    /// The line of a peripheral. A high line is pending again after its handler.
    void set_line(int interrupt, bool high);

    std::uint64_t tick_due() const; ///< cycle at which SysTick counts to 0; UINT64_MAX: it stands
    void          tick();           ///< it has

    bool any_pending() const
    {
        return pending_count_ > 0;
    }
    /// The exception that is taken now; 0: none.
    int next(const Masks &masks) const;
    /// A sleeping core wakes: next() regardless of PRIMASK.
    bool wakes(Masks masks) const;
    void enter(int exception);
    void leave(int exception);

    bool          is_active(int exception) const;
    std::uint32_t vector_of(int exception) const; ///< address of its entry in the table
    bool          fpu_enabled() const;
    bool          wants_reset() const; ///< SYSRESETREQ

    /// Octets that no access may touch, by the region of the MPU that was set last: from and up to; equal: none. Other
    /// regions and other rights are not modelled.
    std::pair<std::uint32_t, std::uint32_t> guarded() const
    {
        return guarded_;
    }

    std::uint32_t read(std::uint32_t offset, unsigned octets) override;
    void          write(std::uint32_t offset, std::uint32_t value, unsigned octets) override;

private:
    static constexpr int count = first_interrupt + interrupts;

    int           group_of(int exception) const; ///< -2 .. 255, lower is more urgent
    int           running_group() const;
    void          set_pending(int exception, bool value);
    std::uint32_t bits(const std::array<bool, count> &of, std::uint32_t word) const;
    void          write_bits(std::uint32_t offset, std::uint32_t value);
    void          write_control(std::uint32_t value);
    void          set_guard();
    std::uint32_t interrupt_state() const;

    std::array<bool, count>                 pending_{};
    std::array<bool, count>                 enabled_{};
    std::array<bool, count>                 line_{};
    std::array<std::uint8_t, count>         priority_{};
    std::vector<int>                        active_;            // the running one last
    int                                     pending_count_ = 0; // of those that can be taken
    std::uint32_t                           vectors_       = 0;
    std::uint32_t                           group_bits_    = 0; // PRIGROUP
    std::uint32_t                           access_        = 0; // CPACR
    std::uint32_t                           control_       = 0; // CCR
    std::uint32_t                           tick_control_  = 0;
    std::uint32_t                           tick_reload_   = 0;
    std::uint64_t                           tick_began_    = 0;
    std::map<std::uint32_t, std::uint32_t>  others_; // registers without effect here
    const std::uint64_t                    &cycles_;
    std::pair<std::uint32_t, std::uint32_t> guarded_{0, 0};
    bool                                    wants_reset_ = false;
};

} // namespace iss
