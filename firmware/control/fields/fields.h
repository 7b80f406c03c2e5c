/* SPDX-License-Identifier: MIT */
/**
 * @file fields.h
 * @brief The constants of a drive as words of 16 bits, in an order that no compiler changes.
 *
 * A walk visits every member of a structure in turn and writes it to a row of words, or reads it from there: one
 * function for both, so that the two cannot differ. Numbers of 32 bits are two words, the high one first; a float is its
 * IEEE 754 bits; a flag is 0 or 1. What is read is not believed yet: the checks of the modules come after it.
 */
#ifndef FIELDS_H
#define FIELDS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    const uint16_t *from;  /**< read from here; NULL: the walk writes or counts */
    uint16_t       *to;    /**< write to here; both NULL: the walk only counts */
    uint32_t        count; /**< words there are */
    uint32_t        at;    /**< words visited; beyond count: the walk was refused there */
    bool            ok;    /**< no word was missing and every flag 0 or 1 */
} fields_t;

/** Makes the members what the `count` words say. Context: init. */
fields_t fields_reader(const uint16_t *words, uint32_t count);

/** Makes the words what the members are; words NULL: counts only. Context: init. */
fields_t fields_writer(uint16_t *words, uint32_t count);

void fields_u16(fields_t *f, uint16_t *x);
void fields_i16(fields_t *f, int16_t *x);
void fields_u32(fields_t *f, uint32_t *x);
void fields_flag(fields_t *f, bool *x);
void fields_float(fields_t *f, float *x);
void fields_floats(fields_t *f, float *x, uint16_t count);

/** True when a walk has visited all words and none was missing. */
bool fields_complete(const fields_t *f);

#endif /* FIELDS_H */
