// SPDX-License-Identifier: MIT
#include "drive/processors/processors.hpp"

extern "C" {
#include "f28335/clock_tree.h"
}

namespace sdre {

static_assert(BOARD_ADC_CODES == 1U << 12U);

Processor processor_f28335()
{
    Processor p{};
    p.name             = "f28335";
    p.clock_Hz         = CLOCK_SYSCLK_Hz;
    p.counter_Hz       = CLOCK_TBCLK_Hz;
    p.most_cycles      = CLOCK_PERIOD_MAX_cycles;
    p.dead_times       = {{1.0, CLOCK_DEAD_TIME_MAX_cnt, 1.0}};
    p.adc_bits         = 12;
    p.most_positions   = 65532;
    p.most_updates     = BOARD_UPDATES_MAX;
    p.has_chopper_pin  = true;
    p.has_cycle_budget = true;
    p.store_address    = 0x300000; // linker/f28335_registers.cmd
    return p;
}

} // namespace sdre
