/* SPDX-License-Identifier: MIT */
/* Where the image keeps what a trace shows: place and octets in the objects of app.c, as the cross
 * compiler has them. Nothing of this file runs. */
#include "app.c"

#define WORDS(name, object, member)                                                                \
    extern const uint32_t layout_##name[2];                                                        \
    __attribute__((section(".layout"), used))                                                      \
    const uint32_t layout_##name[2] = {(uint32_t)offsetof(__typeof__(object), member),             \
                                       (uint32_t)sizeof(((__typeof__(object) *)0)->member)}

#define SIZE(name)                                                                                 \
    extern const uint32_t                                    layout_of_##name;                     \
    __attribute__((section(".layout"), used)) const uint32_t layout_of_##name = sizeof name

SIZE(shared);
SIZE(tick_side);
WORDS(ticks, shared, ticks);
WORDS(command_full, shared, command_full);
WORDS(command, shared, command);
WORDS(board_faults, shared, board_faults);
WORDS(mode, tick_side, modes.mode);
WORDS(fault, tick_side, modes.fault);
WORDS(zero_a_cnt, tick_side, modes.scale.zero_a_cnt);
WORDS(zero_b_cnt, tick_side, modes.scale.zero_b_cnt);
WORDS(gate_on, tick_side, modes.gate_on);
WORDS(drive_state, tick_side, modes.drive.state);
WORDS(drive_fault, tick_side, modes.drive.fault);
WORDS(i_ref_A, tick_side, modes.drive.answer.i_ref_A);
WORDS(v_V, tick_side, modes.drive.v_V);
WORDS(d_omega, tick_side, modes.drive.answer.d_omega);
WORDS(d_q, tick_side, modes.drive.answer.d_q);
WORDS(d_d, tick_side, modes.drive.answer.d_d);
WORDS(commission_stage, tick_side, modes.commission.module.stage);
WORDS(commission_last_stage, tick_side, modes.commission.module.last_stage);
WORDS(commission_reason, tick_side, modes.commission.module.reason);
WORDS(commission_found, tick_side, modes.commission.module.found);
