/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "board.h"
#include "peripherals.h"

#define QUALIFY_6 2U /* six equal samples */
/* Chosen: a sample every 510 cycles. Contacts that bounce for less than 34 us do not show. */
#define SWITCH_QUALPRD 0xFFU

void inputs_init(void)
{
    EALLOW;
    GpioCtrlRegs.GPACTRL.bit.QUALPRD3 = SWITCH_QUALPRD; /* GPIO24 .. GPIO31 */
    GpioCtrlRegs.GPBCTRL.bit.QUALPRD0 = SWITCH_QUALPRD; /* GPIO32 .. GPIO39 */
    GpioCtrlRegs.GPAPUD.bit.GPIO26    = 0U;
    GpioCtrlRegs.GPBPUD.bit.GPIO32    = 0U;
    GpioCtrlRegs.GPBPUD.bit.GPIO33    = 0U;
    GpioCtrlRegs.GPAQSEL2.bit.GPIO26  = QUALIFY_6;
    GpioCtrlRegs.GPBQSEL1.bit.GPIO32  = QUALIFY_6;
    GpioCtrlRegs.GPBQSEL1.bit.GPIO33  = QUALIFY_6;
    GpioCtrlRegs.GPAMUX2.bit.GPIO26   = 0U; /* no peripheral */
    GpioCtrlRegs.GPBMUX1.bit.GPIO32   = 0U;
    GpioCtrlRegs.GPBMUX1.bit.GPIO33   = 0U;
    EDIS;
}

uint16_t board_inputs(void)
{
    const uint16_t home     = (uint16_t)GpioDataRegs.GPADAT.bit.GPIO26;
    const uint16_t negative = (uint16_t)GpioDataRegs.GPBDAT.bit.GPIO32;
    const uint16_t positive = (uint16_t)GpioDataRegs.GPBDAT.bit.GPIO33;

    return (uint16_t)((home * (uint16_t)BOARD_INPUT_HOME) |
                      (negative * (uint16_t)BOARD_INPUT_NEGATIVE) |
                      (positive * (uint16_t)BOARD_INPUT_POSITIVE));
}
