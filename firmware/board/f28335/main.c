/* SPDX-License-Identifier: MIT */
/* Start-up order: safe pins and armed trip (board_init), application, interrupts. The bridge stays off until a
 * run is commanded. */
#include "app.h"
#include "board_config.h"
#include "gain_tables.h"
#include "yield.h"

/* Without a clock that is known to be right, or with a PWM that is not the drive's, nothing may switch. The watchdog does not run yet, so this lasts until the
 * power is cycled. */
static void stay_off(void)
{
    board_gate_trip();
    for (;;) {
        BOARD_YIELD();
    }
}

int main(void)
{
    if (!board_init(&board_config.board)) {
        stay_off();
    }
    (void)app_init(&board_config,
                   &gain_tables_drive); /* refused: runs, stays in FAULT, tells why */
    board_start(app_tick, gain_tables_drive.hardware.updates_per_period);
    for (;;) {
        app_background();
        BOARD_YIELD();
    }
}
