/* SPDX-License-Identifier: MIT */
/* Force-included into board/f28335: there sdre-sil holds two boards, and board.h's names belong to the one that
 * chooses (board_choice.cpp). */
#ifndef F28335_NAMES_H
#define F28335_NAMES_H

#define board_fits             f28335_board_fits
#define board_init             f28335_board_init
#define board_loader_is_wanted f28335_board_loader_is_wanted
#define board_restart          f28335_board_restart
#define board_kept             f28335_board_kept
#define board_line_fits        f28335_board_line_fits
#define board_line_set         f28335_board_line_set
#define board_store            f28335_board_store
#define board_store_erase      f28335_board_store_erase
#define board_store_program    f28335_board_store_program
#define board_can_fits         f28335_board_can_fits
#define board_can_set          f28335_board_can_set
#define board_can_listen       f28335_board_can_listen
#define board_can_read         f28335_board_can_read
#define board_can_arm          f28335_board_can_arm
#define board_can_triggered    f28335_board_can_triggered
#define board_can_write        f28335_board_can_write
#define board_can_state        f28335_board_can_state
#define board_inputs           f28335_board_inputs
#define board_brake_write      f28335_board_brake_write
#define board_chopper_write    f28335_board_chopper_write
#define board_start            f28335_board_start
#define board_sample           f28335_board_sample
#define board_duty_write       f28335_board_duty_write
#define board_gate_enable      f28335_board_gate_enable
#define board_gate_trip        f28335_board_gate_trip
#define board_fault_read       f28335_board_fault_read
#define board_reset_cause      f28335_board_reset_cause
#define board_cycles           f28335_board_cycles
#define board_memory_is_whole  f28335_board_memory_is_whole
#define board_watchdog_serve   f28335_board_watchdog_serve
#define board_serial_read      f28335_board_serial_read
#define board_serial_write     f28335_board_serial_write

#endif /* F28335_NAMES_H */
