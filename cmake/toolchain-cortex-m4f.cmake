# SPDX-License-Identifier: MIT
# Cortex-M4F with Debian's gcc-arm-none-eabi: the machine on which a tick is counted. Like the F28335 it
# has single-precision hardware only, so a double would show as a call.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m4)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY) # an image needs its own start-up code

set(CMAKE_C_COMPILER arm-none-eabi-gcc)

# Square roots are one instruction, because no code reads errno. Enumerations are as on the host:
# the replay reads structures of the host. As with TI's compiler, limits without regard to NaN and
# signed zeros become minima and maxima. A call at the end of a function stays a call.
set(CMAKE_C_FLAGS_INIT
    "-g -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -fno-math-errno -fno-short-enums \
-ffinite-math-only -fno-signed-zeros -fno-optimize-sibling-calls")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostartfiles -Wl,--no-enum-size-warning,--fatal-warnings")
