# SPDX-License-Identifier: MIT
# Hardening of the host tools against a memory error that nobody has found. Copies are checked, and an array on the stack has a
# guard behind it. Addresses of functions cannot be written once the program runs. Position-independent programs are the
# compiler's default on Debian. Test install.sbom reads the programs. Link it PRIVATE.
#
# A build with sanitizers finds more, and the core has the flags of the target.
add_library(sdre_hardening INTERFACE)
if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND NOT SDRE_SANITIZE)
    target_compile_options(sdre_hardening INTERFACE
        $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>:-fstack-protector-strong>
        $<$<AND:$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>,$<CONFIG:Release>>:-U_FORTIFY_SOURCE>
        $<$<AND:$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>,$<CONFIG:Release>>:-D_FORTIFY_SOURCE=2>)
    target_link_options(sdre_hardening INTERFACE LINKER:-z,relro LINKER:-z,now LINKER:-z,noexecstack)
endif()
