/* SPDX-License-Identifier: MIT */
/* Image for a debugger (bench.c): everything in RAM, the flash stays as it is. Boot mode "SARAM", or set the program counter to
 * code_start. Sections are those of EABI. */
MEMORY
{
    BEGIN     : origin = 0x000000, length = 0x000002 /* the boot ROM jumps here */
    RAMM01    : origin = 0x000100, length = 0x000700 /* M0 and M1; 0x000000..0x00004F: stack of the boot ROM */
    RAML0123  : origin = 0x008000, length = 0x004000 /* no wait states, programs and data */
    RAML4567  : origin = 0x00C000, length = 0x004000 /* no wait states for data */

    FPUTABLES : origin = 0x3FEBDC, length = 0x0006A0 /* boot ROM */
    RESET     : origin = 0x3FFFC0, length = 0x000002 /* boot ROM */
}

SECTIONS
{
    codestart    : > BEGIN

    /* Loaded where they run; code_start copies them onto themselves. */
    .TI.ramfunc  :
    {
        *(.TI.ramfunc)
#ifdef FAST_RTS
        -l rts2800_fpu32_fast_supplement_eabi.lib(.text)
#endif
        -l rts2800_fpu32_eabi.lib(.text)
    }
                   > RAML0123,
                   LOAD_START(codestart_code_load),
                   LOAD_SIZE(codestart_code_words),
                   RUN_START(codestart_code_run),
                   ALIGN(2)
    .tables      :
    {
        *(.const:board_config)
    }
                   > RAML4567,
                   LOAD_START(codestart_tables_load),
                   LOAD_SIZE(codestart_tables_words),
                   RUN_START(codestart_tables_run),
                   ALIGN(2)

    .text        : > RAML0123
    .switch      : > RAML0123
    .cinit       : > RAML4567
    .const       : > RAML4567
    .init_array  : > RAML4567
    .binit       : > RAML4567
    .ovly        : > RAML4567
    .args        : > RAML4567

    .stack       : > RAMM01, RUN_START(codestart_stack), RUN_SIZE(codestart_stack_words)
    .bss         : > RAML4567
    .bss:cio     : > RAML4567
    .data        : > RAML4567
    .sysmem      : > RAML4567
    .TI.noinit   : > RAML4567

    FPUmathTables : > FPUTABLES, TYPE = NOLOAD
    .reset       : > RESET, TYPE = DSECT
}
