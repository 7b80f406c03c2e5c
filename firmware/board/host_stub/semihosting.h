/* SPDX-License-Identifier: MIT */
/**
 * @file semihosting.h
 * @brief Host files and program exit through the emulator (Arm semihosting).
 */
#ifndef SEMIHOSTING_H
#define SEMIHOSTING_H

#include <stdbool.h>
#include <stdint.h>

/** Opens a binary file in the emulator's working directory. @return handle; negative: failed. */
int32_t semihosting_open(const char *name, bool for_writing);

/** true when all of it was read. */
bool semihosting_read(int32_t file, void *data, uint32_t size);

/** true when all of it was written. */
bool semihosting_write(int32_t file, const void *data, uint32_t size);

/** Ends the emulator with this exit code. */
void semihosting_exit(uint32_t code);

#endif /* SEMIHOSTING_H */
