/* SPDX-License-Identifier: MIT */
#include "app_states.h"

/* First fault found. Order: faults of any mode, faults of the samples, faults that need a driven
 * motor. */
app_fault_t app_fault_of(const app_modes_t *m, const app_modes_input_t *in)
{
    const bool driving = (m->mode == APP_MODE_ALIGN) || (m->mode == APP_MODE_PRECHARGE) ||
                         (m->mode == APP_MODE_RUN) || (m->mode == APP_MODE_STOP) ||
                         (m->mode == APP_MODE_COMMISSION);

    if (m->mode == APP_MODE_FAULT) {
        return APP_FAULT_NONE; /* the first one stays */
    }
    if (in->memory_changed) {
        return APP_FAULT_MEMORY;
    }
    if (in->background_lost) {
        return APP_FAULT_BACKGROUND;
    }
    if (m->gate_on && (in->board_faults != (uint16_t)BOARD_FAULT_NONE)) {
        return APP_FAULT_BOARD;
    }
    if (m->gate_on && in->tick_missing) {
        return APP_FAULT_TICK;
    }
    /* The lines are unknown there; and a lost encoder is braked without. */
    if (m->reading.index_fault && (m->mode != APP_MODE_COMMISSION) &&
        !m->drive.answer.without_angle) {
        return APP_FAULT_INDEX;
    }
    if ((driving || (m->mode == APP_MODE_CALIBRATE)) && !m->sample.valid) {
        return APP_FAULT_SAMPLE;
    }
    app_fault_t fault = driving ? m->sink_fault : APP_FAULT_NONE;
    if (driving && m->too_hot) {
        fault = APP_FAULT_HEAT;
    }
    if (driving && app_modes_sum_differs(m)) {
        fault = APP_FAULT_CURRENT_SUM;
    }
    return fault;
}
