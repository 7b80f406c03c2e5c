/* SPDX-License-Identifier: MIT */
#include "commission_sensors.h"

/* Four windows of the probe: gains that changed in LOOK or RESISTANCE show in them. */
#define FIRST_TICKS (4L * COMMISSION_PROBE_TICKS)
/* Chosen: largest amplitude of LOOK, in pulses of the check. One raised the current by more. */
#define LOOK_PULSES 2.0f
/* Chosen: the same, to what the smallest admittance needs. The inverter's loss is not in it. */
#define LOOK_RATIO 2.0f

/* Largest amplitude of LOOK per ampere of its bound: the current crosses twice the bound in a half
 * wave. */
static float most_Ohm(const commission_admittance_t *y, float ts_s)
{
    const float time_s = (float)COMMISSION_WAVE_SAMPLES * ts_s;
    return LOOK_RATIO * 2.0f / (time_s * commission_check_least(y)); /* > 0 after the check */
}

static commission_answer_t check_sensors(commission_t *m, const commission_signal_t *s)
{
    commission_admittance_t y   = m->admittance;
    commission_answer_t     out = commission_check_tick(&m->asked.check, m->config, s, &y);

    if (out.step == COMMISSION_DONE) {
        const bool other = m->looked && !commission_check_same(&y, &m->admittance);

        out.step   = other ? COMMISSION_FAILED : COMMISSION_BUSY;
        m->checked = !other;
        commission_guard_start(&m->guard);
        if (!m->looked) {
            m->looked     = true;
            m->admittance = y;
            commission_inductance_start(&m->work.inductance, LOOK_PULSES * y.pulse_V,
                                        most_Ohm(&y, m->config->ts_s));
        }
    }
    return out;
}

commission_answer_t commission_sensors_look(commission_t *m, const commission_signal_t *s)
{
    if (!m->checked) {
        return check_sensors(m, s);
    }
    commission_answer_t out =
        commission_inductance_look(&m->work.inductance, m->config, s, &m->found);

    if ((out.step == COMMISSION_DONE) && !commission_guard_agrees(&m->admittance, &m->found)) {
        m->checked = false;
        out.step   = COMMISSION_FAILED;
    } else if (m->work.inductance.wave.lost) {
        m->work.inductance.wave.lost = false;
        m->checked                   = false;
        commission_check_start(&m->asked.check);
        out = commission_rest(COMMISSION_BUSY);
    } else {
        /* LOOK continues, or has ended */
    }
    return out;
}

bool commission_sensors_explain(commission_t *m, const commission_signal_t *s)
{
    const commission_config_t *c     = m->config;
    const commission_result_t *known = &m->found;
    bool                       ok    = true;

    switch ((int16_t)m->stage) {
    case COMMISSION_LOOK:
        ok = !m->checked || commission_guard_look(&m->guard, c, s, &m->admittance);
        break;
    case COMMISSION_RESISTANCE:
        ok = commission_guard_vector(&m->guard, c, s, known) &&
             commission_resistance_follows(&m->work.resistance, c, known);
        break;
    case COMMISSION_DRAG:
        ok = commission_guard_vector(&m->guard, c, s, known) &&
             commission_drag_follows(&m->work.drag, c, known);
        break;
    case COMMISSION_MAP:
        ok = commission_guard_rotor(&m->guard, c, s, known, COMMISSION_GUARD_MAP_MEAN);
        break;
    default:
        ok = commission_guard_rotor(&m->guard, c, s, known, COMMISSION_GUARD_SPIN_MEAN);
        break;
    }
    return ok;
}

void commission_sensors_probe(commission_t *m, const commission_signal_t *s,
                              commission_answer_t *out)
{
    const bool                 turns   = m->stage == COMMISSION_DRAG;
    const bool                 direct  = turns || (m->stage == COMMISSION_RESISTANCE);
    const commission_vector_t *v       = turns ? &m->work.drag.vector : &m->work.resistance.vector;
    const bool                 first   = m->ticks < FIRST_TICKS;
    const bool                 settles = !turns && (m->work.resistance.mean_ticks == 0L);
    const bool                 asks    = direct && (out->step == COMMISSION_BUSY) &&
                      (first || settles || commission_vector_strays(v));

    if (asks) {
        ab_t pulse_V;

        if (!commission_probe_tick(&m->asked.probe, m->config, s, &m->admittance, &pulse_V)) {
            m->checked = false;
            out->step  = COMMISSION_FAILED;
        }
        out->v_V.alpha += pulse_V.alpha;
        out->v_V.beta += pulse_V.beta;
    } else if (direct) {
        commission_probe_start(&m->asked.probe);
    } else {
        /* the other stages know their currents */
    }
}
