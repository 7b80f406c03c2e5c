// SPDX-License-Identifier: MIT
#include "stm32g431/served_image.hpp"

#include <cmath>

#include "common/errors.hpp"
#include "sil/run/controller.hpp"
#include "stm32g431/image_scenario.hpp"

namespace iss::stm32g431 {
namespace {

constexpr double longest_boot_s = 0.5; // beyond the longest boot
constexpr double seen_at        = 0.9; // of a period: the control interrupt has ended
} // namespace

ServedImage::ServedImage(const sdre::Drive &drive, const sdre::Machine &machine, std::uint64_t seed,
                         const Program &program, double held_s)
    : ServedDrive(with_three_shunts(sdre::bench_scenario(drive, machine, seed)),
                  std::lround(held_s / sdre::control_period_s(drive))),
      board_(bench(), scenario().drive, program, false)
{
    require_constants(program, drive);
    board_.chip.connect_can(can_bus());
    start();
}

void ServedImage::start()
{
    if (!board_.start(longest_boot_s)) {
        throw sdre::InputError("serve: the image does not start" +
                               (findings().empty() ? "" : ": " + findings().front()));
    }
    board_.chip.run_for(seen_at * period_s());
    ends_s_ = time_s();
}

/// An instruction ends a little later, which the next period makes up for: so many periods are so many of the timer. A test
/// can have run the chip beyond this period.
void ServedImage::period()
{
    set_load();
    board_.chip.open_home_switch(home_is_open());
    const int before = board_.chip.resets();
    do {
        ends_s_ += period_s();
    } while (ends_s_ <= time_s());
    board_.chip.run_for(ends_s_ - time_s());
    if (board_.chip.resets() != before) {
        resets_ += board_.chip.resets() - before;
        forget_processor_faults();
    }
}

void ServedImage::power_cycle()
{
    forget_processor_faults();
    board_.chip.power_cycle();
    start();
}

void ServedImage::break_processor(sdre::FaultKind kind)
{
    board_.inject(kind);
}

} // namespace iss::stm32g431
