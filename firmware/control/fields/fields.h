/* SPDX-License-Identifier: MIT */
/**
 * @file fields.h
 * @brief Serialises the constants of a drive as 16-bit words, independent of the compiler.
 *
 * A walk visits every member of a structure in a fixed order, and writes it or reads it. One
 * function does both, so that the formats cannot differ. A 32-bit number is two words, the high one
 * first. A float is its IEEE 754 bits; a flag is 0 or 1. The modules check the values after
 * reading.
 *
 * With FIELDS_NAMED a walk also tells a listener the name of each member (fields_named.h): the
 * host's tools write C text from it. An image of the target has no names.
 */
#ifndef FIELDS_H
#define FIELDS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef FIELDS_NAMED
#include "fields_named.h"
#endif

typedef struct fields {
    const uint16_t *from;  /**< read from here; NULL: the walk writes or counts */
    uint16_t       *to;    /**< write to here; both NULL: the walk only counts */
    uint32_t        count; /**< available words */
    uint32_t        at;    /**< words visited; above count: a word was missing */
    bool            ok;    /**< no word was missing and every flag 0 or 1 */
#ifdef FIELDS_NAMED
    const fields_listener_t *listener; /**< NULL: nobody listens */
    const char              *name;     /**< of the next number; NULL: none */
#endif
} fields_t;

/** A walk that reads the members from `count` words. Context: init. */
fields_t fields_reader(const uint16_t *words, uint32_t count);

/** A walk that writes the members to words; words NULL: it counts only. Context: init. */
fields_t fields_writer(uint16_t *words, uint32_t count);

#ifdef FIELDS_NAMED
/** A walk that counts words and tells the listener every member. */
fields_t fields_told(const fields_listener_t *listener);
#endif

void fields_u16(fields_t *f, uint16_t *x);
void fields_i16(fields_t *f, int16_t *x);
void fields_u32(fields_t *f, uint32_t *x);
void fields_flag(fields_t *f, bool *x);
void fields_float(fields_t *f, float *x);
void fields_floats(fields_t *f, float *x, uint16_t count);

/** True if a walk has visited all words and none was missing. */
bool fields_complete(const fields_t *f);

#ifndef FIELDS_NAMED
/** The address of c->member. */
#define FIELD(f, c, member) (&(c)->member)
/** Visits the structure c->member by its own walk. */
#define FIELDS_PART(walk, f, c, member) (walk)((f), &(c)->member)
/** The numbers up to FIELDS_END() are the array `name`. */
#define FIELDS_BEGIN(f, name) ((void)0)
#define FIELDS_END(f)         ((void)0)
/** `name` is that of the next number, which is not visited in its structure. */
#define FIELDS_NAME(f, name)    ((void)0)
#define FIELDS_TELL(f, kind, x) ((void)0)
#endif

#endif /* FIELDS_H */
