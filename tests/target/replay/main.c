/* SPDX-License-Identifier: MIT */
/**
 * @file main.c
 * @brief Replays recorded control periods (ticks.bin) and writes what came out (results.bin).
 *
 * The build names the law of this image: REPLAY_LAW, its object, and REPLAY_TICKS, its number in tick_file.h.
 *
 * The emulator gives every instruction the same virtual time and the timer counts that time, so the
 * timer's counts are instructions times a constant.
 */
#include <stddef.h>
#include <string.h>

#include "semihosting.h"
#include "tick_file.h"

enum { EXIT_DONE = 0, EXIT_INPUT, EXIT_LAYOUT };

/* Chosen: blocks that make the emulator's file calls rare. */
#define BLOCK_TICKS 512u

#define SYST_CSR   (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR   (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR   (*(volatile uint32_t *)0xE000E018u)
#define SYST_MASK  0x00FFFFFFu
#define SYST_START 5u /* enabled, processor clock */

static tick_file_run_t    run;
static drive_config_t     config;
static tick_file_tick_t   ticks[BLOCK_TICKS];
static tick_file_result_t results[BLOCK_TICKS];
static drive_t            drive;
static pi_foc_t           pi;

static tick_file_result_t replay(const tick_file_tick_t *t)
{
    const drive_sample_t sample = {
        .ia_A            = t->ia_A,
        .ib_A            = t->ib_A,
        .dc_link_V       = t->dc_link_V,
        .theta_e_rad     = t->theta_e_rad,
        .band_rad        = t->band_rad,
        .edge_gap_s      = t->edge_gap_s,
        .omega_e_radps   = t->omega_e_radps,
        .edge_age_s      = t->edge_age_s,
        .valid           = (t->flags & TICK_FILE_VALID) != 0u,
        .edge_of_pattern = (int16_t)((t->flags >> TICK_FILE_EDGE_SHIFT) & TICK_FILE_EDGE_MASK)};
    const bool            positions = (t->flags & TICK_FILE_POSITION) != 0u;
    const bool            torques   = (t->flags & TICK_FILE_TORQUE) != 0u;
    const law_aim_t       aim       = {.position = positions ? &t->position : NULL,
                                       .torque   = torques ? &t->torque : NULL};
    const drive_command_t command   = {.omega_e_radps = t->command_e_radps,
                                       .run           = (t->flags & TICK_FILE_RUN) != 0u,
                                       .derating      = t->derating,
                                       .aim           = (positions || torques) ? &aim : NULL};

    tick_file_to_drive(&t->drive, &drive);

    const uint32_t start  = SYST_CVR;
    const bridge_t law    = drive_tick(&drive, &sample, &command);
    const uint32_t middle = SYST_CVR;
    const bridge_t plain  = pi_foc_tick(&pi, &sample, &command);
    const uint32_t end    = SYST_CVR;

    const tick_file_result_t result = {.timer    = (start - middle) & SYST_MASK, /* counts down */
                                       .pi_timer = (middle - end) & SYST_MASK,
                                       .flags    = law.gate_enable ? TICK_FILE_GATE : 0u,
                                       .duty     = law.duty,
                                       .pi_duty  = plain.duty};
    return result;
}

static bool replay_run(int32_t in, int32_t out)
{
    uint32_t left = run.ticks;

    memcpy(&config, run.config, sizeof(run.config));
    config.law       = &REPLAY_LAW;
    config.constants = &run.constants;
    if (drive_init(&drive, &config) != CTL_OK) {
        return false;
    }
    pi_foc_init(&pi, &run.pi);
    while (left > 0u) {
        const uint32_t count = (left < BLOCK_TICKS) ? left : BLOCK_TICKS;
        if (!semihosting_read(in, ticks, count * (uint32_t)sizeof(ticks[0]))) {
            return false;
        }
        for (uint32_t k = 0u; k < count; k++) {
            results[k] = replay(&ticks[k]);
        }
        if (!semihosting_write(out, results, count * (uint32_t)sizeof(results[0]))) {
            return false;
        }
        left -= count;
    }
    return true;
}

int main(void)
{
    const int32_t in  = semihosting_open("ticks.bin", false);
    const int32_t out = semihosting_open("results.bin", true);

    SYST_RVR = SYST_MASK;
    SYST_CVR = 0u;
    SYST_CSR = SYST_START;
    while ((in >= 0) && (out >= 0) && semihosting_read(in, &run, (uint32_t)sizeof(run))) {
        if (run.ticks == 0u) {
            return EXIT_DONE;
        }
        if ((run.layout != TICK_FILE_LAYOUT) || (run.run_size != sizeof(run)) ||
            (run.tick_size != TICK_FILE_TICK_SIZE) || (run.law != (uint32_t)REPLAY_TICKS)) {
            return EXIT_LAYOUT;
        }
        if (!replay_run(in, out)) {
            return EXIT_INPUT;
        }
    }
    return EXIT_INPUT;
}
