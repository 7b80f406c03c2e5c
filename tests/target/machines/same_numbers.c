/* SPDX-License-Identifier: MIT */
/* The shipped drive in closed loop with a crude rotor, on whatever machine: prints what it answers, in hexadecimal, for
 * machines.py to compare. Rotor and samples are made of sums and products, so that every machine has the same inputs. */
#include <string.h>

#include "drive_tick.h"
#include "gain_tables.h"
#include "out.h"

#define TICKS 3000
#define EVERY 20

/* What the rotor makes of the voltage; it need not be a good motor, only one that moves. */
typedef struct {
    float omega_e_radps;
    float theta_e_rad;
    dq_t  i_A;
} rotor_t;

static void put_word(float x)
{
    uint32_t bits;

    (void)memcpy(&bits, &x, sizeof bits);
    for (int16_t shift = 28; shift >= 0; shift = (int16_t)(shift - 4)) {
        out_char("0123456789abcdef"[(uint16_t)((bits >> shift) & 15U)]);
    }
    out_char(' ');
}

static drive_sample_t sample_of(const rotor_t *r)
{
    const abc_t i_A =
        frames_inverse_clarke(frames_inverse_park(r->i_A, frames_angle(r->theta_e_rad)));
    const drive_sample_t s = {.ia_A          = i_A.a,
                              .ib_A          = i_A.b,
                              .dc_link_V     = 295.0f,
                              .theta_e_rad   = r->theta_e_rad,
                              .omega_e_radps = r->omega_e_radps,
                              .valid         = true};
    return s;
}

static void move(rotor_t *r, const drive_t *d)
{
    const motor_reduced_t *m  = &d->config->motor;
    const float            ts = d->config->ts_s;
    const float            w  = r->omega_e_radps;
    const dq_t             i  = r->i_A;

    r->i_A.q += ts * ((m->l6 * d->v_V.q) - (m->l4 * i.q) - (m->l5 * w) - (m->l10 * w * i.d));
    r->i_A.d += ts * ((m->l8 * d->v_V.d) - (m->l7 * i.d) + (m->l9 * i.q * w));
    r->omega_e_radps += ts * ((m->l1 * i.q) - (m->l2 * w) + (m->l11 * i.q * i.d));
    r->theta_e_rad = frames_wrap(r->theta_e_rad + (ts * w));
}

int main(void)
{
    static drive_t  drive;
    rotor_t         rotor   = {100.0f, 0.5f, {0.0f, 0.0f}};
    drive_command_t command = {.omega_e_radps = 150.0f, .run = true};

    out_init();
    if (drive_init(&drive, &gain_tables_drive) != CTL_OK) {
        out_end(2);
    }
    for (int16_t n = 0; n < TICKS; n++) {
        const drive_sample_t sample = sample_of(&rotor);
        if ((n % 600) == 599) {
            command.omega_e_radps = -2.0f * command.omega_e_radps + 50.0f;
        }
        const bridge_t out = drive_tick(&drive, &sample, &command);
        move(&rotor, &drive);
        if ((n % EVERY) == 0) {
            put_word(out.duty.a);
            put_word(out.duty.b);
            put_word(out.duty.c);
            put_word(rotor.omega_e_radps);
            out_char('\n');
        }
    }
    out_end((drive.state == DRIVE_RUN) ? 0 : 3);
    return 0;
}
