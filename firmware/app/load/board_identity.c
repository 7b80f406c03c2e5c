/* SPDX-License-Identifier: MIT */
#include "board_identity.h"

#include "base.h"
#include "crc32.h"
#include "fields_text.h"

const char *board_field_name(uint16_t field)
{
    static const char *const facts[BOARD_FACT_COUNT] = {
        [BOARD_FACT_PWM_CLOCK_Hz]             = "pwm_clock_Hz",
        [BOARD_FACT_GATE_ON_LEVEL]            = "gate_on_level",
        [BOARD_FACT_DEAD_TIME_MIN_s]          = "dead_time_min_s",
        [BOARD_FACT_PRECHARGE_s]              = "precharge_s",
        [BOARD_FACT_DUTY_MAX]                 = "duty_max",
        [BOARD_FACT_PULSE_MIN_s]              = "pulse_min_s",
        [BOARD_FACT_CURRENT_RANGE_A]          = "current_range_A",
        [BOARD_FACT_CURRENT_SENSORS]          = "current_sensors",
        [BOARD_FACT_RATED_CURRENT_A]          = "rated_current_A",
        [BOARD_FACT_TRIP_CURRENT_A]           = "trip_current_A",
        [BOARD_FACT_DC_LINK_RANGE_V]          = "dc_link_range_V",
        [BOARD_FACT_RATED_DC_LINK_V]          = "rated_dc_link_V",
        [BOARD_FACT_NTC_RESISTANCE_Ohm]       = "ntc_resistance_Ohm",
        [BOARD_FACT_NTC_BETA_K]               = "ntc_beta_K",
        [BOARD_FACT_NTC_DIVIDER_Ohm]          = "ntc_divider_Ohm",
        [BOARD_FACT_TEMPERATURE_LIMIT_degC]   = "temperature_limit_degC",
        [BOARD_FACT_TEMPERATURE_TRIP_degC]    = "temperature_trip_degC",
        [BOARD_FACT_INVERTER_CURRENT_A]       = "inverter_current_A",
        [BOARD_FACT_INVERTER_TIME_CONSTANT_s] = "inverter_time_constant_s",
        [BOARD_FACT_ENCODER_EDGES_Hz]         = "encoder_edges_Hz",
        [BOARD_FACT_CHOPPER_ON_V]             = "chopper_on_V",
        [BOARD_FACT_CHOPPER_OFF_V]            = "chopper_off_V",
        [BOARD_FACT_CHOPPER_RESISTANCE_Ohm]   = "chopper_resistance_Ohm",
        [BOARD_FACT_CHOPPER_POWER_W]          = "chopper_power_W",
        [BOARD_FACT_CHOPPER_TIME_CONSTANT_s]  = "chopper_time_constant_s",
    };
    const char *name = "";

    if (field == (uint16_t)BOARD_FIELD_NAME) {
        name = "name";
    } else if (field == (uint16_t)BOARD_FIELD_SUM) {
        name = "sum";
    } else if ((field > 0U) && (field <= (uint16_t)BOARD_FACT_COUNT)) {
        name = facts[field - 1U];
    } else {
        /* none */
    }
    return name;
}

void board_identity_fields(fields_t *f, board_identity_t *b)
{
    FIELDS_BEGIN(f, board_name);
    fields_text(f, b->name, BOARD_NAME_WORDS);
    FIELDS_END(f);
    FIELDS_BEGIN(f, board_fact);
    fields_floats(f, b->fact, (uint16_t)BOARD_FACT_COUNT);
    FIELDS_END(f);
}

uint32_t board_identity_sum(const board_identity_t *b)
{
    uint16_t         words[BOARD_IDENTITY_WORDS];
    board_identity_t copy;
    fields_t         f = fields_writer(words, BOARD_IDENTITY_WORDS);

    copy = *b;
    board_identity_fields(&f, &copy);
    return crc32_words(CRC32_START, words, BOARD_IDENTITY_WORDS);
}

static bool same_name(const board_identity_t *x, const board_identity_t *y)
{
    bool same = true;

    for (uint16_t n = 0U; n < BOARD_NAME_CHARS; n++) {
        same = same && (x->name[n] == y->name[n]);
    }
    return same;
}

/* Facts go first: their names say what is different. */
board_difference_t board_identity_compare(const board_identity_t *image,
                                          const board_identity_t *board)
{
    board_difference_t d = {.field = (uint16_t)BOARD_FIELD_NONE};

    if (board->sum != board_identity_sum(board)) {
        d.field = (uint16_t)BOARD_FIELD_SUM;
    }
    for (uint16_t n = 0U; (n < (uint16_t)BOARD_FACT_COUNT) && (d.field == 0U); n++) {
        if (!base_in_range(image->fact[n], board->fact[n], board->fact[n])) { /* also a NaN */
            d.field = (uint16_t)(n + 1U);
            d.image = image->fact[n];
            d.board = board->fact[n];
        }
    }
    if ((d.field == 0U) && !same_name(image, board)) {
        d.field = (uint16_t)BOARD_FIELD_NAME;
    }
    return d;
}
