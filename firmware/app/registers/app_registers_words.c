/* SPDX-License-Identifier: MIT */
/* Registers whose bits come from several sources. */
#include "app_registers.h"

#include <stddef.h>

/* Bits of APP_REGISTERS_SUPPORTED_MODES. Those of all: both velocities, homing, commissioning,
 * alignment. */
#define MODE_1       0x00000001UL
#define MODE_8       0x00000080UL
#define MODE_4       0x00000008UL
#define MODE_10      0x00000200UL
#define MODES_OF_ALL 0x00030124UL

#define TORQUE_WINDOW 0.005f /* chosen: of the rated torque, as one reads a torque */

/* Active limits. They never trip. */
static uint16_t limits(const app_status_t *s)
{
    const uint16_t voltage = s->voltage_limited ? (uint16_t)APP_REGISTERS_VOLTAGE_LIMIT : 0U;
    const uint16_t current = s->current_limited ? (uint16_t)APP_REGISTERS_CURRENT_LIMIT : 0U;
    const uint16_t derated = (s->derating > 0.0f) ? (uint16_t)APP_REGISTERS_DERATED : 0U;
    return (uint16_t)(voltage | current | derated);
}

static uint16_t refused_parameters(const app_registers_t *r)
{
    const uint32_t state   = app_registers_stored_state(r);
    const bool     refused = (state == (uint32_t)APP_PARAMETERS_OTHER_VERSION) ||
                         (state == (uint32_t)APP_PARAMETERS_OUT_OF_RANGE) ||
                         (state == (uint32_t)APP_PARAMETERS_PARTLY);

    return refused ? (uint16_t)APP_REGISTERS_DEFAULTS : 0U;
}

uint16_t app_registers_lost(const app_registers_t *r)
{
    const bool     image  = (r->loader != NULL) && r->loader->fallback;
    const uint16_t record = (app_registers_stored_state(r) == (uint32_t)APP_PARAMETERS_LOST)
                                ? (uint16_t)APP_REGISTERS_RECORD_LOST
                                : 0U;

    return (uint16_t)((image ? (uint16_t)APP_REGISTERS_IMAGE_LOST : 0U) | record);
}

uint16_t app_registers_conditions(const app_registers_t *r)
{
    const uint16_t hot     = r->status.hot ? (uint16_t)APP_REGISTERS_HOT : 0U;
    const uint16_t silent  = r->silent ? (uint16_t)APP_REGISTERS_SILENT : 0U;
    const uint16_t gate    = r->status.gate_enable ? (uint16_t)APP_REGISTERS_GATE : 0U;
    const uint16_t dc      = r->status.dc_link_out ? (uint16_t)APP_REGISTERS_DC_OUT : 0U;
    const uint16_t trip    = r->status.tripped ? (uint16_t)APP_REGISTERS_TRIPPED : 0U;
    const uint16_t shorted = r->status.shorted ? (uint16_t)APP_REGISTERS_SHORTED : 0U;
    const uint16_t lost    = r->status.without_angle ? (uint16_t)APP_REGISTERS_WITHOUT_ANGLE : 0U;
    const uint16_t rings   = r->ring.rings ? (uint16_t)APP_REGISTERS_RINGS : 0U;
    const bool     rests   = app_registers_chopper_rests(r);
    const uint16_t chopper = rests ? (uint16_t)APP_REGISTERS_CHOPPER : 0U;
    return (uint16_t)(hot | silent | gate | dc | trip | shorted | lost | rings | chopper |
                      limits(&r->status) | refused_parameters(r) | app_registers_lost(r));
}

uint32_t app_registers_modes(const app_registers_t *r)
{
    const uint32_t positions = r->drive->positions ? (MODE_1 | MODE_8) : 0UL;
    const uint32_t torques   = r->drive->torques ? (MODE_4 | MODE_10) : 0UL;

    return MODES_OF_ALL | positions | torques;
}

float app_registers_current_share(const app_registers_t *r)
{
    return r->requested.objects.current_max_A / r->drive->rated_current_A;
}

void app_registers_set_current_share(const app_registers_t *r, app_registers_request_t *w,
                                     float share)
{
    w->objects.current_max_A = share * r->drive->rated_current_A;
}

uint32_t app_registers_ticks(const app_registers_t *r, float time_s)
{
    const float ticks = (time_s / r->drive->ts_s) + 0.5f;
    return (uint32_t)ticks;
}

/* State bits of CiA 402. Bit 5 is low while a quick stop is active. */
static uint16_t state_bits(app_control_state_t state)
{
    static const uint16_t bits[APP_CONTROL_STATES] = {0x0000U, 0x0040U, 0x0021U, 0x0023U,
                                                      0x0027U, 0x0007U, 0x000FU, 0x0008U};
    return (state < APP_CONTROL_STATES) ? bits[state] : 0U;
}

static uint16_t bit_if(bool x, int bit)
{
    return x ? (uint16_t)bit : 0U;
}

/* True if the reference rests at the target and the shaft is near it. */
static bool is_at_target(const app_registers_t *r)
{
    const app_position_t *p        = &r->status.position;
    const int32_t         off_cnt  = app_position_cnt(p, &p->actual) - r->status.target_cnt;
    const int32_t         most_cnt = (int32_t)r->requested.window_cnt;

    return r->status.arrived && (off_cnt <= most_cnt) && (off_cnt >= -most_cnt);
}

/* True if the current references have the commanded torque. A limit or the slope keeps them off. */
static bool is_at_torque(const app_registers_t *r)
{
    const float target =
        app_control_target_torque(&r->requested.objects, r->status.mode_of_operation);

    return base_within(r->status.torque_demand_share - target, TORQUE_WINDOW);
}

static bool is_reached(const app_registers_t *r)
{
    const app_status_t *s    = &r->status;
    const int16_t       mode = s->mode_of_operation;
    const bool  halted       = app_control_has(r->requested.objects.controlword, APP_CONTROL_HALT);
    const bool  homes        = mode == (int16_t)APP_CONTROL_HOMING;
    const float target =
        (halted || homes) ? 0.0f : app_control_target_e_radps(&r->requested.objects, mode);
    const bool runs = (s->state == APP_CONTROL_OPERATION_ENABLED) && (s->mode == APP_MODE_RUN);
    const bool near = base_within(s->speed_e_radps - target, r->requested.objects.window_e_radps);
    bool       there;

    if (!app_control_is_run(mode)) {
        there = s->done;
    } else if (halted || app_control_is_speed(mode)) {
        there = runs && near;
    } else if (mode == (int16_t)APP_CONTROL_PROFILE_POSITION) {
        there = runs && is_at_target(r);
    } else if (mode == (int16_t)APP_CONTROL_HOMING) {
        there = runs && near && !app_homing_moves(s->homing);
    } else if (mode == (int16_t)APP_CONTROL_CYCLIC_POSITION) {
        there = false;
    } else {
        there = runs && is_at_torque(r);
    }
    return there;
}

/* True if a cyclic command is followed: the run is not halted, stopped, or held by the brake. */
static bool is_following(const app_registers_t *r)
{
    const app_status_t *s = &r->status;

    return (s->mode_of_operation >= (int16_t)APP_CONTROL_CYCLIC_POSITION) &&
           (s->state == APP_CONTROL_OPERATION_ENABLED) && (s->mode == APP_MODE_RUN) &&
           !app_brake_may_hold(s->brake) &&
           !app_control_has(r->requested.objects.controlword, APP_CONTROL_HALT);
}

/* Bit 12, whose meaning depends on the mode. */
static bool is_of_mode(const app_registers_t *r)
{
    const app_status_t *s    = &r->status;
    bool                says = s->done && (s->reference != APP_ANGLE_NONE);

    if (s->mode_of_operation == (int16_t)APP_CONTROL_PROFILE_POSITION) {
        says = s->acknowledged;
    } else if (s->mode_of_operation == (int16_t)APP_CONTROL_HOMING) {
        says = s->homing == APP_HOMING_ATTAINED;
    } else if (s->mode_of_operation == (int16_t)APP_CONTROL_PROFILE_VELOCITY) {
        says = base_within(s->speed_e_radps, r->config->stop.still_e_radps);
    } else if (app_control_is_run(s->mode_of_operation)) {
        says = is_following(r);
    } else {
        /* alignment and commissioning: whether the angle is known */
    }
    return says;
}

static bool shows_switch(const app_status_t *s)
{
    return (s->inputs & ((uint32_t)BOARD_INPUT_NEGATIVE | (uint32_t)BOARD_INPUT_POSITIVE)) != 0U;
}

/* Bit 13: of positions, and of homing. */
static bool is_off(const app_status_t *s)
{
    const bool homes = s->mode_of_operation == (int16_t)APP_CONTROL_HOMING;

    return s->waits || s->beyond || (homes && (s->homing == APP_HOMING_FAILED));
}

uint16_t app_registers_statusword(const app_registers_t *r)
{
    const app_status_t *s     = &r->status;
    const bool          warns = s->hot || s->dc_link_out || s->tripped || s->without_angle ||
                       (app_registers_lost(r) != 0U) || app_registers_chopper_rests(r);
    const bool limited =
        (limits(s) != 0U) || s->held || shows_switch(s) || app_registers_cuts_speed(r);

    return (uint16_t)(state_bits(s->state) | bit_if(!s->dc_link_out, APP_REGISTERS_VOLTAGE) |
                      bit_if(warns, APP_REGISTERS_WARNING) |
                      bit_if(r->silent, APP_REGISTERS_STOPPED_BY_SILENCE) |
                      (uint16_t)APP_REGISTERS_REMOTE |
                      bit_if(is_reached(r), APP_REGISTERS_REACHED) |
                      bit_if(limited, APP_REGISTERS_LIMITED) |
                      bit_if(is_of_mode(r), APP_REGISTERS_OF_MODE) |
                      bit_if(is_off(s), APP_REGISTERS_FOLLOWING_ERROR) |
                      bit_if(s->gate_enable, APP_REGISTERS_BRIDGE_ON) |
                      ((s->reference != APP_ANGLE_NONE) ? APP_REGISTERS_REFERENCED : 0U));
}

uint16_t app_registers_first_sample(const app_registers_t *r)
{
    const board_sample_t *raw   = &r->status.snapshot.raw;
    const uint16_t        valid = raw->valid ? (uint16_t)APP_REGISTERS_SAMPLE_VALID : 0U;
    const uint16_t        index = raw->index_seen ? (uint16_t)APP_REGISTERS_SAMPLE_INDEX : 0U;

    return (uint16_t)(valid | index);
}

uint16_t app_registers_outputs(const app_registers_t *r)
{
    const app_brake_state_t brake = r->status.brake;

    return ((brake != APP_BRAKE_NONE) && !app_brake_output(brake)) ? 1U : 0U;
}

uint32_t app_registers_scope_state(const app_registers_t *r)
{
    return (r->scope != NULL) ? (uint32_t)r->scope->state : 0U;
}

uint32_t app_registers_scope_ticks(const app_registers_t *r)
{
    return ((r->scope != NULL) && (r->scope->state == APP_SCOPE_DONE)) ? r->scope->trigger_ticks
                                                                       : 0U;
}

uint32_t app_registers_record_number(const app_registers_t *r)
{
    return (r->record != NULL) ? r->record->number : 0U;
}

uint32_t app_registers_record_count(const app_registers_t *r)
{
    return (r->record != NULL) ? r->record->kept_count : 0U;
}

uint32_t app_registers_stored_state(const app_registers_t *r)
{
    return (r->parameters != NULL) ? (uint32_t)r->parameters->state : 0U;
}

uint32_t app_registers_stored_done(const app_registers_t *r)
{
    return (r->parameters != NULL) ? (uint32_t)r->parameters->done : 0U;
}

uint32_t app_registers_stored_number(const app_registers_t *r)
{
    return (r->parameters != NULL) ? r->parameters->number : 0UL;
}

uint32_t app_registers_stored_writes(const app_registers_t *r)
{
    return (r->parameters != NULL) ? r->parameters->writes : 0UL;
}

uint32_t app_registers_stored_dropped(const app_registers_t *r)
{
    return (r->parameters != NULL) ? (uint32_t)r->parameters->dropped : 0UL;
}
