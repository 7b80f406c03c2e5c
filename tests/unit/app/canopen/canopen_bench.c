/* SPDX-License-Identifier: MIT */
#include "canopen_bench.h"

#include <string.h>

#include "board_config.h"
#include "gain_tables.h"
#include "unity.h"

#define PERIOD_ms 0.2

app_canopen_t       node;
app_registers_t     registers;
uint32_t            now;
static app_config_t config;

void bench_start(void)
{
    fake_board_reset();
    config = board_config;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_registers_init(&registers, &config, &gain_tables_drive));
    registers.requested.can_node = BENCH_NODE;
    (void)memset(&node, 0xFF, sizeof node); /* init has to set everything */
    now = 0xFFFFFF00UL;                     /* wraps within every longer test */
    app_canopen_init(&node, 1e-3F * (float)PERIOD_ms);
    app_canopen_start(&node, &registers);
    bench_run(1);
    fake_board.can_tx_count = 0;
}

void bench_run(int periods)
{
    for (int n = 0; n < periods; n++) {
        now++;
        app_canopen_poll(&node, &registers, now);
    }
}

void bench_run_ms(double time_ms)
{
    bench_run((int)((time_ms / PERIOD_ms) + 0.5));
}

void bench_send(int id, int length, const int *octets)
{
    board_can_frame_t *f = &fake_board.can_rx[fake_board.can_rx_count++];

    f->id     = (uint16_t)id;
    f->length = (uint16_t)length;
    for (int n = 0; n < 8; n++) {
        f->octets[n] = (uint16_t)((n < length) ? octets[n] : 0xA5);
    }
    bench_run(1);
}

int bench_take(int id, int *octets)
{
    int length = -1;

    for (int k = 0; (k < fake_board.can_tx_count) && (length < 0); k++) {
        const board_can_frame_t f = fake_board.can_tx[k];

        if (f.id == id) {
            length = f.length;
            for (int n = 0; n < 8; n++) {
                octets[n] = f.octets[n];
            }
            fake_board.can_tx_count--;
            memmove(&fake_board.can_tx[k], &fake_board.can_tx[k + 1],
                    (size_t)(fake_board.can_tx_count - k) * sizeof f);
        }
    }
    return length;
}

int bench_count(int id)
{
    int found = 0;

    for (int k = 0; k < fake_board.can_tx_count; k++) {
        found += (fake_board.can_tx[k].id == id) ? 1 : 0;
    }
    fake_board.can_tx_count = 0;
    return found;
}

void bench_nmt(int command, int to)
{
    const int octets[] = {command, to};

    bench_send(0, 2, octets);
}

static uint32_t number(const int *octets)
{
    return (uint32_t)octets[0] | ((uint32_t)octets[1] << 8) | ((uint32_t)octets[2] << 16) |
           ((uint32_t)octets[3] << 24);
}

int bench_read(int index, int sub, uint32_t *value)
{
    const int request[] = {0x40, index & 0xFF, index >> 8, sub, 0, 0, 0, 0};
    int       a[8];

    bench_send(0x600 + BENCH_NODE, 8, request);
    TEST_ASSERT_EQUAL_INT(8, bench_take(0x580 + BENCH_NODE, a));
    TEST_ASSERT_EQUAL_HEX(index, a[1] | (a[2] << 8));
    TEST_ASSERT_EQUAL_HEX(sub, a[3]);
    *value = number(&a[4]);
    return ((a[0] & 0xF3) == 0x43) ? 4 - ((a[0] >> 2) & 3) : -1;
}

uint32_t bench_write(int index, int sub, uint32_t value, int octets)
{
    const int request[] = {0x23 | ((4 - octets) << 2),
                           index & 0xFF,
                           index >> 8,
                           sub,
                           (int)(value & 0xFFU),
                           (int)((value >> 8) & 0xFFU),
                           (int)((value >> 16) & 0xFFU),
                           (int)(value >> 24)};
    int       a[8];

    bench_send(0x600 + BENCH_NODE, 8, request);
    TEST_ASSERT_EQUAL_INT(8, bench_take(0x580 + BENCH_NODE, a));
    TEST_ASSERT_EQUAL_HEX(index, a[1] | (a[2] << 8));
    TEST_ASSERT_EQUAL_HEX(sub, a[3]);
    TEST_ASSERT_TRUE((a[0] == 0x60) || (a[0] == 0x80));
    return (a[0] == 0x60) ? 0UL : number(&a[4]);
}
