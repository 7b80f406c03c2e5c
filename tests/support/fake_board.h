/* SPDX-License-Identifier: MIT */
/**
 * @file fake_board.h
 * @brief board.h for tests: the test sets what the board would sample and sees what it was told.
 */
#ifndef FAKE_BOARD_H
#define FAKE_BOARD_H

#include "board.h"

#define FAKE_BOARD_QUEUE  1024
#define FAKE_BOARD_EVENTS 64
#define FAKE_BOARD_FRAMES 64 /* of each direction */

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    FAKE_BOARD_INIT,
    FAKE_BOARD_START,
    FAKE_BOARD_SAMPLE,
    FAKE_BOARD_FAULT,
    FAKE_BOARD_TRIP,
    FAKE_BOARD_DUTY,
    FAKE_BOARD_ENABLE
} fake_board_event_t;

typedef struct {
    int first;
    int count;
    int octets[FAKE_BOARD_QUEUE];
} fake_board_queue_t;

typedef struct {
    bool                 init_result;
    const board_setup_t *setup; /* that board_init() got */
    board_sample_t       sample;
    uint16_t             causes; /* faults that are there now */
    uint16_t             faults; /* latched */
    bool                 gate;
    board_duty_t         duty;
    bool                 chopper;
    int                  chopper_writes;
    bool                 brake; /**< the last command; the board closes it with the gates */
    int                  brake_writes;
    bool                 stack_spoilt;
    int                  served; /* watchdog */
    bool                 misfit; /* board_fits() refuses */
    bool                 loader_wanted;
    int                  restarts;
    bool                 restart_loader; /* what the last of them asked for */
    int                  store_budget; /* words that may still be erased or written before the power fails; negative: no end */
    uint32_t             cycles;
    uint32_t             cycles_per_read;
    board_line_t         line;                      /* that was set */
    board_can_frame_t    can_rx[FAKE_BOARD_FRAMES]; /* to be read, in this order */
    int                  can_rx_count;
    board_can_frame_t    can_tx[FAKE_BOARD_FRAMES]; /* written */
    int                  can_tx_count;
    int                  can_room; /* frames that the bus takes before it is full */
    uint16_t             can_rate_kbps;
    int                  can_starts;    /* calls of board_can_set() */
    bool                 can_triggered; /* the trigger was read since board_can_arm() */
    void (*after_triggered)(void);      /* called once, after board_can_triggered() has looked */
    uint16_t can_state;
    uint16_t can_ids[BOARD_CAN_IDS];
    uint16_t can_id_count;
    int      serial_room; /* octets that the transmitter takes before it is full */
    void (*tick)(void);
    uint16_t           updates; /* per PWM period */
    uint16_t           inputs;
    fake_board_queue_t rx;
    fake_board_queue_t tx;
    fake_board_event_t events[FAKE_BOARD_EVENTS];
    int                event_count; /* stops at FAKE_BOARD_EVENTS */
} fake_board_t;

extern fake_board_t fake_board;

/* Survives fake_board_reset(). */
extern uint16_t fake_board_store[BOARD_STORE_SLOTS][BOARD_STORE_WORDS];

/** Healthy board at rest: no current, 295 V, 25 degC, position 0, no index. */
void fake_board_reset(void);
/** The causes show in board_fault_read() from now on. */
void fake_board_fail(uint16_t causes);
void fake_board_receive(const int *octets, int count);
/** Every word of the store erased. */
void fake_board_erase_store(void);
/** -1: nothing was sent. */
int fake_board_sent(void);

#ifdef __cplusplus
}
#endif

#endif /* FAKE_BOARD_H */
