/* SPDX-License-Identifier: MIT */
#include "app_registers.h"

#include <stddef.h>

#include "app_registers_count.h"
#include "app_registers_place.h"

#define RPM_PER_RADPS 9.54929659f /* 60 / (2 pi) */
#define ADDRESS_MAX   247U        /* by the protocol */

/* Defaults. Chosen: the lowest number, and the rate that most masters begin with. */
#define CAN_NODE      1U
#define CAN_RATE_kbps 500U

typedef struct {
    const app_registers_entry_t *entries;
    uint16_t                     count;
} map_t;

static const map_t holding = {app_registers_map_holding, APP_REGISTERS_MAP_HOLDING};
static const map_t input   = {app_registers_map_input, APP_REGISTERS_MAP_INPUT};

/* Sets member by member: a local copy would take a quarter of the stack. */
ctl_status_t app_registers_init(app_registers_t *r, const app_config_t *config,
                                const drive_config_t *drive)
{
    static const app_status_t nothing = {.mode = APP_MODE_BOOT};
    const uint16_t            pairs   = drive->hardware.pole_pairs;

    static const app_scope_setup_t scope = {.decimation = 1U};
    static const board_line_t      line  = {
              .baud_Bd = 115200UL, .format = (uint16_t)BOARD_LINE_EVEN, .direction = 0U};

    r->requested.objects              = app_control_default(drive);
    r->requested.scope                = scope;
    r->requested.scope_command        = 0U;
    r->requested.store_command        = (uint16_t)APP_PARAMETERS_NO_COMMAND;
    r->requested.line                 = line;
    r->parameters                     = NULL;
    r->scope                          = NULL;
    r->record                         = NULL;
    r->map                            = NULL;
    r->requested.modbus_address       = config->modbus_address;
    r->requested.modbus_timeout_ticks = config->modbus_timeout_ticks;
    r->requested.can_node             = CAN_NODE;
    r->requested.can_rate_kbps        = CAN_RATE_kbps;
    r->config                         = config;
    r->drive                          = drive;
    r->rpm_per_e_radps                = RPM_PER_RADPS / ((pairs > 0U) ? (float)pairs : 1.0f);
    r->status                         = nothing;
    app_registers_init_units(r);
    app_registers_init_inertia(r);
    app_registers_init_trim(r);
    r->trial   = r->requested;
    r->changed = false;
    r->silent  = false;
    r->by_can  = false;
    r->loader  = NULL;
    app_watch_ring_reset(&r->ring);
    return ((config->modbus_address >= 1U) && (config->modbus_address <= ADDRESS_MAX) &&
            (config->modbus_timeout_ticks > 0U))
               ? CTL_OK
               : CTL_BAD_CONFIG;
}

/* Rows have ascending addresses: a word that is not in a row is in a later one, or in none. */
static app_registers_result_t read_map(const app_registers_t *r, const map_t *map, uint16_t first,
                                       uint16_t count, uint16_t *values)
{
    uint16_t n = 0U;

    for (uint16_t k = 0U; (k < map->count) && (n < count); k++) {
        const app_registers_entry_t *e    = &map->entries[k];
        const uint16_t               all  = app_registers_count_words(e);
        const uint16_t               word = (uint16_t)((first + n) - e->address);

        if (word < all) {
            const uint32_t value = app_registers_place_value(r, e);

            if ((all == 2U) && (word == 0U)) {
                values[n] = (uint16_t)(value >> 16);
                n         = (uint16_t)(n + 1U);
            }
            if (n < count) {
                values[n] = (uint16_t)(value & 0xFFFFUL);
                n         = (uint16_t)(n + 1U);
            }
        }
    }
    return (n == count) ? APP_REGISTERS_OK : APP_REGISTERS_BAD_ADDRESS;
}

static bool is_loader(const app_registers_t *r, uint16_t first)
{
    return (r->loader != NULL) && (first >= APP_LOADER_FIRST);
}

const char *app_registers_board(const app_registers_t *r)
{
    return (r->loader != NULL) ? r->loader->in_force->board->name : "";
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
    if (first >= APP_REGISTERS_INPUTS_TOO) {
        return read_map(r, &input, (uint16_t)(first - APP_REGISTERS_INPUTS_TOO), count, values);
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
    if ((r->scope != NULL) && (first >= APP_TRACES_SCOPE)) {
        return read_traces(r, first, count, values);
    }
    if (is_loader(r, first)) {
        return found(
            app_loader_read(r->loader, (uint16_t)(first - APP_LOADER_FIRST), count, values));
    }
    return read_map(r, &input, first, count, values);
}

void app_registers_saved_read(const app_registers_t *r, uint16_t *words)
{
    uint16_t n = 0U;

    for (uint16_t k = 0U; k < holding.count; k++) {
        const app_registers_entry_t *e = &holding.entries[k];

        if (e->saved != 0U) {
            const uint16_t count = app_registers_count_words(e);

            words[n]      = e->saved;
            words[n + 1U] = 0U;
            (void)read_map(r, &holding, e->address, count,
                           &words[(n + APP_REGISTERS_SAVED_EACH) - count]);
            n = (uint16_t)(n + APP_REGISTERS_SAVED_EACH);
        }
    }
}
