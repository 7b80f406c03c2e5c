/* SPDX-License-Identifier: MIT */
/* Direction pin of a transceiver. The control interrupt releases the line: a background pass may
 * take longer than the silence after which a master sends again. This file runs from flash, as the
 * RAM has no space for it. */
#include "DSP28x_Project.h"
#include "peripherals.h"

#define DIRECTION_PIN (1UL << 27) /* GPIO27, gpio.c */

static volatile bool     used;
static volatile bool     follows; /* false: an octet is being written */
static volatile bool     empty;   /* the transmitter has been since empty_cycles */
static volatile uint32_t empty_cycles;
static uint32_t          bit_cycles;

void line_init(bool uses_direction, uint32_t cycles_per_bit)
{
    follows    = false;
    empty      = false;
    used       = uses_direction;
    bit_cycles = cycles_per_bit;
}

bool line_is_sending(void)
{
    return (SciaRegs.SCIFFTX.bit.TXFFST != 0U) || (SciaRegs.SCICTL2.bit.TXEMPTY == 0U);
}

void line_send(uint16_t octet)
{
    follows = false;
    if (used) {
        GpioDataRegs.GPASET.all = DIRECTION_PIN;
    }
    SciaRegs.SCITXBUF = octet;
    empty             = false;
    follows           = used;
}

/* Releases the line when the transmitter has been empty for one bit time. The manual does not say
 * whether it reads empty before the end of the last stop bit. */
void line_release(void)
{
    if (!follows) {
        return;
    }
    if (line_is_sending()) {
        empty = false;
    } else if (!empty) {
        empty_cycles = board_cycles(); /* before `empty`: the interrupt calls this function too */
        empty        = true;
    } else if ((uint32_t)(board_cycles() - empty_cycles) > bit_cycles) {
        GpioDataRegs.GPACLEAR.all = DIRECTION_PIN;
        follows                   = false;
    } else {
        /* the stop bit may still be on the line */
    }
}
