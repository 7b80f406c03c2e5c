// SPDX-License-Identifier: MIT
#include "stm32g431/chip.hpp"

#include <algorithm>

namespace iss::stm32g431 {
namespace {

constexpr std::uint32_t ram_base   = 0x20000000;
constexpr std::uint32_t ram_octets = 0x8000;

constexpr std::uint32_t cycle_counter = 4; // of the watch unit

// SYSCFG's block has the comparators; those of a, b and c.
constexpr std::array<std::uint32_t, 3> comparators{0x200, 0x204, 0x20C};
constexpr std::uint32_t                sees        = 1U << 30U;
constexpr std::uint32_t                inverted    = 1U << 15U;
constexpr std::uint32_t                dac_level_1 = 0x08;
constexpr std::uint32_t                dac_level_2 = 0x14;
constexpr double                       reference_V = 3.3;

constexpr int line_adc    = 18;
constexpr int line_can    = 21;
constexpr int line_serial = 38;

constexpr std::uint32_t by_program  = 1U << 28U;
constexpr std::uint32_t by_watchdog = 1U << 29U;

// Offsets of RCC.
constexpr std::uint32_t ahb2 = 0x4C;
constexpr std::uint32_t apb1 = 0x58;
constexpr std::uint32_t apb2 = 0x60;

} // namespace

// -- buses --

void Chip::Bus::add(std::uint32_t address, std::uint32_t octets, Device &device)
{
    places_.push_back({address, octets, &device});
}

const Chip::Bus::Place *Chip::Bus::find(std::uint32_t address, const char *what)
{
    for (const Place &p : places_) {
        if (address >= p.address && address < p.address + p.octets) {
            return &p;
        }
    }
    core_.find(std::string(what) +
               " where no peripheral of the model is: " + std::to_string(address));
    return nullptr;
}

std::uint32_t Chip::Bus::read(std::uint32_t offset, unsigned octets)
{
    const Place *const p = find(base_ + offset, "read");
    return p != nullptr ? p->device->read(base_ + offset - p->address, octets) : 0U;
}

void Chip::Bus::write(std::uint32_t offset, std::uint32_t value, unsigned octets)
{
    const Place *const p = find(base_ + offset, "write");
    if (p != nullptr) {
        p->device->write(base_ + offset - p->address, value, octets);
    }
}

std::uint32_t Chip::CycleCounter::read(std::uint32_t offset, unsigned /*octets*/)
{
    return offset == cycle_counter ? static_cast<std::uint32_t>(core_.cycles() - zero_) : on_;
}

void Chip::CycleCounter::write(std::uint32_t offset, std::uint32_t value, unsigned /*octets*/)
{
    if (offset == cycle_counter) {
        zero_ = core_.cycles() - value;
    } else {
        on_ = value;
    }
}

// -- chip --

Chip::Chip(const ElfImage &image, Circuit &circuit) : circuit_(circuit)
{
    core_.add_guarded_memory(flash_base, flash_octets, flash_);
    core_.add_memory(ram_base, ram_octets, true);
    core_.add_guarded_memory(ccm_base, ccm_octets, ccm_);
    connect();
    core_.set_octets(flash_base, std::vector<std::uint8_t>(flash_octets, 0xFFU));
    core_.load(image);
    reset_devices();
    core_.reset(flash_base);
}

void Chip::connect()
{
    apb_.add(0x40000000, 0x400, edges_);
    apb_.add(0x40000800, 0x400, encoder_);
    apb_.add(0x40003000, 0x400, watchdog_);
    apb_.add(0x40004400, 0x400, serial_);
    apb_.add(0x40006400, 0x400, can_);
    apb_.add(0x40007000, 0x400, power_);
    apb_.add(0x4000A400, 0x400, can_.memory());
    apb_.add(0x40010000, 0x400, analog_);
    apb_.add(0x40012C00, 0x400, timer_);
    apb_.add(0x40021000, 0x400, rcc_);
    apb_.add(0x40022000, 0x400, flash_);
    ports_.add(0x48000000, 0x400, port_a_);
    ports_.add(0x48000400, 0x400, port_b_);
    ports_.add(0x48000800, 0x400, port_c_);
    fast_.add(0x50000000, 0x100, adc1_);
    fast_.add(0x50000100, 0x100, adc2_);
    fast_.add(0x50000300, 0x100, adc_common_);
    fast_.add(0x50001000, 0x400, dac_);
    core_.add_device(0x40000000, 0x30000, apb_);
    core_.add_device(0x48000000, 0x1000, ports_);
    core_.add_device(0x50000000, 0x2000, fast_);
    core_.add_device(0xE0001000, 0x1000, counter_);
    edges_.gate_by(rcc_, {apb1, 0});
    encoder_.gate_by(rcc_, {apb1, 2});
    serial_.gate_by(rcc_, {apb1, 17});
    can_.gate_by(rcc_, {apb1, 25});
    can_.memory().gate_by(rcc_, {apb1, 25});
    power_.gate_by(rcc_, {apb1, 28});
    analog_.gate_by(rcc_, {apb2, 0});
    timer_.gate_by(rcc_, {apb2, 11});
    port_a_.gate_by(rcc_, {ahb2, 0});
    port_b_.gate_by(rcc_, {ahb2, 1});
    port_c_.gate_by(rcc_, {ahb2, 2});
    for (Registers *const adc :
         {static_cast<Registers *>(&adc1_), static_cast<Registers *>(&adc2_), &adc_common_}) {
        adc->gate_by(rcc_, {ahb2, 13});
    }
    dac_.gate_by(rcc_, {ahb2, 18});
}

void Chip::reset_devices()
{
    for (Registers *const r :
         {static_cast<Registers *>(&rcc_), &power_, static_cast<Registers *>(&flash_),
          static_cast<Registers *>(&port_a_), static_cast<Registers *>(&port_b_),
          static_cast<Registers *>(&port_c_), &analog_, &dac_, static_cast<Registers *>(&timer_),
          static_cast<Registers *>(&encoder_), static_cast<Registers *>(&edges_),
          static_cast<Registers *>(&adc1_), static_cast<Registers *>(&adc2_), &adc_common_,
          static_cast<Registers *>(&serial_), static_cast<Registers *>(&can_),
          static_cast<Registers *>(&watchdog_)}) {
        r->reset();
    }
    update_gates();
}

void Chip::restart(std::uint32_t cause)
{
    resets_++;
    rcc_.note_reset(cause);
    trigger_lost_ = false;
    reset_devices();
    core_.reset(flash_base);
}

void Chip::power_cycle()
{
    flash_.cut_power(asked_);
    anything_ = static_cast<std::uint8_t>(anything_ + 0x9DU);
    core_.set_octets(ram_base, std::vector<std::uint8_t>(ram_octets, anything_));
    rcc_.lose_power();
    restart(0);
    resets_ = 0;
}

std::uint64_t Chip::next_event()
{
    return std::min({timer_.next_end(), adc1_.due(), adc2_.due(), serial_.due(), can_.due(),
                     core_.exceptions().tick_due(), watchdog_.due(), looks_});
}

void Chip::update_gates()
{
    if (timer_.enabled() != gates_) {
        gates_ = timer_.enabled();
        circuit_.gates_change(gates_,
                              static_cast<double>(core_.cycles() - period_began_) / core_Hz);
    }
}

void Chip::update_lines()
{
    core_.exceptions().set_line(line_adc, adc1_.interrupts() || adc2_.interrupts());
    core_.exceptions().set_line(line_can, can_.interrupts());
    core_.exceptions().set_line(line_serial, serial_.interrupts());
}

/// The trigger at the counter's top.
void Chip::begin_period()
{
    period_began_ = timer_.last_end();
    circuit_.period_begins(
        {timer_.on_cnt(), timer_.full_cnt(), 1.0 / core_Hz, timer_.dead_time_s()});
    const Shaft shaft = circuit_.shaft();
    for (const Edge &edge : shaft.edges) {
        edges_.capture(period_began_ - static_cast<std::uint64_t>(edge.age_s * core_Hz));
    }
    encoder_.latch(shaft);
    if (!trigger_lost_) {
        adc1_.start(circuit_, period_began_);
        adc2_.start(circuit_, period_began_);
    }
    looks_ = look_ > 0U ? period_began_ + look_ : UINT64_MAX;
    update_comparators();
}

void Chip::serve_events()
{
    const std::uint64_t now = core_.cycles();
    if (timer_.next_end() <= now && timer_.pass_end() && timer_.at_top()) {
        begin_period();
    }
    if (adc2_.due() <= now) {
        adc2_.end();
    }
    if (adc1_.due() <= now) {
        adc1_.end();
    }
    if (serial_.due() <= now) {
        serial_.step();
    }
    can_.step();
    if (core_.exceptions().tick_due() <= now) {
        core_.exceptions().tick();
    }
    if (looks_ <= now) {
        looks_ += look_;
        update_comparators();
    }
}

void Chip::run_for(double time_s)
{
    run_to(core_.cycles() + static_cast<std::uint64_t>(time_s * core_Hz));
}

void Chip::run_to(std::uint64_t end)
{
    asked_ = end;
    while (core_.cycles() < end) {
        core_.run_until(std::min(end, next_event()));
        update_gates();
        update_lines(); // what the program has acknowledged is low, before it may be high again
        if (core_.exceptions().wants_reset()) {
            restart(by_program);
        } else if (watchdog_.is_out()) {
            core_.find("the watchdog resets, at " + hex(core_.program_counter()));
            restart(by_watchdog);
        } else {
            serve_events();
        }
        update_lines();
    }
}

void Chip::stop_crystal()
{
    if (rcc_.stop_crystal()) {
        core_.exceptions().pend(exception_nmi);
        timer_.trip();
        update_gates();
    }
}

void Chip::set_over_current(bool active)
{
    over_current_ = active;
    update_comparators();
}

/// A comparator with DAC3 at its inverting input.
bool Chip::is_above(int phase, double pin_V) const
{
    const std::uint32_t csr       = analog_.at(comparators.at(static_cast<std::size_t>(phase)));
    const bool          first     = phase == 0; // channel 1 of DAC3 at comparator 1
    const bool          has_level = (dac_.at(0U) & (first ? 1U : 1U << 16U)) != 0U;
    const std::uint32_t level     = dac_.at(first ? dac_level_1 : dac_level_2);
    const bool          compares  = (csr & 1U) != 0U && ((csr >> 4U) & 7U) == 4U && has_level;
    const bool          inverts   = (csr & inverted) != 0U;
    return compares && (pin_V > level * reference_V / 4096.0) != inverts;
}

void Chip::update_comparators()
{
    const double  into_s = static_cast<double>(core_.cycles() - period_began_) / core_Hz;
    std::uint32_t high   = 0; // a bit of each comparator
    for (int phase = 0; phase < 3; phase++) {
        const bool sees_it = over_current_ || is_above(phase, circuit_.shunt_V(phase, into_s));
        const std::uint32_t offset = comparators.at(static_cast<std::size_t>(phase));
        std::uint32_t      &csr    = analog_.at(offset);
        csr                        = sees_it ? csr | sees : csr & ~sees;
        high |= sees_it ? 1U << ((offset - comparators[0]) / 4U) : 0U;
    }
    timer_.set_break(over_current_ || timer_.breaks_at(high));
    update_gates();
}

} // namespace iss::stm32g431
