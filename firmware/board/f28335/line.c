/* SPDX-License-Identifier: MIT */
/* The direction pin of a transceiver. The control interrupt releases the line, as a pass of the background may last longer than
 * the silence after which a master sends again. An image has this file in flash: the RAM has no room for it. */
#include "DSP28x_Project.h"
#include "peripherals.h"

#define DIRECTION_PIN (1UL << 27) /* GPIO27, gpio.c */

static volatile bool     used;
static volatile bool     follows; /* false: an octet is just being written */
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

/* Back to listening when the transmitter has been empty for a bit. The manual leaves open whether it is empty before the last
 * stop bit has ended. */
void line_release(void)
{
    if (!follows) {
        return;
    }
    if (line_is_sending()) {
        empty = false;
    } else if (!empty) {
        empty_cycles = board_cycles(); /* first: this may be interrupted by itself */
        empty        = true;
    } else if ((uint32_t)(board_cycles() - empty_cycles) > bit_cycles) {
        GpioDataRegs.GPACLEAR.all = DIRECTION_PIN;
        follows                   = false;
    } else {
        /* the stop bit */
    }
}
