// SPDX-License-Identifier: MIT
#include "stm32g431/timers.hpp"

#include <cmath>

namespace iss::stm32g431 {
namespace {

constexpr std::uint32_t cr1  = 0x00;
constexpr std::uint32_t smcr = 0x08;
constexpr std::uint32_t sr   = 0x10;
constexpr std::uint32_t egr  = 0x14;
constexpr std::uint32_t ccer = 0x20;
constexpr std::uint32_t cnt  = 0x24;
constexpr std::uint32_t arr  = 0x2C;
constexpr std::uint32_t rcr  = 0x30;
constexpr std::uint32_t ccr1 = 0x34;
constexpr std::uint32_t ccr3 = 0x3C;
constexpr std::uint32_t ccr4 = 0x40;
constexpr std::uint32_t bdtr = 0x44;
constexpr std::uint32_t af1  = 0x60;

constexpr std::uint32_t run           = 1U;
constexpr std::uint32_t down          = 1U << 4U;
constexpr std::uint32_t moe           = 1U << 15U;
constexpr std::uint32_t lock_level    = 3U << 8U;
constexpr std::uint32_t break_on      = 1U << 12U;
constexpr std::uint32_t break_is_high = 1U << 13U;
constexpr std::uint32_t locked_bits =
    0xFFU | (3U << 10U) | (3U << 12U) | (15U << 16U); // by level 1
constexpr std::uint32_t break_flag  = 1U << 7U;
constexpr std::uint32_t all_outputs = 0x555U;

constexpr std::uint32_t index_flag     = 1U << 3U;
constexpr std::uint32_t latch_flag     = 1U << 4U;
constexpr std::uint32_t direction_flag = 1U << 21U;
constexpr std::uint32_t error_flag     = 1U << 23U;

constexpr double core_Hz = 170e6;

} // namespace

// -- TIM1 --

PwmTimer::PwmTimer(Core &core, const std::array<const Gpio *, 3> &ports)
    : Registers(core, "TIM1", 0x400), ports_(ports)
{
}

void PwmTimer::reset()
{
    Registers::reset();
    active_      = {};
    full_        = 0;
    runs_        = false;
    locked_      = false;
    repetitions_ = 0;
}

std::uint64_t PwmTimer::into() const
{
    const std::uint64_t passed = core().cycles() - began_;
    return full_ > 0 ? passed % (2U * static_cast<std::uint64_t>(full_)) : 0U;
}

bool PwmTimer::at_top() const
{
    return (ends_ & 1U) == 1U; // the last end that was passed
}

std::uint64_t PwmTimer::next_end() const
{
    return runs_ && full_ > 0 ? began_ + (ends_ + 1U) * static_cast<std::uint64_t>(full_)
                              : UINT64_MAX;
}

std::array<int, 3> PwmTimer::written_cnt() const
{
    return {static_cast<int>(at(ccr1)), static_cast<int>(at(ccr1 + 4U)),
            static_cast<int>(at(ccr1 + 8U))};
}

void PwmTimer::update()
{
    active_      = written_cnt();
    full_        = static_cast<int>(at(arr));
    repetitions_ = at(rcr);
}

bool PwmTimer::pass_end()
{
    ends_++;
    const bool updates = repetitions_ == 0U;
    if (updates) {
        update();
        at(sr) |= 1U;
    } else {
        repetitions_--;
    }
    return updates;
}

bool PwmTimer::outputs_are_connected() const
{
    return ports_[0]->is_function(8, 6) && ports_[0]->is_function(9, 6) &&
           ports_[0]->is_function(10, 6) && ports_[2]->is_function(13, 4) &&
           ports_[0]->is_function(12, 6) && ports_[1]->is_function(15, 4);
}

bool PwmTimer::enabled() const
{
    return (at(bdtr) & moe) != 0U && (at(ccer) & all_outputs) == all_outputs &&
           outputs_are_connected();
}

void PwmTimer::trip()
{
    if ((at(bdtr) & break_on) != 0U) {
        at(bdtr) &= ~moe;
        at(sr) |= break_flag;
    }
}

bool PwmTimer::breaks_at(std::uint32_t comparators) const
{
    const std::uint32_t connected = at(af1) >> 1U;
    const bool          high      = (comparators & connected) != 0U;
    return connected != 0U && high == ((at(bdtr) & break_is_high) != 0U);
}

void PwmTimer::set_break(bool active)
{
    break_ = active;
    if (active) {
        trip();
    }
}

double PwmTimer::dead_time_s() const
{
    const std::uint32_t code = at(bdtr) & 0xFFU;
    std::uint32_t       t    = code;
    if (code >= 0xE0U) {
        t = (32U + (code & 31U)) * 16U;
    } else if (code >= 0xC0U) {
        t = (32U + (code & 31U)) * 8U;
    } else if (code >= 0x80U) {
        t = (64U + (code & 63U)) * 2U;
    }
    return t / core_Hz;
}

std::uint32_t PwmTimer::on_read(std::uint32_t offset)
{
    if (offset == cnt || offset == cr1) {
        const std::uint64_t now   = into();
        const auto          full  = static_cast<std::uint64_t>(full_);
        const bool          falls = runs_ && now >= full;
        if (offset == cr1) {
            return (at(cr1) & ~down) | (falls ? down : 0U);
        }
        return static_cast<std::uint32_t>(runs_ ? (falls ? 2U * full - now : now) : at(cnt));
    }
    return at(offset);
}

void PwmTimer::write_break(std::uint32_t value)
{
    const std::uint32_t before = at(bdtr);
    std::uint32_t       now    = value;
    if (locked_ && ((value ^ before) & locked_bits) != 0U) {
        find("BDTR: dead time or break changed after the lock");
        now = (value & ~locked_bits) | (before & locked_bits);
    }
    locked_ = locked_ || (value & lock_level) != 0U;
    if ((now & moe) != 0U && (before & moe) == 0U) {
        if ((now & 0xFFU) == 0U) {
            find("the outputs are enabled without dead time");
        }
        if ((now & break_on) == 0U) {
            find("the outputs are enabled without break input");
        }
        if (!outputs_are_connected()) {
            find("the outputs are enabled, and a pin is not connected");
        }
        now = break_ ? now & ~moe : now;
    }
    at(bdtr) = now;
    core().stop(); // the circuit has to know
}

void PwmTimer::on_write(std::uint32_t offset, std::uint32_t value)
{
    if (offset == cr1) {
        if ((value & run) != 0U && !runs_) {
            runs_  = true;
            began_ = core().cycles();
            ends_  = 0;
            full_  = full_ > 0 ? full_ : static_cast<int>(at(arr));
        }
        at(cr1) = value;
        core().stop();
    } else if (offset == egr) {
        if ((value & 1U) != 0U) {
            update();
            at(sr) |= 1U;
        }
    } else if (offset == sr) {
        at(sr) &= value; // a zero clears
        if (break_) {
            at(sr) |= break_flag;
        }
    } else if (offset == bdtr) {
        write_break(value);
    } else {
        at(offset) = value;
    }
}

// -- TIM4 --

EncoderTimer::EncoderTimer(Core &core, const Gpio &port)
    : Registers(core, "TIM4", 0x400), port_(port)
{
}

std::uint32_t EncoderTimer::position(std::int64_t count) const
{
    const std::int64_t turn = static_cast<std::int64_t>(at(arr)) + 1;
    return static_cast<std::uint32_t>((((count - zero_) % turn) + turn) % turn);
}

void EncoderTimer::latch(const Shaft &shaft)
{
    if (!runs_) {
        last_ = shaft.count;
        return;
    }
    const bool connected = port_.is_function(6, 2) && port_.is_function(7, 2);
    if (!connected || (at(smcr) & 7U) != 3U) {
        zero_ += shaft.count - last_; // it counts nothing
    } else {
        for (const Edge &edge : shaft.edges) {
            at(sr) |= edge.direction != forward_ ? direction_flag : 0U;
            forward_ = edge.direction;
        }
    }
    last_    = shaft.count;
    at(ccr4) = position(shaft.count);
    at(sr) |= latch_flag | (shaft.phase_error ? error_flag : 0U);
    if (shaft.index && port_.is_function(8, 2)) {
        at(ccr3) = position(shaft.index_count);
        at(sr) |= index_flag;
    }
}

std::uint32_t EncoderTimer::on_read(std::uint32_t offset)
{
    return offset == cnt ? position(last_) : at(offset);
}

void EncoderTimer::on_write(std::uint32_t offset, std::uint32_t value)
{
    if (offset == cr1) {
        zero_ = (value & run) != 0U && !runs_ ? last_ : zero_;
        runs_ = (value & run) != 0U;
    }
    if (offset == sr) {
        at(sr) &= value;
    } else {
        at(offset) = value;
    }
}

// -- TIM2 --

EdgeTimer::EdgeTimer(Core &core) : Registers(core, "TIM2", 0x400) {}

void EdgeTimer::capture(std::uint64_t cycle)
{
    if ((at(cr1) & run) != 0U) {
        at(ccr1) = static_cast<std::uint32_t>(cycle - began_);
    }
}

std::uint32_t EdgeTimer::on_read(std::uint32_t offset)
{
    return offset == cnt ? static_cast<std::uint32_t>(core().cycles() - began_) : at(offset);
}

void EdgeTimer::on_write(std::uint32_t offset, std::uint32_t value)
{
    if (offset == cr1 && (value & run) != 0U && (at(cr1) & run) == 0U) {
        began_ = core().cycles();
    }
    at(offset) = value;
}

} // namespace iss::stm32g431
