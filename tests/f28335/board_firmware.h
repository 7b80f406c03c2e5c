/* SPDX-License-Identifier: MIT */
/**
 * @file board_firmware.h
 * @brief The real board layer under a tick and a background that a test controls.
 */
#ifndef BOARD_FIRMWARE_H
#define BOARD_FIRMWARE_H

#include <stdbool.h>
#include <stdint.h>

#include "sil/f28335/f28335_names.h"

#ifdef __cplusplus
extern "C" {
#endif

#include "board.h"

typedef struct {
    /* Set by the test. */
    bool          enable;        /**< gates on from the next tick */
    bool          chops;         /**< the tick commands the chopper */
    bool          chopper;       /**< on */
    bool          brakes;        /**< the tick commands the holding brake */
    bool          brake;         /**< released */
    bool          trip;          /**< gates off from the next tick */
    bool          serve;         /**< the background serves the watchdog */
    double        tick_lasts_us; /**< more than nothing: the next tick takes this long, once */
    uint16_t      updates;       /**< per PWM period */
    board_setup_t setup;         /**< that board_init() gets */
    board_duty_t  duty;
    double        pass_lasts_us; /**< a pass of the background takes this longer */
    board_line_t  line;          /**< baud_Bd other than 0: set up at the start */
    uint16_t      say[16];       /**< the background sends these octets ... */
    int           says;          /**< ... so many of them */
    bool          hear;          /**< the background listens */
    /* Seen by the firmware. */
    bool           init_result;
    bool           started;
    uint32_t       ticks;
    board_sample_t first_sample;
    board_sample_t sample;
    uint16_t       faults;
    board_reset_t  reset_cause;
    uint16_t       heard; /**< octet */
} board_firmware_t;

extern volatile board_firmware_t board_firmware;

int board_firmware_main(void);

#ifdef __cplusplus
}
#endif

#endif /* BOARD_FIRMWARE_H */
