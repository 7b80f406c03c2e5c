/* SPDX-License-Identifier: MIT */
#include "app_scope.h"

#define MASK (APP_SCOPE_SAMPLES - 1U)

void app_scope_init(app_scope_t *s)
{
    static const app_scope_setup_t first = {.decimation = 1U};

    s->state         = APP_SCOPE_IDLE;
    s->setup         = first;
    s->wait_ticks    = 0U;
    s->next          = 0U;
    s->count         = 0U;
    s->left          = 0U;
    s->have_last     = false;
    s->last          = 0.0f;
    s->trigger_ticks = 0UL;
}

bool app_scope_knows(const app_scope_setup_t *setup)
{
    bool known = (setup->decimation > 0U) && (setup->trigger <= (uint16_t)APP_SCOPE_FALLING) &&
                 (setup->channel < APP_SCOPE_CHANNELS) && (setup->before < APP_SCOPE_SAMPLES);

    for (uint16_t k = 0U; k < APP_SCOPE_CHANNELS; k++) {
        known = known && (setup->signal[k] < (uint16_t)APP_SCOPE_SIGNALS);
    }
    return known;
}

void app_scope_arm(volatile app_scope_t *s, const app_scope_setup_t *setup)
{
    s->state      = APP_SCOPE_IDLE; /* from here on no tick accesses it */
    s->setup      = *setup;
    s->wait_ticks = 0U;
    s->next       = 0U;
    s->count      = 0U;
    s->left       = (uint16_t)(APP_SCOPE_SAMPLES - setup->before);
    s->have_last  = false;
    s->state      = APP_SCOPE_FILLS;
}

void app_scope_stop(volatile app_scope_t *s)
{
    s->state = APP_SCOPE_IDLE;
}

/* True if x crossed the level since the previous sample. A NaN crosses no level. */
static bool is_triggered(app_scope_t *s, float x)
{
    const float level   = s->setup.level;
    const bool  rises   = (s->last < level) && (x >= level);
    const bool  falls   = (s->last > level) && (x <= level);
    const bool  known   = s->have_last;
    bool        matches = true;

    if (s->setup.trigger == (uint16_t)APP_SCOPE_RISING) {
        matches = known && rises;
    } else if (s->setup.trigger == (uint16_t)APP_SCOPE_FALLING) {
        matches = known && falls;
    } else {
        /* APP_SCOPE_AT_ONCE: triggers always */
    }
    s->last      = x;
    s->have_last = true;
    return matches;
}

static app_scope_state_t take_rest(app_scope_t *s)
{
    s->left = (uint16_t)(s->left - 1U);
    return (s->left == 0U) ? APP_SCOPE_DONE : APP_SCOPE_TAKES;
}

/* Next state after a sample was stored; x is its value of the trigger channel. */
static app_scope_state_t go_on(app_scope_t *s, float x, uint32_t ticks)
{
    app_scope_state_t state     = s->state;
    const bool        triggered = is_triggered(s, x);

    if (state == APP_SCOPE_TAKES) {
        state = take_rest(s);
    } else if (s->count <= s->setup.before) {
        state = APP_SCOPE_FILLS;
    } else if (triggered) {
        s->trigger_ticks = ticks;
        state            = take_rest(s);
    } else {
        state = APP_SCOPE_WAITS;
    }
    return state;
}

void app_scope_go_on(app_scope_t *s, const app_scope_view_t *view)
{
    if (s->wait_ticks > 0U) {
        s->wait_ticks = (uint16_t)(s->wait_ticks - 1U);
        return;
    }
    s->wait_ticks = (uint16_t)(s->setup.decimation - 1U);

    float *const to = s->samples[s->next & MASK];
    for (uint16_t k = 0U; k < APP_SCOPE_CHANNELS; k++) {
        to[k] = app_scope_signals_value(view, s->setup.signal[k]);
    }
    s->next = (uint16_t)((s->next + 1U) & MASK);
    if (s->count < APP_SCOPE_SAMPLES) {
        s->count = (uint16_t)(s->count + 1U);
    }
    s->state = go_on(s, to[s->setup.channel & (APP_SCOPE_CHANNELS - 1U)], view->modes->ticks);
}

float app_scope_read(const volatile app_scope_t *s, uint16_t at, uint16_t channel)
{
    return s->samples[(uint16_t)(s->next + at) & MASK][channel];
}
