/* SPDX-License-Identifier: MIT */
/**
 * @file laws.h
 * @brief The list of laws: a line each, for its state and for its constants.
 *
 * Naming a state here costs memory (the largest counts), no code: a law's functions are linked when the tables name it.
 */
#ifndef LAWS_H
#define LAWS_H

#include "law.h"
#include "law_conventional.h"
#include "law_dobc.h"
#include "law_ladrc.h"
#include "law_noc.h"
#include "law_noc_h.h"
#include "law_noc_speed.h"
#include "law_pi_foc.h"
#include "law_pid.h"

#define LAW_OWN_FLOATS 16 /**< chosen: room for a law that is tried out before it is listed */

union law_state {
    law_noc_state_t          noc;
    law_noc_speed_state_t    noc_speed;
    law_noc_h_state_t        noc_h;
    law_conventional_state_t conventional;
    law_dobc_state_t         dobc;
    law_pid_state_t          pid;
    law_pi_foc_state_t       pi_foc;
    law_ladrc_state_t        ladrc;
    float                    own[LAW_OWN_FLOATS];
};

/** The constants of one law, in memory of their own: what an image gives a drive. */
#ifdef LAW_CONSTANTS /* An image refuses the constants of a law that it does not link. */
typedef LAW_CONSTANTS law_constants_t;
#else
typedef union {
    law_noc_config_t          noc;
    law_noc_speed_config_t    noc_speed;
    law_noc_h_config_t        noc_h;
    law_conventional_config_t conventional;
    law_dobc_config_t         dobc;
    law_pid_config_t          pid;
    law_pi_foc_config_t       pi_foc;
    law_ladrc_config_t        ladrc;
} law_constants_t;
#endif

#endif /* LAWS_H */
