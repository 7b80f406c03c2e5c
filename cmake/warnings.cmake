# SPDX-License-Identifier: MIT
# The warning policy; link these PRIVATE. project_warnings is for C, project_warnings_cxx for C++.
add_library(project_warnings INTERFACE)
target_compile_options(project_warnings INTERFACE
    $<$<COMPILE_LANG_AND_ID:C,GNU,Clang,AppleClang>:
        -Wall -Wextra -Wpedantic -Werror
        -Wconversion -Wsign-conversion -Wdouble-promotion -Wfloat-conversion
        -Wshadow -Wundef -Wcast-qual -Wfloat-equal -Wswitch-enum
        -Wstrict-prototypes -Wmissing-prototypes -Wvla
        -ffp-contract=off>)

add_library(project_warnings_cxx INTERFACE)
target_compile_options(project_warnings_cxx INTERFACE
    $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:
        -Wall -Wextra -Wpedantic -Werror -Wshadow -Wconversion>)
