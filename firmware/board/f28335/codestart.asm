; SPDX-License-Identifier: MIT
; First code after the boot ROM. The linker puts code_start where the boot ROM jumps to, and defines the
; symbols codestart_*.

        .def    code_start, board_copies
        .ref    _c_int00
        .ref    codestart_stack, codestart_stack_words
        .ref    codestart_code_load, codestart_code_run, codestart_code_words
        .ref    codestart_tables_load, codestart_tables_run, codestart_tables_words

STACK_FILL .set 0xC0DE                  ; what is still there was never used: see docs/hardware.md

        .sect   "codestart"
        .retain
code_start:
        LB      prepare

        .sect   ".text:codestart"
        .retain
prepare:
        SETC    OBJMODE                 ; a debugger's restart skips the boot ROM, which sets it
        EALLOW
        MOVL    XAR4, #0x7029           ; WDCR
        MOV     *+XAR4[0], #0x0068      ; watchdog off: this and the C start-up outlast its 4.4 ms

; Copying takes about 0.1 s at the clock of the start. The pins of gates and driver are low outputs before it.
        MOVB    ACC, #0x7F              ; GPIO0 .. GPIO6
        MOVL    XAR4, #0x6FC4           ; GPACLEAR
        MOVL    *+XAR4[0], ACC
        MOVL    XAR4, #0x6F8A           ; GPADIR; GPAMUX1 is 0 after a reset
        MOVL    *+XAR4[0], ACC
        EDIS

        MOVL    XAR5, #codestart_stack
        MOVL    XAR6, #codestart_stack_words
        MOV     AL, #STACK_FILL
        B       fill_check, UNC
fill:
        MOV     *XAR5++, AL
fill_check:
        BANZ    fill, AR6--

; Before C: the run-time library is among what is copied. None of it is called from here.
        MOVL    XAR4, #codestart_code_load
        MOVL    XAR5, #codestart_code_run
        MOVL    XAR6, #codestart_code_words
        B       code_check, UNC
code:
        MOV     AL, *XAR4++
        MOV     *XAR5++, AL
code_check:
        BANZ    code, AR6--

        MOVL    XAR4, #codestart_tables_load
        MOVL    XAR5, #codestart_tables_run
        MOVL    XAR6, #codestart_tables_words
        B       tables_check, UNC
tables:
        MOV     AL, *XAR4++
        MOV     *XAR5++, AL
tables_check:
        BANZ    tables, AR6--

        LB      _c_int00

; The copies, for the background: board_copy_t of peripherals.h
        .sect   ".const:board_copies"
        .retain
        .align  2
board_copies:
        .long   codestart_code_load, codestart_code_run, codestart_code_words
        .long   codestart_tables_load, codestart_tables_run, codestart_tables_words
        .end
