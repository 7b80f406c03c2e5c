/* SPDX-License-Identifier: MIT */
/* Start-up order: board_prepare() makes the pins safe, sets the clock and arms the trip. Then
 * follow constants with their check sums, peripherals, application and interrupts. The bridge stays
 * off until a run is commanded. */
#include "app.h"
#include "app_loader.h"
#include "board_config.h"
#include "gain_tables.h"
#include "passes.h"
#include "prepare.h"
#include "yield.h"

/* Constants in use by board and tick. The linker places them in RAM without wait states. */
static app_image_t in_force;

firmware_pass_t firmware_start(void)
{
    app_parameters_done_t stored = APP_PARAMETERS_NOT_ASKED;

    if (!board_prepare() ||
        !app_image_choose(&in_force, &board_config, &gain_tables_drive, &board_identity) ||
        !board_init(&in_force.image.app.board)) {
        board_gate_trip(); /* the watchdog does not run yet: only a power cycle ends this */
        return FIRMWARE_STAYS_OFF;
    }
    if (board_loader_is_wanted()) {
        stored = app_parameters_work(&in_force);
        if (stored == APP_PARAMETERS_NOT_ASKED) {
            app_loader_start(&in_force);
            return FIRMWARE_LOADS;
        }
    }
    (void)app_init(&in_force.image.app,
                   &in_force.image.drive); /* if refused: stays in FAULT and reports the reason */
    app_tell_image(&in_force);
    app_take_parameters(stored);
    board_start(app_tick, in_force.image.drive.hardware.updates_per_period);
    return FIRMWARE_DRIVES;
}

void firmware_pass(firmware_pass_t pass)
{
    switch ((int16_t)pass) {
    case FIRMWARE_LOADS:
        app_loader_pass();
        break;
    case FIRMWARE_DRIVES:
        app_background();
        break;
    default:
        break; /* the bridge is off */
    }
}

int main(void)
{
    const firmware_pass_t pass = firmware_start();

    for (;;) {
        firmware_pass(pass);
        BOARD_YIELD();
    }
}
