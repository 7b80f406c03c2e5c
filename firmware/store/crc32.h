/* SPDX-License-Identifier: MIT */
/**
 * @file crc32.h
 * @brief Check sum of words: CRC-32 of ISO-HDLC (polynomial 04C11DB7, reflected), the high octet of each word first.
 *
 * The same as zlib's crc32() of those octets.
 */
#ifndef CRC32_H
#define CRC32_H

#include <stdbool.h>
#include <stdint.h>

#define CRC32_START 0UL /**< of no words */

/** `crc` is that of the words before, CRC32_START at the beginning. */
uint32_t crc32_words(uint32_t crc, const uint16_t *words, uint32_t count);

#endif /* CRC32_H */
