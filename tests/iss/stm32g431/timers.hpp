// SPDX-License-Identifier: MIT
/// TIM1 makes the gates' signals and the trigger, TIM4 counts the encoder, TIM2 keeps the time of its last edge.
#pragma once

#include <array>

#include "stm32g431/circuit.hpp"
#include "stm32g431/system.hpp"

namespace iss::stm32g431 {

/// Centre-aligned PWM of three legs. The counter is computed from the cycles.
class PwmTimer : public Registers {
public:
    PwmTimer(Core &core, const std::array<const Gpio *, 3> &ports);
    void reset() override;

    /// Cycle of the next end of the counter's way; UINT64_MAX: it does not run.
    std::uint64_t next_end() const;
    /// The counter is at an end: true with an update event. It loads what is preloaded.
    bool          pass_end();
    std::uint64_t last_end() const ///< cycle of the end that was passed last
    {
        return began_ + ends_ * static_cast<std::uint64_t>(full_);
    }
    /// The counter's top is where it is now.
    bool at_top() const;
    bool enabled() const; ///< the pins follow the PWM
    void trip();          ///< the break input
    void set_break(bool active);
    /// Whether the break acts with these outputs of the comparators, a bit each.
    bool breaks_at(std::uint32_t comparators) const;

    std::array<int, 3> on_cnt() const ///< active compare values
    {
        return active_;
    }
    std::array<int, 3> written_cnt() const; ///< those that the next update loads
    int                full_cnt() const
    {
        return full_;
    }
    double dead_time_s() const;

protected:
    std::uint32_t on_read(std::uint32_t offset) override;
    void          on_write(std::uint32_t offset, std::uint32_t value) override;

private:
    std::uint64_t into() const; ///< cycles since the counter was 0, of one period
    void          write_break(std::uint32_t value);
    void          update();
    bool          outputs_are_connected() const;

    std::array<const Gpio *, 3> ports_; // A, B, C
    std::uint64_t               began_       = 0;
    std::uint64_t               ends_        = 0; // passed
    std::uint32_t               repetitions_ = 0;
    std::array<int, 3>          active_{};
    int                         full_   = 0;
    bool                        runs_   = false;
    bool                        locked_ = false;
    bool                        break_  = false;
};

class EncoderTimer : public Registers {
public:
    EncoderTimer(Core &core, const Gpio &port);
    /// The trigger of TIM1, with what the shaft did since the one before.
    void latch(const Shaft &shaft);

protected:
    std::uint32_t on_read(std::uint32_t offset) override;
    void          on_write(std::uint32_t offset, std::uint32_t value) override;

private:
    std::uint32_t position(std::int64_t count) const;

    const Gpio  &port_;
    std::int64_t zero_    = 0;
    std::int64_t last_    = 0;
    int          forward_ = 1;
    bool         runs_    = false;
};

/// Counts cycles; the last edge of the encoder is in CCR1.
class EdgeTimer : public Registers {
public:
    explicit EdgeTimer(Core &core);
    void capture(std::uint64_t cycle);

protected:
    std::uint32_t on_read(std::uint32_t offset) override;
    void          on_write(std::uint32_t offset, std::uint32_t value) override;

private:
    std::uint64_t began_ = 0;
};

} // namespace iss::stm32g431
