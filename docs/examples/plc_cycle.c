/* SPDX-License-Identifier: MIT */
/* A PLC's cycle in C, line by line that of plc_cycle.st. Every 20 ms it sends one request (function 23), which writes the
 * command and reads status, faults and speed. The master walks through the states of CiA 402.
 *
 *     cc plc_cycle.c -o plc_cycle $(pkg-config --cflags --libs libmodbus)
 *     ./plc_cycle 1502 run 5 stop 1              # Modbus/TCP of a virtual drive; or /dev/ttyUSB0 in place of 1502
 *
 * Words: run, stop, ack (acknowledges a fault), silent (says nothing at all), each with its seconds. */
#include <errno.h>
#include <modbus.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define CYCLE_s 0.02 /* a request and its answer take 7 ms at 115200 Bd */

#define COMMAND_FIRST 0    /* holding registers: control word, mode of operation, speed */
#define STATUS_FIRST  4096 /* the input registers, where function 23 can read them */

enum { SEND = 4, RECEIVED = 12 };

typedef struct {
    /* in */
    bool    start; /* has to rise: a run that has ended by itself is not begun again */
    bool    acknowledge;
    int32_t speed;     /* 0.1 rad/s electrical */
    bool    connected; /* the last exchange was answered, a cycle ago */
    /* kept */
    bool     started;
    bool     allowed;
    bool     ran;
    uint16_t controlword;
    /* exchanged */
    uint16_t send[SEND];
    uint16_t received[RECEIVED];
} drive_t;

static void cycle(drive_t *d)
{
    const uint16_t state = d->received[0] & 0x6F;

    if (d->start && d->connected && !d->started) {
        d->allowed = true;
    }
    if (!d->start || !d->connected || (d->ran && state != 0x27)) {
        d->allowed = false;
    }
    d->started = d->start && (d->started || d->connected);
    d->ran     = d->allowed && state == 0x27;

    switch (state) {
    case 0x40: /* switch on disabled: shut down */
    case 0x60:
        d->controlword = 0x06;
        break;
    case 0x21: /* ready to switch on: switch on */
        d->controlword = 0x07;
        break;
    case 0x23: /* switched on: enable operation, when it is wanted */
        d->controlword = d->allowed ? 0x0F : 0x07;
        break;
    case 0x27: /* operation enabled */
        d->controlword = d->allowed ? 0x0F : 0x06;
        break;
    case 0x08: /* fault */
    case 0x28:
        d->controlword = d->acknowledge ? 0x80 : 0x00;
        break;
    default: /* starts up, brakes */
        d->controlword = 0x00;
        break;
    }
    d->send[0] = d->controlword;
    d->send[1] = 3; /* profile velocity */
    d->send[2] = (uint16_t)((uint32_t)d->speed >> 16);
    d->send[3] = (uint16_t)d->speed;
}

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void sleep_until(double time_s)
{
    const double left_s = time_s - now_s();
    if (left_s > 0.0) {
        const struct timespec t = {(time_t)left_s, (long)(1e9 * (left_s - (double)(time_t)left_s))};
        nanosleep(&t, NULL);
    }
}

/* Prints changes, one line each. */
static void tell(const drive_t *d, double time_s)
{
    static uint16_t told = 0xFFFF;
    const uint16_t  now  = (uint16_t)((d->received[0] & 0x56F) | (d->connected ? 0U : 0x8000U));
    const uint32_t  both = ((uint32_t)d->received[10] << 16) | d->received[11];

    if (now != told) {
        told = now;
        printf("%7.2f s: state %02X%s%s%s, fault %u, %.1f rad/s\n", time_s, now & 0x6F,
               (now & 0x400) ? ", reached" : "", (now & 0x100) ? ", stopped by silence" : "",
               d->connected ? "" : ", no answer", d->received[4], 0.1 * (double)(int32_t)both);
        fflush(stdout);
    }
}

static modbus_t *open_line(const char *where)
{
    const bool tcp = strspn(where, "0123456789") == strlen(where);
    modbus_t  *m =
        tcp ? modbus_new_tcp("127.0.0.1", atoi(where)) : modbus_new_rtu(where, 115200, 'E', 8, 1);

    if (m == NULL || modbus_set_slave(m, 1) != 0 || modbus_connect(m) != 0) {
        fprintf(stderr, "%s: %s\n", where, modbus_strerror(errno));
        exit(1);
    }
    /* below the 500 ms after which the drive stops; a virtual one's time stands still while its machine is busy */
    const bool real = strncmp(where, "/dev/tty", 8) == 0;
    modbus_set_response_timeout(m, real ? 0 : 2, real ? 400000 : 0);
    return m;
}

int main(int argc, char **argv)
{
    if (argc < 4 || argc % 2 != 0) {
        fprintf(stderr, "usage: %s PORT (run|stop|ack|silent SECONDS)..\n", argv[0]);
        return 1;
    }
    modbus_t    *line    = open_line(argv[1]);
    drive_t      d       = {.speed = 2000};
    const double begin_s = now_s();
    double       next_s  = begin_s;
    unsigned     cycles  = 0;
    unsigned     late    = 0;

    for (int word = 2; word < argc; word += 2) {
        const double end_s = next_s + atof(argv[word + 1]);
        d.start            = strcmp(argv[word], "run") == 0;
        d.acknowledge      = strcmp(argv[word], "ack") == 0;
        if (strcmp(argv[word], "silent") == 0) {
            d.start = d.started; /* the PLC stood still, its operator's switch is where it was */
            sleep_until(end_s);
            next_s      = end_s;
            d.connected = false; /* what it knows is old */
        }
        while (next_s < end_s) {
            cycle(&d);
            d.connected =
                modbus_write_and_read_registers(line, COMMAND_FIRST, SEND, d.send, STATUS_FIRST,
                                                RECEIVED, d.received) == RECEIVED;
            if (!d.connected) {
                modbus_flush(line);
            }
            tell(&d, now_s() - begin_s);
            cycles++;
            next_s += CYCLE_s;
            if (now_s() > next_s + CYCLE_s) {
                late++;
                next_s = now_s();
            }
            sleep_until(next_s);
        }
    }
    printf("%u cycles, %u late\n", cycles, late);
    modbus_close(line);
    modbus_free(line);
    return 0;
}
