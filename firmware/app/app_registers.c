/* SPDX-License-Identifier: MIT */
#include "app_registers.h"

#include <stddef.h>

#define TENTHS      10.0f
#define HUNDREDTHS  100.0f
#define THOUSANDTHS 1000.0f

static uint16_t signed_value(float x, float per_unit)
{
    const float scaled = base_clamp(x * per_unit, -32768.0f, 32767.0f);
    return (uint16_t)(int16_t)(scaled + ((scaled < 0.0f) ? -0.5f : 0.5f));
}

static uint16_t unsigned_value(float x, float per_unit)
{
    return (uint16_t)(base_clamp(x * per_unit, 0.0f, 65535.0f) + 0.5f);
}

static uint16_t high_word(uint32_t x)
{
    return (uint16_t)(x >> 16);
}

static uint16_t low_word(uint32_t x)
{
    return (uint16_t)(x & 0xFFFFUL);
}

/* The operator's integer back to SI; two's complement without relying on the conversion. */
static float speed_of(uint16_t value)
{
    const int32_t tenths = (value < 0x8000U) ? (int32_t)value : ((int32_t)value - 65536L);
    return (float)tenths / TENTHS;
}

/* At least 4 digits: x = digits 10^power. No more than 45 powers of ten are between any two numbers of single precision
 * that are not denormal. */
static void decimal(float x, uint16_t words[2])
{
    float   digits = base_clamp(x, -1.0e30f, 1.0e30f);
    int16_t power  = 0;

    for (int16_t k = 0; (k < 45) && (fabsf(digits) >= 32767.0f); k++) {
        digits *= 0.1f;
        power++;
    }
    for (int16_t k = 0; (k < 45) && (fabsf(digits) < 3276.0f) && (fabsf(digits) > 0.0f); k++) {
        digits *= 10.0f;
        power--;
    }
    words[0] = signed_value(digits, 1.0f);
    words[1] = (uint16_t)power;
}

void app_registers_init(app_registers_t *r, float speed_max_e_radps)
{
    const app_status_t  status  = {.mode = APP_MODE_BOOT};
    const app_command_t command = {
        .omega_e_radps = 0.0f, .run = false, .reset = false, .commission = false};

    r->status            = status;
    r->command           = command;
    r->speed_max_e_radps = speed_max_e_radps;
    r->changed           = false;
    r->silent            = false;
    r->loader            = NULL;
}

static void holding_values(const app_registers_t *r, uint16_t all[APP_REGISTERS_HOLDING_COUNT])
{
    all[APP_REGISTERS_RUN]                = r->command.run ? 1U : 0U;
    all[APP_REGISTERS_RESET]              = 0U;
    all[APP_REGISTERS_SPEED]              = signed_value(r->command.omega_e_radps, TENTHS);
    all[APP_REGISTERS_COMMISSION]         = r->command.commission ? 1U : 0U;
    all[APP_REGISTERS_COMMISSION_CURRENT] = unsigned_value(r->command.bounds.current_A, HUNDREDTHS);
    all[APP_REGISTERS_COMMISSION_SPEED]   = unsigned_value(r->command.bounds.speed_m_radps, TENTHS);
}

/* What acts and never trips. */
static uint16_t limits(const app_status_t *s)
{
    const uint16_t voltage = s->voltage_limited ? (uint16_t)APP_REGISTERS_VOLTAGE_LIMIT : 0U;
    const uint16_t current = s->current_limited ? (uint16_t)APP_REGISTERS_CURRENT_LIMIT : 0U;
    const uint16_t derated = (s->derating > 0.0f) ? (uint16_t)APP_REGISTERS_DERATED : 0U;
    return (uint16_t)(voltage | current | derated);
}

static uint16_t conditions(const app_registers_t *r)
{
    const uint16_t hot     = r->status.hot ? (uint16_t)APP_REGISTERS_HOT : 0U;
    const uint16_t silent  = r->silent ? (uint16_t)APP_REGISTERS_SILENT : 0U;
    const uint16_t gate    = r->status.gate_enable ? (uint16_t)APP_REGISTERS_GATE : 0U;
    const uint16_t dc      = r->status.dc_link_out ? (uint16_t)APP_REGISTERS_DC_OUT : 0U;
    const uint16_t trip    = r->status.tripped ? (uint16_t)APP_REGISTERS_TRIPPED : 0U;
    const uint16_t shorted = r->status.shorted ? (uint16_t)APP_REGISTERS_SHORTED : 0U;
    const uint16_t lost    = r->status.without_angle ? (uint16_t)APP_REGISTERS_WITHOUT_ANGLE : 0U;
    return (uint16_t)(hot | silent | gate | dc | trip | shorted | lost | limits(&r->status));
}

static void state_values(const app_registers_t *r, uint16_t all[APP_REGISTERS_INPUT_COUNT])
{
    const app_status_t *s = &r->status;

    all[APP_REGISTERS_MODE]             = (uint16_t)s->mode;
    all[APP_REGISTERS_FAULT]            = (uint16_t)s->fault;
    all[APP_REGISTERS_DRIVE_FAULT]      = (uint16_t)s->drive_fault;
    all[APP_REGISTERS_BOARD_FAULTS]     = s->board_faults;
    all[APP_REGISTERS_CONDITIONS]       = conditions(r);
    all[APP_REGISTERS_REFERENCE]        = (uint16_t)s->reference;
    all[APP_REGISTERS_ALIGN_STAGE]      = (uint16_t)s->align_stage;
    all[APP_REGISTERS_POSITION]         = s->position_cnt;
    all[APP_REGISTERS_CORRECTIONS]      = s->index_corrections;
    all[APP_REGISTERS_RESET_CAUSE]      = (uint16_t)s->reset_cause;
    all[APP_REGISTERS_PHASE_ERRORS]     = s->phase_errors;
    all[APP_REGISTERS_IGNORED_ANGLES]   = s->ignored_angles;
    all[APP_REGISTERS_IGNORED_CURRENTS] = s->ignored_currents;
    all[APP_REGISTERS_CYCLES]           = s->tick_cycles;
    all[APP_REGISTERS_CYCLES_WORST]     = s->tick_cycles_worst;
    all[APP_REGISTERS_TICKS_HI]         = high_word(s->ticks);
    all[APP_REGISTERS_TICKS_LO]         = low_word(s->ticks);
}

static void measured_values(const app_status_t *s, uint16_t all[APP_REGISTERS_INPUT_COUNT])
{
    all[APP_REGISTERS_SPEED_NOW]     = signed_value(s->speed_e_radps, TENTHS);
    all[APP_REGISTERS_IQ]            = signed_value(s->i_A.q, THOUSANDTHS);
    all[APP_REGISTERS_ID]            = signed_value(s->i_A.d, THOUSANDTHS);
    all[APP_REGISTERS_IQ_REF]        = signed_value(s->i_ref_A.q, THOUSANDTHS);
    all[APP_REGISTERS_ID_REF]        = signed_value(s->i_ref_A.d, THOUSANDTHS);
    all[APP_REGISTERS_VQ]            = signed_value(s->v_V.q, TENTHS);
    all[APP_REGISTERS_VD]            = signed_value(s->v_V.d, TENTHS);
    all[APP_REGISTERS_DC_LINK]       = unsigned_value(s->dc_link_V, TENTHS);
    all[APP_REGISTERS_TEMPERATURE]   = signed_value(s->temperature_degC, TENTHS);
    all[APP_REGISTERS_THETA]         = unsigned_value(s->theta_e_rad, THOUSANDTHS);
    all[APP_REGISTERS_JUMPS]         = s->position_jumps;
    all[APP_REGISTERS_MOTOR_HEAT]    = unsigned_value(s->motor_heat, THOUSANDTHS);
    all[APP_REGISTERS_INVERTER_HEAT] = unsigned_value(s->inverter_heat, THOUSANDTHS);
    all[APP_REGISTERS_DERATING]      = unsigned_value(s->derating, THOUSANDTHS);
    all[APP_REGISTERS_ZERO_A]        = unsigned_value(s->zero_a_cnt, TENTHS);
    all[APP_REGISTERS_ZERO_B]        = unsigned_value(s->zero_b_cnt, TENTHS);
}

static void snapshot_values(const app_snapshot_t *f, uint16_t all[APP_REGISTERS_INPUT_COUNT])
{
    const uint16_t valid = f->raw.valid ? (uint16_t)APP_REGISTERS_SAMPLE_VALID : 0U;
    const uint16_t index = f->raw.index_seen ? (uint16_t)APP_REGISTERS_SAMPLE_INDEX : 0U;

    all[APP_REGISTERS_FIRST_FAULT]        = (uint16_t)f->fault;
    all[APP_REGISTERS_FIRST_MODE]         = (uint16_t)f->mode;
    all[APP_REGISTERS_FIRST_DRIVE_FAULT]  = (uint16_t)f->drive_fault;
    all[APP_REGISTERS_FIRST_BOARD_FAULTS] = f->board_faults;
    all[APP_REGISTERS_FIRST_IA]           = f->raw.ia_cnt;
    all[APP_REGISTERS_FIRST_IB]           = f->raw.ib_cnt;
    all[APP_REGISTERS_FIRST_DC_LINK]      = f->raw.dc_link_cnt;
    all[APP_REGISTERS_FIRST_TEMPERATURE]  = f->raw.temperature_cnt;
    all[APP_REGISTERS_FIRST_POSITION]     = f->raw.position_cnt;
    all[APP_REGISTERS_FIRST_INDEX]        = f->raw.index_cnt;
    all[APP_REGISTERS_FIRST_SAMPLE]       = (uint16_t)(valid | index);
    all[APP_REGISTERS_FIRST_SPEED]        = signed_value(f->speed_e_radps, TENTHS);
    all[APP_REGISTERS_FIRST_WANTED]       = signed_value(f->wanted_e_radps, TENTHS);
    all[APP_REGISTERS_FIRST_TICKS_HI]     = high_word(f->ticks);
    all[APP_REGISTERS_FIRST_TICKS_LO]     = low_word(f->ticks);
}

static void commission_values(const app_commission_status_t *s,
                              uint16_t                       all[APP_REGISTERS_INPUT_COUNT])
{
    const commission_result_t *const f        = &s->found;
    const commission_value_t         values[] = {f->r_Ohm,        f->v_loss_V,   f->ld_H,
                                                 f->lq_H,         f->flux_Wb,    f->inertia_kgm2,
                                                 f->friction_Nms, f->coulomb_Nm, f->offset_rad};

    all[APP_REGISTERS_COMMISSION_STAGE]   = (uint16_t)s->stage;
    all[APP_REGISTERS_COMMISSION_REASON]  = (uint16_t)s->reason;
    all[APP_REGISTERS_COMMISSION_PERCENT] = (uint16_t)s->percent;
    all[APP_REGISTERS_DIRECTION]          = (uint16_t)f->direction;
    all[APP_REGISTERS_POLE_PAIRS]         = (uint16_t)f->pole_pairs;
    all[APP_REGISTERS_COUNTS_HI]          = high_word((uint32_t)f->counts_per_turn);
    all[APP_REGISTERS_COUNTS_LO]          = low_word((uint32_t)f->counts_per_turn);
    all[APP_REGISTERS_RELUCTANCE]         = f->reluctance ? 1U : 0U;
    for (uint16_t k = 0U; k < (uint16_t)(sizeof values / sizeof values[0]); k++) {
        decimal(values[k].value, &all[APP_REGISTERS_FOUND + (4U * k)]);
        decimal(values[k].error, &all[APP_REGISTERS_FOUND + (4U * k) + 2U]);
    }
}

static bool is_loader(const app_registers_t *r, uint16_t first)
{
    return (r->loader != NULL) && (first >= APP_LOADER_FIRST);
}

static app_registers_result_t found(bool all)
{
    return all ? APP_REGISTERS_OK : APP_REGISTERS_BAD_ADDRESS;
}

/* Subtraction instead of a sum, which could wrap in 16 bits. */
static bool exist(uint16_t first, uint16_t count, uint16_t existing)
{
    return (first < existing) && (count <= (uint16_t)(existing - first));
}

app_registers_result_t app_registers_read_holding(const app_registers_t *r, uint16_t first,
                                                  uint16_t count, uint16_t *values)
{
    uint16_t all[APP_REGISTERS_HOLDING_COUNT];

    if (is_loader(r, first)) {
        return found(app_loader_read_holding((uint16_t)(first - APP_LOADER_FIRST), count, values));
    }
    if (!exist(first, count, APP_REGISTERS_HOLDING_COUNT)) {
        return APP_REGISTERS_BAD_ADDRESS;
    }
    holding_values(r, all);
    for (uint16_t i = 0U; i < count; i++) {
        values[i] = all[first + i];
    }
    return APP_REGISTERS_OK;
}

app_registers_result_t app_registers_read_input(const app_registers_t *r, uint16_t first,
                                                uint16_t count, uint16_t *values)
{
    uint16_t all[APP_REGISTERS_INPUT_COUNT];

    if (is_loader(r, first)) {
        return found(
            app_loader_read(r->loader, (uint16_t)(first - APP_LOADER_FIRST), count, values));
    }
    if (!exist(first, count, APP_REGISTERS_INPUT_COUNT)) {
        return APP_REGISTERS_BAD_ADDRESS;
    }
    state_values(r, all);
    measured_values(&r->status, all);
    snapshot_values(&r->status.snapshot, all);
    commission_values(&r->status.commission, all);
    for (uint16_t i = 0U; i < count; i++) {
        values[i] = all[first + i];
    }
    return APP_REGISTERS_OK;
}

static bool value_ok(const app_registers_t *r, uint16_t address, uint16_t value)
{
    if (address == (uint16_t)APP_REGISTERS_SPEED) {
        return base_in_range(speed_of(value), -r->speed_max_e_radps, r->speed_max_e_radps);
    }
    return (address == (uint16_t)APP_REGISTERS_COMMISSION_CURRENT) ||
           (address == (uint16_t)APP_REGISTERS_COMMISSION_SPEED) || (value <= 1U);
}

static void write_one(app_registers_t *r, uint16_t address, uint16_t value)
{
    if (address == (uint16_t)APP_REGISTERS_SPEED) {
        r->command.omega_e_radps = speed_of(value);
    } else if (address == (uint16_t)APP_REGISTERS_RUN) {
        r->command.run = value != 0U;
        r->silent      = r->silent && !r->command.run;
    } else if (address == (uint16_t)APP_REGISTERS_COMMISSION) {
        r->command.commission = value != 0U;
    } else if (address == (uint16_t)APP_REGISTERS_COMMISSION_CURRENT) {
        r->command.bounds.current_A = (float)value / HUNDREDTHS;
    } else if (address == (uint16_t)APP_REGISTERS_COMMISSION_SPEED) {
        r->command.bounds.speed_m_radps = (float)value / TENTHS;
    } else {
        r->command.reset = value != 0U;
    }
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

app_registers_result_t app_registers_write(app_registers_t *r, uint16_t first, uint16_t count,
                                           const uint16_t *values)
{
    if (is_loader(r, first)) {
        return write_loader(r, first, count, values);
    }
    if (!exist(first, count, APP_REGISTERS_HOLDING_COUNT)) {
        return APP_REGISTERS_BAD_ADDRESS;
    }
    for (uint16_t i = 0U; i < count; i++) {
        if (!value_ok(r, (uint16_t)(first + i), values[i])) {
            return APP_REGISTERS_BAD_VALUE;
        }
    }
    for (uint16_t i = 0U; i < count; i++) {
        write_one(r, (uint16_t)(first + i), values[i]);
    }
    r->changed = true;
    return APP_REGISTERS_OK;
}

void app_registers_silence(app_registers_t *r)
{
    if (r->command.run || r->command.commission) {
        r->command.run        = false;
        r->command.commission = false;
        r->changed            = true;
        r->silent             = true;
    }
}
