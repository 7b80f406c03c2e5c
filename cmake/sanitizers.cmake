# SPDX-License-Identifier: MIT
# Link PRIVATE to every target; empty unless SDRE_SANITIZE is on.
#
# C gets every check, and float division by zero besides: the core never divides by zero. C++ goes
# without the per-access pointer checks, and has line tables only: Eigen's templates then compile
# in half the time and memory, and AddressSanitizer still sees a bad access. Without -O1
# closed-loop tests would take minutes.
add_library(sdre_sanitizers INTERFACE)
if(SDRE_SANITIZE)
    set(sdre_sanitize_flags -fsanitize=address,undefined,float-cast-overflow)
    target_compile_options(sdre_sanitizers INTERFACE
        ${sdre_sanitize_flags} -fno-sanitize-recover=all -fno-omit-frame-pointer -O1
        $<$<COMPILE_LANGUAGE:C>:-fsanitize=float-divide-by-zero>
        "$<$<COMPILE_LANGUAGE:CXX>:-g1;-fno-sanitize=null,alignment,object-size,vptr>")
    target_compile_definitions(sdre_sanitizers INTERFACE
        $<$<COMPILE_LANGUAGE:CXX>:_GLIBCXX_ASSERTIONS>)
    target_link_options(sdre_sanitizers INTERFACE ${sdre_sanitize_flags})
endif()
