/* SPDX-License-Identifier: MIT */
/**
 * @file board_identity.h
 * @brief Facts of the board around the processor, which no image of constants may change.
 *
 * sdre-gains makes one constant of a board file (firmware/config/boards). The firmware holds it,
 * and every image holds that of the board it was made for. Both must be equal.
 *
 * A field is a fact, the name or the sum. Its name is the key in the board file.
 */
#ifndef BOARD_IDENTITY_H
#define BOARD_IDENTITY_H

#include "fields.h"

/** Facts in SI units. board_field_name() has the key of each in a board file. */
typedef enum {
    BOARD_FACT_PWM_CLOCK_Hz = 0,   /**< of the PWM counter */
    BOARD_FACT_GATE_ON_LEVEL,      /**< level of a gate output that turns its switch on: 1 */
    BOARD_FACT_DEAD_TIME_MIN_s,    /**< least that gates and switches need */
    BOARD_FACT_PRECHARGE_s,        /**< least time with the lower switches on before a run */
    BOARD_FACT_DUTY_MAX,           /**< largest duty below 1 that the gate supplies bear */
    BOARD_FACT_PULSE_MIN_s,        /**< shortest pulse that the gate drivers pass */
    BOARD_FACT_CURRENT_RANGE_A,    /**< full scale of the converter, either sign */
    BOARD_FACT_CURRENT_SENSORS,    /**< 2 or 3 */
    BOARD_FACT_RATED_CURRENT_A,    /**< largest current limit of a drive, peak */
    BOARD_FACT_TRIP_CURRENT_A,     /**< of the hardware trip; the drive's is not above */
    BOARD_FACT_DC_LINK_RANGE_V,    /**< full scale of the converter */
    BOARD_FACT_RATED_DC_LINK_V,    /**< largest dc link that a drive accepts */
    BOARD_FACT_NTC_RESISTANCE_Ohm, /**< at 25 degC */
    BOARD_FACT_NTC_BETA_K,
    BOARD_FACT_NTC_DIVIDER_Ohm, /**< from the converter's full scale to the sensor */
    BOARD_FACT_TEMPERATURE_LIMIT_degC,
    BOARD_FACT_TEMPERATURE_TRIP_degC,
    BOARD_FACT_INVERTER_CURRENT_A, /**< continuous, peak of a phase */
    BOARD_FACT_INVERTER_TIME_CONSTANT_s,
    BOARD_FACT_ENCODER_EDGES_Hz, /**< most edges of both tracks a second */
    BOARD_FACT_CHOPPER_ON_V,     /**< of the dc link; 0, as the next: no brake chopper */
    BOARD_FACT_CHOPPER_OFF_V,
    BOARD_FACT_CHOPPER_RESISTANCE_Ohm,
    BOARD_FACT_CHOPPER_POWER_W,         /**< continuous */
    BOARD_FACT_CHOPPER_TIME_CONSTANT_s, /**< of the resistor's heat */
    BOARD_FACT_COUNT
} board_fact_t;

#define BOARD_NAME_WORDS     12U /**< of two characters; chosen: all texts of 43/14 have 24 */
#define BOARD_NAME_CHARS     (2U * BOARD_NAME_WORDS)
#define BOARD_IDENTITY_WORDS (BOARD_NAME_WORDS + (2U * (uint16_t)BOARD_FACT_COUNT))

typedef struct {
    char     name[BOARD_NAME_CHARS + 1U];
    float    fact[BOARD_FACT_COUNT];
    uint32_t sum; /**< board_identity_sum() */
} board_identity_t;

/** Numbers of fields: a fact's is 1 + board_fact_t. */
enum {
    BOARD_FIELD_NONE = 0,
    BOARD_FIELD_NAME = (int)BOARD_FACT_COUNT + 1,
    BOARD_FIELD_SUM, /**< the firmware's own identity is damaged */
    BOARD_FIELD_COUNT
};

/** First difference between the constants of an image and the board. */
typedef struct {
    uint16_t field; /**< BOARD_FIELD_NONE: there is none */
    float    image; /**< value of the image; 0 for name and sum */
    float    board;
} board_difference_t;

/** Key of a field in the board file; "" for BOARD_FIELD_NONE and above BOARD_FIELD_SUM. */
const char *board_field_name(uint16_t field);

/** Visits name and facts. Context: init, loader. */
void board_identity_fields(fields_t *f, board_identity_t *b);

/** CRC-32 of name and facts (crc32.h). Context: init, loader. */
uint32_t board_identity_sum(const board_identity_t *b);

/**
 * @brief Compares the identity that an image was made for with the firmware's, field by field.
 *
 * Context: init, loader.
 */
board_difference_t board_identity_compare(const board_identity_t *image,
                                          const board_identity_t *board);

#endif /* BOARD_IDENTITY_H */
