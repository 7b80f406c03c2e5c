/* SPDX-License-Identifier: MIT */
/* One period of the self-commissioning, for the analyser (docs/assurance.md): any sample, any stage, every float any bits. Counts
 * of the state are within what the stages let them reach, and the shaft's encoder within what a drive file allows. */
#include "any.h"
#include "commission.h"

volatile commission_result_t     any_result;
volatile commission_guard_t      any_guard;
volatile commission_admittance_t any_admittance;
volatile commission_check_t      any_check;
volatile commission_probe_t      any_probe;
volatile commission_inductance_t any_inductance;
volatile commission_resistance_t any_resistance;
volatile commission_drag_t       any_drag;
volatile commission_spin_t       any_spin;
volatile commission_ring_t       any_ring;
commission_t                     state;
commission_config_t              config;
commission_sample_t              sample;

#define TICKS_MAX  10000000L /* 100 s at the shortest period, above the limit of every stage */
#define COUNTS_MAX 1000000L
#define PAIRS_MAX  100L
#define SHORT_MAX  30000L /* of the counts in 16 bits */

static void any_vector(commission_vector_t *v)
{
    v->still_ticks = any_long_between(0L, TICKS_MAX);
    v->swing_ticks = any_long_between(0L, TICKS_MAX);
    v->way         = (int16_t)any_long_between(-1L, 1L);
}

static void any_state(commission_stage_t stage)
{
    state.config                = &config;
    state.stage                 = stage;
    state.last_stage            = stage;
    state.reason                = COMMISSION_REASON_NONE;
    state.ticks                 = any_long_between(0L, TICKS_MAX);
    state.rounds                = (int16_t)any_long_between(0L, 2L);
    state.shaft.speed_ticks     = any_long_between(0L, TICKS_MAX);
    state.found                 = any_result;
    state.found.counts_per_turn = any_long_between(1L, COUNTS_MAX);
    state.found.pole_pairs      = (int16_t)any_long_between(0L, PAIRS_MAX);
    state.found.direction       = (int16_t)any_long_between(-1L, 1L);
    state.found.indexed         = any_bool();
    state.found.reluctance      = any_bool();
    state.checked               = any_bool();
    state.looked                = any_bool();
    state.asked.probe           = any_probe;
    state.asked.probe.tick      = (int16_t)any_long_between(0L, COMMISSION_PROBE_TICKS - 1);
    state.asked.probe.full      = any_bool();
    state.guard                 = any_guard;
    state.guard.begun           = any_bool();
    state.admittance            = any_admittance;
    config.counts_per_turn      = any_long_between(0L, COUNTS_MAX);
    sample.index_seen           = any_bool();
    sample.valid                = any_bool();
}

static void tick(void)
{
    (void)commission_tick(&state, &sample, any_bool());
    (void)commission_percent(state.stage, state.last_stage);
}

/* Entry: WATCH, and every stage that does nothing. */
void prove_commission_rest(void)
{
    any_state((commission_stage_t)any_long_between(COMMISSION_IDLE, COMMISSION_WATCH));
    tick();
    any_state((commission_stage_t)any_long_between(COMMISSION_FINISHED, COMMISSION_ABORTED));
    tick();
}

static void any_wave(void)
{
    commission_inductance_t *const l = &state.work.inductance;

    *l              = any_inductance;
    l->axis         = (int16_t)any_long_between(0L, 4L);
    l->wait_ticks   = (int16_t)any_long_between(0L, SHORT_MAX);
    l->wave.found   = any_bool();
    l->wave.lost    = any_bool();
    l->wave.last    = (int16_t)any_long_between(0L, SHORT_MAX);
    l->wave.slips   = (int16_t)any_long_between(0L, SHORT_MAX);
    l->wave.samples = (int16_t)any_long_between(0L, SHORT_MAX);
    l->wave.halves  = (int16_t)any_long_between(0L, SHORT_MAX);
    l->wave.proofs  = (int16_t)any_long_between(0L, SHORT_MAX);
    l->alpha.n = l->beta.n = l->noise.n = any_long_between(0L, TICKS_MAX);
}

/* Entry: LOOK, before the phases and sensors have answered. */
void prove_commission_check(void)
{
    commission_check_t *const k = &state.asked.check;

    any_state(COMMISSION_LOOK);
    state.checked = false;
    *k            = any_check;
    k->found      = any_bool();
    k->tick       = (int16_t)any_long_between(0L, SHORT_MAX);
    k->patterns   = (int16_t)any_long_between(0L, SHORT_MAX);
    tick();
}

/* Entry: LOOK. */
void prove_commission_look(void)
{
    any_state(COMMISSION_LOOK);
    state.checked = true;
    any_wave();
    tick();
}

/* Entry: MAP. */
void prove_commission_map(void)
{
    any_state(COMMISSION_MAP);
    any_wave();
    state.work.inductance.axis   = (int16_t)any_long_between(0L, COMMISSION_MAP_WAVES + 1);
    state.work.inductance.turned = any_bool();
    tick();
}

/* Entry: RESISTANCE. */
void prove_commission_resistance(void)
{
    commission_resistance_t *const r = &state.work.resistance;

    any_state(COMMISSION_RESISTANCE);
    *r            = any_resistance;
    r->angle      = (int16_t)any_long_between(0L, COMMISSION_ANGLES);
    r->at_angle   = (int16_t)any_long_between(0L, COMMISSION_ANGLES - 1);
    r->level      = (int16_t)any_long_between(-1L, 3L);
    r->ticks      = any_long_between(0L, TICKS_MAX);
    r->mean_ticks = any_long_between(0L, TICKS_MAX);
    r->sums       = any_long_between(0L, TICKS_MAX);
    r->line.n     = any_long_between(0L, TICKS_MAX);
    for (int k = 0; k < COMMISSION_ANGLES; k++) {
        r->lines[k].valid = any_bool();
    }
    any_vector(&r->vector);
    tick();
}

/* Entry: DRAG. */
void prove_commission_drag(void)
{
    commission_drag_t *const d = &state.work.drag;

    any_state(COMMISSION_DRAG);
    *d         = any_drag;
    d->ticks   = any_long_between(0L, TICKS_MAX);
    d->part    = (int16_t)any_long_between(0L, 6L);
    d->turns   = (int16_t)any_long_between(0L, 64L);
    d->indexes = (int16_t)any_long_between(0L, SHORT_MAX);
    d->second  = any_bool();
    any_vector(&d->vector);
    tick();
}

/* Entry: SPIN. */
void prove_commission_spin(void)
{
    commission_spin_t *const p = &state.work.spin;

    any_state(COMMISSION_SPIN);
    *p                     = any_spin;
    p->part                = (int16_t)any_long_between(0L, 11L);
    p->ticks               = any_long_between(0L, TICKS_MAX);
    p->coast_ticks         = any_long_between(0L, TICKS_MAX);
    p->window_ticks        = any_long_between(0L, TICKS_MAX);
    p->motion.count        = (int16_t)any_long_between(0L, COMMISSION_WINDOWS);
    p->motion.ticks        = any_long_between(-TICKS_MAX, TICKS_MAX);
    p->motion.length_ticks = any_long_between(0L, TICKS_MAX);
    p->motion.around_ticks = any_long_between(0L, TICKS_MAX);
    p->motion.have_last    = any_bool();
    p->motion.driven       = any_bool();
    for (int k = 0; k < COMMISSION_WINDOWS; k++) {
        p->motion.windows[k].driven = any_bool();
    }
    tick();
}

/* Entry: RING. */
void prove_commission_ring(void)
{
    commission_ring_t *const r = &state.work.ring;

    any_state(COMMISSION_RING);
    *r                  = any_ring;
    r->block.samples    = any_long_between(4L, COUNTS_MAX);
    r->block.cycles     = (int16_t)any_long_between(2L, 1000L);
    r->block.at         = any_long_between(0L, r->block.samples - 1L);
    r->block.turned_cnt = any_long_between(-COUNTS_MAX, COUNTS_MAX);
    r->mean.n           = (int16_t)any_long_between(0L, SHORT_MAX);
    r->seen.hidden      = (int16_t)any_long_between(0L, SHORT_MAX);
    r->fit.n            = (int16_t)any_long_between(0L, COMMISSION_RING_ANSWERS);
    r->part             = (int16_t)any_long_between(0L, 4L);
    r->step             = (int16_t)any_long_between(0L, SHORT_MAX);
    r->blocks           = (int16_t)any_long_between(0L, SHORT_MAX);
    r->ticks            = any_long_between(0L, TICKS_MAX);
    r->rings            = any_bool();
    tick();
}
