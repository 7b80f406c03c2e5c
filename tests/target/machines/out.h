/* SPDX-License-Identifier: MIT */
/**
 * @file out.h
 * @brief Characters out of a machine, and its end: one of the out_*.c files.
 */
#ifndef OUT_H
#define OUT_H

void out_init(void);
void out_char(int c);
/** Does not return; 0 is success. */
void out_end(int code);

#endif /* OUT_H */
