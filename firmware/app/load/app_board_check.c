/* SPDX-License-Identifier: MIT */
#include "app_board_check.h"

#include <math.h>

/* Single precision, and counts that are rounded up to 1e-4 of one. */
#define SAME_RATIO 1.0e-4f

/* Chosen: ten times the rounding of a temperature to 0.01 degC in the table. */
#define SAME_NTC_RATIO 3.0e-3f

#define TURN_rad    6.2831853f
#define NTC_25_K    298.15f
#define ZERO_degC_K 273.15f

typedef struct {
    const board_identity_t *board;
    const app_config_t     *app;
    const drive_config_t   *drive;
    board_difference_t      found;
} check_t;

static void note(check_t *c, board_fact_t fact, float image, bool ok)
{
    if (!ok && (c->found.field == (uint16_t)BOARD_FIELD_NONE)) {
        c->found.field = (uint16_t)((uint16_t)fact + 1U);
        c->found.image = image;
        c->found.board = c->board->fact[fact];
    }
}

static void must_be(check_t *c, board_fact_t fact, float image)
{
    const float board = c->board->fact[fact];
    const float slack = SAME_RATIO * fabsf(board);

    note(c, fact, image, base_in_range(image, board - slack, board + slack));
}

static void at_least(check_t *c, board_fact_t fact, float image)
{
    note(c, fact, image, image >= (c->board->fact[fact] * (1.0f - SAME_RATIO)));
}

static void at_most(check_t *c, board_fact_t fact, float image)
{
    note(c, fact, image, image <= (c->board->fact[fact] * (1.0f + SAME_RATIO)));
}

static void check_gates(check_t *c)
{
    const board_setup_t     *s       = &c->app->board;
    const app_gate_config_t *g       = &c->app->gate;
    const float              full    = (float)s->duty_full_cnt;
    const float              clock   = c->board->fact[BOARD_FACT_PWM_CLOCK_Hz];
    const float              dead_s  = (float)s->dead_time_cnt / clock;
    const float              pulse_s = (float)g->pulse_min_cnt / clock;

    must_be(c, BOARD_FACT_PWM_CLOCK_Hz, (2.0f * full) / c->app->pwm_period_s);
    at_least(c, BOARD_FACT_DEAD_TIME_MIN_s, dead_s);
    at_least(c, BOARD_FACT_DEAD_TIME_MIN_s, c->app->dead_time_s);
    at_least(c, BOARD_FACT_DEAD_TIME_MIN_s, c->drive->hardware.dead_time_s);
    /* Both are rounded: the time by half a period, the pulse to a quarter of one at most. */
    at_least(c, BOARD_FACT_PRECHARGE_s, ((float)g->precharge_ticks + 0.5f) * c->app->pwm_period_s);
    at_most(c, BOARD_FACT_DUTY_MAX, (float)g->duty_max_cnt / full);
    if ((4UL * ((uint32_t)g->pulse_min_cnt + 1UL)) <= s->duty_full_cnt) {
        at_least(c, BOARD_FACT_PULSE_MIN_s, pulse_s);
    }
}

/* e^x within 1e-4 for |x| <= 4. The library's function would take words of the RAM for code. */
static float exponential(float x)
{
    float y = (512.0f + x) / (512.0f - x); /* e^(x / 256) */

    for (uint16_t n = 0U; n < 8U; n++) {
        y *= y;
    }
    return y;
}

/* EQ-BOARD-4: resistance at 25 degC of the sensor that gives this code at this temperature. */
static float ntc_25_Ohm(const check_t *c, float code_cnt, float degC)
{
    const float top_cnt = (float)BOARD_ADC_CODES;
    const float r_Ohm =
        (c->board->fact[BOARD_FACT_NTC_DIVIDER_Ohm] * code_cnt) / (top_cnt - code_cnt);
    const float per_K = (1.0f / (degC + ZERO_degC_K)) - (1.0f / NTC_25_K);

    return r_Ohm / exponential(c->board->fact[BOARD_FACT_NTC_BETA_K] * per_K);
}

static void check_temperature(check_t *c)
{
    const app_scale_config_t *s        = &c->app->scale;
    const float               board    = c->board->fact[BOARD_FACT_NTC_RESISTANCE_Ohm];
    float                     code_cnt = (float)s->ntc_first_cnt;

    for (uint16_t n = 0U; n < s->ntc_points; n++) {
        const float r_Ohm = ntc_25_Ohm(c, code_cnt, s->ntc_degC[n]);
        note(
            c, BOARD_FACT_NTC_RESISTANCE_Ohm, r_Ohm,
            base_in_range(r_Ohm, board * (1.0f - SAME_NTC_RATIO), board * (1.0f + SAME_NTC_RATIO)));
        code_cnt += (float)s->ntc_step_cnt;
    }
    must_be(c, BOARD_FACT_TEMPERATURE_LIMIT_degC, c->app->temperature_limit_degC);
    must_be(c, BOARD_FACT_TEMPERATURE_TRIP_degC, c->app->temperature_trip_degC);
}

static void check_scale(check_t *c)
{
    const app_scale_config_t *s       = &c->app->scale;
    const float               top_cnt = (float)BOARD_ADC_CODES;

    must_be(c, BOARD_FACT_CURRENT_SENSORS, (float)c->app->board.current_sensors);
    must_be(c, BOARD_FACT_CURRENT_RANGE_A, s->current_A_per_cnt * s->current_zero_cnt);
    must_be(c, BOARD_FACT_CURRENT_RANGE_A, s->current_A_per_cnt * (top_cnt - s->current_zero_cnt));
    must_be(c, BOARD_FACT_DC_LINK_RANGE_V, s->dc_link_V_per_cnt * top_cnt);
}

static void check_limits(check_t *c)
{
    const drive_config_t *d         = c->drive;
    const float           pairs     = (float)d->hardware.pole_pairs;
    const float           positions = (float)d->hardware.encoder_positions;
    const float           turn_Hz   = d->trip_speed_e_radps / (TURN_rad * pairs);

    at_most(c, BOARD_FACT_RATED_CURRENT_A, d->current_max_A);
    at_most(c, BOARD_FACT_TRIP_CURRENT_A, d->trip_current_A);
    at_most(c, BOARD_FACT_RATED_DC_LINK_V, d->dc_link_max_V);
    must_be(c, BOARD_FACT_INVERTER_CURRENT_A, c->app->heat.inverter_A);
    must_be(c, BOARD_FACT_INVERTER_TIME_CONSTANT_s, c->app->heat.inverter_s);
    at_most(c, BOARD_FACT_ENCODER_EDGES_Hz, turn_Hz * positions);
}

/* EQ-BOARD-7. A level is a whole code. */
static void check_level(check_t *c, board_fact_t fact, uint16_t level_cnt)
{
    const float per_cnt_V = c->app->scale.dc_link_V_per_cnt;
    const float image_V   = (float)level_cnt * per_cnt_V;
    const float board_V   = c->board->fact[fact];

    note(c, fact, image_V, base_in_range(image_V, board_V - per_cnt_V, board_V + per_cnt_V));
}

/* An image for a board without chopper has no resistor to divide by. */
static float resistor_W(const app_chopper_config_t *chopper, float r_Ohm)
{
    return (chopper->per_V2 > 0.0f) ? (1.0f / (chopper->per_V2 * r_Ohm)) : 0.0f;
}

static void check_chopper(check_t *c)
{
    const app_chopper_config_t *r     = &c->app->chopper;
    const float                 r_Ohm = c->board->fact[BOARD_FACT_CHOPPER_RESISTANCE_Ohm];
    const bool                  there = c->board->fact[BOARD_FACT_CHOPPER_ON_V] > 0.0f;

    note(c, BOARD_FACT_CHOPPER_ON_V, 0.0f,
         ((c->app->board.chopper != 0U) == there) && ((r->on_cnt > 0U) == there));
    if (there) {
        check_level(c, BOARD_FACT_CHOPPER_ON_V, r->on_cnt);
        check_level(c, BOARD_FACT_CHOPPER_OFF_V, r->off_cnt);
        must_be(c, BOARD_FACT_CHOPPER_POWER_W, resistor_W(r, r_Ohm));
        must_be(c, BOARD_FACT_CHOPPER_TIME_CONSTANT_s, r->tau_s);
    } else {
        must_be(c, BOARD_FACT_CHOPPER_OFF_V, 0.0f);
        must_be(c, BOARD_FACT_CHOPPER_RESISTANCE_Ohm, 0.0f);
        must_be(c, BOARD_FACT_CHOPPER_POWER_W, 0.0f);
        must_be(c, BOARD_FACT_CHOPPER_TIME_CONSTANT_s, 0.0f);
    }
}

board_difference_t app_board_check(const board_identity_t *board, const app_config_t *config,
                                   const drive_config_t *drive)
{
    check_t c = {.board = board, .app = config, .drive = drive};

    check_gates(&c);
    check_scale(&c);
    check_temperature(&c);
    check_limits(&c);
    check_chopper(&c);
    return c.found;
}
