# SPDX-License-Identifier: MIT
# Where TI's software is: -D first, then the environment. Included before any compiler is looked for.
# Messages begin with a space: CMake then leaves them on one line.
# A later build finds the directory without the environment. Another environment replaces it, but not one given by -D.
foreach(name C2000_CGT_ROOT C2000WARE_ROOT)
    if(NOT "$ENV{${name}}" STREQUAL "" AND (NOT ${name} OR "${${name}}" STREQUAL "${c2000_environment_${name}}"))
        file(TO_CMAKE_PATH "$ENV{${name}}" root)
        set(${name} "${root}" CACHE PATH "" FORCE)
        set(c2000_environment_${name} "${root}" CACHE INTERNAL "what the environment said")
    endif()
endforeach()

set(c2000_f2833x device_support/f2833x)
set(c2000_needed_C2000_CGT_ROOT
    bin/cl2000 bin/ar2000 bin/hex2000 include/stdint.h lib/rts2800_fpu32_eabi.lib)
set(c2000_needed_C2000WARE_ROOT
    ${c2000_f2833x}/headers/include/DSP2833x_Device.h
    ${c2000_f2833x}/common/include/DSP28x_Project.h)
set(c2000_what_C2000_CGT_ROOT "TI's C2000 compiler")
set(c2000_what_C2000WARE_ROOT "C2000Ware")

# A refused value leaves the cache, so that the corrected command works at once.
macro(c2000_require name)
    if(NOT ${name})
        message(FATAL_ERROR
            " ${name} is not set: the directory of ${c2000_what_${name}}, in the environment or -D")
    endif()
    foreach(file IN LISTS c2000_needed_${name})
        if(NOT EXISTS "${${name}}/${file}" AND NOT EXISTS "${${name}}/${file}.exe")
            set(refused "${${name}}")
            unset(${name} CACHE)
            message(FATAL_ERROR
                " ${name}=${refused} is not ${c2000_what_${name}}: no ${file} there")
        endif()
    endforeach()
endmacro()

if(SDRE_IMAGE)
    c2000_require(C2000_CGT_ROOT)
    c2000_require(C2000WARE_ROOT)
elseif(SDRE_BOARD_CHECK AND C2000WARE_ROOT)
    c2000_require(C2000WARE_ROOT)
endif()

if(C2000WARE_ROOT)
    set(c2000_include_dirs
        "${C2000WARE_ROOT}/${c2000_f2833x}/headers/include"
        "${C2000WARE_ROOT}/${c2000_f2833x}/common/include")
endif()
