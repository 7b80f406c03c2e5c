/* SPDX-License-Identifier: MIT */
/* Implementation of board.h on a simulated motor with the drive's constants. Only
 * host_stub_period() advances time: every run is identical. */
#include "board.h"

#include <stddef.h>

#include "board_config.h"
#include "gain_tables.h"
#include "host_stub.h"
#include "motor_stub.h"

#define DC_LINK_V       300.0f /* chosen: an ideal supply within the drive's range */
#define TEMPERATURE_cnt 10240U /* 25 degC, board_config.c */
#define START_rad       1.0f   /* chosen: away from the alignment angle */

static struct {
    void (*tick)(void);
    motor_stub_t   motor;
    board_sample_t sample;
    board_duty_t   written;
    board_duty_t   in_force;
    bool           gate;
    uint32_t       periods;
} stub;

bool board_init(const board_setup_t *setup)
{
    const uint16_t     half_cnt = setup->duty_full_cnt / 2U;
    const motor_stub_t rest     = {.theta_m_rad = START_rad};
    const board_duty_t half     = {half_cnt, half_cnt, half_cnt};

    stub.motor    = rest;
    stub.written  = half;
    stub.in_force = half;
    stub.gate     = false;
    stub.periods  = 0UL;
    return true;
}

void board_start(void (*tick)(void), uint16_t updates_per_period)
{
    (void)updates_per_period; /* one: app_init() refuses others */
    stub.tick = tick;
}

static float leg_V(uint16_t on_cnt)
{
    const float duty = (float)on_cnt / (float)board_config.board.duty_full_cnt;
    return DC_LINK_V * ((duty < 1.0f) ? duty : 1.0f);
}

void host_stub_period(void)
{
    const motor_reduced_t *l   = &gain_tables_drive.motor;
    const uint16_t         n_p = gain_tables_drive.hardware.pole_pairs;
    const abc_t            v_V = {leg_V(stub.in_force.a_cnt), leg_V(stub.in_force.b_cnt),
                                  leg_V(stub.in_force.c_cnt)};

    if (stub.gate) {
        motor_stub_drive(&stub.motor, l, n_p, v_V, board_config.pwm_period_s);
    } else {
        motor_stub_coast(&stub.motor, l, n_p, board_config.pwm_period_s);
    }
    stub.in_force = stub.written;
    stub.periods++;
    stub.tick();
}

float host_stub_speed_e_radps(void)
{
    return stub.motor.omega_e_radps;
}

bool host_stub_gate(void)
{
    return stub.gate;
}

static uint16_t code(float value_cnt)
{
    const float top_cnt = (float)(BOARD_ADC_CODES - 1U);
    return (uint16_t)(base_clamp(value_cnt, 0.0f, top_cnt) + 0.5f);
}

static uint16_t current_code(float i_A)
{
    const app_scale_config_t *s = &board_config.scale;
    return code(s->current_zero_cnt + (i_A / s->current_A_per_cnt));
}

const board_sample_t *board_sample(void)
{
    const abc_t i_A     = motor_stub_current_A(&stub.motor, gain_tables_drive.hardware.pole_pairs);
    const float turn    = stub.motor.theta_m_rad / BASE_TWO_PI;
    const float edge    = turn * (float)board_config.board.positions;
    const float top_cnt = (float)(board_config.board.positions - 1U);

    const uint16_t position = (uint16_t)base_clamp(edge, 0.0f, top_cnt);
    const float    per_s    = stub.motor.omega_e_radps * (float)board_config.board.positions /
                        (BASE_TWO_PI * (float)gain_tables_drive.hardware.pole_pairs);
    const float beyond = edge - (float)position; /* counts since the edge below */
    const float age_s  = ((per_s > 0.0f) ? beyond : (1.0f - beyond)) / base_max(fabsf(per_s), 1.0f);
    const float age_cnt = base_min(age_s * (float)BOARD_CAPTURE_Hz, 65535.0f);

    const board_sample_t now = {.ia_cnt = current_code(i_A.a),
                                .ib_cnt = current_code(i_A.b),
                                .dc_link_cnt =
                                    code(DC_LINK_V / board_config.scale.dc_link_V_per_cnt),
                                .temperature_cnt = TEMPERATURE_cnt,
                                .position_cnt    = position,
                                .edge_age_cnt    = (uint16_t)age_cnt,
                                .edge_seen       = position != stub.sample.position_cnt,
                                .index_cnt       = 0U,
                                .index_seen      = false,
                                .valid           = true};
    stub.sample              = now;
    return &stub.sample;
}

void board_duty_write(const board_duty_t *duty)
{
    stub.written = *duty;
}

void board_chopper_write(bool on)
{
    (void)on;
}

void board_gate_enable(void)
{
    stub.gate = true;
}

void board_gate_trip(void)
{
    stub.gate = false;
}

uint16_t board_fault_read(void)
{
    return (uint16_t)BOARD_FAULT_NONE;
}

board_reset_t board_reset_cause(void)
{
    return BOARD_RESET_PIN;
}

bool board_fits(const board_setup_t *setup)
{
    return (setup->pwm_cycles == board_config.board.pwm_cycles) && (setup->current_sensors == 2U) &&
           (setup->chopper == 0U);
}

bool board_loader_is_wanted(void)
{
    return false;
}

void board_restart(bool loader)
{
    (void)loader;
}

uint16_t *board_kept(void)
{
    static uint16_t kept[BOARD_KEPT_WORDS];
    return kept;
}

const uint16_t *board_store(uint16_t slot)
{
    (void)slot;
    return NULL;
}

bool board_store_erase(uint16_t slot)
{
    (void)slot;
    return false;
}

bool board_store_program(uint16_t slot, uint32_t offset, const uint16_t *words, uint16_t count)
{
    (void)slot;
    (void)offset;
    (void)words;
    (void)count;
    return false;
}

uint32_t board_cycles(void)
{
    return stub.periods * board_config.board.pwm_cycles;
}

bool board_memory_is_whole(void)
{
    return true; /* stack and code are the host program's */
}

void board_watchdog_serve(void) {}

bool board_line_fits(const board_line_t *line)
{
    (void)line;
    return true;
}

void board_line_set(const board_line_t *line)
{
    (void)line;
}

bool board_serial_read(uint16_t *octet)
{
    (void)octet;
    return false;
}

bool board_serial_write(uint16_t octet)
{
    (void)octet;
    return true;
}

bool board_can_fits(uint16_t rate_kbps)
{
    (void)rate_kbps;
    return true;
}

void board_can_set(uint16_t rate_kbps)
{
    (void)rate_kbps;
}

void board_can_listen(const uint16_t *ids, uint16_t count)
{
    (void)ids;
    (void)count;
}

bool board_can_read(board_can_frame_t *frame)
{
    (void)frame;
    return false;
}

void board_can_arm(void) {}

bool board_can_triggered(void)
{
    return false;
}

bool board_can_write(const board_can_frame_t *frame)
{
    (void)frame;
    return true;
}

uint16_t board_can_state(void)
{
    return 0U;
}

void board_brake_write(bool release)
{
    (void)release;
}

uint16_t board_inputs(void)
{
    return 0U;
}
