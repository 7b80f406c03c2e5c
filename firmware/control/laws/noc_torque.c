/* SPDX-License-Identifier: MIT */
#include "noc_torque.h"

#include "check.h"
#include "near_optimal_run.h"

/* The longest voltage is a corner of the hexagon. It has this share of the dc link. */
#define CORNER (2.0f / 3.0f)

bool torque_loop_check(const torque_gains_t *g)
{
    return check_positive(g->iq_VpA) && check_positive(g->id_VpA) &&
           base_in_range(g->id_max_A, -CHECK_LARGEST, 0.0f);
}

/* Acceleration by the torque. */
typedef struct {
    float accel_e_radps2;
    bool  limited; /* EQ-TORQUE-2 takes some away */
} wanted_t;

/* EQ-TORQUE-1 within EQ-TORQUE-2. */
static wanted_t wanted(const law_noc_config_t *c, const drive_config_t *drive,
                       const near_optimal_view_t *view, const torque_command_t *command)
{
    const current_ref_config_t *r     = &c->near_optimal.current_ref;
    const nosc_gains_t         *g     = &c->near_optimal.nosc;
    const motor_reduced_t      *m     = &drive->motor;
    const float                 w     = view->now.omega_e_radps;
    const float                 most  = command->speed_max_e_radps;
    const float                 per_A = base_max(m->l1 + (m->l11 * view->now.id_A), r->l1_min);
    const float                 k_1ps = TORQUE_LIMIT_SHARE * g->speed_A_per_radps * per_A;
    const float                 brake = g->iq_speed_max_A * per_A;
    const float                 drag  = m->l2 * most;
    const float                 load  = view->est->d_omega;
    const float                 hi    = base_max(k_1ps * (most - w), -brake) + drag - load;
    const float                 lo    = base_min(-k_1ps * (most + w), brake) - drag - load;
    const float most_e_radps2         = r->iq_max_A * (m->l1 + (m->l11 * c->torque.id_max_A));
    const float asked =
        base_clamp(command->share * drive->rated_torque_Nm * m->l3, -most_e_radps2, most_e_radps2);

    const wanted_t found = {.accel_e_radps2 = base_clamp(asked, lo, hi),
                            .limited        = (asked < lo) || (asked > hi)};
    return found;
}

/* The speed reference follows: its speed and its acceleration are those of the shaft. */
static void follow(near_optimal_t *s, const motor_reduced_t *m, const near_optimal_view_t *view)
{
    speed_ref_t *w     = &s->speed_ref;
    const float  iq_A  = s->current_ref.i_A.q;
    const float  per_A = m->l1 + (m->l11 * view->now.id_A);

    w->omega_e_radps         = view->now.omega_e_radps;
    w->omega_dot_e_radps2    = (iq_A * per_A) - (m->l2 * w->omega_e_radps) + view->est->d_omega;
    w->omega_2dot_e_radps3   = 0.0f;
    w->accel_wanted_e_radps2 = w->omega_dot_e_radps2;
}

/* EQ-TORQUE-5: where the references of the last period lead, less what the inverter could not make
 * of their voltage. */
static dq_t begun_A(const law_noc_state_t *s, const drive_config_t *drive, dq_t v_V)
{
    const motor_reduced_t *m     = &drive->motor;
    const dq_t             ref_A = s->near_optimal.current_ref.i_A;
    const dq_t cut_V = {.d = s->torque.asked_V.d - v_V.d, .q = s->torque.asked_V.q - v_V.q};
    const dq_t i_A   = {.d = ref_A.d - (drive->ts_s * m->l8 * cut_V.d),
                        .q = ref_A.q - (drive->ts_s * m->l6 * cut_V.q)};
    return i_A;
}

noc_torque_error_t noc_torque_error(law_noc_state_t *s, const law_noc_config_t *c,
                                    const drive_config_t *drive, const near_optimal_view_t *view,
                                    const law_input_t *in)
{
    const current_ref_config_t *limits = &c->near_optimal.current_ref;
    const nosc_gains_t         *g      = &c->near_optimal.nosc;
    current_ref_t              *ref    = &s->near_optimal.current_ref;
    const dq_t                  is_A   = {.d = view->now.id_A, .q = view->now.iq_A};
    const dq_t                  from_A =
        (s->near_optimal.follows == NEAR_OPTIMAL_TORQUE) ? begun_A(s, drive, in->v_V) : is_A;
    const float    dc_V   = in->sample->dc_link_V;
    const wanted_t torque = wanted(c, drive, view, in->aim->torque);
    const float    accel  = torque.accel_e_radps2 + view->est->d_omega;

    /* EQ-CURRENT-REF-1 with a speed that stays: the load's part of it cancels here */
    const speed_ref_t         all = {.omega_dot_e_radps2 = accel, .accel_wanted_e_radps2 = accel};
    const current_ref_input_t inputs = {.est         = view->est,
                                        .state       = &view->now,
                                        .iq_speed_A  = 0.0f,
                                        .dc_link_V   = dc_V,
                                        .v_max_Aps   = limits->circle_ApVs * dc_V,
                                        .d_omega_dot = 0.0f,
                                        .derating    = in->derating};

    current_ref_update(ref, limits, &drive->motor, &all, &inputs);
    follow(&s->near_optimal, &drive->motor, view);

    noc_torque_error_t error = {
        .e        = {.omega_e_radps = 0.0f, .iq_A = is_A.q - from_A.q, .id_A = is_A.d - from_A.d},
        .gain_VpA = {.d = c->torque.id_VpA, .q = c->torque.iq_VpA}};
    if (torque.limited) { /* the current gains of the speed law, whose loop this is */
        error.e.iq_A     = is_A.q - ref->i_A.q;
        error.e.id_A     = is_A.d - ref->i_A.d;
        error.gain_VpA.d = g->lambda[0][1][2];
        error.gain_VpA.q = nosc_current_gain(g);
    } else {
        ref->i_dot_Aps.d = limits->samples_1ps * (ref->i_A.d - from_A.d);
        ref->i_dot_Aps.q = limits->samples_1ps * (ref->i_A.q - from_A.q);
    }
    return error;
}

/* EQ-TORQUE-4 */
static dq_t reached_V(dq_t u_V, float dc_link_V)
{
    const float most_V = CORNER * dc_link_V;
    const float d_V    = base_clamp(u_V.d, -BASE_1_SQRT3 * dc_link_V, BASE_1_SQRT3 * dc_link_V);
    const float q_V    = fpu_root((most_V * most_V) - (d_V * d_V));
    const dq_t  v_V    = {.d = d_V, .q = base_clamp(u_V.q, -q_V, q_V)};

    return v_V;
}

static void answer(law_noc_state_t *s, const law_noc_config_t *c, const motor_reduced_t *m,
                   const near_optimal_view_t *view, const noc_torque_error_t *error,
                   const law_input_t *in, law_output_t *out)
{
    const float dc_link_V = in->sample->dc_link_V;
    const dq_t  ff_V      = near_optimal_forward_V(&s->near_optimal, m, view, &error->e);
    const dq_t  sum_V     = {.d = ff_V.d - (error->gain_VpA.d * error->e.id_A),
                             .q = ff_V.q - (error->gain_VpA.q * error->e.iq_A)};
    const bool  reached   = !voltage_is_outside(sum_V, dc_link_V);
    const dq_t  u_V       = reached ? sum_V : reached_V(sum_V, dc_link_V);

    s->near_optimal.follows = NEAR_OPTIMAL_TORQUE;
    s->torque.asked_V       = sum_V;
    near_optimal_run_fill(&s->near_optimal, view, out, false);
    out->v_V = near_optimal_clamped_V(&c->near_optimal, m, view, u_V, reached, in);
}

void noc_torque_step(law_noc_state_t *s, const law_noc_config_t *c, const drive_config_t *drive,
                     const near_optimal_view_t *view, const law_input_t *in, law_output_t *out)
{
    const noc_torque_error_t error = noc_torque_error(s, c, drive, view, in);

    answer(s, c, &drive->motor, view, &error, in, out);
}
