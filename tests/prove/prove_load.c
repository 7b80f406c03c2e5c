/* SPDX-License-Identifier: MIT */
/* Modbus server, loader and stored parameters, for the analyser (docs/assurance.md). Flash and the words that outlast a
 * restart have any contents. A request brings any registers, and each module is in any state. */
#include "any_flash.h"
#include "app_modbus.h"
#include "board_config.h"

#define NAMED_(a, b) a##b
#define NAMED(a, b)  NAMED_(a, b)

/* Most counts that app_angle.c turns without an index. */
#define TURN_cnt ((int)board_config.board.positions + (int)board_config.angle.index_correct_max_cnt)

#define QUANTITY_MAX 125 /* registers of a request */

volatile app_modbus_t     any_modbus;
volatile app_loader_t     any_loader;
volatile board_identity_t any_board;
volatile app_status_t     any_status;
volatile app_objects_t    any_objects;
volatile float            any_float;
app_modbus_t              modbus;
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
    s->voltage_limited             = any_bool();
    s->current_limited             = any_bool();
    s->snapshot.raw.valid          = any_bool();
    s->snapshot.raw.index_seen     = any_bool();
    s->commission.found.reluctance = any_bool();
    s->target_cnt                  = any_long_between(-APP_POSITION_CNT_MAX, APP_POSITION_CNT_MAX);
    s->position.known              = any_bool();
    s->position.have               = any_bool();
    s->position.actual.turns       = any_long_between(-POSITION_TURNS_MAX, POSITION_TURNS_MAX);
    s->position.zero.turns         = any_between(-TURN_cnt, TURN_cnt);
    s->position.pole_pairs         = (uint16_t)any_between(1, 64);
    s->position.positions          = board_config.board.positions;
    registers.requested.objects    = any_objects;
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

/* Entry: a pass of the server in any state, beside the application or the loader. */
void prove_modbus(void)
{
    any_image();
    any_registers();
    any_loader_state();
    parameters.rested = any_bool();
    parameters.state =
        (app_parameters_state_t)any_between(APP_PARAMETERS_DEFAULT, APP_PARAMETERS_PARTLY);
    registers.loader     = any_bool() ? &loader : NULL;
    registers.parameters = any_bool() ? &parameters : NULL;
    registers.silent     = any_bool();
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
