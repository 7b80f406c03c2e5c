/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "peripherals.h"

#define WDCR_STOP 0x68U
#define WDFLAG    0x80U /* WDCR: the watchdog has reset the device; written 1 to clear */
/* 256 * 512 crystal cycles = 4.37 ms, the shortest there is: four times the longest background pass expected (1 ms). Bits
 * 5:3 have to be 101 in every write. */
#define WDCR_RUN  0x29U
#define SCSR_LOCK 0x01U /* reset, not interrupt; and the watchdog cannot be stopped any more */

static board_reset_t cause;

void watchdog_stop(void)
{
    cause = ((SysCtrlRegs.WDCR & WDFLAG) != 0U) ? BOARD_RESET_WATCHDOG : BOARD_RESET_PIN;
    EALLOW;
    SysCtrlRegs.WDCR = WDCR_STOP | WDFLAG; /* forgotten: the next reset tells its own cause */
    EDIS;
}

board_reset_t board_reset_cause(void)
{
    return cause;
}

void watchdog_start(void)
{
    board_watchdog_serve();
    EALLOW;
    SysCtrlRegs.WDCR = WDCR_RUN;
    SysCtrlRegs.SCSR = SCSR_LOCK;
    EDIS;
}

void board_watchdog_serve(void)
{
    EALLOW;
    SysCtrlRegs.WDKEY = 0x55U;
    SysCtrlRegs.WDKEY = 0xAAU;
    EDIS;
}
