# SPDX-License-Identifier: MIT
# TI's C2000 compiler for the TMS320F28335. cmake/c2000.cmake has checked both paths by now.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR c28x)

if(NOT C2000_CGT_ROOT)
    set(C2000_CGT_ROOT "$ENV{C2000_CGT_ROOT}")
endif()
find_program(C2000_CL cl2000 PATHS "${C2000_CGT_ROOT}/bin" NO_DEFAULT_PATH)
find_program(C2000_AR ar2000 PATHS "${C2000_CGT_ROOT}/bin" NO_DEFAULT_PATH)
find_program(C2000_HEX hex2000 PATHS "${C2000_CGT_ROOT}/bin" NO_DEFAULT_PATH)
mark_as_advanced(C2000_CL C2000_AR C2000_HEX)

set(CMAKE_C_COMPILER "${C2000_CL}")
set(CMAKE_ASM_COMPILER "${C2000_CL}")
set(CMAKE_AR "${C2000_AR}" CACHE FILEPATH "")
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES C2000_CGT_ROOT)

# The ABI is never left to the compiler's default, which changed. Why EABI: docs/hardware.md.
set(c2000_device "--silicon_version=28 --unified_memory --abi=eabi --float_support=fpu32")
set(CMAKE_C_FLAGS_INIT "${c2000_device}")
set(CMAKE_ASM_FLAGS_INIT "${c2000_device}")
set(CMAKE_C_FLAGS_RELEASE_INIT "-O2 --opt_for_speed=4")
