# SPDX-License-Identifier: MIT
# Link PRIVATE to every target; empty unless SDRE_SANITIZE is on.
add_library(sdre_sanitizers INTERFACE)
if(SDRE_SANITIZE)
    set(sdre_sanitize_flags -fsanitize=address,undefined,float-cast-overflow)
    target_compile_options(sdre_sanitizers INTERFACE
        ${sdre_sanitize_flags}
        $<$<COMPILE_LANGUAGE:C>:-fsanitize=float-divide-by-zero> # the core never divides by zero
        -fno-sanitize-recover=all -fno-omit-frame-pointer
        -O1) # closed-loop tests take minutes without it
    target_compile_definitions(sdre_sanitizers INTERFACE
        $<$<COMPILE_LANGUAGE:CXX>:_GLIBCXX_ASSERTIONS>)
    target_link_options(sdre_sanitizers INTERFACE ${sdre_sanitize_flags})
endif()
