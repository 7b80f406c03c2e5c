/* SPDX-License-Identifier: MIT */
#include "app_angle.h"

#include "app_angle_index.h"
#include "encoder_form.h"

#define EDGE_AGE_MAX_s 1.0f /* chosen: below one count per second the shaft is at rest */
#define EDGE_GAP_MAX_s                                                                             \
    0.05f /* chosen: a longer time gives almost no information on speed and load */
/* Chosen by simulation: the noise of v_q falls to three fifths, and the speed drop grows by a
 * sixteenth. Half a count causes a limit cycle. */
#define QUARTER_cnt 0.25f
/* Chosen by simulation: more frequent counts are better taken at their middle. With 1, a low speed
 * of one count in three periods is a fifth too fast. With 8, a limit cycle occurs at standstill. */
#define ALONE_PERIODS 3.5f
#define WIDEST_cnt    1.5f /* chosen: widest state of the disc */

/* EQ-APP-ANGLE-3 for the last edge of this period, at the lower end of the position `edge_cnt`. */
static void take_edge(app_angle_t *a, uint16_t edge_cnt, float age_s)
{
    const float between_s  = a->edge_age_s - age_s; /* edge_age_s counts up to now */
    float       turned_cnt = (float)app_angle_turned_cnt(a->positions, a->edge_cnt, edge_cnt);

#if APP_DISC_MAP
    turned_cnt = app_disc_turned_cnt(&a->disc, edge_cnt, turned_cnt,
                                     a->have_edge ? between_s : 0.0f); /* EQ-DISC-3 */
#endif

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

/* EQ-APP-ANGLE-3, 4, with the last edge of the period at the age age_s; without one, `timed` is
 * false. */
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
            const uint16_t place     = (uint16_t)(a->edge_cnt & a->pattern_mask);
            reading->edge_of_pattern = (int16_t)((int16_t)place + 1);
        }
        const float beyond_rad =
            base_min(age_s * fabsf(a->edge_speed_e_radps), WIDEST_cnt * a->rad_per_cnt) - half_rad;
        float on_rad = forward ? beyond_rad : -beyond_rad;
#if APP_DISC_MAP
        on_rad += app_disc_off_cnt(&a->disc) * a->rad_per_cnt; /* EQ-DISC-2 */
#endif
        reading->theta_e_rad = app_angle_in_turn(reading->theta_e_rad + on_rad);
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

    if (timed || !a->have_edge || ((turned_cnt != 1) && (turned_cnt != -1))) {
        read_edges(a, raw->position_cnt, timed, age_s, turned_cnt, reading);
    } else {
        read_edges(a, raw->position_cnt, true, 0.5f * a->ts_s, turned_cnt, reading);
        reading->edge_of_pattern = 0;
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
    reading->edge_of_pattern = 0;
    reading->omega_e_radps   = plain.omega_e_radps;
}

static void drop_after_jump(app_angle_t *a, int16_t turned_cnt)
{
    const int32_t change_cnt = (int32_t)turned_cnt - (int32_t)a->turned_cnt;
    const int32_t most_cnt   = (int32_t)a->config->jump_cnt;

    if (a->have_turned && !app_angle_cnt_within(change_cnt, most_cnt)) {
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
#if APP_DISC_MAP
    if (raw->index_seen && raw->edge_seen && (turned_cnt > 0)) {
        app_disc_index(&a->disc, raw->index_cnt);
    }
#endif
    if (index_is_missing(a, raw->index_seen, turned_cnt)) {
        reading->index_fault = true;
        a->reference         = APP_ANGLE_NONE;
    }
}

APP_MEASURE_PART void app_angle_update(app_angle_t *a, const board_sample_t *raw,
                                       app_angle_reading_t *reading)
{
    const uint16_t position_cnt = raw->position_cnt;

    reading->index_fault = raw->index_seen && !app_angle_take_index(a, raw->index_cnt);
    if (reading->index_fault) {
        a->reference = APP_ANGLE_NONE;
    }
    if (a->correct_ticks > 0U) {
        app_angle_approach(a);
    }
    reading->theta_e_rad     = app_angle_at(a, position_cnt, 1U);
    reading->band_rad        = 0.0f;
    reading->edge_of_pattern = 0;
    reading->edge_gap_s      = 0.0f;
    reading->edge_age_s      = 0.0f;
    reading->omega_e_radps   = 0.0f;
    reading->speed_valid     = a->have_before;
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
#if APP_DISC_MAP
    if (a->reference == APP_ANGLE_NONE) {
        app_disc_lose(&a->disc);
    }
#endif
    a->before_cnt  = position_cnt;
    a->have_before = true;
}
