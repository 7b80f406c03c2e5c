/* SPDX-License-Identifier: MIT */
/* Start-up order: safe pins, full clock and armed trip (board_prepare), constants with their sums, peripherals, application,
 * interrupts. The bridge stays off until a run is commanded. */
#include "app.h"
#include "app_loader.h"
#include "board_config.h"
#include "gain_tables.h"
#include "prepare.h"
#include "yield.h"

/* What board and tick read from now on: the linker puts it where there are no wait states. */
static app_image_t in_force;

/* Without a clock that is known to be right, or with a PWM that is not the drive's, nothing may switch. The watchdog does not run yet, so this lasts until the
 * power is cycled. */
static void stay_off(void)
{
    board_gate_trip();
    for (;;) {
        BOARD_YIELD();
    }
}

static void load(void)
{
    app_loader_start(&in_force);
    for (;;) {
        app_loader_pass();
        BOARD_YIELD();
    }
}

int main(void)
{
    app_parameters_done_t stored = APP_PARAMETERS_NOT_ASKED;

    if (!board_prepare() || !app_image_choose(&in_force, &board_config, &gain_tables_drive) ||
        !board_init(&in_force.image.app.board)) {
        stay_off();
    }
    if (board_loader_is_wanted()) {
        stored = app_parameters_work();
        if (stored == APP_PARAMETERS_NOT_ASKED) {
            load();
        }
    }
    (void)app_init(&in_force.image.app,
                   &in_force.image.drive); /* refused: runs, stays in FAULT, tells why */
    app_tell_image(&in_force);
    app_take_parameters(stored);
    board_start(app_tick, in_force.image.drive.hardware.updates_per_period);
    for (;;) {
        app_background();
        BOARD_YIELD();
    }
}
