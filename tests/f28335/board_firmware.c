/* SPDX-License-Identifier: MIT */
#include "board_firmware.h"

#include "DSP28x_Project.h"
#include "prepare.h"

volatile board_firmware_t board_firmware;

static void tick(void)
{
    const board_duty_t duty = board_firmware.duty;

    board_firmware.sample = *board_sample();
    if (board_firmware.ticks == 0U) {
        board_firmware.first_sample = *board_sample();
    }
    board_firmware.ticks = board_firmware.ticks + 1U;
    if (board_firmware.tick_lasts_us > 0.0) {
        const double lasts_us        = board_firmware.tick_lasts_us;
        board_firmware.tick_lasts_us = 0.0;
        DELAY_US(lasts_us);
    }
    board_duty_write(&duty);
    if (board_firmware.enable) {
        board_firmware.enable = false;
        board_gate_enable();
    }
    if (board_firmware.trip) {
        board_firmware.trip = false;
        board_gate_trip();
    }
    if (board_firmware.brakes) {
        board_brake_write(board_firmware.brake);
    }
    if (board_firmware.chops) {
        board_chopper_write(board_firmware.chopper);
    }
    board_firmware.faults = board_fault_read();
}

static void talk(void)
{
    uint16_t octet = 0U;

    for (int n = 0; n < board_firmware.says; n++) {
        (void)board_serial_write(board_firmware.say[n]);
    }
    board_firmware.says = 0;
    if (board_firmware.hear && board_serial_read(&octet)) {
        board_firmware.heard = octet;
    }
}

int board_firmware_main(void)
{
    static board_setup_t setup;

    setup                      = board_firmware.setup;
    board_firmware.init_result = board_prepare() && board_init(&setup);
    board_firmware.faults      = board_fault_read();
    board_firmware.reset_cause = board_reset_cause();
    if (board_firmware.init_result) {
        const board_line_t line = board_firmware.line;
        if (line.baud_Bd != 0U) {
            board_line_set(&line);
        }
        board_start(tick, board_firmware.updates);
        board_firmware.started = true;
    }
    for (;;) {
        if (board_firmware.serve && board_firmware.started) {
            board_watchdog_serve();
        }
        talk();
        if (board_firmware.pass_lasts_us > 0.0) {
            DELAY_US(board_firmware.pass_lasts_us);
        }
        asm(" NOP");
    }
}
