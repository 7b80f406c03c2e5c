/* SPDX-License-Identifier: MIT */
/**
 * @file can_octets.h
 * @brief Octets of a CAN frame in a register of 32 bits. The first octet is the lowest.
 */
#ifndef CAN_OCTETS_H
#define CAN_OCTETS_H

#include <stdint.h>

#define CAN_OCTETS_PER_WORD 4U
#define CAN_OCTETS_BITS     8U
#define CAN_OCTETS_MASK     0xFFUL

/** Word of four octets; what is above eight bits is left out. Context: any. */
static inline uint32_t can_octets_word(const uint16_t *octets)
{
    uint32_t word = 0UL;

    for (uint16_t k = CAN_OCTETS_PER_WORD; k > 0U; k--) {
        word = (word << CAN_OCTETS_BITS) | ((uint32_t)octets[k - 1U] & CAN_OCTETS_MASK);
    }
    return word;
}

/** Writes the four octets of a word. Context: any. */
static inline void can_octets_of(uint32_t word, uint16_t *octets)
{
    uint32_t rest = word;

    for (uint16_t k = 0U; k < CAN_OCTETS_PER_WORD; k++) {
        octets[k] = (uint16_t)(rest & CAN_OCTETS_MASK);
        rest >>= CAN_OCTETS_BITS;
    }
}

#endif /* CAN_OCTETS_H */
