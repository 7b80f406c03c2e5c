/* SPDX-License-Identifier: MIT */
#include "motor.h"

#include "check.h"

bool motor_check(const motor_reduced_t *m)
{
    return check_not_negative(m->l1) && check_not_negative(m->l2) && check_positive(m->l3) &&
           check_positive(m->l4) && check_not_negative(m->l5) && check_positive(m->l6) &&
           check_positive(m->l7) && check_positive(m->l8) && check_positive(m->l9) &&
           check_positive(m->l10) && base_in_range(m->l11, -CHECK_LARGEST, 0.0f) &&
           check_positive(m->inv_l6) && check_positive(m->inv_l8);
}
