/* SPDX-License-Identifier: MIT */
#include "app_angle_index.h"

#include "encoder_form.h"
#include "frames.h"

#define POLE_PAIRS 64U     /* keeps half counts times pole pairs within 32 bits */
#define POSITIONS  65532UL /* whole lines; half of it, either way, is a signed number of 16 bits */
/* Chosen: a false electrical speed below the noise of any drive. 0.126 rad take half a second. */
#define CORRECT_radps 0.25f
#define MOST_PERIODS  65000.0f
#define LEFT_cnt      16000.0f /* a quarter of the largest turn */

static bool turn_ok(uint32_t positions)
{
    return (positions >= (uint32_t)ENCODER_FORM_LINE) && (positions <= POSITIONS) &&
           ((positions % (uint32_t)ENCODER_FORM_LINE) == 0UL);
}

ctl_status_t app_angle_check(const app_angle_config_t *c, const drive_config_t *drive)
{
    const uint16_t pole_pairs = drive->hardware.pole_pairs;
    const uint32_t positions  = drive->hardware.encoder_positions;
    const bool     ok = turn_ok(positions) && (pole_pairs >= 1U) && (pole_pairs <= POLE_PAIRS) &&
                    base_in_range(c->index_theta_e_rad, 0.0f, BASE_TWO_PI) &&
                    (c->index_theta_e_rad < BASE_TWO_PI) &&
                    (c->index_correct_max_cnt >= c->index_tolerance_cnt) &&
                    (c->index_correct_max_cnt < (positions / 4U)) && (c->jump_cnt > 0U) &&
                    base_in_range(drive->ts_s, 1.0e-5f, 1.0e-2f);

    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

ctl_status_t app_angle_init(app_angle_t *a, const app_angle_config_t *c,
                            const drive_config_t *drive)
{
    const uint16_t     pole_pairs = drive->hardware.pole_pairs;
    const uint32_t     positions  = drive->hardware.encoder_positions;
    const float        ts_s       = drive->ts_s;
    const ctl_status_t status     = app_angle_check(c, drive);
    const bool         ok         = status == CTL_OK;

    a->config             = c;
    a->pole_pairs         = pole_pairs;
    a->positions          = (uint16_t)(turn_ok(positions) ? positions : 0UL);
    a->pattern_mask       = (uint16_t)(encoder_form_places(positions) - 1U);
    a->edge_times         = drive->hardware.edge_times;
    a->ts_s               = ts_s;
    a->half_cnt_per_turn  = 2.0f * (float)a->positions;
    a->turns_per_half_cnt = ok ? (1.0f / a->half_cnt_per_turn) : 0.0f;
    a->rad_per_half_cnt   = ok ? (BASE_TWO_PI / a->half_cnt_per_turn) : 0.0f;
    a->rad_per_cnt        = 2.0f * (float)pole_pairs * a->rad_per_half_cnt;
    a->radps_per_cnt      = ok ? (a->rad_per_cnt / ts_s) : 0.0f;
    a->have_edge          = false;
    a->edge_cnt           = 0U;
    a->edge_age_s         = 0.0f;
    a->edge_gap_s         = 0.0f;
    a->edge_speed_e_radps = 0.0f;
    a->reference          = APP_ANGLE_NONE;
    a->zero_cnt           = 0U;
    a->zero_theta_rad     = 0.0f;
    a->correct_ticks      = 0U;
    a->correct_step_rad   = 0.0f;
    a->before_cnt         = 0U;
    a->have_before        = false;
    a->turned_cnt         = 0;
    a->have_turned        = false;
    a->since_index_cnt    = 0L;
    a->have_index         = false;
    a->jumps              = 0U;
    a->corrections        = 0U;
#if APP_DISC_MAP
    app_disc_init(&a->disc, a->positions);
#endif
    return status;
}

static void refer_to_index(app_angle_t *a, uint16_t index_cnt)
{
    a->reference      = APP_ANGLE_INDEX;
    a->zero_cnt       = index_cnt;
    a->zero_theta_rad = a->config->index_theta_e_rad;
    a->correct_ticks  = 0U;
}

/* Difference of the angle at the index from the one that the index has. */
static float index_error_rad(const app_angle_t *a, uint16_t index_cnt)
{
    return frames_wrap(app_angle_at(a, index_cnt, 0U) - a->config->index_theta_e_rad);
}

/* Distance of the index from its expected position [counts]. After an alignment only the electrical
 * angle is known, not the pole pair. */
static float index_error_cnt(const app_angle_t *a, uint16_t index_cnt)
{
    return (a->reference == APP_ANGLE_INDEX)
               ? (float)app_angle_turned_cnt(a->positions, a->zero_cnt, index_cnt)
               : (index_error_rad(a, index_cnt) / a->rad_per_cnt);
}

/* Begins EQ-APP-ANGLE-6: this period's angle is still what the zero before gives. */
static void correct(app_angle_t *a, uint16_t index_cnt)
{
    const float error_rad = index_error_rad(a, index_cnt);
    const float periods   = fabsf(error_rad) / (CORRECT_radps * a->ts_s);
    const float ticks     = base_clamp(periods, 0.0f, MOST_PERIODS) + 1.0f;

    refer_to_index(a, index_cnt);
    a->correct_ticks    = (uint16_t)ticks;
    a->correct_step_rad = error_rad / (float)a->correct_ticks;
}

void app_angle_approach(app_angle_t *a)
{
    a->correct_ticks  = (uint16_t)(a->correct_ticks - 1U);
    a->zero_theta_rad = app_angle_in_turn(a->config->index_theta_e_rad +
                                          ((float)a->correct_ticks * a->correct_step_rad));
}

int16_t app_angle_left_cnt(const app_angle_t *a)
{
    const float left_cnt = (float)a->correct_ticks * a->correct_step_rad / a->rad_per_cnt;
    const float half     = (left_cnt < 0.0f) ? -0.5f : 0.5f;

    return (int16_t)base_clamp(left_cnt + half, -LEFT_cnt, LEFT_cnt);
}

bool app_angle_take_index(app_angle_t *a, uint16_t index_cnt)
{
    if (a->reference == APP_ANGLE_NONE) {
        refer_to_index(a, index_cnt);
        return true;
    }
    const float most_cnt  = (float)a->config->index_correct_max_cnt;
    const float small_cnt = (float)a->config->index_tolerance_cnt;
    const float error_cnt = index_error_cnt(a, index_cnt);
    if (!base_in_range(error_cnt, -most_cnt, most_cnt)) {
        return false;
    }
    if (a->reference == APP_ANGLE_ALIGNED) {
        correct(a, index_cnt);
    } else if (!base_in_range(error_cnt, -small_cnt, small_cnt)) {
        correct(a, index_cnt);
        a->corrections = (uint16_t)(a->corrections + 1U);
    }
    return true;
}

void app_angle_align(app_angle_t *a, uint16_t position_cnt, float theta_e_rad)
{
    a->reference      = APP_ANGLE_ALIGNED;
    a->zero_cnt       = position_cnt;
    a->zero_theta_rad = theta_e_rad;
    a->correct_ticks  = 0U;
}

void app_angle_drop(app_angle_t *a)
{
    a->reference       = APP_ANGLE_NONE;
    a->have_before     = false;
    a->have_turned     = false;
    a->have_edge       = false;
    a->since_index_cnt = 0L;
#if APP_DISC_MAP
    app_disc_lose(&a->disc);
#endif
}

float app_angle_edge(const app_angle_t *a, const app_angle_reading_t *reading)
{
    float edge = -1.0f;

#if APP_DISC_MAP
    if (a->disc.have_zero && (reading->edge_of_pattern != 0)) {
        edge = (float)app_disc_place(&a->disc, a->edge_cnt);
    }
#else
    (void)a;
    (void)reading;
#endif
    return edge;
}
