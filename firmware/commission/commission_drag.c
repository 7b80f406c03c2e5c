/* SPDX-License-Identifier: MIT */
#include "commission_drag.h"

/* Chosen: shares of the current limit: first try, largest, smallest. */
#define FIRST_SHARE 0.1f
#define MOST_SHARE  0.6f
#define LEAST_SHARE 0.02f
#define RAMP_s      0.5f
#define STILL_s     0.2f
#define PATIENCE_s  6.0f
/* Chosen, electrical speeds. The rotor follows below a third of its oscillation frequency. The
 * least speed keeps the test below minutes. */
#define SWING_SHARE   0.3f
#define SLOWEST_radps 1.2f
#define FASTEST_radps 6.0f
#define SPEED_RAMP_s  1.0f
/* Chosen: a magnet's rotor followed. This halves what the inverter's loss adds to its flux. */
#define SECOND_FASTER 2.0f
/* Limit of electrical turns for a whole mechanical turn, and for two index pulses. */
#define MOST_TURNS  8
#define INDEX_TURNS 64
/* x above this ratio to S I means a magnet. The current then stays well below the one at which the
 * rotor leaves the d axis. */
#define MAGNET_RATIO 1.4f
/* Chosen: x of a rotor that has left the d axis is S I itself, EQ-COMMISSION-10. */
#define AXIS_RATIO 1.1f
/* Chosen: share of the inverter's loss that its compensation leaves; x has it over the speed. */
#define LOSS_LEFT  0.004f
#define HOLD_RATIO 3.0f
#define LESS       0.4f
/* Measured with the current of the first pass, simulated EV machine: x is too large by this share of
 * the loss over the speed. A smaller current than needed is doubled. */
#define FIRST_LEFT 0.04f
#define FLUX_LEAST 0.25f
/* Tolerance of a whole number of pole pairs. */
#define WHOLE 0.1f
/* Chosen: share of the limit that the loop acts on; a healthy one is behind by more while a rotor
 * snaps only. */
#define ERROR_SHARE 0.05f
#define FOLLOW_s    0.05f
/* Chosen: R of this share of the limit is the largest voltage that damps the rotor. */
#define DAMP_SHARE 0.5f
/* Chosen: mean distance of the current to its reference, share of the limit; healthy 0.033. */
#define BEHIND_SHARE 0.1f
/* Chosen: mean voltage above that of R, share of that at the limit. With a small current a rotor
 * snaps into place, healthy 0.47. With SNAP_SHARE and more, healthy 0.32. */
#define VOLTAGE_SHARE 0.6f
#define STIFF_SHARE   0.45f
#define SNAP_SHARE    0.3f

/* Parts of a pass, in order. */
enum { SETTLE = 0, LEAD_FORWARD, FORWARD, TURN, BACKWARD, RELEASE, PARTS };

static void begin_part(commission_drag_t *d, int16_t part)
{
    d->part    = part;
    d->way_rad = 0.0f;
    d->ticks   = 0L;
}

static void begin_pass(commission_drag_t *d, float length_A, int16_t turns)
{
    const commission_turns_t none = {.n = 0.0f};
    d->sums[0]                    = none;
    d->sums[1]                    = none;
    d->length_A                   = length_A;
    d->turns                      = turns;
    d->indexes                    = 0;
    begin_part(d, SETTLE);
}

void commission_drag_start(commission_drag_t *d, const commission_config_t *c,
                           const commission_result_t *known)
{
    const float       swing = known->half_swing_s;
    commission_drag_t fresh = {.speed_radps = FASTEST_radps};
    *d                      = fresh;
    if (swing > 0.0f) {
        d->speed_radps = base_clamp(SWING_SHARE * BASE_PI / swing, SLOWEST_radps, FASTEST_radps);
    }
    commission_vector_start(&d->vector, c, known, RAMP_s);
    commission_vector_allow(&d->vector, ERROR_SHARE * c->current_max_A,
                            DAMP_SHARE * known->r_Ohm.value * c->current_max_A, FOLLOW_s);
    begin_pass(d, FIRST_SHARE * c->current_max_A, 1);
}

static void note_index(commission_drag_t *d, const commission_signal_t *s,
                       commission_result_t *found)
{
    if (!s->index_seen || (d->part != FORWARD)) {
        return;
    }
    if (d->indexes == 0) {
        d->index_cnt = s->index_cnt;
    } else if ((d->indexes == 1) && (found->counts_per_turn == 0L)) {
        const int32_t turn     = commission_moved_cnt(s->index_cnt, d->index_cnt);
        found->counts_per_turn = (turn < 0L) ? -turn : turn;
    } else {
        /* further index pulses add nothing */
    }
    d->indexes++;
    found->indexed   = true;
    found->index_cnt = s->index_cnt;
}

static int16_t turns_of(const commission_result_t *found)
{
    return (found->pole_pairs < 2)            ? 2
           : (found->pole_pairs > MOST_TURNS) ? MOST_TURNS
                                              : found->pole_pairs;
}

/* Begins the pass that measures the offset. Counts and type of alignment are known. */
static void begin_second(commission_drag_t *d, const commission_config_t *c,
                         const commission_result_t *found)
{
    const float saliency = found->lq_H.value - found->ld_H.value;
    const float most_A   = MOST_SHARE * c->current_max_A;
    const float left_Wb  = FIRST_LEFT * found->v_loss_V.value / d->speed_radps;
    const float flux_Wb  = found->flux_Wb.value;
    const float sure_Wb  = base_max(flux_Wb - left_Wb, FLUX_LEAST * flux_Wb);
    const float hold_A =
        (found->reluctance || !(saliency > 0.0f)) ? most_A : (sure_Wb / (HOLD_RATIO * saliency));
    d->second = true;
    if (!found->reluctance) {
        d->speed_radps = base_min(SECOND_FASTER * d->speed_radps, FASTEST_radps);
    }
    begin_pass(d, base_min(hold_A, most_A),
               (found->counts_per_turn > 0L) ? turns_of(found) : INDEX_TURNS);
}

/* The rotor did not follow: doubles the current. If an earlier current worked, uses that one. */
static commission_step_t try_again(commission_drag_t *d, const commission_config_t *c,
                                   const commission_result_t *found)
{
    const float most_A = MOST_SHARE * c->current_max_A;

    if (d->followed_A > 0.0f) {
        begin_second(d, c, found);
        return COMMISSION_BUSY;
    }
    if (d->length_A >= most_A) {
        return COMMISSION_FAILED;
    }
    begin_pass(d, base_min(2.0f * d->length_A, most_A), 1);
    return COMMISSION_BUSY;
}

/* Evaluates the first pass. */
static commission_step_t judge_first(commission_drag_t *d, const commission_config_t *c,
                                     commission_result_t *found)
{
    const float saliency = base_max(found->lq_H.value - found->ld_H.value, 0.0f);
    float       i_A      = 0.0f;

    if (!commission_turns_follow(d->sums)) {
        return try_again(d, c, found);
    }
    const float x =
        commission_turns_beyond_Wb(d->sums, found, d->speed_radps, &i_A); /* EQ-COMMISSION-10 */
    found->direction     = (d->sums[0].moved_cnt > 0L) ? 1 : -1;
    const float left_Wb  = LOSS_LEFT * found->v_loss_V.value / d->speed_radps;
    found->reluctance    = !(x > ((MAGNET_RATIO * saliency * i_A) + left_Wb));
    found->flux_Wb.value = found->reluctance ? 0.0f : x;
    d->followed_A        = d->length_A;
    if (found->counts_per_turn > 0L) {
        const float pairs = (float)found->counts_per_turn / fabsf((float)d->sums[0].moved_cnt);
        found->pole_pairs = (int16_t)base_clamp(pairs + 0.5f, 0.0f, 1000.0f);
    }
    const float less_A = LESS * d->length_A;
    if (found->reluctance && (less_A > (LEAST_SHARE * c->current_max_A))) {
        begin_pass(d, less_A, 1);
    } else {
        begin_second(d, c, found);
    }
    return COMMISSION_BUSY;
}

static bool pairs_are_whole(const commission_drag_t *d, const commission_result_t *found)
{
    const float moved = fabsf((float)d->sums[0].moved_cnt);
    const float pairs = (float)found->counts_per_turn * (float)d->turns / base_max(moved, 1.0f);
    const float whole = (float)found->pole_pairs;

    return (found->pole_pairs > 0) && base_within(pairs - whole, WHOLE);
}

/* The rotor has left the d axis: the first pass took a voltage of the inverter for flux. */
static bool is_off_axis(const commission_drag_t *d, const commission_config_t *c,
                        const commission_result_t *found)
{
    const float saliency = found->lq_H.value - found->ld_H.value;

    return !found->reluctance && (d->length_A > (LEAST_SHARE * c->current_max_A)) &&
           (found->flux_Wb.value < (AXIS_RATIO * saliency * d->length_A));
}

static commission_step_t judge_second(commission_drag_t *d, const commission_config_t *c,
                                      commission_result_t *found)
{
    const float       most_A = MOST_SHARE * c->current_max_A;
    commission_step_t out    = COMMISSION_BUSY;

    if (commission_turns_follow(d->sums) && pairs_are_whole(d, found)) {
        commission_turns_solve(d->sums, d->speed_radps, found);
        if (is_off_axis(d, c, found)) {
            begin_pass(d, LESS * d->length_A, d->turns);
        } else {
            out = COMMISSION_DONE;
        }
    } else if (d->length_A < most_A) {
        begin_pass(d, base_min(2.0f * d->length_A, most_A), d->turns);
    } else {
        out = COMMISSION_FAILED;
    }
    return out;
}

/* True at the end of the forward part. With unknown counts per turn, the second pass waits for two
 * index pulses; they also give the pole pairs. Then the pass begins again. */
static bool forward_done(commission_drag_t *d, commission_result_t *found)
{
    const float turned = d->way_rad / BASE_TWO_PI;

    if ((d->turns == INDEX_TURNS) && (found->counts_per_turn > 0L)) {
        const float moved = fabsf((float)d->sums[0].moved_cnt);
        const float pairs = (float)found->counts_per_turn * turned / base_max(moved, 1.0f);
        found->pole_pairs = (int16_t)base_clamp(pairs + 0.5f, 0.0f, 1000.0f);
        begin_pass(d, d->length_A, turns_of(found));
        return false;
    }
    return turned >= (float)d->turns;
}

static void move(commission_drag_t *d, float ts_s, float wanted_radps)
{
    const float most = d->speed_radps * ts_s / SPEED_RAMP_s;
    d->omega_radps   = base_clamp(wanted_radps, d->omega_radps - most, d->omega_radps + most);
    d->theta_rad     = frames_wrap(d->theta_rad + (d->omega_radps * ts_s));
    d->way_rad += fabsf(d->omega_radps) * ts_s;
}

/* Speed of the present part, and whether it has ended. */
static bool part_ends(commission_drag_t *d, const commission_config_t *c, float *wanted_radps,
                      commission_result_t *found)
{
    const bool settled = commission_vector_still(&d->vector, STILL_s) &&
                         (d->ticks > commission_ticks(RAMP_s + STILL_s, c->ts_s));
    const bool late = d->ticks > commission_ticks(PATIENCE_s, c->ts_s);

    switch (d->part) {
    case LEAD_FORWARD:
        *wanted_radps = d->speed_radps;
        return (d->way_rad >= BASE_PI) && (d->omega_radps >= d->speed_radps);
    case FORWARD:
        *wanted_radps = d->speed_radps;
        return forward_done(d, found);
    case TURN:
        *wanted_radps = -d->speed_radps;
        return (d->way_rad >= BASE_TWO_PI) && (d->omega_radps <= -d->speed_radps);
    case BACKWARD:
        *wanted_radps = -d->speed_radps;
        return d->way_rad >= (BASE_TWO_PI * (float)d->turns);
    default:
        *wanted_radps = 0.0f;
        return settled || late;
    }
}

bool commission_drag_follows(const commission_drag_t *d, const commission_config_t *c,
                             const commission_result_t *known)
{
    const float snap_A = SNAP_SHARE * c->current_max_A;
    const float share  = (d->vector.length_A < snap_A) ? VOLTAGE_SHARE : STIFF_SHARE;
    const float most_A = d->vector.length_A + (share * c->current_max_A);
    return commission_vector_follows(&d->vector, BEHIND_SHARE * c->current_max_A,
                                     most_A * known->r_Ohm.value);
}

commission_answer_t commission_drag_tick(commission_drag_t *d, const commission_config_t *c,
                                         const commission_signal_t *s, commission_result_t *found)
{
    commission_answer_t answer       = commission_rest(COMMISSION_BUSY);
    float               wanted_radps = 0.0f;

    note_index(d, s, found);
    const commission_vector_out_t out =
        commission_vector_tick(&d->vector, s, d->theta_rad, 1.5f * d->omega_radps * c->ts_s,
                               (d->part == RELEASE) ? 0.0f : d->length_A);
    if ((d->part == FORWARD) || (d->part == BACKWARD)) {
        commission_turns_add(&d->sums[(d->part == FORWARD) ? 0 : 1], &out, found, d->theta_rad,
                             s->position_cnt, d->second && (found->counts_per_turn > 0L));
    }
    d->ticks++;
    const bool ends = part_ends(d, c, &wanted_radps, found);
    move(d, c->ts_s, wanted_radps);
    if (ends && (d->part == RELEASE)) {
        answer.step = COMMISSION_DONE;
        return answer;
    }
    if (ends && (d->part == BACKWARD)) {
        const commission_step_t step =
            d->second ? judge_second(d, c, found) : judge_first(d, c, found);
        if (step == COMMISSION_DONE) {
            begin_part(d, RELEASE);
        } else {
            answer.step = step;
        }
    } else if (ends) {
        begin_part(d, (int16_t)(d->part + 1));
    } else {
        /* the part continues */
    }
    answer.v_V = out.out_V;
    answer.i_A = frames_inverse_park(out.i_A, frames_angle(d->theta_rad));
    return answer;
}
