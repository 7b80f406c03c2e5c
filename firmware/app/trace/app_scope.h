/* SPDX-License-Identifier: MIT */
/**
 * @file app_scope.h
 * @brief Oscilloscope in the tick: records four signals (app_scope_signals.h) around a trigger.
 *
 *     IDLE -> armed: FILLS the samples before the trigger -> WAITS for it -> TAKES the rest -> DONE
 *
 * In IDLE and DONE the background owns the scope: it changes the setting and reads the samples.
 * Armed, the scope belongs to the tick. Only the background arms and stops it, and only the tick
 * advances it. Each change of owner is one word.
 *
 * Cost: two comparisons when idle. A tick with a sample takes at most 160 instructions (listing of
 * a Cortex-M4; no C28x listing exists).
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

/** Kinds of trigger. */
enum { APP_SCOPE_AT_ONCE = 0, APP_SCOPE_RISING, APP_SCOPE_FALLING };

typedef struct {
    uint16_t signal[APP_SCOPE_CHANNELS];
    uint16_t decimation; /**< ticks between two samples, > 0 */
    uint16_t trigger;    /**< APP_SCOPE_AT_ONCE .. */
    uint16_t channel;    /**< trigger channel, 0 .. 3 */
    float    level;      /**< in the signal's unit */
    uint16_t before;     /**< samples before the trigger, below APP_SCOPE_SAMPLES */
} app_scope_setup_t;

typedef struct {
    app_scope_state_t state;
    app_scope_setup_t setup;
    uint16_t          wait_ticks; /**< until the next sample */
    uint16_t          next;       /**< place of the next sample */
    uint16_t          count;      /**< samples since arming, <= APP_SCOPE_SAMPLES */
    uint16_t          left;       /**< samples still to be taken */
    bool              have_last;
    float             last;          /**< previous value of the trigger channel */
    uint32_t          trigger_ticks; /**< tick of the trigger's sample */
    float             samples[APP_SCOPE_SAMPLES][APP_SCOPE_CHANNELS];
} app_scope_t;

/** Makes the scope IDLE, without samples. Context: init. */
void app_scope_init(app_scope_t *s);

/** True if the setting is valid. Context: background. */
bool app_scope_knows(const app_scope_setup_t *setup);

/** Arms the scope with a setting that app_scope_knows(). Context: background. */
void app_scope_arm(volatile app_scope_t *s, const app_scope_setup_t *setup);

/** Stops the scope and discards the samples. Context: background. */
void app_scope_stop(volatile app_scope_t *s);

/** Executes a tick of an armed scope. Context: control ISR. */
void app_scope_go_on(app_scope_t *s, const app_scope_view_t *view);

/** Call it at the end of a tick. It is inline as the scope is mostly idle. Context: control ISR. */
static inline void app_scope_tick(app_scope_t *s, const app_scope_view_t *view)
{
    if ((s->state != APP_SCOPE_IDLE) && (s->state != APP_SCOPE_DONE)) {
        app_scope_go_on(s, view);
    }
}

/** Reads sample `at` in DONE, in order of time, 0 is the first. Context: background. */
float app_scope_read(const volatile app_scope_t *s, uint16_t at, uint16_t channel);

#endif /* APP_SCOPE_H */
