// SPDX-License-Identifier: MIT
#include "stm32g431/image_run.hpp"

#include <cmath>

#include "common/errors.hpp"
#include "sil/run/controller.hpp"

namespace iss::stm32g431 {
namespace {

// Beyond the longest boot.
constexpr double longest_boot_s = 0.5;
// Chosen: between two ticks, clear of the tick before.
constexpr double       rest_share     = 0.75;
constexpr std::uint8_t modbus_address = 1;

} // namespace

ImageRun::ImageRun(const sdre::Scenario &s, long start_tick, const Program &program,
                   bool ideal_inverter)
    : ModbusRun(s, start_tick), board_(bench_, s.drive, program, ideal_inverter),
      line_(board_.chip.serial()), master_(line_, modbus_address),
      period_cycles_(
          static_cast<std::uint64_t>(std::llround(sdre::control_period_s(s.drive) * core_Hz))),
      resets_(board_.chip.resets())
{
    if (!board_.start(longest_boot_s)) {
        std::string why = "the image does not start";
        for (const std::string &finding : findings()) {
            why += "; " + finding;
        }
        throw sdre::InputError(why);
    }
    rests_ = board_.chip.period_began() +
             static_cast<std::uint64_t>(rest_share * static_cast<double>(period_cycles_));
    board_.chip.run_to(rests_);
    look();
}

bool ImageRun::step()
{
    rests_ += period_cycles_;
    board_.chip.run_to(rests_);
    master_.poll();
    look();
    return board_.chip.resets() == resets_ && !board_.chip.core().halted();
}

/// Takes what the trace shows of the drive from the image's memory.
void ImageRun::look()
{
    const ImageMemory &memory = board_.memory;
    drive_.state              = memory.get<drive_state_t>("tick_side", "drive_state");
    drive_.fault              = memory.get<drive_fault_t>("tick_side", "drive_fault");
    drive_.answer.i_ref_A     = memory.get<dq_t>("tick_side", "i_ref_A");
    drive_.answer.d_omega     = memory.get<float>("tick_side", "d_omega");
    drive_.answer.d_q         = memory.get<float>("tick_side", "d_q");
    drive_.answer.d_d         = memory.get<float>("tick_side", "d_d");
    drive_.v_V                = memory.get<dq_t>("tick_side", "v_V");
}

app_status_t ImageRun::status() const
{
    return board_.status();
}

void ImageRun::inject(sdre::FaultKind kind)
{
    board_.inject(kind);
}

std::array<int, 3> ImageRun::duty_cnt() const
{
    return board_.circuit.duty_cnt();
}

std::vector<std::string> ImageRun::findings() const
{
    return board_.chip.core().findings();
}

} // namespace iss::stm32g431
