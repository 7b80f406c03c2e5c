/* SPDX-License-Identifier: MIT */
#include "app_homing.h"

#include "app_angle_index.h"

#define WITH_INDEX   14 /* methods 1 to 14 go on to the index mark */
#define WITHOUT_LESS 16 /* 17 to 30 are the same without it */
#define INDEX_BACK   33
#define INDEX_ON     34
#define HERE_OLD     35
#define HERE         37

#define FORWARD 1
#define BACK    (-1)

/* How a switch is searched and passed. */
typedef struct {
    uint16_t input;         /* BOARD_INPUT_ */
    int16_t  first;         /* direction of FIND */
    int16_t  passes;        /* direction of PASS */
    bool     from_active;   /* PASS begins on the active side */
    bool     may_turn_back; /* FIND is reversed by a limit switch */
} way_t;

static bool has_switch(int16_t method)
{
    return ((method >= 1) && (method <= WITH_INDEX)) ||
           ((method > WITHOUT_LESS) && (method <= (WITHOUT_LESS + WITH_INDEX)));
}

bool app_homing_knows(int16_t method)
{
    return has_switch(method) || (method == INDEX_BACK) || (method == INDEX_ON) ||
           (method == HERE_OLD) || (method == HERE);
}

static const way_t *way_of(int16_t method)
{
    static const way_t ways[WITH_INDEX] = {{BOARD_INPUT_NEGATIVE, BACK, FORWARD, true, false},
                                           {BOARD_INPUT_POSITIVE, FORWARD, BACK, true, false},
                                           {BOARD_INPUT_HOME, FORWARD, BACK, true, false},
                                           {BOARD_INPUT_HOME, FORWARD, FORWARD, false, false},
                                           {BOARD_INPUT_HOME, BACK, FORWARD, true, false},
                                           {BOARD_INPUT_HOME, BACK, BACK, false, false},
                                           {BOARD_INPUT_HOME, FORWARD, BACK, true, true},
                                           {BOARD_INPUT_HOME, FORWARD, FORWARD, false, true},
                                           {BOARD_INPUT_HOME, FORWARD, BACK, false, true},
                                           {BOARD_INPUT_HOME, FORWARD, FORWARD, true, true},
                                           {BOARD_INPUT_HOME, BACK, FORWARD, true, true},
                                           {BOARD_INPUT_HOME, BACK, BACK, false, true},
                                           {BOARD_INPUT_HOME, BACK, FORWARD, false, true},
                                           {BOARD_INPUT_HOME, BACK, BACK, true, true}};
    const int16_t      number = (method > WITHOUT_LESS) ? (int16_t)(method - WITHOUT_LESS) : method;
    const bool         has    = (number >= 1) && (number <= WITH_INDEX);
    const int16_t      row    = has ? (int16_t)(number - 1) : (int16_t)0;

    return &ways[row];
}

void app_homing_reset(app_homing_t *h)
{
    h->stage      = APP_HOMING_IDLE;
    h->start_high = true;
    h->reversed   = false;
    h->fresh      = false;
    h->looked     = false;
    h->known      = false;
}

/* EQ-APP-HOMING-1. A correction of the angle goes on after it: what is left of it is no way. */
static void attain(app_homing_t *h, const app_objects_t *o, const app_homing_seen_t *seen,
                   int32_t home_cnt)
{
    const int32_t    at_cnt   = home_cnt - (int32_t)app_angle_left_cnt(seen->angle);
    const int32_t    zero_cnt = app_position_held(at_cnt) + app_position_held(o->home_offset_cnt);
    const position_t zero     = app_position_at(seen->position, app_position_held(zero_cnt));

    if ((zero.turns <= APP_POSITION_ZERO_TURNS) && (zero.turns >= -APP_POSITION_ZERO_TURNS)) {
        h->zero  = zero;
        h->fresh = true;
        h->stage = APP_HOMING_ATTAINED;
    } else {
        h->stage = APP_HOMING_FAILED;
    }
}

static void attain_here(app_homing_t *h, const app_objects_t *o, const app_homing_seen_t *seen)
{
    attain(h, o, seen, app_position_cnt(seen->position, &seen->position->actual));
}

static void begin_search(app_homing_t *h, const app_objects_t *o, const app_homing_seen_t *seen)
{
    const bool here  = (o->homing_method == HERE) || (o->homing_method == HERE_OLD);
    const bool finds = has_switch(o->homing_method);
    const bool used  = (o->inputs_used & way_of(o->homing_method)->input) != 0U;

    h->reversed    = false;
    h->looked      = false;
    h->began_ticks = seen->ticks;
    if (!app_homing_knows(o->homing_method) || !seen->position->known || (finds && !used)) {
        h->stage = APP_HOMING_FAILED;
    } else if (here) {
        attain_here(h, o, seen);
    } else {
        h->stage = finds ? APP_HOMING_FIND : APP_HOMING_INDEX;
    }
}

/* Direction of a stage, in the operator's sense. */
static int16_t direction(const app_homing_t *h, const app_objects_t *o)
{
    const way_t *w    = way_of(o->homing_method);
    int16_t      goes = w->passes;

    if (o->homing_method == INDEX_ON) {
        goes = FORWARD;
    } else if (o->homing_method >= INDEX_BACK) {
        goes = BACK;
    } else if (h->stage == APP_HOMING_FIND) {
        goes = h->reversed ? (int16_t)-w->first : w->first;
    } else if ((h->stage == APP_HOMING_RETURN) ||
               ((h->stage == APP_HOMING_LEAVE) && !w->from_active)) {
        goes = (int16_t)-w->passes;
    } else {
        /* as it passes */
    }
    return goes;
}

/* True if the motor turns backward in this stage. */
static bool goes_back(const app_homing_t *h, const app_objects_t *o)
{
    return (direction(h, o) < 0) != o->reversed;
}

/* True if the shaft has passed the mark in this direction since the previous call. The first mark
 * after an alignment is one that has just been passed. */
static bool passes_mark(app_homing_t *h, const app_angle_t *a, bool back)
{
    const bool     known   = a->reference == APP_ANGLE_INDEX;
    const int16_t  off     = app_angle_turned_cnt(a->positions, a->zero_cnt, a->before_cnt);
    const uint16_t quarter = a->positions / 4U;
    const bool     near    = app_angle_cnt_within(off, (int32_t)quarter);
    const bool     rises   = (h->off_cnt < 0) && (off >= 0);
    const bool     falls   = (h->off_cnt > 0) && (off <= 0);
    const bool     signs   = h->known && (back ? falls : rises);
    const bool     found   = h->looked && known && near && (signs || !h->known);

    h->off_cnt = off;
    h->known   = known;
    h->looked  = true;
    return found;
}

static void search_mark(app_homing_t *h, const app_objects_t *o, const app_homing_seen_t *seen)
{
    if (passes_mark(h, seen->angle, goes_back(h, o))) {
        const int32_t here_cnt = app_position_cnt(seen->position, &seen->position->actual);

        attain(h, o, seen, here_cnt - (int32_t)h->off_cnt);
    }
}

/* A limit switch that the shaft runs into, but the one that is searched. */
static bool is_blocked(const app_objects_t *o, const app_homing_seen_t *seen, int16_t goes)
{
    const uint16_t ahead =
        (goes > 0) ? (uint16_t)BOARD_INPUT_POSITIVE : (uint16_t)BOARD_INPUT_NEGATIVE;
    const bool own = has_switch(o->homing_method) && (way_of(o->homing_method)->input == ahead);

    return ((seen->active & ahead) != 0U) && !own;
}

static void search_switch(app_homing_t *h, const app_objects_t *o, const app_homing_seen_t *seen)
{
    const way_t *w      = way_of(o->homing_method);
    const bool   active = (seen->active & w->input) != 0U;

    if ((h->stage == APP_HOMING_FIND) && active) {
        h->stage = APP_HOMING_LEAVE;
    } else if ((h->stage == APP_HOMING_LEAVE) && !active) {
        h->stage = w->from_active ? APP_HOMING_RETURN : APP_HOMING_PASS;
    } else if ((h->stage == APP_HOMING_RETURN) && active) {
        h->stage = APP_HOMING_PASS;
    } else if ((h->stage == APP_HOMING_PASS) && (active != w->from_active)) {
        h->stage = APP_HOMING_INDEX;
    } else {
        /* on the way */
    }
    if ((h->stage == APP_HOMING_INDEX) && (o->homing_method > WITH_INDEX)) {
        attain_here(h, o, seen);
    }
}

static void search_in_time(app_homing_t *h, const app_objects_t *o, const app_homing_seen_t *seen)
{
    const uint32_t spent   = seen->ticks - h->began_ticks;
    const float    spent_s = seen->ts_s * (float)spent;

    if (h->stage == APP_HOMING_INDEX) {
        search_mark(h, o, seen);
    } else {
        search_switch(h, o, seen);
    }
    const bool blocked = app_homing_moves(h->stage) && is_blocked(o, seen, direction(h, o));

    if (blocked && (h->stage == APP_HOMING_FIND) && way_of(o->homing_method)->may_turn_back &&
        !h->reversed) {
        h->reversed = true;
    } else if (app_homing_moves(h->stage) &&
               (blocked || (spent_s > o->homing_time_s) || !seen->position->known)) {
        h->stage = APP_HOMING_FAILED;
    } else {
        /* on the way, or there */
    }
}

float app_homing_tick(app_homing_t *h, const app_objects_t *o, const app_homing_seen_t *seen)
{
    const bool high  = app_control_has(o->controlword, APP_CONTROL_NEW_SETPOINT);
    float      speed = 0.0f;

    if (high && !h->start_high) {
        begin_search(h, o, seen);
    } else if (!high && app_homing_moves(h->stage)) {
        h->stage = APP_HOMING_IDLE; /* interrupted */
    } else {
        /* it goes on */
    }
    h->start_high = high;
    if (app_homing_moves(h->stage)) {
        search_in_time(h, o, seen);
    }
    if (app_homing_moves(h->stage)) {
        const bool fast = (h->stage == APP_HOMING_FIND) || (h->stage == APP_HOMING_LEAVE);

        speed = fast ? o->homing_switch_e_radps : o->homing_zero_e_radps;
        speed = goes_back(h, o) ? -speed : speed;
    }
    return speed;
}
