/* SPDX-License-Identifier: MIT */
/* FDCAN1 with classic frames. It keeps three received frames, fewer than a pass of the background
 * may bring, so an interrupt takes them. */
#include <stddef.h>

#include "can_octets.h"
#include "clock_tree.h"
#include "peripherals.h"

#define RING       8U /* frames; a power of two */
#define SENDING    3U /* buffers of the module */
#define REJECT     2U /* ANFS, ANFE */
#define OCTETS     8U
#define ID_SHIFT   18U
#define ID_MASK    0x7FFUL
#define LENGTH_AT  16U
#define LENGTH     15UL
#define FILTER_ONE 0x08000000UL /* into FIFO 0; a range from ID1 to ID2, which are equal */

#define TIMING                                                                                     \
    (FDCAN_NBTP_NSJW(CLOCK_CAN_SJW - 1UL) | FDCAN_NBTP_NTSEG1(CLOCK_CAN_TSEG1 - 1UL) |             \
     FDCAN_NBTP_NTSEG2(CLOCK_CAN_TSEG2 - 1UL))

typedef enum {
    CAN_LEFT = 0, /* off the bus, and nothing wants it there */
    CAN_LEAVES,   /* asked for the configuration */
    CAN_RETURNS,  /* asked for the bus */
    CAN_ON
} can_stage_t;

static struct {
    can_stage_t       stage;
    uint32_t          timing; /* NBTP */
    board_can_frame_t frames[RING];
    volatile uint32_t put; /* the interrupt advances it */
    volatile uint32_t got; /* the background advances it */
    volatile bool     lost;
    uint16_t          trigger; /* identifier; that of NMT, 0: none */
    volatile uint32_t came;    /* frames with it: the interrupt counts those that came */
    volatile uint32_t read;    /* the background counts those that it read */
    volatile uint32_t armed;   /* and had read at board_can_arm() */
} can;

void can_init(void)
{
    can.stage  = CAN_LEFT;
    can.timing = 0UL;
    can.put    = 0UL;
    can.got    = 0UL;
    can.lost   = false;
    can.came   = 0UL;
    board_can_listen(NULL, 0U);
    board_can_arm();
    core_enable(IRQ_FDCAN1_IT0, CORE_PRIORITY(LEVEL_LINES));
}

bool board_can_fits(uint16_t rate_kbps)
{
    return (rate_kbps == 125U) || (rate_kbps == 250U) || (rate_kbps == 500U) ||
           (rate_kbps == 1000U);
}

void board_can_set(uint16_t rate_kbps)
{
    if (board_can_fits(rate_kbps)) {
        can.timing = TIMING | FDCAN_NBTP_NBRP(CLOCK_CAN_PRESCALER((uint32_t)rate_kbps) - 1UL);
        can.stage  = CAN_LEAVES;
        FDCAN1->CCCR |= FDCAN_CCCR_INIT;
    }
}

/* CCE also empties all buffers. */
static void configure(void)
{
    FDCAN1->CCCR |= FDCAN_CCCR_CCE;
    FDCAN1->NBTP  = can.timing;
    FDCAN1->RXGFC = FDCAN_RXGFC_RRFE | FDCAN_RXGFC_RRFS | FDCAN_RXGFC_ANFE(REJECT) |
                    FDCAN_RXGFC_ANFS(REJECT) | FDCAN_RXGFC_LSS(BOARD_CAN_IDS);
    FDCAN1->TXBC = FDCAN_TXBC_TFQM; /* the lowest identifier first */
    FDCAN1->ILS  = 0UL;
    FDCAN1->IR   = FDCAN_IR_RF0N | FDCAN_IR_RF0L;
    FDCAN1->IE   = FDCAN_IE_RF0NE;
    FDCAN1->ILE  = FDCAN_ILE_EINT0;
    FDCAN1->CCCR &= ~FDCAN_CCCR_INIT; /* and CCE with it */
}

/* The module answers when the frame on the bus has ended. After too many errors it asks for the
 * configuration by itself, and returns when that is withdrawn. */
static void change_stage(void)
{
    const bool off_bus = (FDCAN1->CCCR & FDCAN_CCCR_INIT) != 0UL;

    if ((can.stage == CAN_LEAVES) && off_bus) {
        configure();
        can.stage = CAN_RETURNS;
    } else if ((can.stage == CAN_RETURNS) && !off_bus) {
        can.stage = CAN_ON;
    } else if ((can.stage == CAN_ON) && off_bus) {
        FDCAN1->CCCR &= ~FDCAN_CCCR_INIT;
    } else {
        /* waits, or there is nothing to change */
    }
}

/* A filter that is not used is zero, which is off. */
void board_can_listen(const uint16_t *ids, uint16_t count)
{
    for (uint16_t n = 0U; n < BOARD_CAN_IDS; n++) {
        const uint32_t id = (n < count) ? ((uint32_t)ids[n] & ID_MASK) : 0UL;

        FDCAN_MEMORY->standard_filter[n] = (n < count) ? (FILTER_ONE | (id << 16U) | id) : 0UL;
    }
    can.trigger = (count > BOARD_CAN_TRIGGER) ? ids[BOARD_CAN_TRIGGER] : 0U;
    can.got     = can.put;
    can.read    = can.came;
}

static bool is_trigger(const board_can_frame_t *frame)
{
    return (can.trigger != 0U) && (frame->id == can.trigger);
}

static void take(const fdcan_element_t *element, board_can_frame_t *frame)
{
    const uint32_t length = (element->format >> LENGTH_AT) & LENGTH;

    frame->id     = (uint16_t)((element->head >> ID_SHIFT) & ID_MASK);
    frame->length = (length < OCTETS) ? (uint16_t)length : OCTETS;
    can_octets_of(element->data[0], frame->octets);
    can_octets_of(element->data[1], &frame->octets[4]);
}

void can_isr(void)
{
    uint32_t status = FDCAN1->RXF0S;

    can.lost   = can.lost || ((FDCAN1->IR & FDCAN_IR_RF0L) != 0UL);
    FDCAN1->IR = FDCAN_IR_RF0N | FDCAN_IR_RF0L;
    while (FDCAN_RXF0S_F0FL_OF(status) != 0UL) {
        const uint32_t n = FDCAN_RXF0S_F0GI_OF(status);

        if ((can.put - can.got) < RING) {
            board_can_frame_t *const frame = &can.frames[can.put % RING];

            take(&FDCAN_MEMORY->receive_0[n], frame);
            can.came = can.came + (is_trigger(frame) ? 1UL : 0UL);
            can.put  = can.put + 1UL;
        } else {
            can.lost = true;
        }
        FDCAN1->RXF0A = n;
        status        = FDCAN1->RXF0S;
    }
}

bool board_can_read(board_can_frame_t *frame)
{
    const bool is_there = can.put != can.got;

    if (is_there) {
        *frame   = can.frames[can.got % RING];
        can.read = can.read + (is_trigger(frame) ? 1UL : 0UL);
        can.got  = can.got + 1UL;
    }
    return is_there;
}

void board_can_arm(void)
{
    can.armed = can.read;
}

bool board_can_triggered(void)
{
    return can.came != can.armed;
}

/* True while a frame with this identifier waits. */
static bool waits(uint16_t id)
{
    const uint32_t pending = FDCAN1->TXBRP;
    bool           same    = false;

    for (uint32_t n = 0UL; n < SENDING; n++) {
        same = same || (((pending & (1UL << n)) != 0UL) &&
                        (((FDCAN_MEMORY->send[n].head >> ID_SHIFT) & ID_MASK) == (uint32_t)id));
    }
    return same;
}

bool board_can_write(const board_can_frame_t *frame)
{
    const uint32_t queue = FDCAN1->TXFQS;
    const bool     taken = (can.stage == CAN_ON) && ((queue & FDCAN_TXFQS_TFQF) == 0UL) &&
                       (frame->length <= OCTETS) && !waits(frame->id);

    if (taken) {
        const uint32_t         n       = FDCAN_TXFQS_TFQPI_OF(queue);
        fdcan_element_t *const element = &FDCAN_MEMORY->send[n];

        element->head    = ((uint32_t)frame->id & ID_MASK) << ID_SHIFT;
        element->format  = (uint32_t)frame->length << LENGTH_AT;
        element->data[0] = can_octets_word(frame->octets);
        element->data[1] = can_octets_word(&frame->octets[4]);
        FDCAN1->TXBAR    = 1UL << n;
    }
    return taken;
}

uint16_t board_can_state(void)
{
    const uint32_t status = FDCAN1->PSR;
    uint16_t       state  = 0U;

    change_stage();
    if ((status & FDCAN_PSR_EP) != 0UL) {
        state = (uint16_t)(state | (uint16_t)BOARD_CAN_PASSIVE);
    }
    if ((status & FDCAN_PSR_BO) != 0UL) {
        state = (uint16_t)(state | (uint16_t)BOARD_CAN_OFF);
    }
    if (can.lost) {
        can.lost = false;
        state    = (uint16_t)(state | (uint16_t)BOARD_CAN_LOST);
    }
    return state;
}
