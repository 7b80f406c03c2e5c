/* SPDX-License-Identifier: MIT */
#include "commission.h"

#include "check.h"
#include "commission_sensors.h"
#include "dead_time.h"
#include "svpwm.h"

#define TRIP_RATIO 1.05f
/* Chosen: time of a watch with the bridge open. */
#define WATCH_s    0.2f
#define WATCHES    25 /* five seconds to come to rest */
#define ZERO_SHARE 0.05f
#define STAND_CNT  4L
/* Plausibility limit of every result in SI units. */
#define LARGEST    1.0e9f
#define LOSS_SHARE 0.1f
#define FADE_SHARE 0.005f
/* Chosen: three degrees. With an inductance ratio of 7 they raise the smaller inductance by 2 %. */
#define AGAIN_rad 0.05f

/* Time limit of a stage, and the progress at its start. */
typedef struct {
    float   most_s;
    int16_t percent;
} stage_plan_t;

static const stage_plan_t plans[] = {
    [COMMISSION_IDLE] = {1.0e6f, 0},       [COMMISSION_WATCH] = {1.0f, 0},
    [COMMISSION_LOOK] = {20.0f, 1},        [COMMISSION_RESISTANCE] = {250.0f, 5},
    [COMMISSION_DRAG] = {400.0f, 20},      [COMMISSION_MAP] = {20.0f, 75},
    [COMMISSION_SPIN] = {200.0f, 80},      [COMMISSION_RING] = {150.0f, 88},
    [COMMISSION_FINISHED] = {1.0e6f, 100}, [COMMISSION_ABORTED] = {1.0e6f, 100}};

static bool is_stage(commission_stage_t stage)
{
    return ((int16_t)stage >= (int16_t)COMMISSION_IDLE) &&
           ((int16_t)stage <= (int16_t)COMMISSION_ABORTED);
}

/* A flipped bit of the stage must not read outside the table. */
static const stage_plan_t *plan_of(commission_stage_t stage)
{
    return &plans[is_stage(stage) ? stage : COMMISSION_ABORTED];
}

ctl_status_t commission_init(commission_t *m, const commission_config_t *c)
{
    const bool ok = base_in_range(c->ts_s, 1.0e-5f, 1.0e-2f) && check_positive(c->current_max_A) &&
                    check_positive(c->speed_max_m_radps) && check_positive(c->dc_link_min_V) &&
                    check_positive(c->dc_link_max_V) && (c->dc_link_max_V >= c->dc_link_min_V) &&
                    (c->counts_per_turn >= 0L) && (c->counts_per_turn <= 4000000L);
    m->config     = c;
    m->stage      = ok ? COMMISSION_IDLE : COMMISSION_ABORTED;
    m->last_stage = m->stage;
    m->reason     = ok ? COMMISSION_REASON_NONE : COMMISSION_REASON_CONFIG;
    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

void commission_start(commission_t *m)
{
    const commission_result_t nothing  = {.counts_per_turn = m->config->counts_per_turn};
    const commission_map_t    unmapped = {.step_A = 0.0f};
    const ab_t                zero     = {0.0f, 0.0f};

    if (m->reason == COMMISSION_REASON_CONFIG) {
        return;
    }
    m->stage      = COMMISSION_WATCH;
    m->reason     = COMMISSION_REASON_NONE;
    m->found      = nothing;
    m->map        = unmapped;
    m->ticks      = 0L;
    m->i_A        = zero;
    m->v_now_V    = zero;
    m->v_before_V = zero;
    m->zero_a_A   = 0.0f;
    m->zero_b_A   = 0.0f;
    m->rounds     = 0;
    m->checked    = false;
    m->looked     = false;
}

static bridge_t abort_for(commission_t *m, commission_reason_t reason)
{
    m->last_stage = m->stage;
    m->stage      = COMMISSION_ABORTED;
    m->reason     = reason;
    return bridge_open();
}

static commission_reason_t judge_shaft(commission_t *m, int32_t position_cnt)
{
    if (m->ticks == 0L) {
        commission_shaft_start(&m->shaft, position_cnt);
        return COMMISSION_REASON_NONE;
    }
    switch (commission_shaft_judge(&m->shaft, m->config, m->found.counts_per_turn, position_cnt)) {
    case COMMISSION_SHAFT_JUMP:
        return COMMISSION_REASON_ENCODER;
    case COMMISSION_SHAFT_FAST:
        return COMMISSION_REASON_OVER_SPEED;
    case COMMISSION_SHAFT_OK:
    default:
        return COMMISSION_REASON_NONE;
    }
}

static commission_reason_t judge(commission_t *m, const commission_sample_t *s, bool run)
{
    const float trip_A = TRIP_RATIO * m->config->current_max_A;

    if (!run) {
        return COMMISSION_REASON_WITHDRAWN;
    }
    if (!s->valid) {
        return COMMISSION_REASON_SAMPLE;
    }
    if (!base_within(s->ia_A, trip_A) || !base_within(s->ib_A, trip_A) ||
        !base_within(s->ia_A + s->ib_A, trip_A)) {
        return COMMISSION_REASON_OVER_CURRENT;
    }
    if (!base_in_range(s->dc_link_V, m->config->dc_link_min_V, m->config->dc_link_max_V)) {
        return COMMISSION_REASON_DC_LINK;
    }
    const commission_reason_t moved = judge_shaft(m, s->position_cnt);
    if (moved != COMMISSION_REASON_NONE) {
        return moved;
    }
    return (m->ticks > commission_ticks(plan_of(m->stage)->most_s, m->config->ts_s))
               ? COMMISSION_REASON_TIMEOUT
               : COMMISSION_REASON_NONE;
}

/* Measures the current offsets with the bridge open. */
static bridge_t watch(commission_t *m, const commission_sample_t *s)
{
    const int32_t ticks = commission_ticks(WATCH_s, m->config->ts_s);
    const float   per   = 1.0f / (float)ticks;
    const float   most  = ZERO_SHARE * m->config->current_max_A;

    if (m->ticks == 0L) {
        m->start_cnt = s->position_cnt;
    }
    m->zero_a_A += per * s->ia_A;
    m->zero_b_A += per * s->ib_A;
    m->ticks++;
    if (m->ticks < ticks) {
        return bridge_open();
    }
    const int32_t moved = commission_moved_cnt(s->position_cnt, m->start_cnt);
    const bool    still = (moved <= STAND_CNT) && (moved >= -STAND_CNT);
    if (!base_within(m->zero_a_A, most) || !base_within(m->zero_b_A, most) ||
        (!still && (m->rounds >= WATCHES))) {
        return abort_for(m, COMMISSION_REASON_MOVING);
    }
    if (!still) { /* cogging may still bring it to rest */
        m->rounds++;
        m->ticks    = 0L;
        m->zero_a_A = 0.0f;
        m->zero_b_A = 0.0f;
        return bridge_open();
    }
    m->rounds = 0;
    m->stage  = COMMISSION_LOOK;
    m->ticks  = 0L;
    commission_check_start(&m->asked.check);
    return bridge_open();
}

static commission_signal_t signal_of(commission_t *m, const commission_sample_t *s)
{
    const ab_t                i_A    = frames_clarke(s->ia_A - m->zero_a_A, s->ib_A - m->zero_b_A);
    const ab_t                di_A   = {i_A.alpha - m->i_A.alpha, i_A.beta - m->i_A.beta};
    const commission_signal_t signal = {
        i_A, di_A, m->v_before_V, s->dc_link_V, s->position_cnt, s->index_cnt, s->index_seen};
    m->i_A = i_A;
    return signal;
}

static commission_answer_t run_stage(commission_t *m, const commission_signal_t *s)
{
    switch ((int16_t)m->stage) {
    case COMMISSION_LOOK:
        return commission_sensors_look(m, s);
    case COMMISSION_RESISTANCE:
        return commission_resistance_tick(&m->work.resistance, m->config, s, &m->found);
    case COMMISSION_DRAG:
        return commission_drag_tick(&m->work.drag, m->config, s, &m->found);
    case COMMISSION_MAP:
        return commission_map_tick(&m->work.inductance, m->config, s, &m->found, &m->map);
    case COMMISSION_SPIN:
        return commission_spin_tick(&m->work.spin, m->config, s, &m->found);
    case COMMISSION_RING:
        return commission_ring_tick(&m->work.ring, m->config, s, &m->found);
    default:
        return commission_rest(COMMISSION_FAILED);
    }
}

static commission_reason_t failure_of(const commission_t *m)
{
    if (!m->checked) {
        return COMMISSION_REASON_SENSOR;
    }
    switch ((int16_t)m->stage) {
    case COMMISSION_RESISTANCE:
        return COMMISSION_REASON_RESISTANCE;
    case COMMISSION_DRAG:
        return COMMISSION_REASON_DRAG;
    case COMMISSION_SPIN:
        return COMMISSION_REASON_SPIN;
    case COMMISSION_RING:
        return m->work.ring.rings ? COMMISSION_REASON_RING : COMMISSION_REASON_SPIN;
    default:
        return COMMISSION_REASON_INDUCTANCE;
    }
}

static bool is_number(float x)
{
    return base_within(x, LARGEST);
}

static bool results_are_numbers(const commission_result_t *r)
{
    return is_number(r->r_Ohm.value) && is_number(r->ld_H.value) && is_number(r->lq_H.value) &&
           is_number(r->flux_Wb.value) && is_number(r->inertia_kgm2.value) &&
           is_number(r->friction_Nms.value) && is_number(r->coulomb_Nm.value) &&
           is_number(r->offset_rad.value) && is_number(r->resonance_Hz.value) &&
           is_number(r->damping.value) && is_number(r->load_share.value);
}

/* A voltage cannot be explained by what is no number. */
static commission_reason_t unexplained_reason(const commission_t *m)
{
    return results_are_numbers(&m->found) ? COMMISSION_REASON_SENSOR : COMMISSION_REASON_NUMERIC;
}

static void next_stage(commission_t *m, const commission_signal_t *s)
{
    m->last_stage = m->stage;
    m->ticks      = 0L;
    commission_guard_start(&m->guard);
    commission_probe_start(&m->asked.probe);
    switch ((int16_t)m->stage) {
    case COMMISSION_LOOK:
        m->stage = COMMISSION_RESISTANCE;
        commission_resistance_start(&m->work.resistance, m->config, &m->found);
        break;
    case COMMISSION_RESISTANCE:
        m->stage = COMMISSION_DRAG;
        commission_drag_start(&m->work.drag, m->config, &m->found);
        break;
    case COMMISSION_DRAG:
        m->stage = COMMISSION_MAP;
        commission_inductance_start(&m->work.inductance, LARGEST, 0.0f);
        break;
    case COMMISSION_MAP:
        m->stage = COMMISSION_SPIN;
        commission_spin_start(&m->work.spin, m->config, s, &m->found);
        break;
    case COMMISSION_SPIN:
        /* A larger correction means that MAP measured at a wrong angle: repeat it once. */
        if ((m->rounds == 0) && !base_within(m->found.moved_rad, AGAIN_rad)) {
            m->rounds++;
            m->stage = COMMISSION_MAP;
            commission_inductance_start(&m->work.inductance, LARGEST, 0.0f);
        } else {
            m->stage = COMMISSION_RING;
            commission_ring_start(&m->work.ring, m->config, s, &m->found);
        }
        break;
    default:
        m->stage = COMMISSION_FINISHED;
        break;
    }
}

/* Duty ratios of the requested voltage plus the inverter loss, once known. Stores the voltage. */
static bridge_t modulate(commission_t *m, const commission_answer_t *answer, float dc_link_V)
{
    const svpwm_t wave  = svpwm_within(answer->v_V, dc_link_V);
    const float   share = m->found.v_loss_V.value / dc_link_V;
    const float   fade_A =
        base_max(m->found.v_loss_V.value * m->config->ts_s / base_max(m->found.ld_H.value, 1.0e-9f),
                 FADE_SHARE * m->config->current_max_A);
    const dead_time_config_t loss = {base_clamp(share, 0.0f, LOSS_SHARE), 1.0f / fade_A};

    m->v_before_V    = m->v_now_V;
    m->v_now_V.alpha = wave.share * answer->v_V.alpha;
    m->v_now_V.beta  = wave.share * answer->v_V.beta;
    return bridge_closed(
        dead_time_compensate(&loss, wave.duty, frames_inverse_clarke(answer->i_A)));
}

bridge_t commission_tick(commission_t *m, const commission_sample_t *sample, bool run)
{
    if (!is_stage(m->stage)) {
        return abort_for(m, COMMISSION_REASON_NUMERIC);
    }
    if ((m->stage == COMMISSION_IDLE) || (m->stage >= COMMISSION_FINISHED)) {
        return bridge_open();
    }
    const commission_reason_t reason = judge(m, sample, run);
    if (reason != COMMISSION_REASON_NONE) {
        return abort_for(m, reason);
    }
    if (m->stage == COMMISSION_WATCH) {
        return watch(m, sample);
    }
    const commission_signal_t s         = signal_of(m, sample);
    const bool                explained = commission_sensors_explain(m, &s);
    commission_answer_t answer = explained ? run_stage(m, &s) : commission_rest(COMMISSION_FAILED);
    commission_sensors_probe(m, &s, &answer);
    m->ticks++;
    if (answer.step == COMMISSION_FAILED) {
        return abort_for(m, explained ? failure_of(m) : unexplained_reason(m));
    }
    if (!is_number(answer.v_V.alpha) || !is_number(answer.v_V.beta)) {
        return abort_for(m, COMMISSION_REASON_NUMERIC);
    }
    if (answer.step == COMMISSION_DONE) {
        if (!results_are_numbers(&m->found)) {
            return abort_for(m, COMMISSION_REASON_NUMERIC);
        }
        next_stage(m, &s);
    }
    const bridge_t out = modulate(m, &answer, sample->dc_link_V);
    return (m->stage == COMMISSION_FINISHED) ? bridge_open() : out;
}

int16_t commission_percent(commission_stage_t stage, commission_stage_t last_stage)
{
    return plan_of((stage == COMMISSION_ABORTED) ? last_stage : stage)->percent;
}
