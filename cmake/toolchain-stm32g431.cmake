# SPDX-License-Identifier: MIT
# STM32G431 with Debian's gcc-arm-none-eabi.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m4)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY) # an image needs its own start-up code

set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_AR arm-none-eabi-gcc-ar CACHE FILEPATH "knows the link-time optimizer's objects")
set(CMAKE_RANLIB arm-none-eabi-gcc-ranlib CACHE FILEPATH "as CMAKE_AR")

# Square roots are one instruction, because no code reads errno. Not a number is an input like any other, so no flag
# forbids it. Enumerations are as on the host.
set(CMAKE_C_FLAGS_INIT
    "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -fno-math-errno -fno-short-enums")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostartfiles -Wl,--no-enum-size-warning,--fatal-warnings")
