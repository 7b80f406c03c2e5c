// SPDX-License-Identifier: MIT
#include "exceptions.hpp"

#include <algorithm>

namespace iss {
namespace {

// Offsets in the system control space.
constexpr std::uint32_t tick_csr       = 0x010;
constexpr std::uint32_t tick_rvr       = 0x014;
constexpr std::uint32_t tick_cvr       = 0x018;
constexpr std::uint32_t set_enable     = 0x100;
constexpr std::uint32_t clear_enable   = 0x180;
constexpr std::uint32_t set_pending_at = 0x200;
constexpr std::uint32_t clear_pending  = 0x280;
constexpr std::uint32_t active_bits    = 0x300;
constexpr std::uint32_t priorities     = 0x400;
constexpr std::uint32_t icsr           = 0xD04;
constexpr std::uint32_t vtor           = 0xD08;
constexpr std::uint32_t aircr          = 0xD0C;
constexpr std::uint32_t ccr            = 0xD14;
constexpr std::uint32_t shpr           = 0xD18; // of exceptions 4 to 15
constexpr std::uint32_t mpu_ctrl       = 0xD94;
constexpr std::uint32_t mpu_rbar       = 0xD9C;
constexpr std::uint32_t mpu_rasr       = 0xDA0;
constexpr std::uint32_t cpacr          = 0xD88;

constexpr std::uint32_t key_to_write = 0x05FA;
constexpr std::uint32_t key_to_read  = 0xFA05;
constexpr std::uint8_t  implemented  = 0xF0; // of a priority
constexpr int           idle         = 256;  // below every exception
constexpr int           pend_sv      = 14;
constexpr int           sys_tick     = 15;

bool within(std::uint32_t offset, std::uint32_t first, std::uint32_t octets)
{
    return offset >= first && offset < first + octets;
}

} // namespace

void Exceptions::reset(std::uint32_t vectors)
{
    pending_.fill(false);
    enabled_.fill(false);
    line_.fill(false);
    priority_.fill(0);
    std::fill_n(enabled_.begin(), first_interrupt, true);
    active_.clear();
    pending_count_ = 0;
    vectors_       = vectors;
    group_bits_    = 0;
    access_        = 0;
    control_       = 0;
    wants_reset_   = false;
    tick_control_  = 0;
    tick_reload_   = 0;
    others_.clear();
}

std::uint64_t Exceptions::tick_due() const
{
    const bool runs = (tick_control_ & 3U) == 3U && tick_reload_ > 0U;
    return runs ? tick_began_ + tick_reload_ + 1U : UINT64_MAX;
}

void Exceptions::tick()
{
    tick_began_ = cycles_;
    set_pending(sys_tick, true);
}

void Exceptions::set_pending(int exception, bool value)
{
    const auto n   = static_cast<std::size_t>(exception);
    const bool was = pending_.at(n) && enabled_.at(n);
    pending_.at(n) = value;
    pending_count_ += static_cast<int>(value && enabled_.at(n)) - static_cast<int>(was);
}

void Exceptions::pend(int exception)
{
    set_pending(exception, true);
}

void Exceptions::set_line(int interrupt, bool high)
{
    const int  exception = first_interrupt + interrupt;
    const auto n         = static_cast<std::size_t>(exception);
    if (high && !line_.at(n) && !is_active(exception)) {
        set_pending(exception, true);
    }
    line_.at(n) = high;
}

int Exceptions::group_of(int exception) const
{
    if (exception <= exception_hard_fault) {
        return exception - 4; // -2 NMI, -1 hard fault
    }
    const std::uint32_t sub = (1U << (group_bits_ + 1U)) - 1U;
    return static_cast<int>(priority_.at(static_cast<std::size_t>(exception)) & ~sub);
}

int Exceptions::running_group() const
{
    int group = idle;
    for (const int n : active_) {
        group = std::min(group, group_of(n));
    }
    return group;
}

int Exceptions::next(const Masks &masks) const
{
    int limit = running_group();
    if (masks.basepri != 0) {
        const std::uint32_t sub = (1U << (group_bits_ + 1U)) - 1U;
        limit                   = std::min(limit, static_cast<int>(masks.basepri & ~sub));
    }
    limit     = masks.primask ? std::min(limit, 0) : limit;
    limit     = masks.faultmask ? std::min(limit, -1) : limit;
    int found = 0;
    int best  = idle + 256;
    for (int n = 1; n < count; n++) {
        const auto at = static_cast<std::size_t>(n);
        // The group decides whether it may interrupt, the whole priority which of several comes first.
        const int urgency = n <= exception_hard_fault ? group_of(n) : priority_.at(at);
        if (pending_.at(at) && enabled_.at(at) && group_of(n) < limit && urgency < best) {
            found = n;
            best  = urgency;
        }
    }
    return found;
}

bool Exceptions::wakes(Masks masks) const
{
    masks.primask = false;
    return next(masks) != 0;
}

void Exceptions::enter(int exception)
{
    set_pending(exception, false);
    active_.push_back(exception);
}

void Exceptions::leave(int exception)
{
    active_.erase(std::remove(active_.begin(), active_.end(), exception), active_.end());
    if (line_.at(static_cast<std::size_t>(exception))) {
        set_pending(exception, true);
    }
}

bool Exceptions::is_active(int exception) const
{
    return std::find(active_.begin(), active_.end(), exception) != active_.end();
}

std::uint32_t Exceptions::vector_of(int exception) const
{
    return vectors_ + 4U * static_cast<std::uint32_t>(exception);
}

bool Exceptions::fpu_enabled() const
{
    return (access_ & 0x00F00000U) == 0x00F00000U;
}

bool Exceptions::wants_reset() const
{
    return wants_reset_;
}

std::uint32_t Exceptions::bits(const std::array<bool, count> &of, std::uint32_t word) const
{
    std::uint32_t value = 0;
    for (std::uint32_t n = 0; n < 32; n++) {
        const std::size_t at = first_interrupt + 32U * word + n;
        value |= at < of.size() && of.at(at) ? 1U << n : 0U;
    }
    return value;
}

std::uint32_t Exceptions::interrupt_state() const
{
    const Masks         none{false, false, 0};
    const std::uint32_t running = active_.empty() ? 0U : static_cast<std::uint32_t>(active_.back());
    return running | (static_cast<std::uint32_t>(next(none)) << 12U) |
           (pending_.at(sys_tick) ? 1U << 26U : 0U) | (pending_.at(pend_sv) ? 1U << 28U : 0U);
}

std::uint32_t Exceptions::read(std::uint32_t offset, unsigned octets)
{
    const std::uint32_t word  = (offset & 0x7FU) / 4U;
    std::uint32_t       value = 0;
    if (within(offset, set_enable, 16) || within(offset, clear_enable, 16)) {
        value = bits(enabled_, word);
    } else if (within(offset, set_pending_at, 16) || within(offset, clear_pending, 16)) {
        value = bits(pending_, word);
    } else if (within(offset, active_bits, 16)) {
        std::array<bool, count> active{};
        for (const int n : active_) {
            active.at(static_cast<std::size_t>(n)) = true;
        }
        value = bits(active, word);
    } else if (within(offset, priorities, interrupts) || within(offset, shpr, 12)) {
        const std::uint32_t first = offset >= shpr ? offset - shpr + 4U : offset - priorities + 16U;
        for (unsigned n = 0; n < octets; n++) {
            value |= static_cast<std::uint32_t>(priority_.at(first + n)) << (8U * n);
        }
    } else if (offset == icsr) {
        value = interrupt_state();
    } else if (offset == vtor) {
        value = vectors_;
    } else if (offset == aircr) {
        value = (key_to_read << 16U) | (group_bits_ << 8U);
    } else if (offset == ccr) {
        value = control_ | 0x200U; // frames are aligned to eight octets
    } else if (offset == cpacr) {
        value = access_;
    } else if (offset == tick_csr) {
        value = tick_control_;
    } else if (offset == tick_rvr) {
        value = tick_reload_;
    } else if (offset == tick_cvr) {
        value = tick_reload_ - static_cast<std::uint32_t>(cycles_ - tick_began_);
    } else {
        value = others_[offset];
    }
    return value;
}

void Exceptions::write_bits(std::uint32_t offset, std::uint32_t value)
{
    const std::uint32_t word = (offset & 0x7FU) / 4U;
    for (std::uint32_t n = 0; n < 32; n++) {
        const std::size_t at = first_interrupt + 32U * word + n;
        if (((value >> n) & 1U) == 0U || at >= pending_.size()) {
            continue;
        }
        const bool was = pending_.at(at);
        set_pending(static_cast<int>(at), false); // counted anew below
        if (offset < set_pending_at) {
            enabled_.at(at) = offset < clear_enable;
            set_pending(static_cast<int>(at), was);
        } else {
            set_pending(static_cast<int>(at), offset < clear_pending);
        }
    }
}

void Exceptions::write_control(std::uint32_t value)
{
    set_pending(pend_sv, (pending_.at(pend_sv) && (value & (1U << 27U)) == 0U) ||
                             (value & (1U << 28U)) != 0U);
    set_pending(sys_tick, (pending_.at(sys_tick) && (value & (1U << 25U)) == 0U) ||
                              (value & (1U << 26U)) != 0U);
}

void Exceptions::write(std::uint32_t offset, std::uint32_t value, unsigned octets)
{
    if (within(offset, set_enable, 16) || within(offset, clear_enable, 16) ||
        within(offset, set_pending_at, 16) || within(offset, clear_pending, 16)) {
        write_bits(offset, value);
    } else if (within(offset, priorities, interrupts) || within(offset, shpr, 12)) {
        const std::uint32_t first = offset >= shpr ? offset - shpr + 4U : offset - priorities + 16U;
        for (unsigned n = 0; n < octets; n++) {
            priority_.at(first + n) = static_cast<std::uint8_t>((value >> (8U * n)) & implemented);
        }
    } else if (offset == icsr) {
        write_control(value);
    } else if (offset == vtor) {
        vectors_ = value;
    } else if (offset == aircr && (value >> 16U) == key_to_write) {
        group_bits_  = (value >> 8U) & 7U;
        wants_reset_ = wants_reset_ || (value & 4U) != 0U;
    } else if (offset == ccr) {
        control_ = value;
    } else if (offset == cpacr) {
        access_ = value;
    } else if (offset == tick_csr) {
        tick_control_ = value;
    } else if (offset == tick_rvr) {
        tick_reload_ = value;
    } else if (offset == tick_cvr) {
        tick_began_ = cycles_;
    } else {
        others_[offset] = value;
        set_guard();
    }
}

void Exceptions::set_guard()
{
    const std::uint32_t rights = others_[mpu_rasr];
    const bool          on     = (others_[mpu_ctrl] & rights & 1U) != 0U;
    const bool          none   = (rights >> 24U & 7U) == 0U; // AP
    const std::uint32_t octets = 2U << (rights >> 1U & 31U);
    const std::uint32_t from   = others_[mpu_rbar] & ~(octets - 1U);
    guarded_                   = on && none ? std::pair(from, from + octets) : std::pair(0U, 0U);
}

} // namespace iss
