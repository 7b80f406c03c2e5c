// SPDX-License-Identifier: MIT
#include "stm32g431/can_module.hpp"

#include <algorithm>
#include <cmath>

#include "sil/f28335/clock.hpp"
#include "stm32g431/chip.hpp"

namespace iss::stm32g431 {
namespace {

using sdre::f28335::CanError;
using sdre::f28335::CanFrame;

constexpr std::uint32_t cccr  = 0x18;
constexpr std::uint32_t nbtp  = 0x1C;
constexpr std::uint32_t ecr   = 0x40;
constexpr std::uint32_t psr   = 0x44;
constexpr std::uint32_t ir    = 0x50;
constexpr std::uint32_t ie    = 0x54;
constexpr std::uint32_t ils   = 0x58;
constexpr std::uint32_t ile   = 0x5C;
constexpr std::uint32_t rxgfc = 0x80;
constexpr std::uint32_t rxf0s = 0x90;
constexpr std::uint32_t rxf0a = 0x94;
constexpr std::uint32_t txbc  = 0xC0;
constexpr std::uint32_t txfqs = 0xC4;
constexpr std::uint32_t txbrp = 0xC8;
constexpr std::uint32_t txbar = 0xCC;

constexpr std::uint32_t init        = 1U;
constexpr std::uint32_t change      = 2U; // CCE
constexpr std::uint32_t come        = 1U; // RF0N
constexpr std::uint32_t lost        = 4U; // RF0L
constexpr std::uint32_t queue       = 1U << 24U;
constexpr std::uint32_t clock_at    = 24; // FDCANSEL
constexpr std::uint32_t of_bus      = 2;  // PCLK1
constexpr std::uint32_t timing_0    = 0x06000A03;
constexpr std::uint32_t ccipr       = 0x88;
constexpr std::uint32_t keeps       = 3; // frames in FIFO 0, and buffers to send
constexpr std::uint32_t element     = 72;
constexpr std::uint32_t filters     = 0;
constexpr std::uint32_t fifo        = 0xB0;
constexpr std::uint32_t buffers     = 0x278;
constexpr std::uint32_t id_at       = 18;
constexpr std::uint32_t id_bits     = 0x7FF;
constexpr std::uint32_t length_at   = 16;
constexpr std::uint32_t extended    = 1U << 30U;
constexpr std::uint32_t remote      = 1U << 29U;
constexpr int           join_bits   = 11;
constexpr int           return_bits = 129 * 11;

bool is_configuration(std::uint32_t offset)
{
    return offset == nbtp || offset == rxgfc || offset == txbc;
}

} // namespace

CanModule::CanModule(Core &core, const Rcc &rcc, const Gpio &port_a, const Gpio &port_b,
                     const Gpio &port_c)
    : Registers(core, "FDCAN1", 0x400), rcc_(rcc), port_a_(port_a), port_b_(port_b),
      port_c_(port_c), memory_(core, *this)
{
}

CanModule::~CanModule()
{
    if (bus_ != nullptr) {
        bus_->disconnect();
    }
}

void CanModule::connect(sdre::f28335::CanBus &bus)
{
    bus_        = &bus;
    zero_cycle_ = core().cycles();
    bus.connect(*this);
}

void CanModule::reset()
{
    Registers::reset();
    memory_.reset();
    at(cccr) = init;
    at(nbtp) = timing_0;
    counters_.reset();
    mode_    = Mode::configuration;
    leaves_  = false;
    busy_    = false;
    bus_off_ = false;
    sending_ = -1;
    pending_ = 0;
    held_    = 0;
    got_     = 0;
}

// -- registers --

void CanModule::Memory::on_write(std::uint32_t offset, std::uint32_t value)
{
    const std::uint32_t n = (offset - buffers) / element;
    if (offset >= buffers && n < keeps && (module_.pending_ >> n & 1U) != 0U) {
        find("a frame is changed while it waits to be sent");
    }
    at(offset) = value;
}

std::uint32_t CanModule::on_read(std::uint32_t offset)
{
    if (offset == psr) {
        return (counters_.passive() ? 1U << 5U : 0U) | (counters_.warning() ? 1U << 6U : 0U) |
               (bus_off_ ? 1U << 7U : 0U);
    }
    if (offset == ecr) {
        return static_cast<std::uint32_t>(std::min(counters_.transmit(), 255)) |
               static_cast<std::uint32_t>(std::min(counters_.receive(), 127)) << 8U;
    }
    if (offset == rxf0s) {
        const std::uint32_t put = (got_ + held_) % keeps;
        return held_ | got_ << 8U | put << 16U | (held_ == keeps ? 1U << 24U : 0U);
    }
    if (offset == txfqs) {
        std::uint32_t free = 0;
        std::uint32_t left = 0;
        for (std::uint32_t n = keeps; n-- > 0U;) {
            const bool is_free = (pending_ >> n & 1U) == 0U;
            free               = is_free ? n : free;
            left += is_free ? 1U : 0U;
        }
        return left | free << 16U | (left == 0U ? 1U << 21U : 0U);
    }
    return offset == txbrp ? pending_ : at(offset);
}

void CanModule::on_write(std::uint32_t offset, std::uint32_t value)
{
    if (offset == cccr) {
        write_control(value);
    } else if (offset == ir) {
        at(ir) &= ~value;
    } else if (offset == rxf0a) {
        acknowledge(value);
    } else if (offset == txbar) {
        request(value);
    } else if (is_configuration(offset) && at(cccr) != (init | change)) {
        find("configured without INIT and CCE");
    } else if (offset == txbc && (value & queue) == 0U) {
        find("the model has the transmit queue only");
    } else {
        at(offset) = value;
    }
}

void CanModule::write_control(std::uint32_t value)
{
    if ((value & change) != 0U && (at(cccr) & init) == 0U) {
        find("CCE without INIT");
    }
    if ((value & init) == 0U) {
        at(cccr) = 0;
        if (mode_ == Mode::configuration) {
            mode_       = Mode::joining;
            waits_from_ = bus_ != nullptr ? bus_->recessive_ticks(ticks()) : 0;
        }
        leaves_ = false;
    } else if (mode_ == Mode::configuration) {
        const bool begins = (value & change) != 0U && (at(cccr) & change) == 0U;
        at(cccr)          = init | (value & change);
        if (begins) {
            configure();
        }
    } else if (busy_) {
        leaves_ = true; // INIT reads 1 once the frame is over
    } else {
        mode_    = Mode::configuration;
        at(cccr) = init;
    }
}

/// CCE sets what counts back.
void CanModule::configure()
{
    pending_ = 0;
    held_    = 0;
    got_     = 0;
}

void CanModule::request(std::uint32_t asked)
{
    if ((asked & pending_) != 0U) {
        find("a buffer is requested again before it is sent");
    }
    if ((asked >> keeps) != 0U) {
        find("there are three transmit buffers");
    }
    if ((at(cccr) & change) == 0U) {
        pending_ |= asked & ((1U << keeps) - 1U);
    }
}

void CanModule::acknowledge(std::uint32_t index)
{
    const std::uint32_t count = (index + keeps - got_) % keeps + 1U;
    if (count > held_) {
        find("a frame is acknowledged that FIFO 0 does not hold");
        return;
    }
    held_ -= count;
    got_ = (got_ + count) % keeps;
}

bool CanModule::interrupts() const
{
    return (at(ir) & at(ie) & ~at(ils)) != 0U && (at(ile) & 1U) != 0U;
}

// -- bus --

std::int64_t CanModule::ticks() const
{
    const auto since = static_cast<double>(core().cycles() - zero_cycle_);
    return static_cast<std::int64_t>(since * (sdre::f28335::tick_Hz / core_Hz));
}

std::int64_t CanModule::bits(int count) const
{
    const double rate_Hz = configured_Hz();
    return rate_Hz > 0.0 ? std::llround(count * sdre::f28335::tick_Hz / rate_Hz) : 0;
}

bool CanModule::is_connected() const
{
    constexpr unsigned function = 9;
    return port_a_.is_function(11, function) && port_b_.is_function(9, function) &&
           !port_c_.output(11); // the transceiver is on
}

double CanModule::configured_Hz() const
{
    const std::uint32_t t      = at(nbtp);
    const std::uint32_t quanta = 3U + (t & 0x7FU) + (t >> 8U & 0xFFU);
    const std::uint32_t scale  = 1U + (t >> 16U & 0x1FFU);
    const bool          clock  = (rcc_.at(ccipr) >> clock_at & 3U) == of_bus;
    return clock ? core_Hz / (scale * quanta) : 0.0;
}

double CanModule::bit_rate_Hz() const
{
    return mode_ == Mode::running && !bus_off_ && is_connected() ? configured_Hz() : 0.0;
}

bool CanModule::wants() const
{
    return pending_ != 0U;
}

/// The lowest identifier, of equal ones the lowest buffer.
int CanModule::first_pending() const
{
    int           first = -1;
    std::uint32_t best  = UINT32_MAX;
    for (std::uint32_t n = 0; n < keeps; n++) {
        const std::uint32_t id = memory_.at(buffers + n * element) >> id_at & id_bits;
        if ((pending_ >> n & 1U) != 0U && id < best) {
            best  = id;
            first = static_cast<int>(n);
        }
    }
    return first;
}

CanFrame CanModule::frame_of(int buffer) const
{
    const std::uint32_t at = buffers + static_cast<std::uint32_t>(buffer) * element;
    CanFrame            f;
    f.id       = memory_.at(at) >> id_at & id_bits;
    f.extended = (memory_.at(at) & extended) != 0U;
    f.remote   = (memory_.at(at) & remote) != 0U;
    f.length   = static_cast<std::uint8_t>(std::min(memory_.at(at + 4U) >> length_at & 15U, 8U));
    for (unsigned n = 0; n < 8U; n++) {
        f.data[n] = static_cast<std::uint8_t>(memory_.at(at + 8U + (n & 4U)) >> (8U * (n & 3U)));
    }
    return f;
}

std::optional<CanFrame> CanModule::next()
{
    const int n = first_pending();
    return n >= 0 ? std::optional<CanFrame>(frame_of(n)) : std::nullopt;
}

void CanModule::began(bool sends)
{
    busy_    = true;
    sending_ = sends ? first_pending() : -1;
}

void CanModule::sent()
{
    counters_.sent();
    pending_ &= ~(1U << static_cast<unsigned>(std::max(sending_, 0)));
    busy_ = false;
}

std::uint32_t CanModule::is_accepted(std::uint32_t id) const
{
    const std::uint32_t count = at(rxgfc) >> 16U & 31U;
    for (std::uint32_t n = 0; n < count; n++) {
        const std::uint32_t f     = memory_.at(filters + 4U * n);
        const bool          range = f >> 30U == 0U;
        if (range && (f >> 27U & 7U) == 1U && id >= (f >> 16U & id_bits) && id <= (f & id_bits)) {
            return f;
        }
    }
    return 0;
}

void CanModule::received(const CanFrame &frame)
{
    counters_.received();
    busy_ = false;
    if (frame.extended || frame.remote || is_accepted(frame.id) == 0U) {
        return;
    }
    if (held_ == keeps) {
        at(ir) |= lost;
        return;
    }
    const std::uint32_t to = fifo + (got_ + held_) % keeps * element;
    memory_.at(to)         = frame.id << id_at;
    memory_.at(to + 4U)    = std::uint32_t{frame.length} << length_at;
    memory_.at(to + 8U)    = 0;
    memory_.at(to + 12U)   = 0;
    for (unsigned n = 0; n < frame.length; n++) {
        memory_.at(to + 8U + (n & 4U)) |= std::uint32_t{frame.data[n]} << (8U * (n & 3U));
    }
    held_++;
    at(ir) |= come;
}

void CanModule::failed(CanError error, bool sends)
{
    counters_.failed(error, sends);
    busy_ = false;
    if (counters_.bus_off() && !bus_off_) {
        bus_off_ = true;
        mode_    = Mode::configuration; // until the program clears INIT
        at(cccr) = init;
    }
}

void CanModule::update_mode()
{
    if (leaves_ && !busy_) {
        leaves_  = false;
        mode_    = Mode::configuration;
        at(cccr) = init;
    }
    const std::int64_t quiet = bus_->recessive_ticks(ticks()) - waits_from_;
    if (mode_ == Mode::joining && quiet >= bits(bus_off_ ? return_bits : join_bits)) {
        mode_ = Mode::running;
        if (bus_off_) {
            bus_off_ = false;
            counters_.reset();
        }
    }
}

void CanModule::step()
{
    if (bus_ != nullptr) {
        bus_->pass(ticks());
        update_mode();
    }
}

std::uint64_t CanModule::due() const
{
    if (bus_ == nullptr) {
        return UINT64_MAX;
    }
    const std::int64_t now  = ticks();
    std::int64_t       next = bus_->ticks_to_event(now);
    if (mode_ == Mode::joining && bus_->idle()) {
        const std::int64_t quiet = bus_->recessive_ticks(now) - waits_from_;
        const std::int64_t left =
            std::max<std::int64_t>(0, bits(bus_off_ ? return_bits : join_bits) - quiet);
        next = next < 0 ? left : std::min(next, left);
    }
    if (next < 0) {
        return UINT64_MAX;
    }
    const double cycles = static_cast<double>(next + 1) * (core_Hz / sdre::f28335::tick_Hz);
    return core().cycles() + static_cast<std::uint64_t>(std::ceil(cycles));
}

} // namespace iss::stm32g431
