/* SPDX-License-Identifier: MIT */
#include "semihosting.h"

#include <string.h>

/* Operation numbers and argument blocks: Arm's semihosting specification. */
enum { SYS_OPEN = 0x01, SYS_WRITE = 0x05, SYS_READ = 0x06, SYS_EXIT_EXTENDED = 0x20 };
enum { MODE_READ_BINARY = 1, MODE_WRITE_BINARY = 5 };
#define APPLICATION_EXIT 0x20026u

static int32_t call(uint32_t operation, const uint32_t *arguments)
{
    register uint32_t        r0 __asm__("r0") = operation;
    register const uint32_t *r1 __asm__("r1") = arguments;

    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return (int32_t)r0;
}

int32_t semihosting_open(const char *name, bool for_writing)
{
    const uint32_t arguments[] = {
        (uint32_t)name, for_writing ? MODE_WRITE_BINARY : MODE_READ_BINARY, (uint32_t)strlen(name)};
    return call(SYS_OPEN, arguments);
}

bool semihosting_read(int32_t file, void *data, uint32_t size)
{
    const uint32_t arguments[] = {(uint32_t)file, (uint32_t)data, size};
    return call(SYS_READ, arguments) == 0; /* the octets that are missing */
}

bool semihosting_write(int32_t file, const void *data, uint32_t size)
{
    const uint32_t arguments[] = {(uint32_t)file, (uint32_t)data, size};
    return call(SYS_WRITE, arguments) == 0;
}

void semihosting_exit(uint32_t code)
{
    const uint32_t arguments[] = {APPLICATION_EXIT, code};
    (void)call(SYS_EXIT_EXTENDED, arguments);
}
