// SPDX-License-Identifier: MIT
#include "stm32g431/image_board.hpp"

namespace iss::stm32g431 {
namespace {

constexpr double look_s = 2e-6;

} // namespace

ImageBoard::ImageBoard(sdre::MotorBench &at, const sdre::Drive &drive, const Program &of,
                       bool ideal_inverter)
    : program(of), bench(at), circuit(at, drive, ideal_inverter), chip(of.image, circuit),
      memory(chip.core(), of.image, of.layout)
{
}

bool ImageBoard::start(double within_s)
{
    const long   before = bench.tick();
    const double end_s  = chip.time_s() + within_s;
    while (bench.tick() == before && chip.time_s() < end_s) {
        chip.run_for(look_s);
    }
    return bench.tick() > before;
}

void ImageBoard::inject(sdre::FaultKind kind)
{
    if (kind == sdre::FaultKind::tick_hung) {
        chip.core().hang_at(program.image.symbols.at("app_tick"));
    } else if (kind == sdre::FaultKind::trigger_lost) {
        chip.lose_trigger();
    } else {
        chip.core().mask_interrupts();
    }
}

app_status_t ImageBoard::status() const
{
    app_status_t s{};
    s.mode                  = memory.get<app_mode_t>("tick_side", "mode");
    s.fault                 = memory.get<app_fault_t>("tick_side", "fault");
    s.drive_fault           = memory.get<drive_fault_t>("tick_side", "drive_fault");
    s.board_faults          = memory.get<std::uint16_t>("shared", "board_faults");
    s.zero_a_cnt            = memory.get<float>("tick_side", "zero_a_cnt");
    s.zero_b_cnt            = memory.get<float>("tick_side", "zero_b_cnt");
    s.commission.stage      = memory.get<commission_stage_t>("tick_side", "commission_stage");
    s.commission.last_stage = memory.get<commission_stage_t>("tick_side", "commission_last_stage");
    s.commission.reason     = memory.get<commission_reason_t>("tick_side", "commission_reason");
    s.commission.found      = memory.get<commission_result_t>("tick_side", "commission_found");
    return s;
}

double ImageBoard::opens_s(double within_s)
{
    const double from_s = chip.time_s();
    while (chip.gates_enabled() && chip.time_s() < from_s + within_s) {
        chip.run_for(look_s);
    }
    return chip.gates_enabled() ? -1.0 : chip.time_s() - from_s;
}

} // namespace iss::stm32g431
