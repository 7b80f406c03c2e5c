/* SPDX-License-Identifier: MIT */
#include "app_angle.h"

#include "encoder_form.h"

#define TURNS_MOST     128.0f /* above any number of electrical turns in a shaft turn */
#define EDGE_AGE_MAX_s 1.0f   /* chosen: below one count per second the shaft is at rest */
#define EDGE_GAP_MAX_s                                                                             \
    0.05f /* chosen: a longer time gives almost no information on speed and load */
/* Chosen by simulation: the noise of v_q falls to three fifths, and the speed drop grows by a
 * sixteenth. Half a count causes a limit cycle. */
#define QUARTER_cnt 0.25f
/* Chosen by simulation: more frequent counts are better taken at their middle. With 1, a low speed
 * of one count in three periods is a fifth too fast. With 8, a limit cycle occurs at standstill. */
#define ALONE_PERIODS 3.5f
#define WIDEST_cnt    1.5f    /* chosen: widest state of the disc */
#define POLE_PAIRS    64U     /* keeps half counts times pole pairs within 32 bits */
#define POSITIONS     65532UL /* whole lines; half of it, either way, is a signed number of 16 bits */

static bool turn_ok(uint32_t positions)
{
    return (positions >= (uint32_t)ENCODER_FORM_EDGES) && (positions <= POSITIONS) &&
           ((positions % (uint32_t)ENCODER_FORM_EDGES) == 0UL);
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
    a->before_cnt         = 0U;
    a->have_before        = false;
    a->turned_cnt         = 0;
    a->have_turned        = false;
    a->since_index_cnt    = 0L;
    a->have_index         = false;
    a->jumps              = 0U;
    a->corrections        = 0U;
    return status;
}

int16_t app_angle_turned_cnt(uint16_t positions, uint16_t from_cnt, uint16_t to_cnt)
{
    int32_t turned_cnt = (int32_t)to_cnt - (int32_t)from_cnt;

    if (turned_cnt > (int32_t)(positions / 2U)) {
        turned_cnt -= (int32_t)positions;
    } else if (turned_cnt < -(int32_t)(positions / 2U)) {
        turned_cnt += (int32_t)positions;
    }
    return (int16_t)turned_cnt;
}

static float within_turn(float theta_rad)
{
    if (theta_rad < 0.0f) {
        return theta_rad + BASE_TWO_PI;
    }
    return (theta_rad >= BASE_TWO_PI) ? (theta_rad - BASE_TWO_PI) : theta_rad;
}

/* Angle at `half` half counts past the lower edge of a position. Half counts are integers below
 * 2^23: removing whole turns from them is exact. The added half of a half count keeps the quotient
 * away from integers. With millions of half counts per turn rounding may still cross one;
 * within_turn() corrects that. */
static float theta_at(const app_angle_t *a, uint16_t position_cnt, uint32_t half)
{
    const uint32_t from_zero_cnt =
        (position_cnt >= a->zero_cnt)
            ? ((uint32_t)position_cnt - (uint32_t)a->zero_cnt)
            : ((uint32_t)position_cnt + (uint32_t)a->positions - (uint32_t)a->zero_cnt);
    const uint32_t count    = ((2U * from_zero_cnt) + half) * (uint32_t)a->pole_pairs;
    const float    half_cnt = (float)count;
    const float    passed   = base_min((half_cnt + 0.5f) * a->turns_per_half_cnt, TURNS_MOST);
    const int16_t  turns    = (int16_t)passed; /* at most the pole pairs */
    const float    part_cnt = half_cnt - ((float)turns * a->half_cnt_per_turn);

    return within_turn(a->zero_theta_rad + (part_cnt * a->rad_per_half_cnt));
}

static void refer_to_index(app_angle_t *a, uint16_t index_cnt)
{
    a->reference      = APP_ANGLE_INDEX;
    a->zero_cnt       = index_cnt;
    a->zero_theta_rad = a->config->index_theta_e_rad;
}

/* Distance of the index from its expected position [counts]. After an alignment only the electrical
 * angle is known, not the pole pair. */
static float index_error_cnt(const app_angle_t *a, uint16_t index_cnt)
{
    if (a->reference == APP_ANGLE_INDEX) {
        return (float)app_angle_turned_cnt(a->positions, a->zero_cnt, index_cnt);
    }
    const float error_rad = frames_wrap(theta_at(a, index_cnt, 0U) - a->config->index_theta_e_rad);
    return error_rad / a->rad_per_cnt;
}

/* False if the index came at a wrong position. */
static bool take_index(app_angle_t *a, uint16_t index_cnt)
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
        refer_to_index(a, index_cnt);
    } else if (!base_in_range(error_cnt, -small_cnt, small_cnt)) {
        refer_to_index(a, index_cnt);
        a->corrections = (uint16_t)(a->corrections + 1U);
    }
    return true;
}

/* EQ-APP-ANGLE-3 for the last edge of this period, at the lower end of the position `edge_cnt`. */
static void take_edge(app_angle_t *a, uint16_t edge_cnt, float age_s)
{
    const float turned_cnt = (float)app_angle_turned_cnt(a->positions, a->edge_cnt, edge_cnt);
    const float between_s  = a->edge_age_s - age_s; /* edge_age_s counts up to now */

    if (a->have_edge && (between_s > 0.0f)) {
        a->edge_speed_e_radps = turned_cnt * a->rad_per_cnt / between_s;
    }
    a->have_edge  = true;
    a->edge_cnt   = edge_cnt;
    a->edge_age_s = age_s;
}

/* Reduces a speed at which the next edge would already have come. */
static void wait_for_edge(app_angle_t *a)
{
    if (!base_within(a->edge_speed_e_radps * a->edge_age_s, a->rad_per_cnt)) {
        const float most_radps = a->rad_per_cnt / a->edge_age_s;

        a->edge_speed_e_radps = base_clamp(a->edge_speed_e_radps, -most_radps, most_radps);
    }
}

/* EQ-APP-ANGLE-3, 4, with the last edge of the period at the age age_s; without one, `timed` is false. */
static void read_edges(app_angle_t *a, uint16_t position_cnt, bool timed, float age_s,
                       int16_t turned_cnt, app_angle_reading_t *reading)
{
    const float half_rad = 0.5f * a->rad_per_cnt;

    a->edge_age_s       = base_min(a->edge_age_s + a->ts_s, EDGE_AGE_MAX_s);
    reading->edge_gap_s = base_min(base_max(a->edge_age_s, a->edge_gap_s), EDGE_GAP_MAX_s);
    if (timed) {
        const bool     forward = turned_cnt > 0;
        const uint32_t edge    = (uint32_t)position_cnt + (forward ? 0U : 1U);

        const bool after_edge = a->have_edge; /* otherwise the gap does not begin at an edge */
        a->edge_gap_s         = base_min(a->edge_age_s - age_s, EDGE_GAP_MAX_s);
        take_edge(a, (uint16_t)((edge < a->positions) ? edge : 0U), age_s);
        reading->edge_gap_s = a->edge_gap_s;
        reading->edge_age_s = age_s;
        if (after_edge) {
            reading->edge_of_line = (int16_t)(1U + (a->edge_cnt % (uint16_t)ENCODER_FORM_EDGES));
        }
        const float beyond_rad =
            base_min(age_s * fabsf(a->edge_speed_e_radps), WIDEST_cnt * a->rad_per_cnt) - half_rad;
        reading->theta_e_rad =
            within_turn(reading->theta_e_rad + (forward ? beyond_rad : -beyond_rad));
    } else {
        if (turned_cnt != 0) {
            a->have_edge        = false; /* forth and back: the edge is unknown */
            a->edge_age_s       = a->ts_s;
            a->edge_gap_s       = 0.0f;
            reading->edge_gap_s = a->ts_s;
        } else if (a->have_edge) {
            wait_for_edge(a);
        } else {
            /* no edge yet */
        }
        reading->band_rad = half_rad;
    }
    if (a->have_edge) {
        reading->omega_e_radps = a->edge_speed_e_radps;
    }
}

/* An edge after a change of direction has no time: EQ-APP-ANGLE-5 applies. */
static void read_times(app_angle_t *a, const board_sample_t *raw, int16_t turned_cnt,
                       app_angle_reading_t *reading)
{
    const float age_s = (float)raw->edge_age_cnt * (1.0f / (float)BOARD_CAPTURE_Hz);
    const bool  timed = raw->edge_seen && (turned_cnt != 0) && (age_s <= a->ts_s);
    const bool  alone = (turned_cnt == 1) || (turned_cnt == -1);

    if (timed || !alone || !a->have_edge) {
        read_edges(a, raw->position_cnt, timed, age_s, turned_cnt, reading);
    } else {
        read_edges(a, raw->position_cnt, true, 0.5f * a->ts_s, turned_cnt, reading);
        reading->edge_of_line = 0;
    }
}

/* EQ-APP-ANGLE-5. */
static void read_counts(app_angle_t *a, uint16_t position_cnt, int16_t turned_cnt,
                        app_angle_reading_t *reading)
{
    app_angle_reading_t plain      = *reading;
    const bool          after_edge = a->have_edge;

    read_edges(a, position_cnt, turned_cnt != 0, 0.5f * a->ts_s, turned_cnt, reading);
    if ((turned_cnt < -1) || (turned_cnt > 1) || ((turned_cnt != 0) && !after_edge) ||
        (base_max(a->edge_age_s, a->edge_gap_s) < (ALONE_PERIODS * a->ts_s))) {
        plain.band_rad = QUARTER_cnt * a->rad_per_cnt;
        *reading       = plain;
    }
    reading->edge_of_line  = 0;
    reading->omega_e_radps = plain.omega_e_radps;
}

static void drop_after_jump(app_angle_t *a, int16_t turned_cnt)
{
    const int32_t change_cnt = (int32_t)turned_cnt - (int32_t)a->turned_cnt;
    const int32_t most_cnt   = (int32_t)a->config->jump_cnt;

    if (a->have_turned && ((change_cnt > most_cnt) || (change_cnt < -most_cnt))) {
        a->reference = APP_ANGLE_NONE;
        if (a->jumps < UINT16_MAX) {
            a->jumps = (uint16_t)(a->jumps + 1U);
        }
    }
    a->turned_cnt  = turned_cnt;
    a->have_turned = true;
}

/* True after more than a turn plus the largest correction without an index. Restarts the count
 * then. */
static bool index_is_missing(app_angle_t *a, bool seen, int16_t turned_cnt)
{
    const int32_t most_cnt = (int32_t)a->positions + (int32_t)a->config->index_correct_max_cnt;

    a->have_index      = a->have_index || seen;
    a->since_index_cnt = seen ? 0L : (a->since_index_cnt + (int32_t)turned_cnt);
    if ((a->since_index_cnt <= most_cnt) && (a->since_index_cnt >= -most_cnt)) {
        return false;
    }
    a->since_index_cnt = 0L;
    return a->have_index;
}

/* Checks the counter by two consecutive positions. */
static void check_counter(app_angle_t *a, const board_sample_t *raw, int16_t turned_cnt,
                          app_angle_reading_t *reading)
{
    drop_after_jump(a, turned_cnt);
    if (index_is_missing(a, raw->index_seen, turned_cnt)) {
        reading->index_fault = true;
        a->reference         = APP_ANGLE_NONE;
    }
}

void app_angle_update(app_angle_t *a, const board_sample_t *raw, app_angle_reading_t *reading)
{
    const uint16_t position_cnt = raw->position_cnt;

    reading->index_fault = raw->index_seen && !take_index(a, raw->index_cnt);
    if (reading->index_fault) {
        a->reference = APP_ANGLE_NONE;
    }
    reading->theta_e_rad   = theta_at(a, position_cnt, 1U);
    reading->band_rad      = 0.0f;
    reading->edge_of_line  = 0;
    reading->edge_gap_s    = 0.0f;
    reading->edge_age_s    = 0.0f;
    reading->omega_e_radps = 0.0f;
    reading->speed_valid   = a->have_before;
    if (a->have_before) {
        const int16_t turned_cnt = app_angle_turned_cnt(a->positions, a->before_cnt, position_cnt);

        check_counter(a, raw, turned_cnt, reading);
        reading->omega_e_radps = (float)turned_cnt * a->radps_per_cnt;
        if (a->edge_times) {
            read_times(a, raw, turned_cnt, reading);
        } else {
            read_counts(a, position_cnt, turned_cnt, reading);
        }
    }
    a->before_cnt  = position_cnt;
    a->have_before = true;
}

void app_angle_align(app_angle_t *a, uint16_t position_cnt, float theta_e_rad)
{
    a->reference      = APP_ANGLE_ALIGNED;
    a->zero_cnt       = position_cnt;
    a->zero_theta_rad = theta_e_rad;
}

void app_angle_drop(app_angle_t *a)
{
    a->reference       = APP_ANGLE_NONE;
    a->have_before     = false;
    a->have_turned     = false;
    a->have_edge       = false;
    a->since_index_cnt = 0L;
}
