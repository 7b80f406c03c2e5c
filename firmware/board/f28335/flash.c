/* SPDX-License-Identifier: MIT */
/* The build places this file in RAM: the flash cannot be read while its timing changes. */
#include "DSP28x_Project.h"
#include "clock_tree.h"
#include "peripherals.h"

/* Data sheet, 150 MHz. */
#define PAGE_WAIT    5U
#define RANDOM_WAIT  5U
#define OTP_WAIT     8U
#define WAKE_UP_WAIT 0x1FFU

void flash_init(void)
{
    EALLOW;
    FlashRegs.FOPT.bit.ENPIPE            = 1U; /* prefetch */
    FlashRegs.FBANKWAIT.bit.PAGEWAIT     = PAGE_WAIT;
    FlashRegs.FBANKWAIT.bit.RANDWAIT     = RANDOM_WAIT;
    FlashRegs.FOTPWAIT.bit.OTPWAIT       = OTP_WAIT;
    FlashRegs.FSTDBYWAIT.bit.STDBYWAIT   = WAKE_UP_WAIT;
    FlashRegs.FACTIVEWAIT.bit.ACTIVEWAIT = WAKE_UP_WAIT;
    EDIS;

    asm(" RPT #7 || NOP"); /* the last write must take effect before the return to flash */
}
