# SPDX-License-Identifier: MIT
# Every option of the project is declared here; any other SDRE_* name stops configuration.
set(sdre_bool_options SDRE_BOARD_CHECK SDRE_BUILD_TESTS SDRE_SANITIZE)
set(sdre_path_options SDRE_IMAGE SDRE_PYTHON)

option(SDRE_BOARD_CHECK "Only compile the board layer against TI's headers, with this compiler" OFF)
option(SDRE_BUILD_TESTS "Build the tests (needs Unity and GoogleTest)" ON)
option(SDRE_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
set(SDRE_IMAGE "" CACHE STRING "Build the target's image: flash or ram (empty: host tools)")
set(SDRE_PYTHON "" CACHE STRING "Python with matplotlib, for plots (empty: look for one)")

# A refused value leaves the cache, so that the corrected command works at once.
get_cmake_property(sdre_cache_names CACHE_VARIABLES)
list(FILTER sdre_cache_names INCLUDE REGEX "^SDRE_")
foreach(name IN LISTS sdre_cache_names)
    if(name IN_LIST sdre_bool_options)
        string(TOUPPER "${${name}}" value)
        if(NOT value MATCHES "^(ON|OFF|TRUE|FALSE|YES|NO|1|0)$")
            set(refused "${${name}}")
            unset(${name} CACHE)
            message(FATAL_ERROR "${name}=${refused}: expected ON or OFF")
        endif()
    elseif(NOT name IN_LIST sdre_path_options)
        unset(${name} CACHE)
        list(JOIN sdre_bool_options " " known)
        message(FATAL_ERROR "unknown option ${name} (known: ${known} ${sdre_path_options})")
    endif()
endforeach()

if(NOT SDRE_IMAGE MATCHES "^(flash|ram|)$")
    set(refused "${SDRE_IMAGE}")
    unset(SDRE_IMAGE CACHE)
    message(FATAL_ERROR "SDRE_IMAGE=${refused}: expected flash or ram")
endif()
