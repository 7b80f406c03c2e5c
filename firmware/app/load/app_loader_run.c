/* SPDX-License-Identifier: MIT */
/* Runs the loader instead of the application, with both buses. Time comes from the cycle count, as
 * there are no ticks. */
#include "app_loader.h"

#include <stddef.h>

#include "app_line.h"

static struct {
    app_config_t   config; /**< copy: the loader overwrites the image */
    drive_config_t drive;
    uint32_t       tick_cycles;
    uint32_t       cycles; /**< at the last whole tick */
    uint32_t       ticks;
} side;

void app_loader_start(app_image_t *image)
{
    side.drive = image->image.drive;
    app_config_for(&side.config, &image->image.app, side.drive.hardware.updates_per_period);
    app_loader_init(&app_line.loader, image);
    app_line.loader.state = APP_LOADER_IDLE;
    app_line.loader.image = image;
    (void)app_registers_init(&app_line.registers, &side.config, &side.drive);
    app_line.registers.loader = &app_line.loader;
    (void)app_modbus_init(&app_line.modbus, side.config.modbus_gap_ticks);
    app_parameters_take(&app_line.parameters, &app_line.registers, APP_PARAMETERS_NOT_ASKED);
    app_line.registers.parameters =
        NULL; /* the loader uses the settings of both buses only; it stores no parameters */
    board_line_set(&app_line.registers.requested.line);
    app_canopen_init(&app_line.canopen, side.drive.ts_s);
    app_canopen_start(&app_line.canopen, &app_line.registers);
    app_modbus_follow(&app_line.modbus, &app_line.registers.requested.line, side.drive.ts_s,
                      side.config.modbus_gap_ticks);
    side.tick_cycles = side.config.board.pwm_cycles / side.drive.hardware.updates_per_period;
    side.cycles      = board_cycles();
    side.ticks       = 0UL;
}

static void count_ticks(void)
{
    while ((uint32_t)(board_cycles() - side.cycles) >= side.tick_cycles) {
        side.cycles += side.tick_cycles;
        side.ticks += 1UL;
    }
}

void app_loader_pass(void)
{
    count_ticks();
    app_modbus_poll(&app_line.modbus, &app_line.registers, side.ticks);
    app_canopen_poll(&app_line.canopen, &app_line.registers, side.ticks);
    if (app_line.canopen.restart) {
        board_restart(false);
    }
    if (!app_modbus_is_quiet(&app_line.modbus, side.ticks) ||
        !app_canopen_is_quiet(&app_line.canopen, side.ticks)) {
        return; /* an answer is being sent */
    }
    if (app_line.loader.restart) {
        board_restart(app_line.loader.enter);
    }
    app_loader_work(&app_line.loader);
}
