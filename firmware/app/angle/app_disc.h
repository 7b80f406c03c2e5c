/* SPDX-License-Identifier: MIT */
/**
 * @file app_disc.h
 * @brief A map of the encoder disc: where each edge of a turn really is.
 *
 *     edge n of a turn is at n + o(n) counts; n = 0 is the index mark, turning forward  EQ-DISC-1
 *     theta_e += n_p o(n) 2 pi / N, for an angle that rests on edge n                  EQ-DISC-2
 *     omega_e = n_p (edge + o - edge before - o before) 2 pi / (N t_before)            EQ-DISC-3
 *     in force when sum |e| with the map < 0.75 sum |e| without it                     EQ-DISC-4
 *
 * e is the position of an edge minus the one that the speed before predicts. It compares the map
 * with the disc after every start. Another disc, or an index at another place, has larger errors
 * with this map than without it. The map acts after that only.
 *
 * The map lies behind the constants of a stored image (drive_image.h) and is read from there:
 *
 *     0        APP_DISC_FORMAT
 *     1        positions of a turn, N
 *     2 ..     o(n) in 1/256 counts, eight bits two's complement; even n in the low octet
 *
 * An image of the firmware has this with SDRE_DISC_MAP only. Host tools always have it.
 */
#ifndef APP_DISC_H
#define APP_DISC_H

#include "app_options.h"
#include "app_part.h"
#include "base.h"

#define APP_DISC_FORMAT     0xD15CU /**< chosen: neither erased nor cleared */
#define APP_DISC_HEAD_WORDS 2UL
/** Edges of a comparison. Chosen: its sums vary by some 3 %, far below what decides. */
#define APP_DISC_COMPARED 512U

typedef enum {
    APP_DISC_ABSENT = 0, /**< the program cannot use a map */
    APP_DISC_NONE,       /**< the constants have no map */
    APP_DISC_NO_INDEX,   /**< waits for the index, turning forward */
    APP_DISC_COMPARES,   /**< compares the map with the disc: not in force yet */
    APP_DISC_OTHER,      /**< it is not the map of this disc: not in force until a restart */
    APP_DISC_IN_FORCE
} app_disc_state_t;

typedef struct {
    app_disc_state_t state;
    const uint16_t  *octets; /**< two edges a word; NULL: no map */
    uint16_t         positions;
    uint16_t         zero_cnt;   /**< position of the index */
    bool             have_zero;  /**< an index came, turning forward */
    bool             have_edge;  /**< off_cnt is of the edge before */
    bool             have_speed; /**< so are the next two */
    float            off_cnt;    /**< o of the last edge */
    float            plain_cntps;
    float            mapped_cntps;
    float            plain_cnt; /**< sums of |e|, of this comparison */
    float            mapped_cnt;
    uint16_t         compared;
} app_disc_t;

/** True if these words are a map for this number of positions. Context: init, or the loader. */
bool app_disc_check(const uint16_t *words, uint32_t count, uint32_t positions);

/** Without a map and without an index. Context: init. */
void app_disc_init(app_disc_t *d, uint16_t positions);

/** Uses the map of these words, which app_disc_check() accepts; NULL: none. Context: init. */
void app_disc_take(app_disc_t *d, const uint16_t *words);

/** Takes an index pulse that came while the shaft turned forward. Context: control ISR. */
void app_disc_index(app_disc_t *d, uint16_t index_cnt);

/** Counts may be lost: the next index begins again. Context: control ISR. */
void app_disc_lose(app_disc_t *d);

#if APP_DISC_MAP
/**
 * @brief Takes an edge.
 *
 * @param edge_cnt   Position at whose lower end the edge is, below the positions of a turn.
 * @param turned_cnt Whole counts since the edge before.
 * @param between_s  Time since the edge before; 0 or less: there is none, or it is unknown.
 * @return Counts between the two edges; turned_cnt unless the map is in force (EQ-DISC-3).
 *
 * Context: control ISR. One division while it compares.
 */
APP_MEASURE_PART float app_disc_turned_cnt(app_disc_t *d, uint16_t edge_cnt, float turned_cnt,
                                           float between_s);
#endif

/** One step of a comparison, EQ-DISC-4. Context: control ISR, between_s > 0. */
void app_disc_compare(app_disc_t *d, float turned_cnt, float mapped_cnt, float between_s);

/** o of the last edge [counts], EQ-DISC-2; 0 unless the map is in force. Context: control ISR. */
static inline float app_disc_off_cnt(const app_disc_t *d)
{
    return (d->state == APP_DISC_IN_FORCE) ? d->off_cnt : 0.0f;
}

/** Number of an edge in the turn that begins at the index. Context: control ISR, with have_zero. */
static inline uint16_t app_disc_place(const app_disc_t *d, uint16_t edge_cnt)
{
    const uint32_t from = (uint32_t)edge_cnt + (uint32_t)d->positions - (uint32_t)d->zero_cnt;

    return (uint16_t)((edge_cnt >= d->zero_cnt) ? (from - (uint32_t)d->positions) : from);
}

#endif /* APP_DISC_H */
