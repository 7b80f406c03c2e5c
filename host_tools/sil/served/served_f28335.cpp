// SPDX-License-Identifier: MIT
#include "sil/served/served_f28335.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "sil/board/board_choice.hpp"
#include "sil/board/board_runs.hpp"

extern "C" {
extern volatile std::uint32_t watchdog_after_reset[2]; // firmware/board/f28335/watchdog.c
std::uint16_t                *f28335_board_kept(void);
}

namespace sdre {
namespace {

// Beyond the longest boot: clock 4 ms, converter 5 ms. After a reset the loader may run, which has no ticks.
constexpr double longest_boot_s = 0.5;
// Chosen: between two ticks, clear of the conversion that follows each.
constexpr double rest_share = 0.25;

constexpr int pin_home     = 26; // docs/hardware.md
constexpr int pin_negative = 32;
constexpr int pin_positive = 33;

/// The firmware's constants, before anything of the board is made.
Controller bound(const Scenario &s)
{
    require_f28335(s.drive);
    Controller c = prepare_controller(s, Precision::extended);
    set_firmware(c.config, s.drive);
    return c;
}

} // namespace

ServedF28335::ServedF28335(const Drive &drive, const Machine &machine, std::uint64_t seed,
                           const f28335::FlashWords &flash, bool own_stack)
    : ServedDrive(bench_scenario(drive, machine, seed)), controller_(bound(scenario())),
      surroundings_(bench(), false, drive.board.dc_link_range_V, 1), own_stack_(own_stack)
{
    if (flash.empty()) {
        f28335::erase_flash();
    } else {
        f28335::set_flash(flash);
    }
    power_cycle();
}

void ServedF28335::power_up(bool after_reset)
{
    before_s_ += device_ ? device_->time_s() : 0.0;
    device_.reset(); // the registers exist once
    surroundings_.brake_changes(false, 0.0);
    forget_processor_faults();
    f28335::hang_ticks(false);
    device_ = std::make_unique<f28335::Device>(
        surroundings_, f28335::whole_firmware(),
        f28335::DeviceOptions{{},
                              scenario().drive.inverter.dead_time_s,
                              after_reset ? watchdog_low_s_ : power_on_low_s_,
                              f28335::AtLoad::old_values,
                              own_stack_,
                              &can_bus()});
    const long before = bench().tick();
    if (!device_->run_until([&] { return bench().tick() > before; }, longest_boot_s) &&
        !after_reset) {
        throw InputError(fmt::format("serve: the firmware does not start{}{}",
                                     findings().empty() ? "" : ": ",
                                     findings().empty() ? "" : findings().front()));
    }
    ready_s_ = device_->time_s();
    device_->run_for(rest_share * period_s());
}

/// Memory without power: anything, and not the same twice.
void ServedF28335::power_cycle()
{
    for (volatile std::uint32_t &word : watchdog_after_reset) {
        word = 0x9E3779B9U * ++power_cycles_;
    }
    for (std::size_t n = 0; n < BOARD_KEPT_WORDS; n++) {
        f28335_board_kept()[n] = static_cast<std::uint16_t>((0x9E3779B9U * ++power_cycles_) >> 16U);
    }
    power_up(false);
}

void ServedF28335::period()
{
    if (device_->stopped()) {
        resets_++;
        power_up(true);
        return;
    }
    set_load();
    set_inputs();
    device_->run_for(period_s());
}

/// Contacts that open when they are active; an input without a switch is open.
void ServedF28335::set_inputs()
{
    const double        at = turns();
    const AxisSwitches &s  = switches();
    device_->set_input(pin_home, home_is_open());
    device_->set_input(pin_negative, !s.negative || at <= *s.negative);
    device_->set_input(pin_positive, !s.positive || at >= *s.positive);
}

void ServedF28335::break_processor(FaultKind kind)
{
    if (kind == FaultKind::tick_hung) {
        f28335::hang_ticks(true);
    } else if (kind == FaultKind::trigger_lost) {
        device_->lose_trigger();
    } else {
        device_->mask_interrupts();
    }
}

std::vector<std::string> ServedF28335::findings() const
{
    std::vector<std::string> all;
    for (const f28335::Findings::Entry &e : device_->findings().all()) {
        all.push_back(fmt::format("{:.6f} s: {}", e.time_s, e.text));
    }
    return all;
}

} // namespace sdre
