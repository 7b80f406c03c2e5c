/* SPDX-License-Identifier: MIT */
/* eCAN-A. Registers and mailboxes are 32 bits wide: each access has a whole one. The background
 * polls; nothing interrupts. */
#include "DSP28x_Project.h"
#include "can_octets.h"
#include "clock_tree.h"
#include "peripherals.h"

/* Mailboxes 0 .. 7 send. Each identifier to be received has three, from 8 on. */
#define SENDING      8U
#define PER_ID       3U
#define BOXES        32U
#define SENDING_MASK 0x000000FFUL
#define TRIGGER_MASK (7UL << (SENDING + (PER_ID * BOARD_CAN_TRIGGER))) /* its three mailboxes */
#define RECEIVING    0xFFFFFF00UL

/* CANMC */
#define MC_AUTO_ON   0x00000080UL /* ABO: returns by itself after bus off */
#define MC_ORDER     0x00000400UL /* DBO: the first octet is the lowest */
#define MC_CONFIGURE 0x00001000UL /* CCR */
#define MC_ECAN      0x00002000UL /* SCB: 32 mailboxes */
#define MC_RUN       (MC_AUTO_ON | MC_ORDER | MC_ECAN)

/* CANES */
#define ES_CONFIGURABLE 0x00000010UL /* CCE */
#define ES_OFF          0x00040000UL
#define ES_ERRORS       0x01BF0000UL /* latched, until a 1 is written; the first freezes others */

#define PASSIVE_LEAST 128UL /* error counters from here on; by ISO 11898-1 */

#define IO_CAN 0x00000008UL /* TXFUNC and RXFUNC */

#define ID_SHIFT      18U
#define ID_MASK       0x7FFUL
#define LENGTH_MASK   0xFUL
#define PRIORITY_MOST 31U
#define OCTETS        8U

/* Bit timing but the prescaler: SJW, TSEG1, TSEG2, each less one. */
#define TIMING                                                                                     \
    (((CLOCK_CAN_SJW - 1UL) << 8U) | ((CLOCK_CAN_TSEG1 - 1UL) << 3U) | (CLOCK_CAN_TSEG2 - 1UL))

typedef enum {
    CAN_LEFT = 0, /* off the bus, and nothing wants it there */
    CAN_LEAVES,   /* asked for the configuration */
    CAN_RETURNS,  /* asked for the bus */
    CAN_ON
} can_stage_t;

static struct {
    can_stage_t stage;
    uint32_t    timing; /* CANBTC */
    uint32_t    used;   /* mailboxes that receive */
    bool        lost;   /* a frame was overwritten before it was taken */
    /* the trigger came, board_can_arm(); volatile, as the tick reads it */
    volatile bool triggered;
} can;

static volatile struct MBOX *box_of(uint16_t n)
{
    return &(&ECanaMboxes.MBOX0)[n];
}

/* When a frame came [bits]. */
static uint32_t stamp_of(uint16_t n)
{
    const volatile Uint32 *stamp = &ECanaMOTSRegs.MOTS0;

    stamp += n;
    return *stamp;
}

static uint32_t bit_of(uint16_t n)
{
    return 1UL << n;
}

static void set_master_control(uint32_t value)
{
    EALLOW;
    ECanaRegs.CANMC.all = value;
    EDIS;
}

/* Reads and writes, as a bit field would be accessed in halves. */
static void enable_boxes(uint32_t off, uint32_t on)
{
    const uint32_t now = ECanaRegs.CANME.all;

    ECanaRegs.CANME.all = (now & ~off) | on;
}

void can_init(void)
{
    can.stage  = CAN_LEFT;
    can.timing = 0UL;
    can.used   = 0UL;
    can.lost   = false;
    board_can_arm();
    EALLOW;
    ECanaRegs.CANTIOC.all = IO_CAN;
    ECanaRegs.CANRIOC.all = IO_CAN;
    ECanaRegs.CANGIM.all  = 0UL; /* polled */
    ECanaRegs.CANMIM.all  = 0UL;
    EDIS;
    set_master_control(MC_RUN | MC_CONFIGURE);
    ECanaRegs.CANME.all = 0UL;
    for (uint16_t n = 0U; n < BOXES; n++) {
        box_of(n)->MSGCTRL.all = 0UL; /* undefined after a reset */
    }
    ECanaRegs.CANMD.all  = RECEIVING;
    ECanaRegs.CANTA.all  = 0xFFFFFFFFUL;
    ECanaRegs.CANRMP.all = 0xFFFFFFFFUL;
}

bool board_can_fits(uint16_t rate_kbps)
{
    return (rate_kbps == 125U) || (rate_kbps == 250U) || (rate_kbps == 500U) ||
           (rate_kbps == 1000U);
}

void board_can_set(uint16_t rate_kbps)
{
    if (board_can_fits(rate_kbps)) {
        const uint32_t prescaler = (uint32_t)(CLOCK_CAN_PRESCALER(rate_kbps));

        can.timing           = ((prescaler - 1U) << 16U) | (uint32_t)TIMING;
        can.stage            = CAN_LEAVES;
        ECanaRegs.CANTRR.all = SENDING_MASK;
        set_master_control(MC_RUN | MC_CONFIGURE);
    }
}

/* The module answers when the frame on the bus has ended. */
static void change_stage(uint32_t es)
{
    const bool configurable = (es & ES_CONFIGURABLE) != 0UL;

    if ((can.stage == CAN_LEAVES) && configurable) {
        EALLOW;
        ECanaRegs.CANBTC.all = can.timing;
        EDIS;
        set_master_control(MC_RUN);
        can.stage = CAN_RETURNS;
    } else if ((can.stage == CAN_RETURNS) && !configurable) {
        can.stage = CAN_ON;
    } else {
        /* waits, or there is nothing to change */
    }
}

/* The three mailboxes of an identifier: a frame takes the highest one that is free. Only the lowest
 * may be overwritten, so that the newest frame is kept. */
static void set_receiver(uint16_t first, uint16_t id)
{
    for (uint16_t n = first; n < (uint16_t)(first + PER_ID); n++) {
        box_of(n)->MSGID.all   = (uint32_t)id << ID_SHIFT;
        box_of(n)->MSGCTRL.all = 0UL;
    }
}

void board_can_listen(const uint16_t *ids, uint16_t count)
{
    const uint16_t n_ids = (count < BOARD_CAN_IDS) ? count : BOARD_CAN_IDS;
    uint32_t       used  = 0UL;
    uint32_t protected   = 0UL;

    enable_boxes(RECEIVING, 0UL);
    ECanaRegs.CANRMP.all = RECEIVING;
    for (uint16_t k = 0U; k < n_ids; k++) {
        const uint16_t first = (uint16_t)(SENDING + (PER_ID * k));

        set_receiver(first, (uint16_t)(ids[k] & (uint16_t)ID_MASK));
        used      = used | bit_of(first) | (6UL << first);
        protected = protected | (6UL << first);
    }
    can.used             = used;
    ECanaRegs.CANOPC.all = protected;
    enable_boxes(0UL, used);
}

/* The frame that came first: time stamps count bits and wrap. BOXES: none. */
static uint16_t oldest(uint32_t pending)
{
    const uint32_t now   = ECanaRegs.CANTSC;
    uint16_t       found = BOXES;
    uint32_t       age   = 0UL;

    for (uint16_t n = SENDING; n < BOXES; n++) {
        if ((pending & bit_of(n)) != 0UL) {
            const uint32_t its = now - stamp_of(n);

            if ((found == BOXES) || (its > age)) {
                found = n;
                age   = its;
            }
        }
    }
    return found;
}

static void take(const volatile struct MBOX *box, board_can_frame_t *frame)
{
    const uint32_t control = box->MSGCTRL.all & LENGTH_MASK;

    frame->id     = (uint16_t)((box->MSGID.all >> ID_SHIFT) & ID_MASK);
    frame->length = (control < OCTETS) ? (uint16_t)control : OCTETS;
    can_octets_of(box->MDL.all, frame->octets);
    can_octets_of(box->MDH.all, &frame->octets[4]);
}

bool board_can_read(board_can_frame_t *frame)
{
    const uint16_t n     = oldest((uint32_t)ECanaRegs.CANRMP.all & can.used);
    bool           whole = false;

    if (n < BOXES) {
        can.lost             = can.lost || (((uint32_t)ECanaRegs.CANRML.all & bit_of(n)) != 0UL);
        can.triggered        = can.triggered || ((bit_of(n) & TRIGGER_MASK) != 0UL);
        ECanaRegs.CANRMP.all = bit_of(n); /* clears CANRML too */
        take(box_of(n), frame);
        /* Pending again: a newer frame came over it meanwhile. The next call takes that one. */
        whole = ((uint32_t)ECanaRegs.CANRMP.all & bit_of(n)) == 0UL;
    }
    return whole;
}

void board_can_arm(void)
{
    can.triggered = false;
}

bool board_can_triggered(void)
{
    return can.triggered || (((uint32_t)ECanaRegs.CANRMP.all & TRIGGER_MASK) != 0UL);
}

/* A mailbox that is free; BOXES: none, or one with this identifier waits. */
static uint16_t free_box(uint16_t id)
{
    const uint32_t waiting = (uint32_t)ECanaRegs.CANTRS.all;
    uint16_t       found   = BOXES;
    bool           same    = false;

    for (uint16_t n = 0U; n < SENDING; n++) {
        if ((waiting & bit_of(n)) == 0UL) {
            found = n;
        } else {
            same = same || (((box_of(n)->MSGID.all >> ID_SHIFT) & ID_MASK) == (uint32_t)id);
        }
    }
    return same ? BOXES : found;
}

bool board_can_write(const board_can_frame_t *frame)
{
    const uint16_t n     = free_box(frame->id);
    const bool     taken = (can.stage == CAN_ON) && (n < BOXES) && (frame->length <= OCTETS);

    if (taken) {
        volatile struct MBOX *const box      = box_of(n);
        const uint32_t              priority = PRIORITY_MOST - ((uint32_t)frame->id >> 6U);

        enable_boxes(bit_of(n), 0UL); /* the identifier of an enabled one cannot be written */
        box->MSGID.all   = (uint32_t)frame->id << ID_SHIFT;
        box->MSGCTRL.all = (priority << 8U) | (uint32_t)frame->length;
        box->MDL.all     = can_octets_word(frame->octets);
        box->MDH.all     = can_octets_word(&frame->octets[4]);
        enable_boxes(0UL, bit_of(n));
        ECanaRegs.CANTA.all  = bit_of(n);
        ECanaRegs.CANTRS.all = bit_of(n);
    }
    return taken;
}

/* The counters show the present state. CANES keeps that of a moment. */
static bool is_passive(void)
{
    return (ECanaRegs.CANTEC.all >= PASSIVE_LEAST) || (ECanaRegs.CANREC.all >= PASSIVE_LEAST);
}

uint16_t board_can_state(void)
{
    const uint32_t es    = ECanaRegs.CANES.all;
    uint16_t       state = 0U;

    change_stage(es);
    if (is_passive()) {
        state = (uint16_t)(state | (uint16_t)BOARD_CAN_PASSIVE);
    }
    if ((es & ES_OFF) != 0UL) {
        state = (uint16_t)(state | (uint16_t)BOARD_CAN_OFF);
    }
    if ((es & ES_ERRORS) != 0UL) {
        ECanaRegs.CANES.all = es & ES_ERRORS;
    }
    if (can.lost) {
        can.lost = false;
        state    = (uint16_t)(state | (uint16_t)BOARD_CAN_LOST);
    }
    return state;
}
