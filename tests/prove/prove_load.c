/* SPDX-License-Identifier: MIT */
/* Modbus server, CANopen node, loader and stored parameters, for the analyser (docs/assurance.md). Flash and the words that
 * outlast a restart have any contents. A request brings any registers, and each module is in any state. */
#include "any_flash.h"
#include "app_canopen.h"
#include "app_canopen_block.h"
#include "app_canopen_process.h"
#include "app_modbus.h"
#include "board_config.h"

#define NAMED_(a, b) a##b
#define NAMED(a, b)  NAMED_(a, b)

/* Most counts that app_angle.c turns without an index. */
#define TURN_cnt ((int)board_config.board.positions + (int)board_config.angle.index_correct_max_cnt)

#define QUANTITY_MAX 125 /* registers of a request */

volatile app_modbus_t     any_modbus;
volatile app_canopen_t    any_canopen;
volatile app_loader_t     any_loader;
volatile board_identity_t any_board;
volatile app_status_t     any_status;
volatile app_objects_t    any_objects;
volatile float            any_float;
app_modbus_t              modbus;
app_canopen_t             canopen;
app_image_t               image;
app_loader_t              loader;
app_registers_t           registers;
app_parameters_t          parameters;
drive_config_t            drive;
board_identity_t          board;
uint16_t                  kept[BOARD_KEPT_WORDS];
uint16_t                  request[QUANTITY_MAX];
uint16_t                  answer[QUANTITY_MAX];

uint16_t *board_kept(void)
{
    return kept;
}

bool board_line_fits(const board_line_t *line)
{
    (void)line;
    return any_bool();
}

bool board_can_fits(uint16_t rate_kbps)
{
    (void)rate_kbps;
    return any_bool();
}

void board_can_set(uint16_t rate_kbps)
{
    (void)rate_kbps;
}

void board_can_listen(const uint16_t *ids, uint16_t count)
{
    //@ check room: count <= BOARD_CAN_IDS;
    uint16_t read = 0U;

    for (uint16_t n = 0U; n < count; n++) {
        read |= ids[n];
    }
    (void)read;
}

/* The CAN bus: any frame that can.c can make. */
bool board_can_read(board_can_frame_t *frame)
{
    frame->id     = (uint16_t)(any_word & 0x7FFU);
    frame->length = (uint16_t)any_between(0, 8);
    for (uint16_t n = 0U; n < 8U; n++) {
        frame->octets[n] = (uint16_t)(any_word & 0xFFU);
    }
    return any_bool();
}

bool board_can_write(const board_can_frame_t *frame)
{
    //@ check identifier: frame->id <= 0x7FF;
    //@ check length: frame->length <= 8;
    uint16_t read = 0U;

    for (uint16_t n = 0U; n < 8U; n++) {
        read |= frame->octets[n];
    }
    return (read != 0U) || any_bool();
}

uint16_t board_can_state(void)
{
    return (uint16_t)(any_word & 7U);
}

bool board_fits(const board_setup_t *setup)
{
    (void)setup;
    return any_bool();
}

/* The board's serial line: any octets, room or not. */
bool board_serial_read(uint16_t *octet)
{
    *octet = (uint16_t)(any_word & 0xFFU);
    return any_bool();
}

bool board_serial_write(uint16_t octet)
{
    (void)octet;
    return any_bool();
}

static void any_image(void)
{
    board                        = any_board;
    board.name[BOARD_NAME_CHARS] = '\0'; /* as board_identity_fields() leaves it */
    image.board                  = &board;
    image.number                 = (uint32_t)any_long;
    image.fallback               = any_bool();
    image.other_board            = any_bool();
    image.result = (drive_image_result_t)any_between(DRIVE_IMAGE_OK, DRIVE_IMAGE_OTHER_BOARD);
    image.difference.field = any_word;
    image.difference.image = any_float;
    image.difference.board = any_float;
}

/* As app_loader_write() and app_loader_work() leave it; both show that below. */
static void any_loader_state(void)
{
    loader            = any_loader;
    loader.state      = (app_loader_state_t)any_between(APP_LOADER_AWAY, APP_LOADER_FLASH);
    loader.task       = (app_loader_command_t)any_between(APP_LOADER_ENTER, APP_LOADER_LEAVE);
    loader.restart    = any_bool();
    loader.enter      = any_bool();
    loader.fallback   = any_bool();
    loader.write.kind = STORE_IMAGE;
    loader.write.slot = (uint16_t)any_between(0, 1);
    loader.write.count =
        (uint32_t)any_long_between(0L, (int32_t)(BOARD_STORE_WORDS - STORE_HEAD_WORDS));
    loader.in_force = &image;
    loader.image    = any_bool() ? &image : NULL;
}

static void is_whole(void)
{
    //@ check state: APP_LOADER_AWAY <= loader.state <= APP_LOADER_FLASH;
    //@ check slot: loader.write.slot <= 1;
    //@ check count: loader.write.count <= BOARD_STORE_WORDS - STORE_HEAD_WORDS;
}

/* Entry: any request of the loader's registers, and its work. */
void prove_loader(void)
{
#ifndef PROVE_any /* a law with its fields */
    const uint16_t first = any_word;
    const uint16_t count = (uint16_t)any_between(1, QUANTITY_MAX);

    any_image();
    image.image.drive.law = &NAMED(law_, PROVE_LAW);
    app_loader_init(&loader, &image);
    any_loader_state();
    (void)app_loader_read(&loader, first, count, answer);
    (void)app_loader_read_holding(first, count, answer);
    (void)app_loader_write(&loader, any_bool(), first, count, request);
    is_whole();
    any_loader_state();
    loader.image = &image; /* it runs */
    app_loader_work(&loader);
    is_whole();
#endif
}

static void any_registers(void)
{
    app_status_t *const s = &registers.status;

    drive.ts_s      = base_clamp(any_float, 1.0e-5f, 1.0e-2f); /* as checked, the next too */
    drive.positions = any_bool();
    drive.torques   = any_bool();
    drive.hardware.pole_pairs = (uint16_t)any_between(1, 64);
    (void)app_registers_init(&registers, &board_config, &drive);
    *s                             = any_status;
    s->hot                         = any_bool();
    s->dc_link_out                 = any_bool();
    s->tripped                     = any_bool();
    s->shorted                     = any_bool();
    s->gate_enable                 = any_bool();
    s->without_angle               = any_bool();
    s->arrived                     = any_bool();
    s->waits                       = any_bool();
    s->done                        = any_bool();
    s->acknowledged                = any_bool();
    s->beyond                      = any_bool();
    s->voltage_limited             = any_bool();
    s->current_limited             = any_bool();
    s->snapshot.raw.valid          = any_bool();
    s->snapshot.raw.index_seen     = any_bool();
    s->commission.found.reluctance = any_bool();
    s->target_cnt                  = any_long_between(-APP_POSITION_CNT_MAX, APP_POSITION_CNT_MAX);
    s->position.known              = any_bool();
    s->position.have               = any_bool();
    s->position.actual.turns       = any_long_between(-POSITION_TURNS_MAX, POSITION_TURNS_MAX);
    s->position.zero.turns = any_long_between(-APP_POSITION_ZERO_TURNS, APP_POSITION_ZERO_TURNS);
    s->position.homed      = any_bool();
    s->held                = any_bool();
    s->homing              = any_between(APP_HOMING_IDLE, APP_HOMING_FAILED);
    s->position.pole_pairs = (uint16_t)any_between(1, 64);
    s->position.positions  = board_config.board.positions;
    registers.requested.objects        = any_objects;
    registers.requested.scale.reversed = any_bool();
    registers.requested.scale.num      = (uint32_t)any_long_between(1, 2147483647L);
    registers.requested.scale.den      = (uint32_t)any_long_between(1, 2147483647L);
}

/* Entry: the record is taken, asked for and written, whatever flash and kept words hold. */
void prove_parameters(void)
{
    any_image();
    any_registers();
    app_parameters_take(&parameters, &registers, APP_PARAMETERS_NOT_ASKED);
    //@ check state: APP_PARAMETERS_DEFAULT <= parameters.state <= APP_PARAMETERS_PARTLY;
    app_parameters_rest(&parameters, any_float);
    app_parameters_ask(&registers, (app_parameters_command_t)any_between(0, 3));
    (void)app_parameters_work(&image);
}

static void any_surroundings(void)
{
    any_image();
    any_registers();
    any_loader_state();
    parameters.rested = any_bool();
    parameters.state =
        (app_parameters_state_t)any_between(APP_PARAMETERS_DEFAULT, APP_PARAMETERS_PARTLY);
    registers.silent = any_bool();
}

/* Entry: a pass of the server in any state, beside the application or the loader. */
void prove_modbus(void)
{
    any_surroundings();
    registers.loader     = any_bool() ? &loader : NULL; /* here, so that both cases stay apart */
    registers.parameters = any_bool() ? &parameters : NULL;
    modbus               = any_modbus;
    modbus.rx_count      = (uint16_t)any_between(0, APP_MODBUS_FRAME_MAX);
    modbus.tx_count      = (uint16_t)any_between(0, APP_MODBUS_FRAME_MAX);
    modbus.tx_sent       = (uint16_t)any_between(0, modbus.tx_count);
    modbus.rx_spoilt     = any_bool();
    app_modbus_poll(&modbus, &registers, (uint32_t)any_long);
    //@ check received: modbus.rx_count <= APP_MODBUS_FRAME_MAX;
    //@ check answered: modbus.tx_count <= APP_MODBUS_FRAME_MAX;
    is_whole();
}

static const app_registers_entry_t *any_row(bool receives)
{
    const app_registers_entry_t *row = NULL;

    if (any_bool()) {
        row = &app_registers_map_holding[any_between(0, (int)APP_REGISTERS_MAP_HOLDING - 1)];
    } else if (!receives && any_bool()) {
        row = &app_registers_map_input[any_between(0, (int)APP_REGISTERS_MAP_INPUT - 1)];
    } else {
        /* none */
    }
    return row;
}

/* With rows and numbers that a mapping can have. */
static void any_pdo(app_canopen_pdo_t *p, bool receives)
{
    p->count   = (uint16_t)any_between(0, (int)APP_CANOPEN_MAPPED);
    p->length  = (uint16_t)any_between(0, 8);
    p->full    = any_bool();
    p->wanted  = any_bool();
    p->watched = any_bool();
    for (uint16_t k = 0U; k < APP_CANOPEN_MAPPED; k++) {
        p->map[k].entry = any_row(receives);
    }
}

static app_canopen_state_t any_node_state(void)
{
    return any_bool() ? (any_bool() ? APP_CANOPEN_BOOTS : APP_CANOPEN_STOPPED)
                      : (any_bool() ? APP_CANOPEN_OPERATIONAL : APP_CANOPEN_PRE_OPERATIONAL);
}

/* Octets of a transfer that has two in each word. */
enum { PAIRED = 2 * (int)APP_CANOPEN_SDO_WORDS };

static void any_node(void)
{
    app_canopen_sdo_t *const       s = &canopen.sdo;
    app_canopen_emergency_t *const e = &canopen.emergency;

    canopen              = any_canopen;
    canopen.state        = any_node_state();
    canopen.node         = (uint16_t)any_between(0, 127);
    canopen.ticks_per_ms = base_clamp(any_float, 0.1f, 100.0f); /* by its init */
    canopen.restart      = any_bool();
    canopen.waiting =
        (app_canopen_sync_t)any_between(APP_CANOPEN_SYNC_NEW, APP_CANOPEN_SYNC_PREPARED);
    canopen.acted = any_bool();
    canopen.block =
        ((uint32_t)any_between(1, (int)APP_CANOPEN_SDO_WORDS) << 16U) + (uint32_t)any_word;
    canopen.watches = any_bool();
    canopen.missed  = any_bool();
    canopen.stuck   = any_bool();
    s->stage   = (app_canopen_sdo_stage_t)any_between(APP_CANOPEN_SDO_IDLE, APP_CANOPEN_SDO_WRITES);
    s->answers = any_bool();
    s->paired  = any_bool();
    s->at      = (uint16_t)any_between(0, s->paired ? PAIRED : (int)APP_CANOPEN_SDO_MAX);
    s->count   = (uint16_t)any_between(0, s->paired ? PAIRED : (int)APP_CANOPEN_SDO_MAX);
    s->answer.id     = (uint16_t)(APP_CANOPEN_ID_ANSWER + canopen.node);
    s->answer.length = 8U;
    e->count         = (uint16_t)any_between(0, (int)APP_CANOPEN_ERRORS);
    e->unsent        = (uint16_t)any_between(0, (int)APP_CANOPEN_ERRORS);
    e->communication = any_bool();
    for (uint16_t n = 0U; n < APP_CANOPEN_PDOS; n++) {
        any_pdo(&canopen.received[n], true);
        any_pdo(&canopen.sent[n], false);
    }
}

static void is_pdo(const app_canopen_pdo_t *p)
{
    //@ check objects: p->count <= APP_CANOPEN_MAPPED;
    //@ check octets: p->length <= 8;
    for (uint16_t k = 0U; k < APP_CANOPEN_MAPPED; k++) {
        //@ check row: p->map[k].entry == NULL || \valid_read(p->map[k].entry);
    }
}

/* Shows that the node is again one of any_node(). */
static void is_node(void)
{
    //@ check state: canopen.state == 0 || canopen.state == 4 || canopen.state == 5 || canopen.state == 127;
    //@ check node: canopen.node <= 127;
    //@ check stage: APP_CANOPEN_SDO_IDLE <= canopen.sdo.stage <= APP_CANOPEN_SDO_WRITES;
    //@ check block: 1 <= canopen.block / 65536 <= APP_CANOPEN_SDO_WORDS;
    //@ check done: canopen.sdo.at <= PAIRED;
    //@ check announced: canopen.sdo.count <= PAIRED;
    //@ check answer: canopen.sdo.answer.length == 8;
    //@ check errors: canopen.emergency.count <= APP_CANOPEN_ERRORS;
    //@ check unsent: canopen.emergency.unsent <= APP_CANOPEN_ERRORS;
    for (uint16_t n = 0U; n < APP_CANOPEN_PDOS; n++) {
        is_pdo(&canopen.received[n]);
        is_pdo(&canopen.sent[n]);
    }
}

/* Registers and mappings as the node sees them. prove_canopen_rows shows the first two contracts for each row. Its rows have
 * too many kinds to be told apart in all mappings, so prove_canopen_pdo takes these contracts. It shows the other two, and
 * prove_canopen takes all. */
/*@ requires row: \valid_read(e);
    assigns \result \from indirect: *r, indirect: *e; */
uint32_t app_registers_place_value(const app_registers_t *r, const app_registers_entry_t *e);

/*@ requires row: \valid_read(entry);
    assigns \result, r->requested, r->trial, r->changed, r->silent, r->by_can
        \from indirect: *r, indirect: *entry, octets, value;
    ensures changed: r->changed == 0 || r->changed == 1;
    ensures silent: r->silent == 0 || r->silent == 1;
    ensures by_can: r->by_can == 0 || r->by_can == 1;
    ensures node: r->requested.can_node <= 127; */
uint32_t app_canopen_objects_write(app_registers_t *r, const app_registers_entry_t *entry,
                                   uint16_t octets, uint32_t value);

/*@ requires row: \valid_read(entry);
    assigns \result, r->trial \from indirect: *r, indirect: *entry, octets, value;
    ensures answer: \result == 0 || \result == 1; */
bool app_canopen_objects_try(app_registers_t *r, const app_registers_entry_t *entry,
                             uint16_t octets, uint32_t value);

/*@ assigns \result, r->trial \from indirect: *r;
    ensures answer: \result == 0 || \result == 1; */
bool app_registers_fits(app_registers_t *r);

/*@ requires objects: p->count <= APP_CANOPEN_MAPPED;
    assigns \result, r->trial \from indirect: *p, indirect: *r;
    ensures answer: \result == 0 || \result == 1; */
bool app_canopen_pdo_try(const app_canopen_pdo_t *p, app_registers_t *r);

/*@ requires objects: p->count <= APP_CANOPEN_MAPPED;
    assigns \result, r->requested, r->trial, r->changed, r->silent, r->by_can \from indirect: *p, indirect: *r;
    ensures answer: \result == 0 || \result == 1;
    ensures changed: r->changed == 0 || r->changed == 1;
    ensures silent: r->silent == 0 || r->silent == 1;
    ensures by_can: r->by_can == 0 || r->by_can == 1;
    ensures node: r->requested.can_node <= 127; */
bool app_canopen_pdo_act(const app_canopen_pdo_t *p, app_registers_t *r);

/*@ requires objects: p->count <= APP_CANOPEN_MAPPED;
    assigns \result, p->octets[0 .. 7] \from indirect: *p, indirect: *r;
    ensures answer: \result == 0 || \result == 1; */
bool app_canopen_pdo_read(app_canopen_pdo_t *p, const app_registers_t *r);

/* Shown by prove_canopen_block. */
/*@ requires room: \valid(words + (0 .. 63)) && \valid(octets);
    requires block: 1 <= c->block / 65536 <= 64;
    assigns \result, words[0 .. 63], *octets \from indirect: *c, indirect: *r, indirect: sub;
    ensures octets: *octets <= 128; */
uint32_t app_canopen_block_read(const app_canopen_t *c, const app_registers_t *r, uint16_t sub,
                                uint16_t *words, uint16_t *octets);

/*@ requires room: \valid_read(words + (0 .. 63));
    requires octets: octets <= 128;
    assigns \result, r->requested, r->trial, r->changed, r->silent, r->by_can
        \from indirect: *c, indirect: sub, words[0 .. 63], octets;
    ensures changed: r->changed == 0 || r->changed == 1;
    ensures silent: r->silent == 0 || r->silent == 1;
    ensures by_can: r->by_can == 0 || r->by_can == 1;
    ensures node: r->requested.can_node <= 127; */
uint32_t app_canopen_block_write(const app_canopen_t *c, app_registers_t *r, uint16_t sub,
                                 const uint16_t *words, uint16_t octets);

static void any_can_registers(void)
{
    any_surroundings();
    registers.loader                  = any_bool() ? &loader : NULL;
    registers.parameters              = any_bool() ? &parameters : NULL;
    registers.by_can                  = any_bool();
    registers.requested.can_node      = (uint16_t)any_between(0, 127);
    registers.requested.can_rate_kbps = (uint16_t)any_between(125, 1000);
}

/* Entry: each register is read as an object. Each that can be written is, with any octets. */
void prove_canopen_rows(void)
{
    for (int k = 0; k < (int)APP_REGISTERS_MAP_INPUT; k++) {
        any_can_registers();
        (void)app_registers_place_value(&registers, &app_registers_map_input[k]);
    }
    for (int k = 0; k < (int)APP_REGISTERS_MAP_HOLDING; k++) {
        any_can_registers();
        (void)app_registers_place_value(&registers, &app_registers_map_holding[k]);
        (void)app_canopen_objects_write(&registers, &app_registers_map_holding[k], any_word,
                                        (uint32_t)any_long);
        is_whole();
        app_registers_begin(&registers);
        (void)app_canopen_objects_try(&registers, &app_registers_map_holding[k], any_word,
                                      (uint32_t)any_long);
        (void)app_registers_fits(&registers);
    }
}

/* Entry: a received PDO acts, and a sent one is read. */
void prove_canopen_pdo(void)
{
    any_can_registers();
    any_node();
    (void)app_canopen_pdo_act(&canopen.received[0], &registers);
    (void)app_canopen_pdo_try(&canopen.received[0], &registers);
    (void)app_canopen_pdo_read(&canopen.sent[0], &registers);
}

/* Entry: any block of registers is read, and written with any octets. */
void prove_canopen_block(void)
{
    uint16_t octets = 0U;

    any_can_registers();
    any_node();
    registers.loader = any_bool() ? &loader : NULL; /* here, so that both cases stay apart */
    (void)app_canopen_block_read(&canopen, &registers, any_word, canopen.sdo.octets, &octets);
    //@ check read: octets <= PAIRED;
    (void)app_canopen_block_write(&canopen, &registers, any_word, canopen.sdo.octets,
                                  (uint16_t)any_between(0, PAIRED));
    is_whole();
}

/* Entry: a pass of the CANopen node in any state, with any frames. */
void prove_canopen(void)
{
    any_can_registers();
    any_node();
    app_canopen_poll(&canopen, &registers, (uint32_t)any_long);
    (void)app_canopen_process_prepare(&canopen, &registers);
    is_node();
    is_whole();
}
