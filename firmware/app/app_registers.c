/* SPDX-License-Identifier: MIT */
#include "app_registers.h"

#include <stddef.h>

#include "app_registers_count.h"

#define SCOPE_ARM  1U /* values of SCOPE_COMMAND */
#define SCOPE_STOP 2U

#define RPM_PER_RADPS 9.54929659f /* 60 / (2 pi) */
#define ADDRESS_MAX   247U        /* by the protocol */

typedef struct {
    const app_registers_entry_t *entries;
    uint16_t                     count;
    bool                         input;
} map_t;

static const map_t holding = {app_registers_map_holding, APP_REGISTERS_MAP_HOLDING, false};

/* Member by member, and from constants: on the stack they would take a quarter of it. */
ctl_status_t app_registers_init(app_registers_t *r, const app_config_t *config,
                                const drive_config_t *drive)
{
    static const app_status_t nothing = {.mode = APP_MODE_BOOT};
    const uint16_t            pairs   = drive->hardware.pole_pairs;

    static const app_scope_setup_t scope = {.decimation = 1U};

    r->wanted.objects              = app_control_default(drive);
    r->wanted.scope                = scope;
    r->wanted.scope_command        = 0U;
    r->scope                       = NULL;
    r->record                      = NULL;
    r->wanted.modbus_address       = config->modbus_address;
    r->wanted.modbus_timeout_ticks = config->modbus_timeout_ticks;
    r->config                      = config;
    r->drive                       = drive;
    r->rpm_per_e_radps             = RPM_PER_RADPS / ((pairs > 0U) ? (float)pairs : 1.0f);
    r->status                      = nothing;
    r->trial                       = r->wanted;
    r->changed                     = false;
    r->silent                      = false;
    r->loader                      = NULL;
    return ((config->modbus_address >= 1U) && (config->modbus_address <= ADDRESS_MAX) &&
            (config->modbus_timeout_ticks > 0U))
               ? CTL_OK
               : CTL_BAD_CONFIG;
}

uint32_t app_registers_ticks(const app_registers_t *r, float time_s)
{
    const float ticks = (time_s / r->drive->ts_s) + 0.5f;
    return (uint32_t)ticks;
}

static bool is_whole(const app_registers_entry_t *e)
{
    return (e->type != APP_REGISTERS_DEC) && !(e->per_unit > 0.0f);
}

static uint32_t value_of(const app_registers_t *r, const map_t *map, const app_registers_entry_t *e)
{
    if (is_whole(e)) {
        return map->input ? app_registers_map_input_whole(r, e->address)
                          : app_registers_map_holding_whole(r, e->address);
    }
    return app_registers_count_of(map->input ? app_registers_map_input_real(r, e->address)
                                             : app_registers_map_holding_real(r, e->address),
                                  e);
}

/* The entry that this address belongs to, and whether it is its second word; count where there is none. */
static uint16_t find(const map_t *map, uint16_t address)
{
    for (uint16_t k = 0U; k < map->count; k++) {
        const app_registers_entry_t *e = &map->entries[k];
        if ((address >= e->address) &&
            ((uint16_t)(address - e->address) < app_registers_count_words(e))) {
            return k;
        }
    }
    return map->count;
}

static app_registers_result_t read_map(const app_registers_t *r, const map_t *map, uint16_t first,
                                       uint16_t count, uint16_t *values)
{
    uint16_t k = find(map, first);
    uint16_t n = 0U;

    for (; (k < map->count) && (n < count); k++) {
        const app_registers_entry_t *e     = &map->entries[k];
        const uint32_t               value = value_of(r, map, e);
        const uint16_t               at    = (uint16_t)(first + n); /* below the last entry's end */

        if ((at < e->address) || ((uint16_t)(at - e->address) >= app_registers_count_words(e))) {
            break; /* behind a block */
        }
        if ((app_registers_count_words(e) == 2U) && (at == e->address)) {
            values[n] = (uint16_t)(value >> 16);
            n         = (uint16_t)(n + 1U);
        }
        if (n < count) {
            values[n] = (uint16_t)(value & 0xFFFFUL);
            n         = (uint16_t)(n + 1U);
        }
    }
    return (n == count) ? APP_REGISTERS_OK : APP_REGISTERS_BAD_ADDRESS;
}

static bool is_loader(const app_registers_t *r, uint16_t first)
{
    return (r->loader != NULL) && (first >= APP_LOADER_FIRST);
}

static app_registers_result_t found(bool all)
{
    return all ? APP_REGISTERS_OK : APP_REGISTERS_BAD_ADDRESS;
}

app_registers_result_t app_registers_read_holding(const app_registers_t *r, uint16_t first,
                                                  uint16_t count, uint16_t *values)
{
    if (is_loader(r, first)) {
        return found(app_loader_read_holding((uint16_t)(first - APP_LOADER_FIRST), count, values));
    }
    return read_map(r, &holding, first, count, values);
}

static app_registers_result_t read_traces(const app_registers_t *r, uint16_t first, uint16_t count,
                                          uint16_t *values)
{
    const app_traces_result_t result = app_traces_read(r->scope, r->record, first, count, values);

    return (result == APP_TRACES_NOT_NOW) ? APP_REGISTERS_BUSY : found(result == APP_TRACES_OK);
}

app_registers_result_t app_registers_read_input(const app_registers_t *r, uint16_t first,
                                                uint16_t count, uint16_t *values)
{
    static const map_t input = {app_registers_map_input, APP_REGISTERS_MAP_INPUT, true};

    if ((r->scope != NULL) && (first >= APP_TRACES_SCOPE)) {
        return read_traces(r, first, count, values);
    }
    if (is_loader(r, first)) {
        return found(
            app_loader_read(r->loader, (uint16_t)(first - APP_LOADER_FIRST), count, values));
    }
    return read_map(r, &input, first, count, values);
}

/* A write may come to within half of what a register shows. */
static bool is_in(const app_registers_entry_t *e, float x)
{
    const float room = (e->per_unit > 0.0f) ? (0.5f / e->per_unit) : 0.5f;
    return base_in_range(x, e->least - room, e->most + room);
}

static bool is_stopped(const app_registers_t *r)
{
    return !r->status.gate_enable && (r->status.state != APP_CONTROL_OPERATION_ENABLED) &&
           (r->status.state != APP_CONTROL_QUICK_STOP_ACTIVE);
}

/* What a register has already may be written at any time: a master that sends all of its command. */
static bool is_there(const app_registers_t *r, const app_registers_entry_t *e,
                     const uint16_t *words)
{
    const uint32_t value = value_of(r, &holding, e);
    const bool     wide  = app_registers_count_words(e) == 2U;
    const uint32_t high  = wide ? words[0] : 0U;
    const uint32_t low   = wide ? words[1] : words[0];

    return (value & (wide ? 0xFFFFFFFFUL : 0xFFFFUL)) == ((high << 16) | low);
}

static app_registers_result_t try_one(app_registers_t *r, const app_registers_entry_t *e,
                                      const uint16_t *words)
{
    const float x = app_registers_count_written(e, words);

    if (!is_in(e, x)) {
        return APP_REGISTERS_BAD_VALUE;
    }
    if (e->stopped && !is_stopped(r) && !is_there(r, e, words)) {
        return APP_REGISTERS_BUSY;
    }
    app_registers_map_put(r, &r->trial, e->address, x);
    return APP_REGISTERS_OK;
}

/* What a table of constants cannot tell. */
static bool may_be_wanted(const app_registers_t *r, const app_registers_wanted_t *w)
{
    const float most = r->drive->speed_max_e_radps;
    return base_in_range(w->objects.omega_e_radps, -most, most) && app_control_knows(&w->objects) &&
           app_scope_knows(&w->scope);
}

/* Every value whole. */
static bool are_whole(uint16_t first, uint16_t count)
{
    uint16_t k = find(&holding, first);
    uint16_t n = 0U;

    for (; (k < holding.count) && (n < count); k++) {
        const app_registers_entry_t *e = &holding.entries[k];
        if ((e->address != (uint16_t)(first + n)) ||
            (app_registers_count_words(e) > (uint16_t)(count - n))) {
            return false;
        }
        n = (uint16_t)(n + app_registers_count_words(e));
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
    return found(result == APP_LOADER_OK);
}

static void command_scope(app_registers_t *r)
{
    const uint16_t command = r->wanted.scope_command;

    r->wanted.scope_command = 0U;
    if ((r->scope != NULL) && (command == SCOPE_ARM)) {
        app_scope_arm(r->scope, &r->wanted.scope);
    } else if ((r->scope != NULL) && (command == SCOPE_STOP)) {
        app_scope_stop(r->scope);
    } else {
        /* nothing is asked for */
    }
}

app_registers_result_t app_registers_write(app_registers_t *r, uint16_t first, uint16_t count,
                                           const uint16_t *values)
{
    uint16_t k = find(&holding, first);
    uint16_t n = 0U;

    if (is_loader(r, first)) {
        return write_loader(r, first, count, values);
    }
    if (!are_whole(first, count)) {
        return APP_REGISTERS_BAD_ADDRESS;
    }
    r->trial = r->wanted;
    while (n < count) {
        const app_registers_entry_t *e      = &holding.entries[k];
        const app_registers_result_t result = try_one(r, e, &values[n]);
        if (result != APP_REGISTERS_OK) {
            return result;
        }
        n = (uint16_t)(n + app_registers_count_words(e));
        k = (uint16_t)(k + 1U);
    }
    if (!may_be_wanted(r, &r->trial)) {
        return APP_REGISTERS_BAD_VALUE;
    }
    r->wanted = r->trial;
    command_scope(r);
    r->silent  = r->silent && !app_control_enables(r->wanted.objects.controlword);
    r->changed = true;
    return APP_REGISTERS_OK;
}

void app_registers_silence(app_registers_t *r)
{
    app_objects_t *o = &r->wanted.objects;

    if (app_control_enables(o->controlword)) {
        o->controlword = (o->lost_option == (int16_t)APP_CONTROL_LOST_QUICK_STOP)
                             ? (uint16_t)APP_CONTROL_QUICK_STOP
                             : (uint16_t)APP_CONTROL_DISABLE_VOLTAGE;
        r->changed     = true;
        r->silent      = true;
    }
}
