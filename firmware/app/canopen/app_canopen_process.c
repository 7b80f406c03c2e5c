/* SPDX-License-Identifier: MIT */
#include "app_canopen_process.h"

#include "app_canopen_emergency.h"

#define TENTH 0.1f /* of a millisecond */

void app_canopen_process_reset(app_canopen_t *c)
{
    c->waiting = APP_CANOPEN_SYNC_NEW;
    for (uint16_t n = 0U; n < APP_CANOPEN_PDOS; n++) {
        app_canopen_pdo_reset(&c->received[n], n, c->node, true);
        app_canopen_pdo_reset(&c->sent[n], n, c->node, false);
    }
}

void app_canopen_process_start(app_canopen_t *c, uint32_t now_ticks)
{
    c->waiting = APP_CANOPEN_SYNC_NEW;
    for (uint16_t n = 0U; n < APP_CANOPEN_PDOS; n++) {
        c->received[n].full    = false;
        c->received[n].watched = false;
        c->sent[n].wanted      = app_canopen_pdo_has_events(&c->sent[n]); /* the first is news */
        c->sent[n].syncs       = 0U;
        c->sent[n].at_ticks    = now_ticks;
    }
}

static bool act_on(app_canopen_t *c, app_canopen_pdo_t *p, app_registers_t *r)
{
    const bool ok = app_canopen_pdo_act(p, r);

    p->full = false;
    if (!ok) {
        app_canopen_emergency_tell(&c->emergency, APP_CANOPEN_PDO_REFUSED);
    }
    return ok;
}

static void take_octets(app_canopen_t *c, app_canopen_pdo_t *p, app_registers_t *r,
                        const board_can_frame_t *frame, uint32_t now_ticks)
{
    if (frame->length < p->length) {
        app_canopen_emergency_tell(&c->emergency, APP_CANOPEN_PDO_SHORT);
    } else {
        for (uint16_t n = 0U; n < p->length; n++) {
            p->octets[n] = (uint16_t)(frame->octets[n] & 0xFFU);
        }
        p->watched  = p->event_ms > 0U;
        p->at_ticks = now_ticks;
        p->full     = true;
        if (p->type > APP_CANOPEN_SYNC_MOST) {
            (void)act_on(c, p, r);
        } else {
            c->waiting = APP_CANOPEN_SYNC_NEW;
        }
    }
}

void app_canopen_process_take(app_canopen_t *c, app_registers_t *r, const board_can_frame_t *frame,
                              uint32_t now_ticks)
{
    for (uint16_t n = 0U; n < APP_CANOPEN_PDOS; n++) {
        app_canopen_pdo_t *const p = &c->received[n];

        if (app_canopen_pdo_is_used(p) && (app_canopen_pdo_id(p) == frame->id)) {
            take_octets(c, p, r, frame, now_ticks);
        }
    }
}

/* Types 1 .. 240: with each of so many SYNCs. Type 0: with the next one after a change. */
static void count_sync(app_canopen_pdo_t *p, const app_registers_t *r)
{
    if ((p->type > 0U) && (p->type <= APP_CANOPEN_SYNC_MOST)) {
        p->syncs = (uint16_t)(p->syncs + 1U);
        if (p->syncs >= p->type) {
            p->syncs = 0U;
            (void)app_canopen_pdo_read(p, r);
            p->wanted = true;
        }
    } else if (p->type == 0U) {
        p->wanted = app_canopen_pdo_read(p, r) || p->wanted;
        p->syncs  = 1U; /* now it may go */
    } else {
        /* events alone */
    }
}

/* The tick has the command of what was prepared, or takes it next. */
void app_canopen_process_sync(app_canopen_t *c, app_registers_t *r)
{
    bool known = (c->waiting == APP_CANOPEN_SYNC_PREPARED) && !r->changed;

    c->waiting = APP_CANOPEN_SYNC_NEW;
    for (uint16_t n = 0U; n < APP_CANOPEN_PDOS; n++) {
        if (c->received[n].full) {
            known = act_on(c, &c->received[n], r) && known;
        }
        if (app_canopen_pdo_is_used(&c->sent[n])) {
            count_sync(&c->sent[n], r);
        }
    }
    c->acted   = c->acted || known; /* a second SYNC in this pass takes nothing back */
    r->changed = r->changed && !known;
}

static bool waits_for_sync(const app_canopen_t *c)
{
    bool waits = false;

    for (uint16_t n = 0U; n < APP_CANOPEN_PDOS; n++) {
        waits = waits || c->received[n].full;
    }
    return waits && (c->state == APP_CANOPEN_OPERATIONAL);
}

/* A change of the mode may need other constants, which come with a later command. */
bool app_canopen_process_prepare(app_canopen_t *c, app_registers_t *r)
{
    bool ok = (c->waiting == APP_CANOPEN_SYNC_NEW) && waits_for_sync(c);

    if (ok) {
        app_registers_begin(r);
        for (uint16_t n = 0U; n < APP_CANOPEN_PDOS; n++) {
            ok = ok && (!c->received[n].full || app_canopen_pdo_try(&c->received[n], r));
        }
        ok = ok && app_registers_fits(r) &&
             (r->trial.objects.mode_of_operation == r->requested.objects.mode_of_operation);
        c->waiting = ok ? APP_CANOPEN_SYNC_PREPARED : APP_CANOPEN_SYNC_REFUSED;
        c->acted   = false;
    }
    return ok;
}

bool app_canopen_process_is_prepared(const app_canopen_t *c)
{
    return (c->waiting == APP_CANOPEN_SYNC_PREPARED) && (c->state == APP_CANOPEN_OPERATIONAL);
}

/* An event: a change, or the event timer. The inhibit time holds both back. */
static bool is_due(app_canopen_t *c, app_canopen_pdo_t *p, const app_registers_t *r,
                   uint32_t now_ticks)
{
    bool due = p->wanted;

    if (p->type > APP_CANOPEN_SYNC_MOST) {
        const bool rested =
            app_canopen_node_passed(c, p->at_ticks, now_ticks, TENTH * (float)p->inhibit_100us);

        p->wanted = app_canopen_pdo_read(p, r) || p->wanted;
        if ((p->event_ms > 0U) &&
            app_canopen_node_passed(c, p->at_ticks, now_ticks, (float)p->event_ms)) {
            p->wanted = true;
        }
        due = p->wanted && rested;
    } else if (p->type == 0U) {
        due = p->wanted && (p->syncs > 0U);
    } else {
        /* with SYNC */
    }
    return due;
}

static void send_octets(app_canopen_t *c, app_canopen_pdo_t *p, uint32_t now_ticks)
{
    board_can_frame_t frame = {.id = app_canopen_pdo_id(p), .length = p->length};

    for (uint16_t n = 0U; n < p->length; n++) {
        frame.octets[n] = p->octets[n];
    }
    if (app_canopen_node_send(c, &frame)) {
        p->wanted   = false;
        p->syncs    = (p->type == 0U) ? 0U : p->syncs;
        p->at_ticks = now_ticks;
    }
}

void app_canopen_process_send(app_canopen_t *c, const app_registers_t *r, uint32_t now_ticks)
{
    for (uint16_t n = 0U; n < APP_CANOPEN_PDOS; n++) {
        app_canopen_pdo_t *const p = &c->sent[n];

        if (app_canopen_pdo_is_used(p) && is_due(c, p, r, now_ticks)) {
            send_octets(c, p, now_ticks);
        }
    }
}

bool app_canopen_process_late(app_canopen_t *c, uint32_t now_ticks)
{
    bool late = false;

    for (uint16_t n = 0U; n < APP_CANOPEN_PDOS; n++) {
        app_canopen_pdo_t *const p = &c->received[n];

        if (p->watched && app_canopen_node_passed(c, p->at_ticks, now_ticks, (float)p->event_ms)) {
            p->watched = false; /* until the next one comes */
            late       = true;
        }
    }
    return late;
}
