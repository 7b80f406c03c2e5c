// SPDX-License-Identifier: MIT
#include "drive/processors/processors.hpp"

extern "C" {
#include "stm32g431/clock_tree.h"
}

namespace sdre {
namespace {

static_assert(BOARD_ADC_CODES == 1U << 12U);

DeadTimeRange range(unsigned least, unsigned most, unsigned step, unsigned /*code*/)
{
    return {static_cast<double>(least), static_cast<double>(most), static_cast<double>(step)};
}

} // namespace

Processor processor_stm32g431()
{
    Processor p{};
    p.name             = "stm32g431";
    p.clock_Hz         = CLOCK_SYSCLK_Hz;
    p.counter_Hz       = CLOCK_SYSCLK_Hz; // TIM1, undivided
    p.most_cycles      = CLOCK_PERIOD_MAX_cycles;
    p.dead_times       = {CLOCK_DEAD_TIMES(range)};
    p.adc_bits         = 12;
    p.most_positions   = 65532;
    p.most_updates     = BOARD_UPDATES_MAX;
    p.has_chopper_pin  = false;
    p.has_cycle_budget = false;
    return p;
}

} // namespace sdre
