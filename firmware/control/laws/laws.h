/* SPDX-License-Identifier: MIT */
/**
 * @file laws.h
 * @brief The list of laws: for each, one line for its state and one for its constants.
 *
 * A state in the list costs memory only, that of the largest one. The linker takes the functions of
 * the law that the tables name.
 */
#ifndef LAWS_H
#define LAWS_H

#include "law.h"
#include "law_conventional.h"
#include "law_dobc.h"
#include "law_ladrc.h"
#include "law_noc.h"
#include "law_noc_h.h"
#include "law_noc_iron.h"
#include "law_noc_shaft.h"
#include "law_noc_speed.h"
#include "law_pi_foc.h"
#include "law_pid.h"

#define LAW_OWN_FLOATS 16 /**< chosen: space for a law under test that is not in the list */

union law_state {
    law_noc_state_t          noc;
    law_noc_speed_state_t    noc_speed;
    law_noc_h_state_t        noc_h;
    law_noc_iron_state_t     noc_iron;
    law_noc_shaft_state_t    noc_shaft;
    law_conventional_state_t conventional;
    law_dobc_state_t         dobc;
    law_pid_state_t          pid;
    law_pi_foc_state_t       pi_foc;
    law_ladrc_state_t        ladrc;
    float                    own[LAW_OWN_FLOATS];
};

/** Memory for the constants of one law, when they come from an image. */
#ifdef LAW_CONSTANTS /* An image refuses the constants of a law that it does not link. */
typedef LAW_CONSTANTS law_constants_t;
#else
typedef union {
    law_noc_config_t          noc;
    law_noc_speed_config_t    noc_speed;
    law_noc_h_config_t        noc_h;
    law_noc_iron_config_t     noc_iron;
    law_noc_shaft_config_t    noc_shaft;
    law_conventional_config_t conventional;
    law_dobc_config_t         dobc;
    law_pid_config_t          pid;
    law_pi_foc_config_t       pi_foc;
    law_ladrc_config_t        ladrc;
} law_constants_t;
#endif

#endif /* LAWS_H */
