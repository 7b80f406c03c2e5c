/* SPDX-License-Identifier: MIT */
/**
 * @file fields_text.h
 * @brief Serialises a text as words of two characters, for the walks of fields.h.
 */
#ifndef FIELDS_TEXT_H
#define FIELDS_TEXT_H

#include "fields.h"

/** Visits 2 * words characters, the first one of a word high. x also has a terminating zero. */
void fields_text(fields_t *f, char *x, uint16_t words);

#endif /* FIELDS_TEXT_H */
