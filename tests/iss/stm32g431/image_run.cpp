// SPDX-License-Identifier: MIT
#include "stm32g431/image_run.hpp"

#include <cmath>

#include "common/errors.hpp"
#include "sil/run/controller.hpp"

namespace iss::stm32g431 {
namespace {

// Beyond the longest boot.
constexpr double longest_boot_s = 0.5;
constexpr double look_s         = 20e-6;
// Chosen: between two ticks, clear of the tick before.
constexpr double       rest_share     = 0.75;
constexpr std::uint8_t modbus_address = 1;

} // namespace

ImageRun::ImageRun(const sdre::Scenario &s, long start_tick, const Program &program,
                   bool ideal_inverter)
    : ModbusRun(s, start_tick), program_(program), circuit_(bench_, s.drive, ideal_inverter),
      chip_(program.image, circuit_), memory_(chip_.core(), program.image, program.layout),
      line_(chip_.serial()), master_(line_, modbus_address),
      period_cycles_(
          static_cast<std::uint64_t>(std::llround(sdre::control_period_s(s.drive) * core_Hz))),
      resets_(chip_.resets())
{
    while (bench_.tick() < 0) {
        if (chip_.time_s() > longest_boot_s) {
            std::string why = "the image does not start";
            for (const std::string &finding : findings()) {
                why += "; " + finding;
            }
            throw sdre::InputError(why);
        }
        chip_.run_for(look_s);
    }
    rests_ = chip_.period_began() +
             static_cast<std::uint64_t>(rest_share * static_cast<double>(period_cycles_));
    chip_.run_to(rests_);
    look();
}

bool ImageRun::step()
{
    rests_ += period_cycles_;
    chip_.run_to(rests_);
    master_.poll();
    look();
    return chip_.resets() == resets_ && !chip_.core().halted();
}

/// Takes what the trace shows of the drive from the image's memory.
void ImageRun::look()
{
    drive_.state          = memory_.get<drive_state_t>("tick_side", "drive_state");
    drive_.fault          = memory_.get<drive_fault_t>("tick_side", "drive_fault");
    drive_.answer.i_ref_A = memory_.get<dq_t>("tick_side", "i_ref_A");
    drive_.answer.d_omega = memory_.get<float>("tick_side", "d_omega");
    drive_.answer.d_q     = memory_.get<float>("tick_side", "d_q");
    drive_.answer.d_d     = memory_.get<float>("tick_side", "d_d");
    drive_.v_V            = memory_.get<dq_t>("tick_side", "v_V");
}

app_status_t ImageRun::status() const
{
    app_status_t s{};
    s.mode         = memory_.get<app_mode_t>("tick_side", "mode");
    s.fault        = memory_.get<app_fault_t>("tick_side", "fault");
    s.drive_fault  = drive_.fault;
    s.board_faults = memory_.get<std::uint16_t>("shared", "board_faults");
    s.zero_a_cnt   = memory_.get<float>("tick_side", "zero_a_cnt");
    s.zero_b_cnt   = memory_.get<float>("tick_side", "zero_b_cnt");
    return s;
}

void ImageRun::inject(sdre::FaultKind kind)
{
    break_chip(chip_, program_, kind);
}

std::array<int, 3> ImageRun::duty_cnt() const
{
    return circuit_.duty_cnt();
}

std::vector<std::string> ImageRun::findings() const
{
    return chip_.core().findings();
}

} // namespace iss::stm32g431
