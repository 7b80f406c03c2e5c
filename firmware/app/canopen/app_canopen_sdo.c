/* SPDX-License-Identifier: MIT */
#include "app_canopen_sdo.h"

#include "app_canopen_block.h"
#include "app_canopen_dictionary.h"

#define OCTETS    8U
#define EXPEDITED 4U /* octets that fit the first frame */
#define SEGMENT   7U /* octets of a segment */

/* Commands of the client: the upper three bits of the first octet. */
#define WRITE_SEGMENT 0U
#define WRITE_FIRST   1U
#define READ_FIRST    2U
#define READ_SEGMENT  3U
#define ABORT         4U

#define SIZE_SAID 0x01U
#define ALL_HERE  0x02U
#define LAST      0x01U
#define TOGGLE    0x10U

/* First octets of answers. */
#define WRITTEN         0x60U
#define SEGMENT_WRITTEN 0x20U
#define READ_ANSWER     0x40U
#define ABORTED         0x80U

/* Octets of a transfer whose words have two each. */
static const uint16_t paired_octets = 2U * APP_CANOPEN_SDO_WORDS;

static void begin_answer(app_canopen_t *c, uint16_t command)
{
    static const board_can_frame_t empty = {.length = OCTETS};
    board_can_frame_t *const       a     = &c->sdo.answer;

    *a             = empty;
    a->id          = (uint16_t)(APP_CANOPEN_ID_ANSWER + c->node);
    a->octets[0]   = command;
    c->sdo.answers = true;
}

static void name_object(app_canopen_sdo_t *s)
{
    s->answer.octets[1] = (uint16_t)(s->index & 0xFFU);
    s->answer.octets[2] = (uint16_t)(s->index >> 8U);
    s->answer.octets[3] = s->sub;
}

static void put_number(app_canopen_sdo_t *s, uint32_t value)
{
    for (uint16_t n = 0U; n < 4U; n++) {
        s->answer.octets[4U + n] = (uint16_t)((value >> (8UL * (uint32_t)n)) & 0xFFUL);
    }
}

static void abort_transfer(app_canopen_t *c, uint32_t reason)
{
    begin_answer(c, ABORTED);
    name_object(&c->sdo);
    put_number(&c->sdo, reason);
    c->sdo.stage = APP_CANOPEN_SDO_IDLE;
}

/* Most octets that the transfer can have. */
static uint16_t most_of(const app_canopen_sdo_t *s)
{
    return s->paired ? paired_octets : (uint16_t)APP_CANOPEN_SDO_MAX;
}

/* Word of the room that has this octet. */
static uint16_t room_word_of(const app_canopen_sdo_t *s, uint16_t n)
{
    return s->paired ? (uint16_t)(n >> 1U) : n;
}

static uint16_t octet_of(const app_canopen_sdo_t *s, uint16_t n)
{
    const uint16_t at    = room_word_of(s, n);
    const uint16_t word  = (at < APP_CANOPEN_SDO_WORDS) ? s->octets[at] : 0U;
    const bool     upper = s->paired && ((n & 1U) != 0U);

    return upper ? (uint16_t)(word >> 8U) : (uint16_t)(word & 0xFFU);
}

/* Drops what has no room, as end_write() knows the length. */
static void put_octet(app_canopen_sdo_t *s, uint16_t n, uint16_t octet)
{
    const uint16_t at    = room_word_of(s, n);
    const bool     upper = s->paired && ((n & 1U) != 0U);

    if (at < APP_CANOPEN_SDO_WORDS) {
        s->octets[at] =
            upper ? (uint16_t)(s->octets[at] | ((octet & 0xFFU) << 8U)) : (uint16_t)(octet & 0xFFU);
    }
}

static uint32_t read_octets(const app_canopen_t *c, const app_registers_t *r, app_canopen_sdo_t *s)
{
    uint32_t result;

    if (s->paired) {
        result = app_canopen_block_read(c, r, s->sub, s->octets, &s->count);
    } else {
        result = app_canopen_dictionary_read(c, r, s->index, s->sub, s->octets, &s->count);
    }
    return result;
}

static uint32_t write_octets(app_canopen_t *c, app_registers_t *r, const app_canopen_sdo_t *s)
{
    uint32_t result;

    if (s->paired) {
        result = app_canopen_block_write(c, r, s->sub, s->octets, s->at);
    } else {
        result = app_canopen_dictionary_write(c, r, s->index, s->sub, s->octets, s->at);
    }
    return result;
}

static void begin_read(app_canopen_t *c, const app_registers_t *r)
{
    app_canopen_sdo_t *const s      = &c->sdo;
    const uint32_t           result = read_octets(c, r, s);

    if (result != APP_CANOPEN_OK) {
        abort_transfer(c, result);
    } else if (s->count <= EXPEDITED) {
        begin_answer(
            c, (uint16_t)(READ_ANSWER | ((EXPEDITED - s->count) << 2U) | ALL_HERE | SIZE_SAID));
        name_object(s);
        for (uint16_t n = 0U; n < s->count; n++) {
            s->answer.octets[4U + n] = octet_of(s, n);
        }
    } else {
        begin_answer(c, READ_ANSWER | SIZE_SAID);
        name_object(s);
        put_number(s, s->count);
        s->stage  = APP_CANOPEN_SDO_READS;
        s->toggle = 0U;
        s->at     = 0U;
    }
}

static void read_segment(app_canopen_t *c, uint16_t toggle)
{
    app_canopen_sdo_t *const s    = &c->sdo;
    const uint16_t           left = (uint16_t)(s->count - s->at);
    const uint16_t           now  = (left < SEGMENT) ? left : SEGMENT;
    const uint16_t           last = (uint16_t)((left <= SEGMENT) ? LAST : 0U);

    if (toggle != s->toggle) {
        abort_transfer(c, APP_CANOPEN_TOGGLE);
    } else {
        begin_answer(c, (uint16_t)(toggle | ((SEGMENT - now) << 1U) | last));
        for (uint16_t n = 0U; (n < now) && (s->at < paired_octets); n++) {
            s->answer.octets[1U + n] = octet_of(s, s->at);
            s->at                    = (uint16_t)(s->at + 1U);
        }
        s->toggle = (uint16_t)(s->toggle ^ TOGGLE);
        if (last != 0U) {
            s->stage = APP_CANOPEN_SDO_IDLE;
        }
    }
}

static void end_write(app_canopen_t *c, app_registers_t *r, uint16_t answer)
{
    app_canopen_sdo_t *const s      = &c->sdo;
    const uint32_t           result = write_octets(c, r, s);

    if (result == APP_CANOPEN_OK) {
        begin_answer(c, answer);
        s->stage = APP_CANOPEN_SDO_IDLE;
    } else {
        abort_transfer(c, result);
    }
}

static void begin_write(app_canopen_t *c, app_registers_t *r, const uint16_t *q)
{
    app_canopen_sdo_t *const s    = &c->sdo;
    const bool               said = (q[0] & SIZE_SAID) != 0U;

    s->at = 0U;
    if ((q[0] & ALL_HERE) != 0U) {
        const uint16_t unused = (uint16_t)((q[0] >> 2U) & 3U);

        s->at = said ? (uint16_t)(EXPEDITED - unused) : 0U;
        for (uint16_t n = 0U; n < EXPEDITED; n++) {
            put_octet(s, n, q[4U + n]);
        }
        end_write(c, r, WRITTEN);
        name_object(s);
    } else if (said && ((q[4] > most_of(s)) || ((q[5] | q[6] | q[7]) != 0U))) {
        abort_transfer(c, APP_CANOPEN_LENGTH);
    } else {
        s->count  = said ? q[4] : 0U;
        s->stage  = APP_CANOPEN_SDO_WRITES;
        s->toggle = 0U;
        begin_answer(c, WRITTEN);
        name_object(s);
    }
}

static void write_segment(app_canopen_t *c, app_registers_t *r, const uint16_t *q)
{
    app_canopen_sdo_t *const s      = &c->sdo;
    const uint16_t           toggle = (uint16_t)(q[0] & TOGGLE);
    const uint16_t           now    = (uint16_t)(SEGMENT - ((q[0] >> 1U) & 7U));
    const uint16_t           all    = (uint16_t)(s->at + now);
    const bool               last   = (q[0] & LAST) != 0U;

    if (toggle != s->toggle) {
        abort_transfer(c, APP_CANOPEN_TOGGLE);
    } else if ((all > most_of(s)) || (all == 0U) ||
               (last && (s->count != 0U) && (all != s->count))) {
        abort_transfer(c, APP_CANOPEN_LENGTH);
    } else {
        for (uint16_t n = 0U; n < now; n++) {
            put_octet(s, (uint16_t)(s->at + n), q[1U + n]);
        }
        s->at     = all;
        s->toggle = (uint16_t)(s->toggle ^ TOGGLE);
        if (last) {
            end_write(c, r, (uint16_t)(SEGMENT_WRITTEN | toggle));
        } else {
            begin_answer(c, (uint16_t)(SEGMENT_WRITTEN | toggle));
        }
    }
}

static void name_request(app_canopen_sdo_t *s, const uint16_t *q)
{
    s->index = (uint16_t)(q[1] | (q[2] << 8U));
    s->sub   = q[3];
}

void app_canopen_sdo_take(app_canopen_t *c, app_registers_t *r, const board_can_frame_t *request)
{
    app_canopen_sdo_t *const s       = &c->sdo;
    const uint16_t *const    q       = request->octets;
    const uint16_t           command = (uint16_t)(q[0] >> 5U);
    const bool               first   = (command == WRITE_FIRST) || (command == READ_FIRST);

    if (request->length != OCTETS) {
        /* no request of an SDO client */
    } else if (command == ABORT) {
        s->stage = APP_CANOPEN_SDO_IDLE;
    } else if (first) {
        s->stage = APP_CANOPEN_SDO_IDLE;
        name_request(s, q);
        s->paired = app_canopen_block_has(s->index, s->sub);
        if (command == WRITE_FIRST) {
            begin_write(c, r, q);
        } else {
            begin_read(c, r);
        }
    } else if ((command == READ_SEGMENT) && (s->stage == APP_CANOPEN_SDO_READS)) {
        read_segment(c, (uint16_t)(q[0] & TOGGLE));
    } else if ((command == WRITE_SEGMENT) && (s->stage == APP_CANOPEN_SDO_WRITES)) {
        write_segment(c, r, q);
    } else {
        if (command > ABORT) { /* a block transfer: its first frame names the object */
            name_request(s, q);
        }
        abort_transfer(c, APP_CANOPEN_COMMAND);
    }
}

void app_canopen_sdo_send(app_canopen_t *c)
{
    if (c->sdo.answers && app_canopen_node_send(c, &c->sdo.answer)) {
        c->sdo.answers = false;
    }
}
