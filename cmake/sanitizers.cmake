# SPDX-License-Identifier: MIT
# Link one of these PRIVATE to every target; all but sdre_test_code are empty unless SDRE_SANITIZE is on.
#
# sdre_sanitizers: C gets every check and float division by zero, because the core never divides by
# zero. C++ has no per-access pointer checks and only line tables. Eigen's templates then compile in
# half the time and memory, and AddressSanitizer still detects a bad access. Without -O1 closed-loop
# tests would take minutes.
#
# sdre_address_sanitizer: AddressSanitizer alone, for the solvers, whose arithmetic is Eigen's: with the
# checks of undefined behaviour its templates take a quarter longer to compile. Eigen's own assertions
# on sizes and indices stay.
#
# sdre_test_code: assertions alone, never optimised, for the code of the tests. This code takes longer
# to compile than to run, and a fifth of that time was for checks of the tests themselves. The
# tested code has its checks and is optimised.
add_library(sdre_sanitizers INTERFACE)
add_library(sdre_address_sanitizer INTERFACE)
add_library(sdre_test_code INTERFACE)
target_compile_options(sdre_test_code INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-O0>)
if(SDRE_SANITIZE)
    target_compile_options(sdre_test_code INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-g1>)
    # As Eigen allocates where AddressSanitizer is on: the one side frees what the other has made.
    target_compile_definitions(sdre_test_code INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=0)
    foreach(target sdre_sanitizers sdre_address_sanitizer)
        target_compile_options(${target} INTERFACE
            -fsanitize=address -fno-omit-frame-pointer $<$<COMPILE_LANGUAGE:CXX>:-g1>)
    endforeach()
    foreach(target sdre_sanitizers sdre_address_sanitizer sdre_test_code)
        target_compile_definitions(${target} INTERFACE
            $<$<COMPILE_LANGUAGE:CXX>:_GLIBCXX_ASSERTIONS>)
        target_link_options(${target} INTERFACE -fsanitize=address,undefined,float-cast-overflow)
    endforeach()
    target_compile_options(sdre_address_sanitizer INTERFACE -O2) # compiled in the time of -O1
    target_compile_options(sdre_sanitizers INTERFACE
        -O1 -fsanitize=undefined,float-cast-overflow -fno-sanitize-recover=all
        $<$<COMPILE_LANGUAGE:C>:-fsanitize=float-divide-by-zero>
        $<$<COMPILE_LANGUAGE:CXX>:-fno-sanitize=null,alignment,object-size,vptr>)
endif()
