/* SPDX-License-Identifier: MIT */
#include "fake_board.h"

#include <stddef.h>
#include <string.h>

fake_board_t fake_board;
uint16_t     fake_board_store[BOARD_STORE_SLOTS][BOARD_STORE_WORDS];

void fake_board_reset(void)
{
    const board_sample_t rest = {.ia_cnt          = 2048U,
                                 .ib_cnt          = 2048U,
                                 .dc_link_cnt     = 2685U, /* 295 V of 450 V */
                                 .temperature_cnt = 3357U, /* 25 degC */
                                 .position_cnt    = 0U,
                                 .index_cnt       = 0U,
                                 .index_seen      = false,
                                 .valid           = true};
    const fake_board_t   none = {.init_result  = true,
                                 .sample       = rest,
                                 .serial_room  = 1 << 20,
                                 .can_room     = 1 << 20,
                                 .store_budget = -1};
    fake_board                = none;
}

static void note(fake_board_event_t event)
{
    if (fake_board.event_count < FAKE_BOARD_EVENTS) {
        fake_board.events[fake_board.event_count++] = event;
    }
}

static void push(fake_board_queue_t *q, int octet)
{
    q->octets[(q->first + q->count) % FAKE_BOARD_QUEUE] = octet;
    q->count++;
}

static int pop(fake_board_queue_t *q)
{
    const int octet = q->octets[q->first];
    q->first        = (q->first + 1) % FAKE_BOARD_QUEUE;
    q->count--;
    return octet;
}

void fake_board_fail(uint16_t causes)
{
    fake_board.causes = causes;
    fake_board.faults = (uint16_t)(fake_board.faults | causes);
}

void fake_board_receive(const int *octets, int count)
{
    for (int i = 0; i < count; i++) {
        push(&fake_board.rx, octets[i]);
    }
}

int fake_board_sent(void)
{
    return (fake_board.tx.count > 0) ? pop(&fake_board.tx) : -1;
}

bool board_init(const board_setup_t *setup)
{
    fake_board.setup = setup;
    note(FAKE_BOARD_INIT);
    return fake_board.init_result;
}

void board_start(void (*tick)(void), uint16_t updates_per_period)
{
    note(FAKE_BOARD_START);
    fake_board.tick    = tick;
    fake_board.updates = updates_per_period;
}

const board_sample_t *board_sample(void)
{
    note(FAKE_BOARD_SAMPLE);
    return &fake_board.sample;
}

void board_duty_write(const board_duty_t *duty)
{
    note(FAKE_BOARD_DUTY);
    fake_board.duty = *duty;
}

void board_chopper_write(bool on)
{
    fake_board.chopper = on;
    fake_board.chopper_writes++;
}

void board_brake_write(bool release)
{
    fake_board.brake = release;
    fake_board.brake_writes++;
}

void board_gate_enable(void)
{
    note(FAKE_BOARD_ENABLE);
    fake_board.faults = fake_board.causes;
    fake_board.gate   = fake_board.causes == (uint16_t)BOARD_FAULT_NONE;
}

void board_gate_trip(void)
{
    note(FAKE_BOARD_TRIP);
    fake_board.gate = false;
}

uint16_t board_fault_read(void)
{
    note(FAKE_BOARD_FAULT);
    return fake_board.faults;
}

board_reset_t board_reset_cause(void)
{
    return BOARD_RESET_PIN;
}

bool board_fits(const board_setup_t *setup)
{
    (void)setup;
    return !fake_board.misfit;
}

bool board_loader_is_wanted(void)
{
    return fake_board.loader_wanted;
}

void board_restart(bool loader)
{
    fake_board.restarts++;
    fake_board.restart_loader = loader;
}

uint16_t *board_kept(void)
{
    static uint16_t kept[BOARD_KEPT_WORDS];
    return kept;
}

void fake_board_erase_store(void)
{
    memset(fake_board_store, 0xFF, sizeof fake_board_store);
}

const uint16_t *board_store(uint16_t slot)
{
    return (slot < (uint16_t)BOARD_STORE_SLOTS) ? fake_board_store[slot] : NULL;
}

/* False: the power has failed; the word is what a cut leaves of it, some of its bits. */
static bool change(uint16_t *word, uint16_t to, uint16_t left)
{
    if (fake_board.store_budget == 0) {
        return false;
    }
    fake_board.store_budget -= (fake_board.store_budget > 0) ? 1 : 0;
    *word = (fake_board.store_budget == 0) ? left : to;
    return true;
}

bool board_store_erase(uint16_t slot)
{
    const int      budget = fake_board.store_budget;
    const bool     cut    = (budget >= 0) && (budget <= (int)BOARD_STORE_WORDS);
    const uint32_t whole  = cut ? (uint32_t)((budget > 0) ? (budget - 1) : 0) : BOARD_STORE_WORDS;
    uint16_t      *words  = fake_board_store[slot];

    memset(words, 0xFF, whole * sizeof words[0]);
    if (!cut) {
        fake_board.store_budget -= (budget > 0) ? (int)BOARD_STORE_WORDS : 0;
        return true;
    }
    if (budget > 0) {
        (void)change(&words[whole], 0xFFFFU, (uint16_t)(words[whole] | 0x5A5AU));
    }
    fake_board.store_budget = 0;
    return false;
}

bool board_store_program(uint16_t slot, uint32_t offset, const uint16_t *words, uint16_t count)
{
    for (uint32_t n = 0U; n < count; n++) {
        uint16_t *word = &fake_board_store[slot][offset + n];
        if ((*word & words[n]) != words[n]) {
            return false; /* not erased */
        }
        if (!change(word, words[n], (uint16_t)(words[n] | 0x0F0FU))) {
            return false;
        }
    }
    return true;
}

uint32_t board_cycles(void)
{
    fake_board.cycles += fake_board.cycles_per_read;
    return fake_board.cycles;
}

bool board_memory_is_whole(void)
{
    return !fake_board.stack_spoilt;
}

void board_watchdog_serve(void)
{
    fake_board.served++;
}

bool board_line_fits(const board_line_t *line)
{
    return (line->baud_Bd == 9600UL) || (line->baud_Bd == 19200UL) || (line->baud_Bd == 115200UL);
}

void board_line_set(const board_line_t *line)
{
    fake_board.line = *line;
}

bool board_serial_read(uint16_t *octet)
{
    if (fake_board.rx.count == 0) {
        return false;
    }
    *octet = (uint16_t)pop(&fake_board.rx);
    return true;
}

bool board_serial_write(uint16_t octet)
{
    if (fake_board.serial_room == 0) {
        return false;
    }
    fake_board.serial_room--;
    push(&fake_board.tx, (int)octet);
    return true;
}

bool board_can_fits(uint16_t rate_kbps)
{
    return (rate_kbps == 125U) || (rate_kbps == 250U) || (rate_kbps == 500U) ||
           (rate_kbps == 1000U);
}

void board_can_set(uint16_t rate_kbps)
{
    fake_board.can_rate_kbps = rate_kbps;
    fake_board.can_starts++;
}

void board_can_listen(const uint16_t *ids, uint16_t count)
{
    memcpy(fake_board.can_ids, ids, count * sizeof ids[0]);
    fake_board.can_id_count = count;
}

static bool is_trigger(const board_can_frame_t *frame)
{
    return (fake_board.can_id_count > (int)BOARD_CAN_TRIGGER) &&
           (frame->id == fake_board.can_ids[BOARD_CAN_TRIGGER]);
}

bool board_can_read(board_can_frame_t *frame)
{
    if (fake_board.can_rx_count == 0) {
        return false;
    }
    *frame                   = fake_board.can_rx[0];
    fake_board.can_triggered = fake_board.can_triggered || is_trigger(frame);
    fake_board.can_rx_count--;
    memmove(&fake_board.can_rx[0], &fake_board.can_rx[1],
            (size_t)fake_board.can_rx_count * sizeof fake_board.can_rx[0]);
    return true;
}

void board_can_arm(void)
{
    fake_board.can_triggered = false;
}

bool board_can_triggered(void)
{
    void (*const interrupt)(void) = fake_board.after_triggered;
    bool waits                    = fake_board.can_triggered;

    for (int k = 0; k < fake_board.can_rx_count; k++) {
        waits = waits || is_trigger(&fake_board.can_rx[k]);
    }
    if (interrupt != NULL) {
        fake_board.after_triggered = NULL;
        interrupt();
    }
    return waits;
}

bool board_can_write(const board_can_frame_t *frame)
{
    if ((fake_board.can_room == 0) || (fake_board.can_tx_count == FAKE_BOARD_FRAMES)) {
        return false;
    }
    fake_board.can_room--;
    fake_board.can_tx[fake_board.can_tx_count++] = *frame;
    return true;
}

uint16_t board_inputs(void)
{
    return fake_board.inputs;
}

uint16_t board_can_state(void)
{
    return fake_board.can_state;
}
