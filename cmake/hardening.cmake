# SPDX-License-Identifier: MIT
# The host tools against a memory error that nobody has found: checked copies, a guard behind each array on the
# stack, and addresses of functions that cannot be written once the program runs. Link it PRIVATE. Position-independent
# programs are the compiler's default on Debian. Test install.sbom reads the programs.
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
