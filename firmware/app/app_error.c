/* SPDX-License-Identifier: MIT */
#include "app_error.h"

#define APP_FAULTS   ((uint16_t)APP_FAULT_FOLLOWING + 1U)
#define DRIVE_FAULTS ((uint16_t)DRIVE_FAULT_MEMORY + 1U)

uint16_t app_error_code(app_fault_t fault, drive_fault_t drive_fault)
{
    /* FF00 and up: faults without a code in the standard. */
    static const uint16_t of_app[APP_FAULTS] = {
        0x0000U, 0x6320U, /* CONFIG: parameter */
        0x5400U,          /* BOARD: power section */
        0x6010U,          /* BACKGROUND: watchdog */
        0x5200U,          /* SAMPLE: control hardware */
        0x5210U,          /* OFFSET: measuring circuit */
        0xFF06U,          /* TEMPERATURE_SENSOR */
        0x4310U,          /* TEMPERATURE: drive too hot */
        0x7305U,          /* INDEX: incremental sensor */
        0x7320U,          /* ALIGN: position */
        0x1000U,          /* DRIVE: the drive's own fault says more */
        0x6100U,          /* TICK: internal software */
        0x2310U,          /* HEAT: continuous over-current */
        0x5510U,          /* MEMORY: RAM */
        0xFF0EU,          /* COMMISSION */
        0x1000U,          /* CURRENT_SUM */
        0x8611U           /* FOLLOWING: following error */
    };

    static const uint16_t of_drive[DRIVE_FAULTS] = {
        0x1000U, 0x5200U, /* SAMPLE */
        0x2310U,          /* OVER_CURRENT */
        0x3200U,          /* DC_LINK: voltage in the drive */
        0x8400U,          /* OVER_SPEED */
        0x7305U,          /* ENCODER: incremental sensor */
        0x6320U,          /* COMMAND: parameter */
        0x6100U,          /* NUMERIC: internal software */
        0x5210U,          /* CURRENT_SENSOR: measuring circuit */
        0xFF19U,          /* PHASE */
        0x7122U,          /* MODEL: motor or commutation */
        0x7121U,          /* STALL: motor blocked */
        0x8400U,          /* AWAY: speed */
        0x5510U           /* MEMORY: RAM */
    };
    const uint16_t app   = (uint16_t)fault;
    const uint16_t drive = (uint16_t)drive_fault;

    if ((fault == APP_FAULT_DRIVE) && (drive < DRIVE_FAULTS)) {
        return of_drive[drive];
    }
    return (app < APP_FAULTS) ? of_app[app] : 0x1000U;
}
