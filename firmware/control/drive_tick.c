/* SPDX-License-Identifier: MIT */
#include "drive_tick.h"

#include <stddef.h>

#include "drive_fault.h"
#include "frames.h"
#include "voltage.h"

/* Exceeds the voltage of every law, d and q together; its square does not overflow. */
#define VOLTAGE_ANY_V 1.0e9f

static const dq_t  zero_dq  = {0.0f, 0.0f};
static const abc_t zero_abc = {0.0f, 0.0f, 0.0f};

/* EQ-CURRENT-GATE-2 */
static float jump_ApV(const drive_config_t *c)
{
    return 2.0f * c->ts_s * base_max(c->motor.l6, c->motor.l8);
}

/* EQ-CURRENT-WATCH-4 and EQ-DRIVE-3. Two edges are off by up to half a count, and so is the speed
 * between them. The law's speed trips at the trip level itself. */
static void set_encoder_limits(drive_t *d, const drive_config_t *c)
{
    const float accel = (c->motor.l1 + (fabsf(c->motor.l11) * c->current_max_A)) * c->current_max_A;
    const float count_rad =
        BASE_TWO_PI * (float)c->hardware.pole_pairs / (float)c->hardware.encoder_positions;

    d->wire_open_s              = current_watch_open_s(count_rad, accel);
    d->sample_speed_max_e_radps = c->trip_speed_e_radps + (count_rad / c->ts_s);
}

ctl_status_t drive_init(drive_t *d, const drive_config_t *config)
{
    const ctl_status_t status = drive_config_check(config);

    d->config          = (status == CTL_OK) ? config : NULL;
    d->config_again    = d->config;
    d->law_again       = (status == CTL_OK) ? config->law : NULL;
    d->constants_again = (status == CTL_OK) ? config->constants : NULL;
    d->jump_ApV        = (status == CTL_OK) ? jump_ApV(config) : 0.0f;
    if (status == CTL_OK) {
        set_encoder_limits(d, config);
    }
    drive_reset(d);
    return status;
}

void drive_reset(drive_t *d)
{
    const law_output_t nothing = {.plausible = false};

    d->state     = DRIVE_OFF;
    d->fault     = DRIVE_FAULT_NONE;
    d->answer    = nothing;
    d->v_V       = zero_dq;
    d->v_limited = false;
    d->i_hat_A   = zero_abc;
    current_gate_reset(&d->current_gate);
    current_watch_reset(&d->current_watch);
    motion_watch_reset(&d->motion_watch);
}

/* True if drive_fault_of() finds no wrong sample. Two comparisons tell: of the least distance from
 * a limit, and of a sum in which a NaN or an infinity shows. */
static bool is_in_range(const drive_t *d, const drive_sample_t *s)
{
    const drive_config_t *c     = d->config;
    const float           theta = fabsf(s->theta_e_rad);
    const float           omega = fabsf(s->omega_e_radps);
    const float           edges = base_min(base_min(s->edge_gap_s, s->edge_age_s),
                                           base_min(s->band_rad, BASE_PI - s->band_rad));
    const float link  = base_min(s->dc_link_V - c->dc_link_min_V, c->dc_link_max_V - s->dc_link_V);
    const float shaft = base_min(BASE_TWO_PI - theta, d->sample_speed_max_e_radps - omega);
    const float least = base_min(base_min(edges, link), shaft);
    const float sum   = theta + omega + s->edge_gap_s + s->edge_age_s + s->band_rad + s->dc_link_V;

    return s->valid && (least >= 0.0f) && (sum <= DRIVE_FAULT_TIMES_MAX_s);
}

static drive_fault_t find_fault(const drive_t *d, const drive_sample_t *s,
                                const drive_command_t *command, current_gate_verdict_t currents)
{
    return ((currents != CURRENT_GATE_TRIP) && is_in_range(d, s) &&
            drive_fault_command_ok(d->config, command))
               ? DRIVE_FAULT_NONE
               : drive_fault_of(d, s, command, currents);
}

/* Checks an answer of the law. Without it, the voltage limit would turn a NaN into full voltage. */
static drive_fault_t find_wrong(const drive_config_t *c, const law_output_t *answer)
{
    drive_fault_t fault = DRIVE_FAULT_NONE;

    if (!answer->plausible) {
        fault = DRIVE_FAULT_ENCODER;
    } else if (!base_within(answer->now.omega_e_radps, c->trip_speed_e_radps)) {
        fault = DRIVE_FAULT_OVER_SPEED;
    } else if (!((fabsf(answer->v_V.d) + fabsf(answer->v_V.q)) <= VOLTAGE_ANY_V)) {
        fault = DRIVE_FAULT_NUMERIC;
    } else {
        /* no fault */
    }
    return fault;
}

static bridge_t trip(drive_t *d, drive_fault_t fault)
{
    d->state = DRIVE_FAULT;
    d->fault = fault;
    d->v_V   = zero_dq;
    return bridge_open();
}

/* Bumpless start: the law takes over the measurement. */
static void start(drive_t *d, const drive_sample_t *sample)
{
    d->config->law->reset(&d->law, d->config, sample);
    current_watch_start(&d->current_watch, sample->ia_A, sample->ib_A);
    d->v_V   = zero_dq;
    d->state = DRIVE_RUN;
}

/* The voltage of the next period as duty ratios. */
static bridge_t modulate(drive_t *d, float dc_link_V)
{
    const drive_config_t *c     = d->config;
    const law_output_t   *out   = &d->answer;
    const frames_angle_t  angle = frames_angle(out->theta_rad);
    const dq_t            i_A   = {.d = out->now.id_A, .q = out->now.iq_A};

    const voltage_t v     = voltage_produce(out->v_V, angle, dc_link_V, c->overmodulation);
    const ab_t      i_ab  = frames_inverse_park(i_A, angle);
    const abc_t     i_abc = frames_inverse_clarke(i_ab);

    const current_watch_expected_t expected = {.angle     = angle,
                                               .ahead_rad = 0.5f * c->ts_s * out->now.omega_e_radps,
                                               .i_A       = i_ab,
                                               .d_Aps     = {.d = out->d_d, .q = out->d_q},
                                               .predicted = out->predicted};
    current_watch_expect(&d->current_watch, &expected, c->ts_s);
    if (d->motion_watch.look == MOTION_WATCH_LOOK_CURRENTS) { /* in the next period */
        current_watch_ask(&d->current_watch, out->i_ref_A, angle);
    }
    d->v_V       = v.v_V;
    d->v_limited = v.limited;
    d->i_hat_A   = i_abc;
    return bridge_closed(dead_time_compensate(&c->dead_time, v.duty, i_abc));
}

static current_watch_scale_t scale_of(const drive_t *d, float change_A)
{
    const current_watch_scale_t scale = {.ts_s          = d->config->ts_s,
                                         .current_max_A = d->config->current_max_A,
                                         .open_s        = d->wire_open_s,
                                         .jump_A        = change_A};
    return scale;
}

static drive_fault_t fault_of_currents(current_watch_verdict_t found)
{
    if (found == CURRENT_WATCH_GOOD) {
        return DRIVE_FAULT_NONE;
    }
    return (found == CURRENT_WATCH_OPEN) ? DRIVE_FAULT_PHASE : DRIVE_FAULT_CURRENT_SENSOR;
}

static drive_fault_t watch_currents(drive_t *d, const drive_sample_t *sample, float change_A)
{
    const current_watch_scale_t scale = scale_of(d, change_A);

    return fault_of_currents(
        current_watch_judge(&d->current_watch, sample->ia_A, sample->ib_A, &scale));
}

static drive_fault_t look_at_currents(drive_t *d, const drive_sample_t *sample, float change_A)
{
    const current_watch_scale_t scale = scale_of(d, change_A);

    d->motion_watch.look = MOTION_WATCH_LOOK_STALL;
    return fault_of_currents(current_watch_look(&d->current_watch, sample->ia_A, sample->ib_A,
                                                d->answer.now.omega_e_radps,
                                                MOTION_WATCH_LOOKS * scale.ts_s, &scale));
}

static drive_fault_t watch_motion(drive_t *d, const drive_sample_t *sample, float command_e_radps)
{
    static const drive_fault_t faults[] = {DRIVE_FAULT_NONE, DRIVE_FAULT_MODEL, DRIVE_FAULT_STALL,
                                           DRIVE_FAULT_AWAY}; /* of motion_watch_verdict_t */

    const motion_watch_input_t in = {.motor           = &d->config->motor,
                                     .current_max_A   = d->config->current_max_A,
                                     .ts_s            = d->config->ts_s,
                                     .now             = d->answer.now,
                                     .command_e_radps = command_e_radps,
                                     .dc_link_V       = sample->dc_link_V,
                                     .edge_gap_s      = sample->edge_gap_s,
                                     .d_Aps = d->answer.predicted ? d->current_watch.d_slow_Aps
                                                                  : zero_dq};
    return faults[motion_watch_judge(&d->motion_watch, &in)];
}

static drive_fault_t watch_in_turn(drive_t *d, const drive_sample_t *sample,
                                   const drive_command_t *command, float change_A)
{
    if (d->motion_watch.look == MOTION_WATCH_LOOK_CURRENTS) {
        return look_at_currents(d, sample, change_A);
    }
    return watch_motion(
        d, sample, (command->aim == NULL) ? command->omega_e_radps : d->answer.profile_e_radps);
}

static bridge_t run(drive_t *d, const drive_sample_t *sample, const drive_command_t *command,
                    float change_A)
{
    const drive_fault_t currents = watch_currents(d, sample, change_A);
    if (currents != DRIVE_FAULT_NONE) {
        return trip(d, currents);
    }

    const law_input_t in = {.sample          = sample,
                            .command_e_radps = command->omega_e_radps,
                            .aim             = command->aim,
                            .v_V             = d->v_V,
                            .derating        = base_clamp(command->derating, 0.0f, 1.0f)};

    d->config->law->step(&d->law, d->config, &in, &d->answer);

    drive_fault_t wrong = find_wrong(d->config, &d->answer);
    if (wrong == DRIVE_FAULT_NONE) {
        wrong = watch_in_turn(d, sample, command, change_A);
    }
    return (wrong == DRIVE_FAULT_NONE) ? modulate(d, sample->dc_link_V) : trip(d, wrong);
}

/* A sample with the currents that the law predicts for this instant. A law without a prediction
 * uses those of the previous period. */
static drive_sample_t without_currents(const drive_t *d, const drive_sample_t *sample)
{
    const law_output_t *out = &d->answer; /* its angle belongs to the middle of this period */
    const dq_t          i_A = {.d = out->now.id_A, .q = out->now.iq_A};
    const float theta_rad   = out->theta_rad - (0.5f * d->config->ts_s * out->now.omega_e_radps);

    return current_gate_replaced(sample, i_A, theta_rad);
}

/* The predicted currents belong to the middle of this period, at most a twentieth of a turn
 * ahead. */
static current_gate_verdict_t judge_currents(drive_t *d, const drive_sample_t *sample,
                                             float change_A)
{
    const current_gate_input_t in = {.trip_A   = d->config->trip_current_A,
                                     .jump_A   = change_A,
                                     .i_hat_A  = d->i_hat_A,
                                     .expected = d->state == DRIVE_RUN};

    return current_gate_judge(&d->current_gate, sample->ia_A, sample->ib_A, &in);
}

/* False if a pointer or count has changed, which could cause a wild read. A changed pointer is
 * never dereferenced. */
static bool is_whole(const drive_t *d)
{
    if (d->config != d->config_again) {
        return false;
    }
    const drive_config_t *c = d->config;
    return (c->law == d->law_again) && (c->constants == d->constants_again) &&
           ((c->law->counts_ok == NULL) || c->law->counts_ok(c));
}

bridge_t drive_tick(drive_t *d, const drive_sample_t *sample, const drive_command_t *command)
{
    if ((d->config == NULL) || (d->state == DRIVE_FAULT)) {
        return bridge_open();
    }
    if (!is_whole(d)) {
        return trip(d, DRIVE_FAULT_MEMORY);
    }
    const float                  change_A = d->jump_ApV * sample->dc_link_V;
    const current_gate_verdict_t currents = judge_currents(d, sample, change_A);
    const drive_fault_t          fault    = find_fault(d, sample, command, currents);
    if (fault != DRIVE_FAULT_NONE) {
        return trip(d, fault);
    }
    if (!command->run) {
        /* Not at the start: the first tick of a run is a dear one. */
        current_watch_reset(&d->current_watch);
        motion_watch_reset(&d->motion_watch);
        d->state = DRIVE_OFF;
        return bridge_open();
    }
    const drive_sample_t *used = sample;
    drive_sample_t        replaced;
    if (currents == CURRENT_GATE_SPIKE) {
        replaced = without_currents(d, sample);
        used     = &replaced;
    } else if (d->state == DRIVE_OFF) {
        start(d, sample);
    } else {
        /* runs, with what was measured */
    }
    return run(d, used, command, change_A); /* the one call, so that the compiler puts it here */
}
