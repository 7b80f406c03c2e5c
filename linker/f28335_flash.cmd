/* SPDX-License-Identifier: MIT */
/* Stand-alone image: stored in flash, the control interrupt runs from RAM. Sections are those of EABI.
 *
 * Sector A holds the boot entry too: next to it are 0x33FF80..0x33FFF5 (has to be 0 where the security
 * module is used) and the passwords 0x33FFF8..0x33FFFF (all 0 locks the device for ever). Neither is in any range
 * below, so both stay erased, 0xFFFF. */
MEMORY
{
    BEGIN     : origin = 0x33FFF6, length = 0x000002 /* the boot ROM jumps here */
    STORE     : origin = 0x300000, length = 0x020000 /* sectors H to E: board_store_memory; nothing is linked there */
    FLASH     : origin = 0x320000, length = 0x01F000 /* sectors D .. B, and A far from its end */

    RAMM01    : origin = 0x000100, length = 0x000700 /* M0 and M1; 0x000000..0x00004F: stack of the boot ROM */
    RAML0123  : origin = 0x008000, length = 0x004000 /* no wait states, programs and data */
    RAML4567  : origin = 0x00C000, length = 0x004000 /* no wait states for data; apart, to be read beside a fetch */

    FPUTABLES : origin = 0x3FEBDC, length = 0x0006A0 /* boot ROM */
    RESET     : origin = 0x3FFFC0, length = 0x000002 /* boot ROM */
}

SECTIONS
{
    codestart    : > BEGIN

    /* These functions run once, or when a run begins. Their files are compiled for the RAM; named in front of .TI.ramfunc, they
     * are not taken by it. */
    .seldom      :
    {
        *(.TI.ramfunc:app_background)
        *(.TI.ramfunc:app_gate_check)
        *(.TI.ramfunc:app_gate_may_start)
        *(.TI.ramfunc:app_init)
        *(.TI.ramfunc:app_modes_init)
        *(.TI.ramfunc:app_scale_check)
        *(.TI.ramfunc:app_scale_init)
        *(.TI.ramfunc:app_scale_set_zero)
        *(.TI.ramfunc:app_take_parameters)
        *(.TI.ramfunc:app_tell_image)
        *(.TI.ramfunc:board_gate_enable)
        *(.TI.ramfunc:check)
        *(.TI.ramfunc:control_isr_init)
        *(.TI.ramfunc:cycles_init)
        *(.TI.ramfunc:cycles_wait)
        *(.TI.ramfunc:dobc_check)
        *(.TI.ramfunc:dobc_reset)
        *(.TI.ramfunc:drive_init)
        *(.TI.ramfunc:drive_reset)
        *(.TI.ramfunc:encoder_init)
        *(.TI.ramfunc:encoder_start)
        *(.TI.ramfunc:foc_check)
        *(.TI.ramfunc:foc_reset)
        *(.TI.ramfunc:law_noc_speed_reset)
        *(.TI.ramfunc:nodo_check)
        *(.TI.ramfunc:nodo_parity_check)
        *(.TI.ramfunc:nodo_reset)
        *(.TI.ramfunc:nosc_check)
        *(.TI.ramfunc:pid_law_check)
        *(.TI.ramfunc:pid_law_reset)
        *(.TI.ramfunc:pie_init)
        *(.TI.ramfunc:pie_start)
        *(.TI.ramfunc:pwm_init)
        *(.TI.ramfunc:pwm_start)
        *(.TI.ramfunc:read_status)
        *(.TI.ramfunc:speed_difference_check)
        *(.TI.ramfunc:speed_difference_reset)
        *(.TI.ramfunc:speed_ref_reset)
        *(.TI.ramfunc:tick_watch_start)
        *(.TI.ramfunc:trip_init)
        *(.TI.ramfunc:trip_overdue)
    }
                   > FLASH

    /* The control interrupt with everything it calls, the run-time library included. code_start copies it. */
    .TI.ramfunc  :
    {
        *(.TI.ramfunc)
#ifdef FAST_RTS
        -l rts2800_fpu32_fast_supplement_eabi.lib(.text)
#endif
        -l rts2800_fpu32_eabi.lib(.text)
    }
                   LOAD = FLASH,
                   RUN = RAML0123,
                   LOAD_START(codestart_code_load),
                   LOAD_SIZE(codestart_code_words),
                   RUN_START(codestart_code_run),
                   ALIGN(2)

    /* The law's entry points; copied likewise. */
    .tables      :
    {
        *(.const:law_*)
    }
                   LOAD = FLASH,
                   RUN = RAML4567,
                   LOAD_START(codestart_tables_load),
                   LOAD_SIZE(codestart_tables_words),
                   RUN_START(codestart_tables_run),
                   ALIGN(2)

    /* All constants of the drive, read in every period: main() fills it from the compiled ones or from the store. */
    .in_force    :
    {
        *(.bss:in_force)
    }
                   > RAML4567

    .text        : > FLASH
    .cinit       : > FLASH
    .const       : > FLASH
    .switch      : > FLASH
    .init_array  : > FLASH
    .binit       : > FLASH
    .ovly        : > FLASH
    .args        : > FLASH

    .stack       : > RAMM01, RUN_START(codestart_stack), RUN_SIZE(codestart_stack_words)
    .bss         : > RAML4567
    .bss:cio     : > RAML4567
    .data        : > RAML4567
    .sysmem      : > RAML4567
    .TI.noinit   : > RAML4567

    /* The fast math library's tables are in the ROM already; only their addresses are wanted. */
    FPUmathTables : > FPUTABLES, TYPE = NOLOAD

    /* The boot ROM has the reset vector. */
    .reset       : > RESET, TYPE = DSECT
}
