/* SPDX-License-Identifier: MIT */
/**
 * @file app_scope.h
 * @brief An oscilloscope in the tick: four of its signals (app_scope_signals.h), every so many ticks, around a trigger.
 *
 *     IDLE -> armed: FILLS what shall stand before the trigger -> WAITS for it -> TAKES the rest -> DONE
 *
 * The setting is changed, and what was taken is read, while the scope is IDLE or DONE: nothing changes then. Armed, it is the
 * tick's. The background alone arms and stops, the tick alone goes on from there; each change is one word.
 *
 * Cost: idle two comparisons. A tick that takes a sample loads four values by a table of cases and looks at the trigger: about
 * 160 instructions at the most, whatever the setting (listing for a Cortex-M4; a C28x's was not had).
 */
#ifndef APP_SCOPE_H
#define APP_SCOPE_H

#include "app_scope_signals.h"

#define APP_SCOPE_CHANNELS 4U
#ifndef APP_SCOPE_SAMPLES      /* SDRE_SCOPE_SAMPLES */
#define APP_SCOPE_SAMPLES 512U /**< of each channel; a power of two */
#endif

typedef enum {
    APP_SCOPE_IDLE = 0,
    APP_SCOPE_FILLS,
    APP_SCOPE_WAITS,
    APP_SCOPE_TAKES,
    APP_SCOPE_DONE
} app_scope_state_t;

/** What triggers. */
enum { APP_SCOPE_AT_ONCE = 0, APP_SCOPE_RISING, APP_SCOPE_FALLING };

typedef struct {
    uint16_t signal[APP_SCOPE_CHANNELS];
    uint16_t decimation; /**< ticks between two samples, > 0 */
    uint16_t trigger;    /**< APP_SCOPE_AT_ONCE .. */
    uint16_t channel;    /**< that triggers, 0 .. 3 */
    float    level;      /**< in the signal's unit */
    uint16_t before;     /**< samples before the trigger, below APP_SCOPE_SAMPLES */
} app_scope_setup_t;

typedef struct {
    app_scope_state_t state;
    app_scope_setup_t setup;
    uint16_t          wait_ticks; /**< until the next sample */
    uint16_t          next;       /**< place of the next sample */
    uint16_t          count;      /**< samples since it was armed, at most all */
    uint16_t          left;       /**< samples still to be taken */
    bool              have_last;
    float             last;          /**< of the channel that triggers */
    uint32_t          trigger_ticks; /**< tick of the trigger's sample */
    float             samples[APP_SCOPE_SAMPLES][APP_SCOPE_CHANNELS];
} app_scope_t;

/** Nothing was taken. Context: init. */
void app_scope_init(app_scope_t *s);

/** Whether there is such a setting. */
bool app_scope_knows(const app_scope_setup_t *setup);

/** Begins; a setting that app_scope_knows(). Context: background. */
void app_scope_arm(volatile app_scope_t *s, const app_scope_setup_t *setup);

/** Gives up; what was taken is worth nothing. Context: background. */
void app_scope_stop(volatile app_scope_t *s);

/** A tick of an armed scope. Context: control ISR. */
void app_scope_go_on(app_scope_t *s, const app_scope_view_t *view);

/** After everything else of a tick. Inline: most of the time the scope is idle. Context: control ISR. */
static inline void app_scope_tick(app_scope_t *s, const app_scope_view_t *view)
{
    if ((s->state != APP_SCOPE_IDLE) && (s->state != APP_SCOPE_DONE)) {
        app_scope_go_on(s, view);
    }
}

/** Sample `at` of DONE in the order of time, 0 being the first. Context: background. */
float app_scope_read(const volatile app_scope_t *s, uint16_t at, uint16_t channel);

#endif /* APP_SCOPE_H */
