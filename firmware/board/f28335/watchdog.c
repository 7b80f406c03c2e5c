/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "peripherals.h"
#include "restart_mark.h"
#include "yield.h"

#define WDCR_STOP 0x68U
#define WDFLAG    0x80U /* WDCR: reported as the watchdog's reset; written 1 to clear */
/* The shortest period, 256 * 512 crystal cycles = 4.37 ms: four of the longest background passes
 * (clock_tree.h). Bits 5:3 must be 101 in every write. */
#define WDCR_RUN  0x29U
#define SCSR_LOCK 0x01U /* reset, not interrupt; the watchdog cannot be stopped after this */

#define WDCR_RESET 0x00U /* check bits that are not 101: a reset at once */
static board_reset_t cause;

/* Survives a reset: no start-up code writes it. WDFLAG is not used: it is unreliable after any
 * reset (docs/hardware.md, "Reset"). */
#ifdef __TI_COMPILER_VERSION__
#pragma NOINIT(watchdog_after_reset)
#endif
volatile uint32_t watchdog_after_reset[2];

/* Survives a reset too. */
#ifdef __TI_COMPILER_VERSION__
#pragma NOINIT(kept)
#endif
static uint16_t kept[BOARD_KEPT_WORDS];

void watchdog_stop(void)
{
    cause = ((SysCtrlRegs.WDCR & WDFLAG) != 0U) ? BOARD_RESET_WATCHDOG : BOARD_RESET_PIN;
    EALLOW;
    SysCtrlRegs.WDCR = WDCR_STOP | WDFLAG; /* cleared: the next reset sets its own cause */
    EDIS;
}

board_reset_t board_reset_cause(void)
{
    return cause;
}

bool board_loader_is_wanted(void)
{
    return restart_mark_take(watchdog_after_reset);
}

uint16_t *board_kept(void)
{
    return kept;
}

void board_restart(bool loader)
{
    board_gate_trip();
    restart_mark_set(watchdog_after_reset, loader);
    EALLOW;
    SysCtrlRegs.WDCR = WDCR_RESET;
    EDIS;
    for (;;) {
        BOARD_YIELD();
    }
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
