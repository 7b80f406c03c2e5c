/* SPDX-License-Identifier: MIT */
/* Stand-alone image: stored in flash, the control interrupt runs from RAM. Sections are those of EABI.
 *
 * Sector A holds the boot entry only: next to it are 0x33FF80..0x33FFF5 (has to be 0 where the security
 * module is used) and the passwords 0x33FFF8..0x33FFFF (all 0 locks the device for ever). Neither is in any range
 * below, so both stay erased, 0xFFFF. */
MEMORY
{
    BEGIN     : origin = 0x33FFF6, length = 0x000002 /* the boot ROM jumps here */
    STORE     : origin = 0x300000, length = 0x020000 /* sectors H to E: board_store_memory; nothing is linked there */
    FLASH     : origin = 0x320000, length = 0x018000 /* sectors D .. B */

    RAMM0     : origin = 0x000050, length = 0x0003B0 /* below: stack of the boot ROM */
    RAMM1     : origin = 0x000400, length = 0x000400
    RAML0123  : origin = 0x008000, length = 0x004000 /* no wait states, programs and data */
    RAML4567  : origin = 0x00C000, length = 0x004000 /* no wait states for data; apart, to be read beside a fetch */

    FPUTABLES : origin = 0x3FEBDC, length = 0x0006A0 /* boot ROM */
    RESET     : origin = 0x3FFFC0, length = 0x000002 /* boot ROM */
}

SECTIONS
{
    codestart    : > BEGIN

    /* The control interrupt with everything it calls, the run-time library included, and what sets the flash's wait
     * states. code_start copies it. */
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

    .stack       : > RAMM1, RUN_START(codestart_stack), RUN_SIZE(codestart_stack_words)
    .bss         : > RAML4567
    .bss:cio     : > RAMM0
    .data        : > RAML4567
    .sysmem      : > RAMM0
    .TI.noinit   : > RAML4567

    /* The fast math library's tables are in the ROM already; only their addresses are wanted. */
    FPUmathTables : > FPUTABLES, TYPE = NOLOAD

    /* The boot ROM has the reset vector. */
    .reset       : > RESET, TYPE = DSECT
}
