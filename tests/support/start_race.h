/* SPDX-License-Identifier: MIT */
/**
 * @file start_race.h
 * @brief A request that restarts the device, and a run that starts while its answer is on the way.
 */
#ifndef START_RACE_H
#define START_RACE_H

#include "app.h"
#include "app_control.h"
#include "fake_board.h"
#include "unity.h"

#define START_RACE_READY  2000 /* ticks after app_init() */
#define START_RACE_PASSES 400
#define START_RACE_ANSWER 8 /* octets of functions 6 and 16 */

static inline void start_race_pass(const drive_config_t *drive, bool run)
{
    app_objects_t o = app_control_default(drive);

    o.controlword = (uint16_t)(run ? APP_CONTROL_ENABLE_OPERATION : APP_CONTROL_SHUT_DOWN);
    (void)app_command_write(&o);
    app_tick();
    fake_board.cycles += 1000U;
    app_background();
}

static inline void start_race_ready(const drive_config_t *drive)
{
    for (int n = 0; n < START_RACE_READY; n++) {
        fake_board.sample.index_seen = (n == (START_RACE_READY - 10));
        start_race_pass(drive, false);
    }
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, app_status_read().mode);
}

/**
 * @brief Passes after a request was received. The run is commanded from pass `from` to the middle.
 *
 * A restart must come with the bridge open and after the whole answer.
 *
 * @return 1: it restarted; 0: the bridge came on first, and the request is forgotten; -1: refused.
 */
static inline int start_race(const drive_config_t *drive, int from)
{
    for (int n = 0; n < START_RACE_PASSES; n++) {
        start_race_pass(drive, (n >= from) && (n < (START_RACE_PASSES / 2)));
        if (fake_board.restarts > 0) {
            TEST_ASSERT_FALSE(fake_board.gate);
            TEST_ASSERT_EQUAL_INT(START_RACE_ANSWER, fake_board.tx.count);
            return 1;
        }
    }
    return (fake_board.tx.count == START_RACE_ANSWER) ? 0 : -1;
}

#endif /* START_RACE_H */
