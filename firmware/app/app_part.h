/* SPDX-License-Identifier: MIT */
/**
 * @file app_part.h
 * @brief Marks of functions of the tick: `static` in a unit of firmware/one_unit, empty elsewhere.
 */
#ifndef APP_PART_H
#define APP_PART_H

#ifndef APP_PART
#define APP_PART /**< parts of one_unit/app.c */
#endif

#ifndef APP_MEASURE_PART
#define APP_MEASURE_PART /**< parts of one_unit/app_measure.c */
#endif

#endif /* APP_PART_H */
