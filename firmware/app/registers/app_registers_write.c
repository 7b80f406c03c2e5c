/* SPDX-License-Identifier: MIT */
/* Writes to the holding registers. */
#include "app_registers.h"

#include <stddef.h>

#include "app_registers_count.h"
#include "app_registers_place.h"

#define SCOPE_ARM  1U /* values of SCOPE_COMMAND */
#define SCOPE_STOP 2U

/* Limits a value to its range, with a tolerance of half a count of the register. */
static float held_value(const app_registers_entry_t *e, float x)
{
    const float room = (e->per_unit > 0.0f) ? (0.5f / e->per_unit) : 0.5f;
    return base_clamp(x, e->least - room, e->most + room);
}

static bool is_stopped(const app_registers_t *r)
{
    return !r->status.gate_enable && (r->status.state != APP_CONTROL_OPERATION_ENABLED) &&
           (r->status.state != APP_CONTROL_QUICK_STOP_ACTIVE);
}

/* True if the register already has this value. Such a write is always allowed, as a master may send
 * its whole command each time. */
static bool is_there(const app_registers_t *r, const app_registers_entry_t *e,
                     const uint16_t *words)
{
    const uint32_t value = app_registers_place_value(r, e);
    const bool     wide  = app_registers_count_words(e) == 2U;
    const uint32_t high  = wide ? words[0] : 0U;
    const uint32_t low   = wide ? words[1] : words[0];

    return (value & (wide ? 0xFFFFFFFFUL : 0xFFFFUL)) == ((high << 16) | low);
}

/* A command that restarts the drive. It needs its signature, against stray writes. It needs
 * standstill, because the motor is uncontrolled for seconds. It needs a rest, because the flash
 * wears. */
static app_registers_result_t try_command(app_registers_t *r, const app_registers_entry_t *e,
                                          const uint16_t *words)
{
    const uint32_t given  = ((uint32_t)words[0] << 16) | words[1];
    const bool     stands = base_within(r->status.speed_e_radps, r->config->stop.still_e_radps);
    const bool     idle =
        (e->address == (uint16_t)APP_REGISTERS_ACCEPT_FALLBACK) && (app_registers_lost(r) == 0U);

    if (given != e->signature) {
        return APP_REGISTERS_BAD_VALUE;
    }
    if ((r->parameters == NULL) || !r->parameters->rested || !is_stopped(r) || !stands || idle) {
        return APP_REGISTERS_BUSY;
    }
    app_registers_place_put(r, &r->trial, e, 0.0f, 0L);
    return APP_REGISTERS_OK;
}

static app_registers_result_t try_one(app_registers_t *r, const app_registers_entry_t *e,
                                      const uint16_t *words)
{
    const float given = app_registers_count_written(e, words);
    const float x     = held_value(e, given);

    if (e->signature != 0UL) {
        return try_command(r, e, words);
    }
    if (!base_in_range(given, x, x)) { /* beyond its range */
        return APP_REGISTERS_BAD_VALUE;
    }
    if (e->stopped && !is_stopped(r) && !is_there(r, e, words)) {
        return APP_REGISTERS_BUSY;
    }
    app_registers_place_put(r, &r->trial, e, x, app_registers_count_whole(e, words));
    return APP_REGISTERS_OK;
}

/* Checks that depend on the drive or on several registers. */
static bool may_be_requested(const app_registers_t *r, app_registers_request_t *w)
{
    const float most = r->drive->speed_max_e_radps;
    return base_in_range(w->objects.omega_e_radps, -most, most) && app_registers_see_units(r, w) &&
           app_control_knows(&w->objects, r->drive) && app_scope_knows(&w->scope) &&
           board_line_fits(&w->line) && board_can_fits(w->can_rate_kbps);
}

/* True if the range contains no half of a two-word value. */
static bool are_whole(uint16_t first, uint16_t count)
{
    uint16_t n = 0U;

    for (uint16_t k = 0U; (k < APP_REGISTERS_MAP_HOLDING) && (n < count); k++) {
        const app_registers_entry_t *e = &app_registers_map_holding[k];
        if (e->address == (uint16_t)(first + n)) {
            n = (uint16_t)(n + app_registers_count_words(e));
        }
    }
    return (n == count) && (count > 0U);
}

static app_registers_result_t write_loader(app_registers_t *r, uint16_t first, uint16_t count,
                                           const uint16_t *values)
{
    const app_loader_result_t result = app_loader_write(
        r->loader, r->status.gate_enable, (uint16_t)(first - APP_LOADER_FIRST), count, values);

    if (result == APP_LOADER_BAD_VALUE) {
        return APP_REGISTERS_BAD_VALUE;
    }
    return (result == APP_LOADER_OK) ? APP_REGISTERS_OK : APP_REGISTERS_BAD_ADDRESS;
}

static void command_scope(app_registers_t *r)
{
    const uint16_t command = r->requested.scope_command;

    r->requested.scope_command = 0U;
    if ((r->scope != NULL) && (command == SCOPE_ARM)) {
        app_scope_arm(r->scope, &r->requested.scope);
    } else if ((r->scope != NULL) && (command == SCOPE_STOP)) {
        app_scope_stop(r->scope);
    } else {
        /* no command */
    }
}

/* Every write of the target position is a set-point, of the same value too. */
static void count_target(app_registers_t *r, uint16_t first, uint16_t count)
{
    const uint16_t at = (uint16_t)((uint16_t)APP_REGISTERS_TARGET_POSITION - first);

    if (at < count) {
        r->trial.objects.target_number = (uint16_t)(r->trial.objects.target_number + 1U);
    }
}

/* Changes the copy. All addresses are known to exist. */
static app_registers_result_t try_all(app_registers_t *r, uint16_t first, uint16_t count,
                                      const uint16_t *values)
{
    app_registers_result_t result = APP_REGISTERS_OK;
    uint16_t               n      = 0U;

    for (uint16_t k = 0U;
         (k < APP_REGISTERS_MAP_HOLDING) && (n < count) && (result == APP_REGISTERS_OK); k++) {
        const app_registers_entry_t *e = &app_registers_map_holding[k];
        if (e->address == (uint16_t)(first + n)) {
            result = try_one(r, e, &values[n]);
            n      = (uint16_t)(n + app_registers_count_words(e));
        }
    }
    return result;
}

void app_registers_begin(app_registers_t *r)
{
    r->trial = r->requested;
}

app_registers_result_t app_registers_try(app_registers_t *r, uint16_t first, uint16_t count,
                                         const uint16_t *values)
{
    app_registers_result_t result = APP_REGISTERS_BAD_ADDRESS;

    if (are_whole(first, count)) {
        result = try_all(r, first, count, values);
        count_target(r, first, count);
    }
    return result;
}

bool app_registers_fits(app_registers_t *r)
{
    return may_be_requested(r, &r->trial);
}

app_registers_result_t app_registers_write(app_registers_t *r, uint16_t first, uint16_t count,
                                           const uint16_t *values)
{
    if ((r->loader != NULL) && (first >= APP_LOADER_FIRST)) {
        return write_loader(r, first, count, values);
    }
    app_registers_begin(r);
    const app_registers_result_t result = app_registers_try(r, first, count, values);
    if (result != APP_REGISTERS_OK) {
        return result;
    }
    if (!app_registers_fits(r)) {
        return APP_REGISTERS_BAD_VALUE;
    }
    r->requested = r->trial;
    command_scope(r);
    r->silent  = r->silent && !app_control_enables(r->requested.objects.controlword);
    r->by_can  = r->by_can && (first != (uint16_t)APP_REGISTERS_CONTROLWORD);
    r->changed = true;
    return APP_REGISTERS_OK;
}

/* Words of a stored parameter by its digest; NULL: it is not stored. */
static const uint16_t *stored_of(uint16_t digest, const uint16_t *words, uint16_t count)
{
    const uint16_t *found = NULL;

    for (uint16_t k = 0U; (k < count) && (found == NULL); k++) {
        const uint16_t *each = &words[(uint32_t)k * APP_REGISTERS_SAVED_EACH];

        found = (each[0] == digest) ? each : NULL;
    }
    return found;
}

/* Stored parameters that this firmware has. */
static uint16_t known_of(const uint16_t *words, uint16_t count)
{
    uint16_t known = 0U;

    for (uint16_t k = 0U; k < APP_REGISTERS_MAP_HOLDING; k++) {
        const uint16_t digest = app_registers_map_holding[k].saved;

        if ((digest != 0U) && (stored_of(digest, words, count) != NULL)) {
            known = (uint16_t)(known + 1U);
        }
    }
    return known;
}

bool app_registers_saved_take(app_registers_t *r, const uint16_t *words, uint16_t count,
                              uint16_t *unknown)
{
    const uint16_t known = known_of(words, count);
    bool           ok    = true;

    r->trial = r->requested;
    for (uint16_t k = 0U; k < APP_REGISTERS_MAP_HOLDING; k++) {
        const app_registers_entry_t *e = &app_registers_map_holding[k];
        const uint16_t *stored = (e->saved != 0U) ? stored_of(e->saved, words, count) : NULL;

        if (stored != NULL) {
            const uint16_t first =
                (uint16_t)(APP_REGISTERS_SAVED_EACH - app_registers_count_words(e));

            ok = (try_one(r, e, &stored[first]) == APP_REGISTERS_OK) && ok;
        }
    }
    *unknown = (known < count) ? (uint16_t)(count - known) : 0U;
    if (ok && may_be_requested(r, &r->trial)) {
        r->requested = r->trial;
        r->changed   = true;
        return true;
    }
    return false;
}

void app_registers_silence(app_registers_t *r)
{
    app_objects_t *o = &r->requested.objects;

    if (app_control_enables(o->controlword)) {
        o->controlword = (o->lost_option == (int16_t)APP_CONTROL_LOST_QUICK_STOP)
                             ? (uint16_t)APP_CONTROL_QUICK_STOP
                             : (uint16_t)APP_CONTROL_DISABLE_VOLTAGE;
        r->changed     = true;
        r->silent      = true;
    }
}

void app_registers_see_path(app_registers_t *r)
{
    if (r->status.unled) {
        app_registers_silence(r);
    }
}
