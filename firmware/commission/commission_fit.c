/* SPDX-License-Identifier: MIT */
#include "commission_fit.h"

/* Below this squared sine of their angle, two columns are parallel in single precision. */
#define LEAST_SINE2 1.0e-5f

void commission_fit_reset(commission_fit_t *f)
{
    const commission_fit_t empty = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0L};
    *f                           = empty;
}

void commission_fit_add(commission_fit_t *f, float a, float b, float y)
{
    f->aa += a * a;
    f->ab += a * b;
    f->bb += b * b;
    f->ay += a * y;
    f->by += b * y;
    f->yy += y * y;
    f->n++;
}

commission_fitted_t commission_fit_solve(const commission_fit_t *f)
{
    commission_fitted_t out = {0.0f, 0.0f, 0.0f, 0.0f, false};
    const float         det = (f->aa * f->bb) - (f->ab * f->ab);

    if ((f->n < 2) || !(det > (LEAST_SINE2 * f->aa * f->bb))) {
        return out;
    }
    const float inv      = 1.0f / det; /* EQ-COMMISSION-1 */
    out.x0               = ((f->bb * f->ay) - (f->ab * f->by)) * inv;
    out.x1               = ((f->aa * f->by) - (f->ab * f->ay)) * inv;
    const float rest     = base_max((f->yy - (out.x0 * f->ay)) - (out.x1 * f->by), 0.0f);
    const float freedom  = (f->n > 2) ? (float)(f->n - 2) : 1.0f;
    const float variance = rest / freedom;
    out.error0           = 2.0f * sqrtf(variance * f->bb * inv);
    out.error1           = 2.0f * sqrtf(variance * f->aa * inv);
    out.valid            = true;
    return out;
}
