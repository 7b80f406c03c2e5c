/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "clock_tree.h"
#include "peripherals.h"

#define POWER_UP_CYCLES (CLOCK_SYSCLK_Hz / 200UL) /* 5 ms, data sheet */
#define POWER_UP        0xE0U                     /* band gap, reference and converter */
/* Device advisory: the first pair of a sequence needs a window above 160 ns. The window here is 6
 * ADC clocks, 240 ns. The first pair is also converted twice and its first result ignored. The
 * allowed source impedance is in docs/hardware.md. */
#define ACQUISITION 5U
#define PAIRS       3U

void adc_init(const board_setup_t *setup)
{
    EALLOW;    /* as in TI's code: the trim registers may be protected */
    ADC_cal(); /* factory trim; a load by debugger skips the boot ROM's call */
    EDIS;

    AdcRegs.ADCTRL3.all = POWER_UP;
    cycles_wait(POWER_UP_CYCLES);

    AdcRegs.ADCTRL1.all           = 0U; /* two sequencers, one run per trigger, ADCCLK = HSPCLK */
    AdcRegs.ADCTRL1.bit.ACQ_PS    = ACQUISITION;
    AdcRegs.ADCTRL3.bit.ADCCLKPS  = 0U; /* HSPCLK undivided */
    AdcRegs.ADCTRL3.bit.SMODE_SEL = 1U; /* inputs A and B of a pair are held at the same instant */
    AdcRegs.ADCMAXCONV.all        = PAIRS - 1U;
    AdcRegs.ADCCHSELSEQ1.all      = 0U;
    AdcRegs.ADCCHSELSEQ1.bit.CONV00 = 0U; /* A0, B0: result ignored */
    AdcRegs.ADCCHSELSEQ1.bit.CONV01 = 0U; /* A0, B0: phase currents */
    AdcRegs.ADCCHSELSEQ1.bit.CONV02 = 1U; /* A1, B1: dc link, temperature */
    if (setup->current_sensors == 3U) {
        AdcRegs.ADCMAXCONV.all          = PAIRS; /* one more */
        AdcRegs.ADCCHSELSEQ1.bit.CONV03 = 2U;    /* A2 is free, B2: phase current c */
    }
    AdcRegs.ADCTRL2.all = ADC_RUN;
    adc_rewind();
}
