/* SPDX-License-Identifier: MIT */
/* Runs the application once: start-up, alignment, a speed, stop. The exit code names the failed
 * step; 0 is success. */
#include "app.h"
#include "app_control.h"
#include "board_config.h"
#include "gain_tables.h"
#include "host_stub.h"

enum {
    EXIT_DONE = 0,
    EXIT_BOARD, /* board_init() refused */
    EXIT_CONFIG,
    EXIT_READY, /* the mode of this name was not reached in time */
    EXIT_RUN,
    EXIT_SPEED, /* not the commanded speed */
    EXIT_STOP   /* still running, or gates on */
};

/* Chosen, with about a tenth of room: longer than board_config.c's times. */
#define READY_TICKS       200U
#define ALIGN_TICKS       15000U
#define SETTLE_TICKS      1500U /* 0.3 s */
#define WATCH_TICKS       500U
#define NEW_COMMAND_TICKS (SETTLE_TICKS + 100U)
#define STOP_TICKS        3U

#define SPEED_E_RADPS    150.0f /* chosen: a moderate speed; rated is 523 */
#define TOL_TRUE_E_RADPS 5.0f   /* worst 1.2 */
#define TOL_TOLD_E_RADPS 15.0f  /* worst 3.8: a count of the encoder is 3.1 mrad electrical */

static drive_config_t drive;

static void period(void)
{
    host_stub_period();
    app_background();
}

static bool reaches(app_mode_t mode, uint16_t ticks)
{
    for (uint16_t k = 0U; (k < ticks) && (app_status_read().mode != mode); k++) {
        period();
    }
    return app_status_read().mode == mode;
}

static bool command(float omega_e_radps, bool run)
{
    app_objects_t wanted = app_control_default(&drive);

    wanted.omega_e_radps = omega_e_radps;
    wanted.controlword   = run ? APP_CONTROL_ENABLE_OPERATION : APP_CONTROL_SHUT_DOWN;
    return app_command_write(&wanted);
}

/* Checks the reported speed and the true speed. */
static bool holds_speed(void)
{
    bool holds = true;

    for (uint16_t k = 0U; k < (SETTLE_TICKS + WATCH_TICKS); k++) {
        period();
        if (k == NEW_COMMAND_TICKS) { /* as a master does that repeats its commands */
            holds = holds && command(SPEED_E_RADPS, true);
        }
        if (k >= SETTLE_TICKS) {
            const app_status_t s = app_status_read();
            holds                = holds && (s.mode == APP_MODE_RUN) &&
                    base_within(s.speed_e_radps - SPEED_E_RADPS, TOL_TOLD_E_RADPS) &&
                    base_within(host_stub_speed_e_radps() - SPEED_E_RADPS, TOL_TRUE_E_RADPS);
        }
    }
    return holds;
}

int main(void)
{
    if (!board_init(&board_config.board)) {
        return EXIT_BOARD;
    }
    drive = gain_tables_drive;
    drive.hardware.encoder_positions =
        board_config.board.positions; /* the tables belong to another encoder */
    if (app_init(&board_config, &drive) != CTL_OK) {
        return EXIT_CONFIG;
    }
    board_start(app_tick, 1U);
    if (!reaches(APP_MODE_READY, READY_TICKS) || host_stub_gate()) {
        return EXIT_READY;
    }
    if (!command(0.0f, false)) {
        return EXIT_READY;
    }
    period(); /* ready to switch on */
    period();
    if (!command(SPEED_E_RADPS, true) || !reaches(APP_MODE_RUN, ALIGN_TICKS)) {
        return EXIT_RUN;
    }
    if (!holds_speed()) {
        return EXIT_SPEED;
    }
    if (!command(0.0f, false) || !reaches(APP_MODE_READY, STOP_TICKS) || host_stub_gate()) {
        return EXIT_STOP;
    }
    return EXIT_DONE;
}
