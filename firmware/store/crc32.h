/* SPDX-License-Identifier: MIT */
/**
 * @file crc32.h
 * @brief CRC-32/ISO-HDLC (polynomial 04C11DB7, reflected) of 16-bit words.
 *
 * Each word enters high octet first. zlib's crc32() of the same octets gives the same value.
 */
#ifndef CRC32_H
#define CRC32_H

#include <stdbool.h>
#include <stdint.h>

#define CRC32_START 0UL /**< CRC of an empty sequence */

/**
 * @brief Continues a CRC over further words.
 *
 * @param crc   CRC of the preceding words, or CRC32_START.
 * @param words First of the words to add.
 * @param count Number of words.
 * @return CRC of all words so far.
 *
 * Context: any. Cost is proportional to `count`: 16 shifts a word.
 */
uint32_t crc32_words(uint32_t crc, const uint16_t *words, uint32_t count);

#endif /* CRC32_H */
